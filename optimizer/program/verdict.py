"""What an answer may claim: one rule for single answers, sweeps and fronts.

The bound and the value are compared as they are. A bound above the value by no more than the rounding error of the
value is lowered to it. A bound further above contradicts the answer, and then nothing is proven.
"""

import logging
import math
from functools import cache
from types import ModuleType

import numpy as np

from optimizer.numerics.arrays import Complex, Real, Reals, all_true, of_programs_of, spread
from optimizer.numerics.records import record
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.certificate import Multipliers, ceiling_allowance
from optimizer.program.points import Points, points_at
from optimizer.program.scaling import natural_reach
from optimizer.program.statement import Statement

_LOG = logging.getLogger(__name__)
#: an answer whose total mass is not certified this closely, in units of its yardstick, is called inaccurate
MASS_GAP = 1e-4
#: of the least mass that could cancel something: smaller differences of mass do not count
_MASS_SHARE = CEILING_TOLERANCE / MASS_GAP
#: rounding of a mass, relative to it
_MASS_ROUNDING = 1e-13
_OPTIMAL = np.array("optimal")
#: the outcome of a bound above its value: :func:`optimizer.program.kernel.verdicts.verdicts`
_CONTRADICTED = 4

OPTIMAL = "Proven optimal: the gap to the lower bound is within the requested gap, and every limit is kept."
OPTIMAL_LIGHTEST = (
    "Proven optimal: the gap to the lower bound is within the requested gap, and every limit is kept. The total mass is"
    " proven minimum to 1e-4 of its reference value."
)
ON_THE_BOUNDARY = "The ceilings are neither kept nor proven infeasible: they lie on the boundary of the feasible peaks."
NOT_CLOSE = "The objective is not certified to the requested gap."
NOT_LIGHT = "The total mass is not certified as minimum."
CONTRADICTED = "Nothing is proven: a bound contradicts the answer, which is a fault of the service."
INFEASIBLE = "Proven infeasible: no counterweights within the limits keep the ceilings."


@record(frozen=True)
class Verdict:
    """What is proven of answers; NaN where nothing is."""

    status: np.ndarray  # (...) "optimal" or "inaccurate"
    reason: np.ndarray  # (...) a sentence
    lower_bound: Real  # (..., G) of every goal
    gap: Real  # (..., G) goal minus its bound
    relative_gap: Real  # (...) the largest gap over its yardstick
    mass_lower_bound: Real  # (...) kg
    mass_gap: Real  # (...) total mass above its bound, over its yardstick
    mass_yardstick: Real  # (...) kg


@record(frozen=True)
class Claim:
    """Goals that were made small, with what is proven: nothing is below the bounds in all of them.

    There is one goal, G = 1, but for the two of a front.
    """

    value: Real  # (..., G)
    lower_bound: Real  # (..., G)
    rounding: Real  # (..., G) of the value
    yardstick: Real  # (..., G)
    excess: Real  # (...) largest relative excess over a ceiling, -inf without ceilings
    mass: Real  # (...) kg
    mass_resolution: Real  # (...) kg, smaller differences of mass do not count
    mass_lower_bound: Real | None  # (...) kg; None without a search for the least mass
    contradicted: bool = False  # another bound on the path to this one is above its value


def claim(
    statement: Statement,
    u: Complex,
    mass: Real,
    lower_bound: Real,
    multipliers: Multipliers | None,
    mass_lower_bound: Real | None,
    point: Points | None = None,
) -> Claim:
    """What counterweights come to, of one goal.

    The bound is made to hold for all that exceed the ceilings by no more than these counterweights do.

    Parameters
    ----------
    u : (..., K) kg m.
    mass : (...) kg, of the counterweights as they are returned.
    lower_bound, multipliers : of the objective, with its proof; None where there is none.
    point : what they come to, where that has been worked out.
    """
    point, size = points_at(statement, u) if point is None else point, yardstick(statement)[..., None]
    allowance: Reals = 0.0
    if multipliers is not None and (point.excess > 0).any():
        allowance = _allowance(statement, u, multipliers, point.excess)
    return Claim(
        point.objective[..., None],
        np.asarray(lower_bound - allowance)[..., None],
        point.rounding[..., None],
        size,
        point.excess,
        mass,
        mass_resolution(statement, size),
        mass_lower_bound,
    )


def _allowance(statement: Statement, u: Complex, multipliers: Multipliers, excess: Real) -> Real:
    """What a bound falls by for counterweights (..., K) that exceed ceilings, mostly few of many (...)."""
    if excess.ndim != 1 or statement.flat.leading != excess.shape:
        return ceiling_allowance(statement, multipliers, statement.ceilings.excess(u))
    (over,) = (excess > 0).nonzero()
    part, allowance = statement.subset(over), np.zeros(excess.shape)
    allowance[over] = ceiling_allowance(part, multipliers.subset(over), part.ceilings.excess(u[over]))
    return allowance


def verdict(claim: Claim, tolerance: float) -> Verdict:
    """Judge answers.

    Parameters
    ----------
    tolerance : largest gap, in units of the yardsticks, that is certified enough.
    """
    leading, several = claim.value.shape[:-1], claim.value.shape[-1]
    many, of_mass, of_programs = math.prod(leading), claim.mass_lower_bound is not None, of_programs_of(leading)
    goals = claim.value, claim.lower_bound, claim.rounding, claim.yardstick
    masses = (
        claim.excess,
        claim.mass,
        claim.mass_resolution,
        claim.mass if claim.mass_lower_bound is None else claim.mass_lower_bound,
    )
    proven, figures, outcome = np.empty((2, many, several)), np.empty((4, many)), np.empty(many, np.int64)
    worst = _verdicts().verdicts(
        *[of_programs(values, 1) for values in goals],
        *[of_programs(values, 0) for values in masses],
        of_mass,
        bool(claim.contradicted),
        float(tolerance),
        CEILING_TOLERANCE,
        MASS_GAP,
        _MASS_ROUNDING,
        proven,
        figures,
        outcome,
    )
    if worst == _CONTRADICTED:
        false = np.count_nonzero(outcome == _CONTRADICTED)
        _LOG.error("a lower bound is above the value of an answer: %d of %d", false, many)
    why = OPTIMAL_LIGHTEST if of_mass else OPTIMAL
    if worst == 0:
        status, reason = spread(_OPTIMAL, leading), spread(np.asarray(why, dtype=object), leading)
    else:
        place = outcome.reshape(leading)
        status = np.where(place == 0, "optimal", "inaccurate")
        # objects, as texts take the room of the longest in each design
        reason = np.asarray(np.array([why, NOT_LIGHT, NOT_CLOSE, ON_THE_BOUNDARY, CONTRADICTED], object)[place], object)
    bound, relative = proven.reshape(2, *leading, several), figures.reshape(4, *leading)
    # to iterate over an array ends with an error that takes longer than the views do
    return Verdict(status, reason, bound[0], bound[1], relative[0], relative[1], relative[2], relative[3])


def yardstick(statement: Statement) -> Real:
    """What gaps are relative to: the objective without counterweights; where that is 0, what they could change (...).

    That is the sum over terms and webs of what the counterweight that cancels everything, or the largest that fits,
    does to a term.
    """
    rest = statement.at_rest
    if rest > 0 if rest.ndim == 0 else all_true(rest > 0):
        return rest
    reach = np.minimum(statement.limits.reach, natural_reach(statement)[..., None])
    change = np.add.reduce(np.abs(statement.norms.influence) * reach[..., None, :], axis=(-2, -1))
    return np.where(rest > 0, rest, change)


def mass_resolution(statement: Statement, yardstick: Real) -> Real:
    """Smallest difference of masses that counts (...), kg.

    It is 1e-5 of the least mass that could cancel a row of the objective, or the response under a ceiling, at the web
    where a kilogram does most. So the gap that it allows, 1e-4 of it, changes either by no more than ceilings may be
    exceeded by. No minimum mass is more accurate than the ceilings that it is to keep.

    Parameters
    ----------
    yardstick : (..., 1) of the objective or (..., rows) of its rows.
    """
    return _MASS_SHARE * statement.flat.least_masses(yardstick)


# loads the compiler, a tenth of a second, and so at the first call; an import at each takes as long as a short loop
@cache
def _verdicts() -> ModuleType:
    from optimizer.program.kernel import verdicts

    return verdicts
