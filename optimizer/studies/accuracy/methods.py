"""The methods that are compared, a small entry each; a new one is an entry more."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache, partial

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.program.certificate import objective_lower_bound
from optimizer.program.cuts.optimum import GoalLevel
from optimizer.program.cuts.semi_infinite import Problem
from optimizer.program.kernel.finer_numbers import PRECISIONS, Precision
from optimizer.program.methods.compiled import StageSolutions, stage_solutions
from optimizer.program.methods.optima import optima
from optimizer.program.multipliers import objective_multipliers
from optimizer.program.reference.assembled import NoPoint
from optimizer.program.reference.modelling import ConeProgram
from optimizer.program.statement import Statement
from optimizer.studies.accuracy.judge import Judge, JudgeOfNorms, judge_of
from optimizer.studies.accuracy.rivals import matrices
from optimizer.studies.accuracy.rivals.polygonal import polygonal
from optimizer.studies.accuracy.rivals.sampled import OverTheTurn, sampled

ANGLES = (6, 12, 36, 72, 360, 720)
SIDES = (4, 8, 16, 32, 64, 128, 256)
TOLERANCES = (1e-2, 1e-4, 1e-6, 1e-8, 1e-10)
GAPS = (1e-3, 1e-6, 1e-9)
#: programs of one batch
BATCH = 1000
#: positions of an angle grid or a polygon, as shares of its step; the first is that of the machine as drawn
POSITIONS = (0.0, 0.25, 0.5, 0.75)
_FIXED = POSITIONS[:1]


@record(frozen=True)
class LadderProgram:
    """The program to solve; all its webs can carry something, but for those of goals over a revolution.

    statement : over a revolution with the cuts to begin with.
    plain : where something is off, the same as one sum of norms; None where it is none.
    sums : (groups,) as of :class:`optimizer.studies.accuracy.judge.JudgeOfNorms`.
    problem : of goals over a revolution; None of the first order.
    earlier : goals of it before the last, with what they may come to.
    """

    statement: Statement
    turn: OverTheTurn
    plain: Statement | None = None
    sums: np.ndarray | None = None
    problem: Problem | None = None
    earlier: tuple[GoalLevel, ...] = ()

    @cached_property
    def judge(self) -> Judge:
        """By what methods are judged."""
        if self.problem is None:
            return JudgeOfNorms(self.statement, self.sums)
        return judge_of(self.problem, self.levels)

    @cached_property
    def levels(self) -> Real:
        """(goals - 1,) what the goals before the last may come to."""
        return np.array([goal.most for goal in self.earlier])

    def objective(self, u: Complex) -> float:
        """What counterweights (K,) kg m come to."""
        return self.judge.objective(u)


@record(frozen=True)
class MethodResult:
    """Counterweights that a method found, unjudged."""

    unbalance: Complex  # (K,) kg m
    claimed: float | None  # objective that the method itself sees, where it shows it
    prove: Callable[[], float]  # lower bound that the method itself proves, outside the clock


#: one run for a position of the grid and a limit of time in seconds; or why there is no answer
Run = Callable[[LadderProgram, float, float], MethodResult | str]


@record(frozen=True)
class Method:
    """One way to the smallest objective.

    name, setting : as in the answer.
    prepare : a fresh run, nothing compiled yet.
    positions : positions of its grid that can make a difference.
    entries : size of what it hands to its solver, by which work is bounded.
    programs : programs that one run solves; times are for one of them.
    """

    name: str
    setting: str
    prepare: Callable[[], Run]
    positions: tuple[float, ...] = _FIXED
    entries: Callable[[LadderProgram], int] = lambda task: 0
    programs: int = 1


def methods() -> Iterator[Method]:
    """All methods, those that the others are measured against first."""
    for gap in GAPS:
        yield Method("service", f"relative gap {gap:.0e}", partial(_service, gap))
    for gap in GAPS:
        yield Method("interior_point", f"relative gap {gap:.0e}", partial(_interior_point, gap, None))
    for gap in GAPS:
        yield Method(
            "interior_point_batch",
            f"relative gap {gap:.0e}",
            partial(_batch, gap),
            entries=_batch_entries,
            programs=BATCH,
        )
    for precision in PRECISIONS:
        setting = precision.name.removeprefix("interior point, ").removesuffix(" precision")
        yield Method("interior_point_interpreted", setting, partial(_interior_point, GAPS[-1], precision))
    for tolerance in TOLERANCES:
        yield Method("cone_program", f"tolerance {tolerance:.0e}", partial(_cone_program, tolerance))
    for tolerance in TOLERANCES:
        yield Method("cone_program_matrices", f"tolerance {tolerance:.0e}", partial(_matrices, tolerance))
    for angles in ANGLES:
        yield Method(
            "sampled_angles",
            f"{angles} angles",
            partial(_sampled, angles),
            POSITIONS,
            partial(_sampled_entries, angles),
        )
    for sides in SIDES:
        yield Method(
            "polygonal_cones", f"{sides} sides", partial(_polygonal, sides), POSITIONS, partial(_polygon_entries, sides)
        )


def _service(relative_gap: float) -> Run:

    def run(task: LadderProgram, position: float, time_limit_s: float) -> MethodResult | str:
        outcome = optima(task.statement.alone(), relative_gap, False).single()
        if outcome.conflict is not None:
            return "no counterweights keep the ceilings"
        bound = outcome.lower_bound
        return MethodResult(outcome.unbalance, outcome.objective, lambda: bound)

    return run


def _interior_point(relative_gap: float, precision: Precision | None) -> Run:
    def run(task: LadderProgram, position: float, time_limit_s: float) -> MethodResult | str:
        webs = task.statement.limits.radius.size
        if precision is not None and webs > precision.most_webs:
            return f"too large: {webs} webs, at most {precision.most_webs} are tried"
        alone = task.statement.alone()
        gap = relative_gap * _rest(alone)
        return _first(stage_solutions(alone, gap, gap, False, precision))

    return run


def _batch(relative_gap: float) -> Run:
    batch: Statement | None = None

    def run(task: LadderProgram, position: float, time_limit_s: float) -> MethodResult | str:
        nonlocal batch
        # put together in the first run; the rounds time what solves it
        batch = batch or _lighter(task.statement, np.linspace(1.0, 0.9, BATCH))
        gap = relative_gap * _rest(batch)
        return _first(stage_solutions(batch, gap, gap, False))

    return run


def _lighter(statement: Statement, share: Real) -> Statement:
    """The program with these shares (N,) of the machine's masses and ceilings, within the same limits."""
    batch = statement.alone().subset(np.zeros(share.size, int))
    norms, ceilings, column = batch.norms, batch.ceilings, share[:, None]
    return replace(
        batch,
        norms=replace(norms, constant=norms.constant * column),
        floor=batch.floor * column,
        ceilings=replace(
            ceilings,
            norms=replace(ceilings.norms, constant=ceilings.norms.constant * column),
            cap=ceilings.cap * column,
            size=ceilings.size * column,
        ),
    )


def _first(stages: StageSolutions) -> MethodResult:
    bound = float(stages.lower_bound[0])
    return MethodResult(stages.unbalance[0], float(stages.objective[0]), lambda: bound)


def _rest(batch: Statement) -> Real:
    return batch.objective(np.zeros(batch.limits.radius.shape, complex))


def _cone_program(tolerance: float) -> Run:
    # compiled in the first run, for every shape
    program = cache(ConeProgram)

    def run(task: LadderProgram, position: float, time_limit_s: float) -> MethodResult | str:
        statement = task.statement
        data, scaling = matrices.scaled(statement, tolerance)
        solution = program(data.shape).solve(data, tolerance)
        if solution is None:
            return "the solver has no point to offer"
        unbalance = statement.limits.into(scaling.unbalance(statement, solution))
        return _proving(task, matrices.RivalPoint(unbalance, scaling.multipliers(statement, solution), None))

    return run


def _matrices(tolerance: float) -> Run:
    return lambda task, position, limit: _proving(task, matrices.exact(task.statement, tolerance, limit))


def _sampled(angles: int) -> Run:
    return lambda task, position, limit: _proving(task, sampled(task.statement, task.turn, angles, position, limit))


def _polygonal(sides: int) -> Run:
    return lambda task, position, limit: _proving(task, polygonal(task.statement, sides, position, limit))


def _proving(task: LadderProgram, point: matrices.RivalPoint | NoPoint) -> MethodResult | str:
    if isinstance(point, NoPoint):
        return point.reason

    def prove() -> float:
        candidates = objective_multipliers(task.statement, point.unbalance, point.multipliers)
        return max(float(objective_lower_bound(task.statement, candidate)) for candidate in candidates)

    return MethodResult(point.unbalance, point.claimed, prove)


def _sampled_entries(angles: int, task: LadderProgram) -> int:
    webs = task.statement.limits.radius.size
    return (len(task.turn.peaks) + len(task.turn.ceilings)) * angles // 2 * (4 * webs + 1)


def _batch_entries(task: LadderProgram) -> int:
    norms, ceilings = task.statement.norms.constant.size, len(task.statement.ceilings.names)
    return BATCH * (norms + ceilings) * int(task.statement.limits.radius.size)


def _polygon_entries(sides: int, task: LadderProgram) -> int:
    norms, ceilings = task.statement.norms.constant.size, len(task.statement.ceilings.names)
    webs = int(np.size(task.statement.limits.radius))
    return sides * ((norms + ceilings) * (2 * webs + 1) + 3 * webs)
