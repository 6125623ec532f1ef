"""The whole program for one machine: smallest objective, ceilings, least mass."""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from optimizer.arrays import Complex
from optimizer.program.certificate import Multipliers, nothing_proven
from optimizer.program.fast import fast
from optimizer.program.kernel.finer_numbers import PRECISIONS, Precision
from optimizer.program.reach import bounded, far_limits
from optimizer.program.reference.solver import Solver, excess_program
from optimizer.program.solution import INTERIOR_POINT, OPTIMUM_SHARE, Solution
from optimizer.program.statement import CEILING_TOLERANCE, Statement
from optimizer.program.verdict import yardstick

#: the smallest objective is sought this much more sharply than optima are told apart
_SHARPNESS = 1e-4
#: relative gap of the least mass that ends the search
_MASS_GAP = 1e-6
#: relative gap of the least mass above which finer numbers are worth their time
_MASS_WORTH = 1e-5


@dataclass(frozen=True)
class Unreachable:
    """Proof that no counterweights keep the ceilings, and those that come closest."""

    closest: Complex  # (K,) kg m
    excess: float  # largest relative excess over a ceiling of the closest
    excess_lower_bound: float  # > 0
    certify_s: float  # time spent on bounds
    multipliers: Multipliers  # of the excess: rows and terms are those of the ceilings, each over its size


def within_reach(statement: Statement, solver: Solver) -> Statement:
    """One program with a finite, proven limit where there is none, or one far beyond any need (reach.py)."""
    if not np.any(far_limits(statement)):
        return statement
    point = np.zeros(statement.limits.radius.shape, complex)
    if np.any(statement.ceilings.excess(point) > 0):
        excess = excess_program(statement.ceilings, statement.limits)
        excess = bounded(excess, _above(excess, point))
        nearest = solver.smallest_objective(excess, 0.1 * CEILING_TOLERANCE)
        if nearest.lower_bound > 0:
            return replace(statement, limits=excess.limits)
        point = nearest.unbalance
        if nearest.objective > CEILING_TOLERANCE:
            return bounded(statement, np.inf)
    return bounded(statement, _above(statement, point))


def _above(statement: Statement, point: Complex) -> float:
    """A level that leaves room for all that counts as an optimum, if this point may be reached."""
    value = float(statement.objective(point))
    return value + (value - float(np.min(statement.floor)))


def optimum(statement: Statement, relative_gap: float, least_mass: bool, solver: Solver) -> Solution | Unreachable:
    """Certified optimum of a statement; webs that cannot carry anything are left out of the program.

    Parameters
    ----------
    statement : one whose limits are finite (:func:`within_reach`).
    relative_gap : asked gap, relative to the objective without counterweights.
    least_mass : take the least total mass among the optima.

    Returns
    -------
    Solution, whose gap tells how far it is certified and whose excess whether the ceilings are kept
    (if neither could be decided, on the very boundary, they are not); or the proof that they cannot be.
    """
    webs = statement.limits.reach > 0
    part = statement.only(webs)
    size = float(yardstick(part))
    share, demand = min(OPTIMUM_SHARE, relative_gap) * size, relative_gap * size
    quick = _interior_point(part, share, demand, least_mass) if np.any(webs) else None
    if quick is not None and quick.certified:
        found: Solution | Unreachable = quick.lightest
    else:
        found = _by_cone_program(part, share, least_mass, solver, quick)
        for precision in PRECISIONS:
            if _proven(found, share, least_mass) or not 0 < part.limits.radius.size <= precision.most_webs:
                break
            fine = _interior_point(part, share, demand, least_mass, precision)
            found = fine.lightest if fine.certified else _better_of(found, fine.lightest, share)
    if isinstance(found, Unreachable):
        return replace(found, closest=_everywhere(found.closest, webs))
    found = replace(found, unbalance=_everywhere(found.unbalance, webs))
    if least_mass and found.mass_multipliers is None:
        # nothing is proven about the mass but that it is not below 0
        found = replace(found, mass_multipliers=nothing_proven(part), mass_target=found.objective + share)
    return found


def _by_cone_program(
    statement: Statement, share: float, least_mass: bool, solver: Solver, known: "_Found | None"
) -> Solution | Unreachable:
    first = solver.smallest_objective(statement, _SHARPNESS * share, known.smallest if known else None)
    if first.excess > 0:
        # perhaps only by rounding: the sign of the smallest excess decides
        nearest = solver.smallest_excess(statement.ceilings, statement.limits)
        certify_s = first.certify_s + nearest.certify_s
        if nearest.lower_bound > 0:
            assert nearest.multipliers is not None  # they are what proves the bound
            return Unreachable(
                nearest.unbalance, nearest.objective, nearest.lower_bound, certify_s, nearest.multipliers
            )
        first = replace(first, certify_s=certify_s)
        if not first.keeps_ceilings:
            first = first.moved_to(statement, nearest.unbalance)
    if least_mass and first.keeps_ceilings:
        first = solver.least_mass(statement, first, share, _MASS_GAP, known.lightest if known else None)
    return first


def _proven(found: Solution | Unreachable, share: float, least_mass: bool) -> bool:
    """Whether finer numbers are not worth their time."""
    if isinstance(found, Unreachable):
        return True
    proven = found.keeps_ceilings and found.gap <= share
    return proven and (not least_mass or found.mass - found.mass_lower_bound <= _MASS_WORTH * found.mass)


def _better_of(one: Solution | Unreachable, other: Solution, share: float) -> Solution | Unreachable:
    """The better point with the better bound on the objective; of two optima the lighter one."""
    if isinstance(one, Unreachable) or not other.keeps_ceilings:
        return one
    one = one.bounded(other.lower_bound, other.multipliers)
    bound = one.lower_bound
    both_optimal = max(one.objective, other.objective) - bound <= share
    lighter = other.mass < one.mass
    chosen = other if not one.keeps_ceilings or (lighter if both_optimal else other.objective < one.objective) else one
    # a bound on the mass holds for its own first stage only, unless that stage was the worse one
    heavier = other if other.mass_lower_bound > one.mass_lower_bound else one
    proof = heavier if both_optimal else chosen
    return replace(
        chosen.bounded(bound, one.multipliers),
        mass_lower_bound=proof.mass_lower_bound,
        mass_multipliers=proof.mass_multipliers,
        mass_target=proof.mass_target,
    )


class _Found(NamedTuple):
    """What the interior point found."""

    smallest: Solution
    lightest: Solution
    certified: bool


def _interior_point(
    statement: Statement, share: float, demand: float, least_mass: bool, precision: Precision | None = None
) -> _Found:
    found = fast(statement.alone(), np.array([share]), np.array([demand]), least_mass, precision)
    method = precision.name if precision else INTERIOR_POINT
    nothing = Solution(
        found.smallest[0],
        np.inf,
        float(found.lower_bound[0]),
        np.inf,
        0.0,
        np.inf,
        method,
        found.certify_s,
        found.multipliers.chosen(0),
    )
    smallest = nothing.moved_to(statement, found.smallest[0])
    lightest = smallest
    if least_mass:
        lightest = replace(
            smallest,
            mass_lower_bound=float(found.mass_lower_bound[0]),
            mass_multipliers=found.mass_multipliers.chosen(0),
            mass_target=float(found.mass_target[0]),
        )
    return _Found(smallest, lightest.moved_to(statement, found.unbalance[0]), bool(found.certified[0]))


def _everywhere(u: Complex, webs: np.ndarray) -> Complex:
    everywhere = np.zeros(webs.shape, complex)
    everywhere[webs] = u
    return everywhere
