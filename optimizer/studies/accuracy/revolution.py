"""Methods for goals over a revolution: each sees some angles, some orders or some cuts of every response.

A response at one angle is never above its peak, so that a program of some angles is a relaxation: its multipliers prove
a bound of the peaks at all angles. Angles of an even grid are the customary method. Angles at which the peaks of the
round before stand are what the service adds, a round at a time. Orders that are left out prove nothing.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import partial

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.cuts.cut import Pool
from optimizer.program.cuts.optimum import Conflict, next_goal
from optimizer.program.cuts.proof import proofs, times, units
from optimizer.program.cuts.semi_infinite import Cuts, Problem
from optimizer.program.optimum import optimum
from optimizer.program.reference.assembled import GroupLimit, NoPoint, solved
from optimizer.program.statement import Statement
from optimizer.studies.accuracy.ladder import SOLVE_S
from optimizer.studies.accuracy.methods import ANGLES, GAPS, POSITIONS, LadderProgram, Method, MethodResult, Run
from optimizer.studies.accuracy.rivals.grid import angle_cuts, order_cuts, samples_of
from optimizer.studies.accuracy.rivals.matrices import scaled
from optimizer.studies.accuracy.uncertain import Steps, absence, parts, rounds_in_words

#: orders of the shaft up to which a response is seen, and angles of a revolution at which it is then
ORDERS, ANGLES_OF_ORDERS = (1, 2, 4, 8), 360
#: times that the cuts at the peaks of a point are added
ROUNDS = (0, 1, 2, 4)
#: of the solver; ceilings are lowered by as much
_TOLERANCE = 1e-9
#: width of the brackets whose peaks are the next cuts
_WIDTH = 1e-6
#: methods of finitely many norms, and why each is a row that says so
_ABSENT: Mapping[str, str] = {
    "interior_point": "knows no revolution: its program has finitely many norms",
    "interior_point_batch": "knows no revolution: its programs have finitely many norms",
    "interior_point_interpreted": "knows no revolution: its program has finitely many norms",
    "cone_program": "knows no revolution: its program is compiled once, and peaks move with the counterweights",
    "polygonal_cones": "knows no revolution: its program has finitely many norms",
}


def revolution_methods(steps: Steps) -> Iterator[Method]:
    """All methods: parts of what may be off, orders, angles and cuts, then the service."""
    worst = steps.robust(GAPS[-1], SOLVE_S)
    if steps.task.robust:
        yield from parts(steps)
    for most in ORDERS:
        of_orders = partial(_prepared, partial(_of_orders, most, steps.senses))
        yield Method("orders", f"orders up to {most}", of_orders, entries=_entries_of_orders)
    for angles in ANGLES:
        of_angles = partial(_prepared, partial(_of_angles, angles))
        yield Method("sampled_angles", f"{angles} angles", of_angles, POSITIONS, partial(_entries, angles))
    for rounds in ROUNDS:
        yield Method("cuts", rounds_in_words(rounds), partial(_prepared_rounds, rounds))
    for gap in GAPS:
        # corners of masses are found on the way; without them the program is the whole
        corners = bool(worst.scatters and worst.measures) and not steps.has_several_goals
        prepared = steps.run(gap, steps.whole) if corners else partial(_service, steps, gap)
        yield Method("service", f"relative gap {gap:.0e}", prepared)
    for method, reason in _ABSENT.items():
        yield absence(method, reason)


def _prepared(cuts: Callable[[Problem, float], tuple[Cuts, bool]]) -> Run:
    """A method of one program with some cuts, and whether these are no larger than the responses."""

    def run(task: LadderProgram, position: float, time_limit_s: float) -> MethodResult | str:
        problem = _problem(task)
        own, proves = cuts(problem, position)
        result = _optimum(problem, own, task.levels, time_limit_s)
        return result if proves or isinstance(result, str) else replace(result, prove=_nothing)

    return run


def _of_angles(angles: int, problem: Problem, position: float) -> tuple[Cuts, bool]:
    return angle_cuts(problem, angles, position), True


def _of_orders(most: int, senses: Mapping[str | None, float], problem: Problem, position: float) -> tuple[Cuts, bool]:
    return order_cuts(problem, most, ANGLES_OF_ORDERS, senses), False


def _prepared_rounds(rounds: int) -> Run:
    """The first cuts, then so often those at the peaks of the point before."""

    def run(task: LadderProgram, position: float, time_limit_s: float) -> MethodResult | str:
        problem = _problem(task)
        pool = Pool(problem.first, problem.scatter)
        every = np.full(len(problem.quantities), -np.inf)
        result = _optimum(problem, pool.cuts, task.levels, time_limit_s)
        for _ in range(rounds):
            if isinstance(result, str):
                break
            reached = problem.values(result.unbalance, _WIDTH).reached
            if not pool.add([(entry,) for entry in reached], result.unbalance, every):
                break
            result = _optimum(problem, pool.cuts, task.levels, time_limit_s)
        return result

    return run


def _service(steps: Steps, relative_gap: float) -> Run:
    def run(task: LadderProgram, position: float, time_limit_s: float) -> MethodResult | str:
        problem = _problem(task)
        if task.earlier:
            # what the last of them came to its value with keeps all of their levels
            at_levels = task.earlier[-1].unbalance
            return steps.result(next_goal(problem, task.earlier, at_levels, relative_gap, time_limit_s))
        result = optimum(problem, relative_gap, False, time_limit_s)
        return "no counterweights keep the ceilings" if isinstance(result, Conflict) else steps.result(result)

    return run


def _problem(task: LadderProgram) -> Problem:
    assert task.problem is not None  # it is there where goals are over a revolution
    return task.problem


def _optimum(problem: Problem, cuts: Cuts, levels: Real, time_limit_s: float) -> MethodResult | str:
    """The optimum of finitely many cuts by clarabel, under levels of the goals before the last."""
    stated, unit, last = problem.outer(cuts), units(problem), len(problem.goals) - 1
    goal_of, case_of = problem.goal_of, problem.case_of
    statement = times(stated, 1.0 / unit[goal_of])
    data, scaling = scaled(statement, _TOLERANCE, times(problem.begun, 1.0 / unit[goal_of]))
    highest = statement.largest(statement.floor)

    def sums(n: int, most: float) -> Iterator[GroupLimit]:
        """The sums of a goal, none above a level."""
        for case in np.flatnonzero(problem.goal_of_case == n):
            groups = case_of == case
            yield GroupLimit(groups, (most - float(np.sum(highest[groups]))) / scaling.objective)

    targets = [limit for n, level in enumerate(levels / unit[:last]) for limit in sums(n, level - _TOLERANCE)]
    result = solved(data, _TOLERANCE, time_limit_s, goal_of == last, targets, [*sums(last, 0.0)])
    if isinstance(result, NoPoint):
        return result.reason
    u = statement.limits.into(scaling.unbalance(statement, result.solution))
    multipliers = scaling.multipliers(statement, result.solution)

    def prove() -> float:
        every = proofs(problem, cuts, stated, u, multipliers, levels)
        return max((proof.bound for proof in every), default=-np.inf)

    return MethodResult(u, _claimed(problem, stated, u), prove)


def _claimed(problem: Problem, statement: Statement, u: Complex) -> float:
    return float(problem.of_goals(statement.largest(statement.rows(statement.norms.sizes(u))))[-1])


def _nothing() -> float:
    return -np.inf


def _entries(angles: int, task: LadderProgram) -> int:
    """Rows and columns that some angles make, of all quantities."""
    problem = _problem(task)
    return samples_of(problem, angles) * 3 * (3 * problem.limits.radius.size + len(problem.groups))


def _entries_of_orders(task: LadderProgram) -> int:
    return _entries(ANGLES_OF_ORDERS, task)
