"""Which stages solve programs, many at once, and which of their points are taken, each with its own proof."""

import time
from functools import partial

import numpy as np

from optimizer.numerics.arrays import Complex, Real, all_true
from optimizer.numerics.records import record
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.certificate import Multipliers, nothing_proven
from optimizer.program.compiled_evaluation import Shares
from optimizer.program.kernel.finer_numbers import Precision
from optimizer.program.methods.disc_programs import disc_stages, suits_discs
from optimizer.program.methods.rounding import HEAVIER, RUNGS
from optimizer.program.methods.stage_ends import StageEnds, Tolerances, in_finer_numbers, solve_stages
from optimizer.program.points import points_at
from optimizer.program.solution import CEILING_ROUNDING, Solutions, side_by_side
from optimizer.program.statement import Statement

_DOUBLE = Tolerances(1e-5, 1e-12, 1e-9, 1e-7, 2e-12)
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
    until: float = np.inf,
) -> StageSolutions:
    """Both stages of N statements of one shape, one leading axis (N,).

    The result for one program does not depend on the others.

    Parameters
    ----------
    share : (N,) how far above the smallest objective an optimum may be, in units of the objective.
    demand : (N,) target gap; one above the share is met by less than the best.
    precision : solve in finer numbers, interpreted: a thousand times slower.
    at_least : (N,) lower bound of the objective under the ceilings, which may be far more than at rest.
    until : time.thread_time() after which finer numbers raise
        :class:`optimizer.program.kernel.finer_numbers.OutOfTime`; compiled ones end by themselves.
    """
    if precision is not None:
        finest = precision.finest
        finer = Tolerances(1e-7, finest, 100 * finest, precision.mass, 0.1 * CEILING_ROUNDING)
        solved = solve_stages(statement, share, least_mass, finer, in_finer_numbers(precision, until), at_least)
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

    Where the ceilings are kept without counterweights, the optimum without ceilings mostly keeps them too. That is
    sought first: what is proven without ceilings is proven with them. It is sought again where it is above one.
    """
    if not statement.ceilings.names:
        solved = solve_stages(statement, share, least_mass, _DOUBLE, disc_stages, at_least)
        return _judged(statement, share, demand, least_mass, solved)
    ceilings = statement.ceilings
    below = np.logical_and.reduce(statement.constant_sizes[:, -len(ceilings.names) :] <= ceilings.cap, axis=-1)
    method = partial(disc_stages, without_ceilings=below)
    solved = solve_stages(statement, share, least_mass, _DOUBLE, method, at_least)
    stages = _judged(statement, share, demand, least_mass, solved)
    left = np.flatnonzero(below & ~stages.certified)
    if left.size:
        part = statement.subset(left)
        solved = solve_stages(part, share[left], least_mass, _DOUBLE, disc_stages, at_least[left])
        stages.put(left, _judged(part, share[left], demand[left], least_mass, solved))
    return stages


def _out_of_reach(statement: Statement) -> np.ndarray:
    """Whether the ceilings of N programs are proven to be out of reach (N,) bool: then no method ends well."""
    excess, tolerance = statement.excess(), np.full(statement.floor.shape[:-1], CEILING_TOLERANCE)
    nearest = _judged(excess, tolerance, tolerance, False, solve_stages(excess, tolerance, False, _DOUBLE))
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


def _guess(statement: Statement, share: Real, least_mass: bool) -> StageEnds:
    if not suits_discs(statement, least_mass).all():
        return solve_stages(statement, share, least_mass, _DOUBLE)
    guess = solve_stages(statement, share, least_mass, _DOUBLE, disc_stages)
    # prices are above 0 where a stage has ended
    last = guess.mass_proof if least_mass else guess.proof
    left = np.flatnonzero(np.minimum(guess.proof.row, last.row)[:, 0] <= 0.0)
    if left.size:
        guess.put(left, solve_stages(statement.subset(left), share[left], least_mass, _DOUBLE))
    return guess


def _general(statement: Statement, share: Real, demand: Real, least_mass: bool, at_least: Real) -> StageSolutions:
    """Both stages of programs of any limits; under ceilings what is left is tried once more."""
    solved = solve_stages(statement, share, least_mass, _DOUBLE, at_least=at_least)
    stages = _judged(statement, share, demand, least_mass, solved)
    if not statement.ceilings.names or stages.certified.all():
        return stages
    left = np.flatnonzero(~stages.certified)
    excess, tolerance = statement.subset(left).excess(), np.full(left.size, CEILING_TOLERANCE)
    nearest = solve_stages(excess, tolerance, False, _DOUBLE).smallest
    room = points_at(statement.subset(left), nearest).excess < 0
    left, inside = left[room], nearest[room]
    for tolerances in (_DOUBLE, _ELSEWHERE):
        if not left.size:
            break
        part = statement.subset(left)
        if tolerances is _DOUBLE:
            points = solved.subset(left)
        else:
            points = solve_stages(part, share[left], least_mass, tolerances, at_least=part.objective(inside))
        again = _judged(part, share[left], demand[left], least_mass, points.pulled(part, inside))
        stages.put(left[again.certified], again.subset(again.certified))
        left, inside = left[~again.certified], inside[~again.certified]
    return stages


def _judged(statement: Statement, share: Real, demand: Real, least_mass: bool, solved: StageEnds) -> StageSolutions:
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
