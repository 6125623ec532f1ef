"""The compiled interior point behind the certificate: many programs at once, each with its own proof."""

import time
from collections.abc import Callable
from functools import cache, partial
from types import ModuleType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real, all_true, in_order, mapped, parts, plain
from optimizer.numerics.records import record
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.certificate import Multipliers, nothing_proven
from optimizer.program.compiled_evaluation import Dual, Shares
from optimizer.program.kernel.finer_numbers import Precision, solve_in
from optimizer.program.methods.disc_programs import disc_stages, suits_discs
from optimizer.program.methods.rounding import HEAVIER, RUNGS
from optimizer.program.points import points_at
from optimizer.program.scaling import cancelling
from optimizer.program.solution import CEILING_ROUNDING, Solutions, side_by_side
from optimizer.program.statement import Statement

if TYPE_CHECKING:
    from optimizer.program.kernel.interior_point import Programs

#: both stages, as :func:`optimizer.program.kernel.interior_point.solve`, of programs in units of their own
Method = Callable[..., tuple[Any, ...]]


class _Tolerances(NamedTuple):
    """Gaps at which the stages end."""

    sharpness: float  # first stage, as a share of what optima may differ by, between finest and coarsest
    finest: float
    coarsest: float
    mass: float  # second stage, relative to the mass
    ceilings: float  # share of their size by which ceilings are lowered, so that the answer keeps them


_DOUBLE = _Tolerances(1e-5, 1e-12, 1e-9, 1e-7, 2e-12)
#: what rounding ended early under ceilings mostly ends well when they are a hair elsewhere
_ELSEWHERE = _DOUBLE._replace(ceilings=2e-11)
#: largest gap of the first stage that is good enough, as a share of what optima may differ by, where its point is
#: the answer and where the lightest is; and the largest relative gap of the mass
ENOUGH, ENOUGH_FOR_MASS, MASS_ENOUGH = 1e-3, 1e-2, 1e-5
#: optima reach this far into the share, which leaves room for rounding
TARGET = 1.0 - 1e-7
_SHARES = Shares(TARGET, ENOUGH_FOR_MASS, MASS_ENOUGH, HEAVIER, CEILING_ROUNDING, CEILING_TOLERANCE)
_SHARES_OF_ANY_MASS = _SHARES._replace(enough=ENOUGH)
#: norms from which on it takes longer than a sparse solver, of which it factors three unknowns each
MOST_NORMS = 150


@record(frozen=True)
class StageSolutions(Solutions):
    """Where both stages of N programs ended: of the points that they came upon the lightest that is an optimum."""

    smallest: Complex  # (N, K) kg m, of the smallest objective in either stage, whatever its mass
    certified: np.ndarray  # (N,) bool: nothing better is worth looking for


def suits_kernel(statement: Statement) -> bool:
    """Whether the compiled interior point takes such programs; others are cone programs.

    They have one group, real influences, no webs that are to be alike, and not too many norms.
    """
    real = not statement.norms.is_complex and not statement.ceilings.norms.is_complex
    few = statement.row.size <= MOST_NORMS
    return bool(real and few and statement.group[-1] == 0 and statement.limits.alike is None)


def stage_solutions(
    statement: Statement,
    share: Real,
    demand: Real,
    least_mass: bool,
    precision: Precision | None = None,
    at_least: Real | float = 0.0,
) -> StageSolutions:
    """Both stages of N statements of one shape, one leading axis (N,).

    The result for one program does not depend on the others.

    Parameters
    ----------
    share : (N,) how far above the smallest objective an optimum may be, in units of the objective.
    demand : (N,) target gap; one above the share is met by less than the best.
    precision : solve in finer numbers, interpreted: a thousand times slower.
    at_least : (N,) lower bound of the objective under the ceilings, which may be far more than at rest.
    """
    if precision is not None:
        finest = precision.finest
        finer = _Tolerances(1e-7, finest, 100 * finest, precision.mass, 0.1 * CEILING_ROUNDING)
        solved = _solve(statement, share, least_mass, finer, _in(precision), at_least)
        return _judged(statement, share, demand, least_mass, solved)
    (discs,) = suits_discs(statement, least_mass).nonzero()
    level = at_least if isinstance(at_least, np.ndarray) else np.full(share.shape, at_least)
    if not discs.size:
        return _general(statement, share, demand, least_mass, level)
    if discs.size == share.size:
        quick = _as_discs(statement, share, demand, least_mass, level)
        if not all_true(quick.certified):
            left = np.flatnonzero(~quick.certified)
            if statement.ceilings.names:
                left = left[~_out_of_reach(statement.subset(left))]
            if left.size:
                part = statement.subset(left)
                quick.put(left, _general(part, share[left], demand[left], least_mass, level[left]))
        return quick
    quick = _as_discs(statement.subset(discs), share[discs], demand[discs], least_mass, level[discs])
    certain = discs[quick.certified]
    left = np.setdiff1d(np.arange(share.size), certain)
    rest = _general(statement.subset(left), share[left], demand[left], least_mass, level[left])
    return side_by_side([quick.subset(quick.certified), rest], np.argsort(np.concatenate([certain, left])))


def _as_discs(statement: Statement, share: Real, demand: Real, least_mass: bool, at_least: Real) -> StageSolutions:
    """Both stages of programs that all suit the interior point for discs.

    Ceilings that are kept without counterweights mostly are kept by the optimum without them too, and that is what is
    sought then: what is proven without ceilings is proven with them. It is sought again where it is above one.
    """
    if not statement.ceilings.names:
        return _judged(
            statement, share, demand, least_mass, _solve(statement, share, least_mass, _DOUBLE, disc_stages, at_least)
        )
    ceilings = statement.ceilings
    below = np.logical_and.reduce(statement.constant_sizes[:, -len(ceilings.names) :] <= ceilings.cap, axis=-1)
    method = partial(disc_stages, without_ceilings=below)
    solved = _solve(statement, share, least_mass, _DOUBLE, method, at_least)
    stages = _judged(statement, share, demand, least_mass, solved)
    left = np.flatnonzero(below & ~stages.certified)
    if left.size:
        part = statement.subset(left)
        solved = _solve(part, share[left], least_mass, _DOUBLE, disc_stages, at_least[left])
        stages.put(left, _judged(part, share[left], demand[left], least_mass, solved))
    return stages


def _out_of_reach(statement: Statement) -> np.ndarray:
    """Whether the ceilings of N programs are proven to be out of reach (N,) bool: then no method ends well."""
    excess, tolerance = statement.excess(), np.full(statement.floor.shape[:-1], CEILING_TOLERANCE)
    nearest = _judged(excess, tolerance, tolerance, False, _solve(excess, tolerance, False, _DOUBLE))
    return np.asarray(nearest.lower_bound > CEILING_ROUNDING)


def unproven(statement: Statement, share: Real, least_mass: bool) -> tuple[Complex, Complex]:
    """Where both stages of N statements end, a guess: whether it is near an optimum is not looked at.

    Parameters are those of :func:`stage_solutions`.

    Returns
    -------
    Unbalances (N, K) kg m, and multipliers (N, J + I) of the terms and ceilings in the last stage.
    """
    guess = _guess(statement, share, least_mass)
    proof = guess.mass_proof if least_mass else guess.proof
    prices = np.concatenate([proof.term, proof.ceiling], axis=-1)
    return guess.lightest if least_mass else guess.smallest, prices


def ends(statement: Statement, share: Real, least_mass: bool) -> tuple[Complex, Complex]:
    """Where the first stage of N statements ends and where the last, guesses likewise (N, K) kg m."""
    guess = _guess(statement, share, least_mass)
    return guess.smallest, guess.lightest


def _guess(statement: Statement, share: Real, least_mass: bool) -> "_Solved":
    if not suits_discs(statement, least_mass).all():
        return _solve(statement, share, least_mass, _DOUBLE)
    guess = _solve(statement, share, least_mass, _DOUBLE, disc_stages)
    # prices are above 0 where a stage has ended
    last = guess.mass_proof if least_mass else guess.proof
    left = np.flatnonzero(np.minimum(guess.proof.row, last.row)[:, 0] <= 0.0)
    if left.size:
        guess.put(left, _solve(statement.subset(left), share[left], least_mass, _DOUBLE))
    return guess


def _general(statement: Statement, share: Real, demand: Real, least_mass: bool, at_least: Real) -> StageSolutions:
    """Both stages of programs of any limits; under ceilings what is left is tried once more."""
    solved = _solve(statement, share, least_mass, _DOUBLE, at_least=at_least)
    stages = _judged(statement, share, demand, least_mass, solved)
    if not statement.ceilings.names or stages.certified.all():
        return stages
    left = np.flatnonzero(~stages.certified)
    nearest = _solve(statement.subset(left).excess(), np.full(left.size, CEILING_TOLERANCE), False, _DOUBLE).smallest
    room = points_at(statement.subset(left), nearest).excess < 0
    left, inside = left[room], nearest[room]
    for tolerances in (_DOUBLE, _ELSEWHERE):
        if not left.size:
            break
        part = statement.subset(left)
        if tolerances is _DOUBLE:
            points = solved.subset(left)
        else:
            points = _solve(part, share[left], least_mass, tolerances, at_least=part.objective(inside))
        again = _judged(part, share[left], demand[left], least_mass, points.pulled(part, inside))
        stages.put(left[again.certified], again.subset(again.certified))
        left, inside = left[~again.certified], inside[~again.certified]
    return stages


def _judged(statement: Statement, share: Real, demand: Real, least_mass: bool, solved: "_Solved") -> StageSolutions:
    """Of the points of both stages the ones to take, with their proofs."""
    began = time.perf_counter()
    judgement = statement.flat.judge(
        share,
        demand,
        statement.constant_sizes,
        _SHARES if least_mass else _SHARES_OF_ANY_MASS,
        (solved.smallest, solved.lightest),
        solved.proof.parts,
        solved.mass_proof.parts if least_mass else None,
        RUNGS,
    )
    certify_s = time.perf_counter() - began
    figures = judgement.figures
    return StageSolutions(
        unbalance=judgement.unbalance,
        objective=figures[0],
        lower_bound=judgement.lower_bound,
        mass=figures[1],
        mass_lower_bound=judgement.mass_lower_bound,
        excess=figures[2],
        multipliers=Multipliers(*judgement.proof),
        mass_multipliers=solved.mass_proof if least_mass else nothing_proven(statement),
        mass_target=judgement.mass_target,
        certify_s=np.full(share.shape, certify_s / max(share.size, 1)),
        clean=judgement.clean,
        smallest=judgement.smallest,
        certified=judgement.certified,
    )


@record(frozen=True)
class _Solved:
    """Where the stages of N programs ended."""

    smallest: Complex  # (N, K) kg m, the end of the first stage
    lightest: Complex  # (N, K) kg m, the end of the second one
    proof: Multipliers  # (N, ...), of the objective
    mass_proof: Multipliers  # (N, ...), of the mass

    def subset(self, programs: np.ndarray) -> "_Solved":
        return mapped(self, lambda array: array[programs])

    def put(self, programs: np.ndarray, rivals: "_Solved") -> None:
        """Others in place of some."""
        self.smallest[programs], self.lightest[programs] = rivals.smallest, rivals.lightest
        self.proof.put(programs, rivals.proof)
        self.mass_proof.put(programs, rivals.mass_proof)

    def pulled(self, statement: Statement, inside: Complex) -> "_Solved":
        points = pulled(statement, self.smallest, inside), pulled(statement, self.lightest, inside)
        return _Solved(*points, self.proof, self.mass_proof)


def _solve(
    statement: Statement,
    share: Real,
    least_mass: bool,
    tolerances: _Tolerances,
    method: Method | None = None,
    at_least: Real | float = 0.0,
) -> _Solved:
    if statement.limits.radius.shape[-1] == 0:
        # nothing to choose
        nothing, proof = np.zeros(statement.limits.radius.shape, complex), nothing_proven(statement)
        return _Solved(nothing, nothing, proof, proof)
    reach, unit, demands = _scales(statement, share, tolerances, at_least)
    result = (method or _by_interior_point)(
        statement, reach, unit, tolerances.ceilings, least_mass, demands[0], demands[1], tolerances.mass
    )
    points, (term, row, ceiling) = _physical(statement, (reach, unit), *result)
    proofs = Multipliers(term[0], row[0], ceiling[0]), Multipliers(term[1], row[1], ceiling[1])
    return _Solved(points[0], points[1], *proofs)


def _physical(
    statement: Statement, scales: tuple[Real, Real], v: Complex, cone: Real, row: Real, mass_unit: Real
) -> tuple[Complex, Dual]:
    """Points (2, N, K) kg m within all limits, and multipliers (2, N, ...), where both stages ended.

    Parameters
    ----------
    scales : of :func:`_scales`.
    v, cone, row, mass_unit : as a method finds them.
    """
    programs, points, stages = statement.flat.programs, np.empty(v.shape, complex), v.shape[:2]
    terms, ceilings = programs.owner.size, programs.size.shape[1]
    proof = np.empty((*stages, terms), complex), np.empty(row.shape), np.empty((*stages, ceilings), complex)
    arrays = in_order(v), in_order(cone), in_order(row), in_order(mass_unit)
    _units().physical(*arrays, *scales, programs.size, programs.vectors[0], points, *proof, *programs.region)
    return points, proof


def _scales(
    statement: Statement, share: Real, tolerances: _Tolerances, at_least: Real | float
) -> tuple[Real, Real, Real]:
    """How far webs reach (N, K), the unit of the objective (N,), and in that the share and the target gap (2, N)."""
    region, influence = statement.flat.programs.region, in_order(statement.norms.influence)
    many, _, webs = influence.shape
    reach, unit, demands = np.empty((many, webs)), np.empty(many), np.empty((2, many))
    _disc_forms().scales(
        in_order(statement.constant_sum),
        influence,
        np.abs(cancelling(statement)),
        in_order(statement.single_reach),
        region.radius,
        region.max_mass,
        region.budget,
        at_least if isinstance(at_least, np.ndarray) else np.full(many, at_least),
        in_order(share),
        tolerances.sharpness,
        tolerances.finest,
        tolerances.coarsest,
        reach,
        unit,
        demands,
    )
    return reach, unit, demands


def pulled(statement: Statement, u: Complex, inside: Complex) -> Complex:
    """Points above a ceiling, moved towards ones below it just so far; excesses are convex (..., K)."""
    above, below = points_at(statement, np.array([u, inside])).excess
    needed = above > CEILING_ROUNDING
    step = np.where(needed, above / np.where(needed, above - np.minimum(below, 0.0), 1.0), 0.0)
    return u + step[..., None] * (inside - u)


def _by_interior_point(statement: Statement, reach: Real, unit: Real, margin: float, *stages: Any) -> tuple[Any, ...]:
    # the compiler is loaded at its first use
    from optimizer.program.kernel.interior_point import solve

    return _in_frame(statement, *solve(_programs(statement, reach, unit, margin), *stages))


def _in(precision: Precision) -> Method:
    """Interpreted, in finer numbers, which warn where compiled ones end in a NaN, and the search with it."""

    def method(statement: Statement, reach: Real, unit: Real, margin: float, *stages: Any) -> tuple[Any, ...]:
        with np.errstate(all="ignore"):
            arrays = solve_in(precision)(_programs(statement, reach, unit, margin), *stages)
        return _in_frame(statement, *(np.asarray(values, dtype=float) for values in arrays))

    return method


def _in_frame(statement: Statement, v: Real, *rest: Any) -> tuple[Any, ...]:
    """Unbalances along and across the sectors (2, N, 3, K), after the sizes, as vectors."""
    limits = statement.limits
    return limits.centre * (v[:, :, 1] + 1j * limits.half_angle_sin * v[:, :, 2]), *rest


def _programs(statement: Statement, reach: Real, unit: Real, margin: float) -> "Programs":
    from optimizer.program.kernel.interior_point import Programs

    limits, norms, ceilings = statement.limits, statement.norms, statement.ceilings
    constant = np.concatenate([norms.constant / unit[:, None], ceilings.norms.constant / ceilings.size], axis=-1)
    influence = np.concatenate(
        [norms.influence / unit[:, None, None], ceilings.norms.influence / ceilings.size[..., None]], axis=-2
    )
    cap = ceilings.cap / ceilings.size
    mass = reach / limits.radius
    highest = np.maximum.reduce(statement.floor, axis=-1)
    budget = limits.max_total_mass[:, None]
    # where nothing is left no web reaches anything
    over = np.add.reduce(mass, axis=-1, keepdims=True) > budget
    programs = Programs(
        row=statement.row.astype(np.int64),
        floor=(statement.floor - highest[:, None]) / unit[:, None],
        cap=cap - np.clip(cap, 0.0, margin),
        constant=parts(constant),
        influence=influence * reach[:, None, :],
        centre=parts(limits.centre),
        sine=limits.half_angle_sin,
        cosine=limits.half_angle_cos,
        sector=np.where(limits.free, 0.0, 1.0),
        mass=mass,
        budget=mass / np.where(over, budget, np.inf),
    )
    return Programs(*(plain(values) for values in programs))


# loads the compiler, a tenth of a second, and so at the first call; an import at each takes as long as a short loop
@cache
def _disc_forms() -> ModuleType:
    from optimizer.program.kernel import disc_forms

    return disc_forms


@cache
def _units() -> ModuleType:
    from optimizer.program.kernel import units

    return units
