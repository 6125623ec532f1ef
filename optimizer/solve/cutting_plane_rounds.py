"""Choices for a program over the turn, in rounds: the best by finitely many cuts, what it truly comes to, and the cuts
that tell the two apart.

No choice comes to less than its cuts: what is proven of all choices by these holds over the turn. A choice with its
own cuts in the program cannot return below its true value, so that rounds end at the target gap.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.choices.discrete.options import EQUAL
from optimizer.choices.feasible_set import Choice, FeasibleSet, SearchResult, Subproblem
from optimizer.numerics.arrays import Complex
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.cuts.cut import Cut, Pool, distinct
from optimizer.program.cuts.exact_penalty import under_levels
from optimizer.program.cuts.optimum import CertifiedOptimum
from optimizer.program.cuts.row_generation import FEW, MANY, single_group
from optimizer.program.cuts.semi_infinite import Problem
from optimizer.program.methods.discs import in_discs
from optimizer.solve.answer_fields import bound_beside

#: width of the brackets that compare choices, as a share of goals and ceilings
_CLOSE = 1e-10
#: what a search may leave open of the target gap, and of the present gap as long as that is more
_GAP_SHARE, _LEFT = 0.5, 0.25
#: share of the time left that a search has, unless the one before has shown nothing new
_TURN = 0.3
#: angles at which every peak has a cut from the start: choices by few cuts are good at those alone
_ANGLES = 24
#: choices whose rows a tree is of
_RECENT = 8
#: share of the largest value of a quantity from which on its other maxima are cuts too
_HIGH = 0.9
#: prices of goals that come first: where programs are solved, and where choices are only judged
_STEEP, _SHEER = 1e3, 1e9


class Start(NamedTuple):
    """What rounds begin with, and where they may end."""

    incumbent: Choice | None = (
        None  # that keeps ceilings and goals; where goals come first and are solved there has to be one
    )
    level: float = -np.inf  # the search ends once it is decided whether any comes to no more; -inf asks for the best
    hints: Sequence[Complex] = ()  # (K,) kg m, near which good choices may be


_NOTHING = Start()


def in_rounds(
    program: Problem,
    best: CertifiedOptimum,
    choices: FeasibleSet,
    relative_gap: float,
    size: float,
    left_s: Callable[[], float],
    start: Start = _NOTHING,
) -> tuple[Choice, SearchResult]:
    """The best choice, and what is proven of all.

    Parameters
    ----------
    program : whose last goal is to be small.
    best : its optimum of any masses at any angles, with the most that the goals before it may come to.
    relative_gap : target gap.
    size : what gaps are relative to, in units of the goal.
    left_s : what is left of the time limit.
    """
    incumbent, level, hints = start
    # choices keep ceilings to a tolerance, which is worth something of the goal
    gap, resolution, relaxation_bound = relative_gap * size, EQUAL * size, bound_beside(best.proof, CEILING_TOLERANCE)
    pool, points, case_of = Pool(_first_cuts(program), program.scatter), best.point.unbalance[None], program.case_of
    most = np.array([goal.most for goal in best.goals[:-1]])
    kinds = program.goal_of_case
    if program.finite is not None and incumbent is None:
        # the program is exact, and needs no cuts
        whole = choices.relaxation(replace(program.finite, limits=best.limits))
        last = choices.best(Subproblem(whole, points, relaxation_bound, relative_gap, size, left_s()))
        result = last.result
        bound = np.inf if result.lower_bound == np.inf else max(relaxation_bound, result.lower_bound)
        return last, replace(result, lower_bound=bound)
    bound, least, leader, stuck = relaxation_bound, np.inf, incumbent, not program.quantities
    if incumbent is not None:
        points = np.concatenate([points, incumbent.unbalance[None]])
        least = float(program.values(incumbent.unbalance, _CLOSE).goals[-1])
    points = np.concatenate([points, *(hint[None] for hint in hints)])
    for point in points:
        _learn(program, pool, point)
    at_rest, nodes, rounds = float(program.at_rest.goals[-1]), 0, 0

    def ended(result: SearchResult, proven: bool, early: str | None) -> SearchResult:
        lower = np.inf if result.lower_bound == np.inf else bound
        return SearchResult(leader is not None, lower, nodes, result.method, proven, early, rounds, pool.count())

    while True:
        rounds += 1
        statement = replace(program.outer(pool.cuts), limits=best.limits).spelled()
        recent = points[[0, *range(max(1, len(points) - _RECENT), len(points))]]
        loose = in_discs(under_levels(statement, program, most, bound, _STEEP), choices.reach, inside=False)
        below = single_group(loose, case_of, recent, FEW, kinds)
        if choices.solved:
            # a choice below the incumbent keeps the goals that come first
            whole = in_discs(under_levels(statement, program, most, least, _STEEP), choices.reach, inside=True)
            whole = single_group(whole, case_of, recent, FEW, kinds)
        else:
            whole = under_levels(statement, program, most, bound, _SHEER)
            # a statement is of one sum
            whole = single_group(whole, case_of, points, MANY, kinds) if case_of[-1] > 0 else whole
        tolerance = _GAP_SHARE * gap if stuck else max(_GAP_SHARE * gap, _LEFT * (min(least, at_rest) - bound))
        left = left_s() * (1.0 if stuck else _TURN)
        last = choices.best(Subproblem(whole, points, bound, tolerance / size, size, left, below))
        result, nodes = last.result, nodes + last.result.nodes
        if result.lower_bound == np.inf:
            # none keeps the cuts of the ceilings
            return last, ended(result, False, None)
        before, bound = (bound, least), max(bound, result.lower_bound)
        values = program.values(last.unbalance, _CLOSE)
        value, feasible = float(values.goals[-1]), bool(np.all(values.goals[:-1] <= most))
        if feasible and values.excess <= CEILING_TOLERANCE and value <= least + resolution:
            least, leader = min(value, least), last
        closed = least - bound <= max(gap, resolution) or least <= level or -np.inf < level < bound
        learnt = _learn(program, pool, last.unbalance)
        if most.size:
            # closer brackets separate levels better
            learnt |= bound > before[0] + resolution or least < before[1] - resolution
        if closed or left_s() <= 0.0 or (stuck and not learnt):
            all_compared = closed and leader is last and result.proven
            early = None if closed else result.ended or ("time" if left_s() <= 0.0 else "cuts")
            return leader or last, ended(result, all_compared, early)
        stuck, points = not learnt, np.concatenate([points, last.unbalance[None]])


def _first_cuts(program: Problem) -> list[list[Cut]]:
    """Cuts to begin with."""
    angle = np.linspace(0.0, 2.0 * np.pi, _ANGLES, endpoint=False)
    cuts_of = [list(cuts) for cuts in program.first]
    for cuts, quantity in zip(cuts_of, program.quantities, strict=True):
        if quantity.measure == "peak":
            values = zip(angle.tolist(), quantity.response.at(angle).tolist(), strict=True)
            # of what turns with the shaft alone every angle has the same
            cuts[:] = distinct([*cuts, *(quantity.cut(at, value) for at, value in values)])
    return cuts_of


def _learn(program: Problem, pool: Pool, u: Complex) -> bool:
    """Take the cuts that tell what an unbalance (K,) comes to; whether any is new."""
    reached = program.values(u, _CLOSE).reached
    _, places = program.sample_values(u, _HIGH * np.array([evaluation.lower for evaluation in reached]))
    thresholds = np.full(len(reached), -np.inf)
    new = pool.add([(evaluation,) for evaluation in reached], u, thresholds)
    return pool.add(places, u, thresholds) or new
