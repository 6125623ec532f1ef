"""Which method is tried when: for one program that the compiled interior point leaves open (docs/mathematics.md, 9).

Without ceilings, one after the other, each from the point and bound so far: polish, reference solver, finer numbers.
With ceilings a first phase decides whether they can be kept, and with how much room:

    out of reach             the proof of that is the answer
    rest is an optimum       the answer, but for the tolerance of the ceilings
    room below them          polish and reference solver, under the ceilings as they are
    on the edge, or no proof all methods again, under the ceilings raised by the tolerance that they have
"""

from dataclasses import replace

import numpy as np

from optimizer.numerics.arrays import Complex
from optimizer.program.certificate import Multipliers, nothing_proven, objective_lower_bound
from optimizer.program.kernel.finer_numbers import OutOfTime, Precision, finest
from optimizer.program.methods.compiled import ENOUGH, TARGET, suits_kernel
from optimizer.program.methods.feasibility_phase import (
    AMPLE,
    at_rest,
    proven_again,
    raised,
    smallest_excess,
)
from optimizer.program.methods.inactive_rows import ActiveRows, near_rows
from optimizer.program.methods.polish import lightened, polished
from optimizer.program.methods.rounding import snap_to_limits
from optimizer.program.methods.single import StagePair, Target, enough, interior_point
from optimizer.program.points import points_at
from optimizer.program.reference.solver import least_mass, smallest_objective
from optimizer.program.solution import CEILING_ROUNDING, CLOSED_FORM, CONE_PROGRAM, ConeSolution, evaluated
from optimizer.program.statement import Statement

#: the smallest objective is sought this much more sharply than the tolerance between optima
_SHARPNESS = 1e-4
#: relative gap of the least mass that ends the search
_MASS_GAP = 1e-6


def cascade(statement: Statement, target: Target, quick: StagePair) -> ConeSolution:
    """Certified optimum of one program whose webs can all carry something.

    Parameters
    ----------
    quick : point and multipliers of the compiled interior point, not certified.

    Returns
    -------
    ConeSolution, whose gap states how far it is certified and whose excess whether the ceilings are kept; or the proof
    that they cannot be. On the very boundary, where neither can be decided, they are not kept.
    Where time is up the methods that have begun are the last.
    """
    find = _under_ceilings if statement.ceilings.names else _by_all
    solution = find(statement, target, quick)
    if solution.conflict is not None:
        return solution
    if target.least_mass and solution.mass_multipliers is None:
        # nothing is proven about the mass but that it is not below 0
        solution = replace(
            solution, mass_multipliers=nothing_proven(statement), mass_target=solution.objective + target.share
        )
    return _snap(statement, target, solution)


def _snap(statement: Statement, target: Target, solution: ConeSolution) -> ConeSolution:
    """The same without dust, and at the limits that it touches."""
    limit = solution.objective
    if solution.below_ceilings:
        # what exceeds the ceilings is judged by a lower bound
        share = (TARGET if target.least_mass else ENOUGH) * target.share
        nearest = solution.lower_bound + share - float(statement.rounding(solution.unbalance))
        # no further than what is proven of the mass holds
        limit = min(nearest, max(solution.mass_target, limit))
    bound = np.array([solution.mass_lower_bound]) if target.least_mass else None
    alone = statement.alone()
    points = snap_to_limits(alone, points_at(alone, solution.unbalance[None]), np.array([limit]), bound)
    return solution.with_point(statement, points.unbalance[0])


def _under_ceilings(statement: Statement, target: Target, quick: StagePair) -> ConeSolution:
    """With ceilings: first whether they can be kept, and with how much room (docs/mathematics.md section 9)."""
    nearest = smallest_excess(statement, target.until)
    if nearest.lower_bound > CEILING_ROUNDING:
        # that ceilings cannot be kept is a finding of the reference solver alone
        method = CONE_PROGRAM if nearest.unbalance.size else CLOSED_FORM
        none = evaluated(statement, nearest.unbalance)
        return replace(none, method=method, certify_s=nearest.certify_s, conflict=nearest.multipliers)
    if target.least_mass and (rest := at_rest(statement, target, quick.smallest)):
        return replace(rest, certify_s=rest.certify_s + nearest.certify_s)
    if nearest.objective <= -AMPLE:
        solution = _by_all(statement, target, quick, nearest.unbalance, finer=False)
        if enough(solution, target):
            return replace(solution, certify_s=solution.certify_s + nearest.certify_s)
    # what stands on the edge, or is too steep to be proven, takes up the tolerance of its ceilings
    higher = raised(statement)
    if not target.late:
        quick = interior_point(higher, target, inside=nearest.unbalance)
    solution = quick.lightest if quick.certified else _by_all(higher, target, quick, nearest.unbalance)
    return proven_again(statement, replace(solution, certify_s=solution.certify_s + nearest.certify_s))


def _by_all(
    statement: Statement,
    target: Target,
    quick: StagePair,
    inside: Complex | None = None,
    finer: bool = True,
) -> ConeSolution:
    """One method after the other, each from the point and bound so far.

    Parameters
    ----------
    inside : a point as far below the ceilings as there is.
    finer : whether finer numbers are tried too.
    """
    quick = lightened(statement, target, polished(statement, target, quick, inside))
    if quick.certified:
        return quick.lightest
    solution = smallest_objective(statement, _SHARPNESS * target.share, quick.smallest, lambda _: target.late)
    if statement.row.size == 1 and statement.limits.radius.size and solution.gap > target.demand:
        solution = _single_term(statement, solution)
    if target.least_mass and solution.below_ceilings:
        solution = least_mass(statement, solution, target.share, _MASS_GAP, quick.lightest, lambda _: target.late)
    precision = finest(statement.limits.radius.size) if finer and suits_kernel(statement) else None
    if precision is None or enough(solution, target) or target.late:
        return solution
    return _in_finer_numbers(statement, target, solution, precision, inside)


def _in_finer_numbers(
    statement: Statement, target: Target, solution: ConeSolution, precision: Precision, inside: Complex | None
) -> ConeSolution:
    """The better of a solution and of what finer numbers find, whose time grows with the rows.

    Rows far below the largest, as those of scenarios that decide nothing, are left out first.
    """
    rows = near_rows(statement, solution.unbalance)
    while True:
        active = ActiveRows.of(statement, rows)
        try:
            fine = _finer(active.program, target, precision, inside)
        except OutOfTime:
            return solution
        whole = active.over_all(statement, fine.lightest)
        above = near_rows(statement, whole.unbalance) & ~rows
        if not np.any(above) or whole.objective <= fine.lightest.objective:
            return whole if fine.certified else _better_of(solution, whole, target.share)
        rows |= above


def _finer(statement: Statement, target: Target, precision: Precision, inside: Complex | None) -> StagePair:
    stages = polished(statement, target, interior_point(statement, target, precision, inside), inside)
    return lightened(statement, target, stages, precision)


def _single_term(statement: Statement, solution: ConeSolution) -> ConeSolution:
    """The better of a point and of what each web comes to alone, exact of the only term, and what that term proves.

    Where one web does 1e10 times as much with a kilogram as another, no units suit both in a solver. What is left of
    the term at an optimum points along its multiplier (the projection onto a convex set).
    """
    constant, influence = statement.norms.constant[0], statement.norms.influence[0]
    does = influence != 0
    alone = statement.limits.into(np.diag(np.where(does, -constant / np.where(does, influence, 1.0), 0.0)))
    best = solution.with_point(statement, alone[np.argmin(statement.objective(alone))])
    solution = best if best.below_ceilings and best.objective < solution.objective else solution
    left = constant + influence @ solution.unbalance
    if left == 0:
        return solution
    along = Multipliers(np.array([left / abs(left)]), np.ones(1), np.zeros_like(statement.ceilings.norms.constant))
    return solution.bounded(float(objective_lower_bound(statement, along)), along)


def _better_of(first: ConeSolution, second: ConeSolution, share: float) -> ConeSolution:
    """The better point with the better bound on the objective; of two optima the one that is closer to the least mass.

    A bound on the mass holds for what comes to no more than its own first stage counts as an optimum. That of the other
    may come to more, since its first stage was another.
    """
    first = first.bounded(second.lower_bound, second.multipliers)
    if not second.below_ceilings:
        return first
    bound, solutions = first.lower_bound, (first, second)
    if not first.below_ceilings:
        better = proof = second
    elif max(first.objective, second.objective) - bound > share:
        better = proof = min(solutions, key=lambda solution: solution.objective)
    else:
        pairs = (
            (candidate, of)
            for candidate in solutions
            for of in solutions
            if of is candidate or candidate.objective <= of.mass_target
        )
        better, proof = min(pairs, key=lambda pair: pair[0].mass - pair[1].mass_lower_bound)
    return replace(
        better.bounded(bound, first.multipliers),
        mass_lower_bound=proof.mass_lower_bound,
        mass_multipliers=proof.mass_multipliers,
        mass_target=proof.mass_target,
    )
