"""From request to the ladders: what each method finds, how far it is off, and what it takes."""

import logging
import os
import platform
import time
from collections.abc import Iterable, Mapping
from importlib.metadata import version
from typing import NamedTuple

import numpy as np

from optimizer.errors import MissingInput
from optimizer.formulation.formulate import limited, weights
from optimizer.formulation.goals import cone_program
from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Task
from optimizer.numerics.arrays import Complex
from optimizer.outputs.registry import prepare
from optimizer.outputs.requirements import effects_of_objective, missing
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.certificate import Multipliers, ceiling_allowance
from optimizer.program.cuts.optimum import CertifiedOptimum, Conflict
from optimizer.program.methods.implied_bounds import within_reach
from optimizer.program.methods.optima import optima
from optimizer.program.statement import Statement
from optimizer.studies.accuracy.choices import at_rest, choices_ladder
from optimizer.studies.accuracy.effects import effects_ladder
from optimizer.studies.accuracy.goals_before import goal_errors, goals_before, level_prices
from optimizer.studies.accuracy.judge import Judge, JudgeOfNorms, judge_of
from optimizer.studies.accuracy.ladder import (
    LADDER_S,
    SOLVE_S,
    Clock,
    FirstRun,
    Trial,
    frontier,
    median_ms,
    survey,
    time_rounds,
)
from optimizer.studies.accuracy.methods import POSITIONS, LadderProgram, Method, methods
from optimizer.studies.accuracy.peaks import peaks_ladder
from optimizer.studies.accuracy.revolution import revolution_methods
from optimizer.studies.accuracy.rivals.sampled import OverTheTurn, WeightedResponse
from optimizer.studies.accuracy.uncertain import SHARPEST, Steps, plain, uncertain_methods, whole_problem
from schemas.base.mappings import or_mapping
from schemas.base.version import package_version
from schemas.request.accuracy import (
    AccuracyAnswer,
    AccuracyRequest,
    AccuracyRow,
    Environment,
    GoalBefore,
    ProgramSize,
    Reference,
    Status,
)

_LOG = logging.getLogger(__name__)
#: relative rounding of objectives and bounds of some hundred terms; nothing below it is told apart
_ROUNDING = 1e-13
_PACKAGES = ("numpy", "numba", "scipy", "clarabel", "cvxpy")


@or_mapping(AccuracyRequest)
def accuracy(request: AccuracyRequest) -> AccuracyAnswer:
    """The ladders of methods and of simulations for a machine; least mass is off, whatever the request says.

    Raises
    ------
    MissingInput
        if the machine, or that of a scenario, lacks what the objective needs.
    """
    start = time.perf_counter()
    task = Task.of(request)
    lacking = list(missing(task.machine, task.objective))
    if lacking:
        raise MissingInput(lacking)
    # outputs play no part: what they would miss must not refuse the ladder
    scene = prepare(request, ("residual",), () if task.scenarios else effects_of_objective(task.objective))
    fields = (_choice_fields if request.has_production_limits else _method_fields)(request, scene)
    return AccuracyAnswer(
        **fields,
        repeats=request.repeats,
        positions=len(POSITIONS),
        effects_ladder=effects_ladder(request.machine, scene.layout, request.repeats),
        peaks_ladder=peaks_ladder(request.machine, scene.layout, request.repeats),
        environment=_environment(),
        total_ms=(time.perf_counter() - start) * 1e3,
    )


def _choice_fields(request: AccuracyRequest, scene: Prepared) -> dict[str, object]:
    """Fields of the answer where counterweights are as a workshop makes them."""
    closed = at_rest(request, scene)
    usable = closed.limits.reach > 0
    fields: dict[str, object] = {"size": _size(request, closed, usable), "ladder": ()}
    if closed.at_rest == 0.0 or not np.any(usable):
        return fields | {"status": "nothing_to_choose", "reference": None}
    result = choices_ladder(request, scene)
    status = "infeasible" if result.unreachable else "measured" if result.reference else "contradicted"
    return fields | {"status": status, "reference": result.reference, "choices_ladder": result.rows}


def _method_fields(request: AccuracyRequest, scene: Prepared) -> dict[str, object]:
    """Fields of the answer where counterweights have any mass at any angle."""
    task = Task.of(request)
    if task.objective.of_the_revolution:
        return _revolution_fields(request, task, scene)
    return (_worst_case_fields if task.robust else _nominal_fields)(request, task, scene)


def _nominal_fields(request: AccuracyRequest, task: Task, scene: Prepared) -> dict[str, object]:
    """Those of the unchanged machine, nothing off."""
    statement = within_reach(cone_program(*task.space, scene.responses, scene.omega_squared))
    usable = statement.limits.reach > 0
    program = LadderProgram(statement.only(usable), _turn(request, scene).only(usable))
    return _ladder_fields(request, scene, program, _best(program.statement), methods())


def _worst_case_fields(request: AccuracyRequest, task: Task, scene: Prepared) -> dict[str, object]:
    """Those of the worst case, whose optimum is the first run of the most accurate row of the service."""
    whole = judge_of(whole_problem(task, scene))
    assert isinstance(whole, JudgeOfNorms)  # nothing of it is over a revolution
    if whole.sums is None:
        whole = whole.within(within_reach(whole.statement).limits)
    usable = whole.statement.limits.reach > 0
    steps, start = Steps(task, scene, usable), time.perf_counter()
    optimum = steps.whole(steps.robust(SHARPEST, SOLVE_S))
    elapsed_s = time.perf_counter() - start
    # of several sums the search knows how far counterweights reach
    judge = (whole if whole.sums is None else whole.within(optimum.limits)).only(usable)
    program = LadderProgram(judge.statement, _turn(request, scene).only(usable), plain(judge), judge.sums)
    if isinstance(optimum, Conflict):
        return _ladder_fields(request, scene, program, None, ())
    return _fields_beside(request, scene, program, steps, optimum, elapsed_s, uncertain_methods(steps, judge))


def _revolution_fields(request: AccuracyRequest, task: Task, scene: Prepared) -> dict[str, object]:
    """Those of goals over a revolution, in the worst case where more counts than the unchanged machine."""
    steps = Steps(task, scene, np.ones(len(task.space.machine.webs), bool))
    whole, start = steps.robust(SHARPEST, SOLVE_S).goals().anywhere, time.perf_counter()
    optimum = steps.whole(steps.robust(SHARPEST, SOLVE_S))
    elapsed_s = time.perf_counter() - start
    # the search knows how far counterweights without a limit reach
    problem = whole.changed(limits=optimum.limits)
    turn = OverTheTurn((), task.objective.combine, ())
    if isinstance(optimum, Conflict):
        return _ladder_fields(request, scene, LadderProgram(problem.begun, turn, problem=problem), None, ())
    program = LadderProgram(problem.begun, turn, problem=problem, earlier=optimum.goals[:-1])
    return _fields_beside(request, scene, program, steps, optimum, elapsed_s, revolution_methods(steps))


def _fields_beside(
    request: AccuracyRequest,
    scene: Prepared,
    program: LadderProgram,
    steps: Steps,
    optimum: CertifiedOptimum,
    elapsed_s: float,
    ways: Iterable[Method],
) -> dict[str, object]:
    """Fields of the ladder whose most accurate row of the service has run already, and took so long."""
    result, proof, judge = steps.result(optimum), optimum.proof, program.judge
    u = result.unbalance
    best = Best(u, judge.objective(u), result.prove(), judge.excess(u), proof.statement, proof.multipliers)
    best = best._replace(level_prices=level_prices(program, proof))
    # the rows of several goals begin with the levels that this run has found
    several = bool(program.earlier)
    earlier = None if several else FirstRun("service", f"relative gap {SHARPEST:.0e}", result, elapsed_s)
    return _ladder_fields(request, scene, program, best, ways, earlier)


def _ladder_fields(
    request: AccuracyRequest,
    scene: Prepared,
    program: LadderProgram,
    best: "Best | None",
    ways: Iterable[Method],
    earlier: FirstRun | None = None,
) -> dict[str, object]:
    """Fields of the answer with the ladder of some methods.

    Parameters
    ----------
    best : None where no counterweights keep the ceilings.
    earlier : run of one of them that is known.
    """
    usable = program.judge.limits.reach > 0
    status: Status = "measured"
    reference: Reference | None = None
    rows: tuple[AccuracyRow, ...] = ()
    rest = program.judge.at_rest
    if best is None:
        status = "infeasible"
    elif rest == 0.0 or not np.any(usable):
        status = "nothing_to_choose"
        reference, _ = _judged(program, [], best, rest, scene.omega_squared)
    else:
        trials = _run(program, ways, request.repeats, earlier)
        reference, rows = _judged(program, trials, best, rest, scene.omega_squared)
    if reference is None and status != "infeasible":
        status = "contradicted"
    return {"status": status, "reference": reference, "size": _size(request, program.judge, usable), "ladder": rows}


class Best(NamedTuple):
    """The smallest objective before any method runs, with its proof."""

    unbalance: Complex  # (K,) kg m
    objective: float
    lower_bound: float
    excess: float  # largest relative excess over a ceiling; -inf without ceilings
    statement: Statement  # of the proof
    multipliers: Multipliers
    level_prices: float = 0.0  # what an excess over all levels of the goals before gains, for a relative one of 1


def _best(statement: Statement) -> Best | None:
    """That of the unchanged machine, nothing off; None where no counterweights keep the ceilings."""
    result = optima(statement.alone(), SHARPEST, False).single()
    if result.conflict is not None:
        return None
    figures = result.unbalance, result.objective, result.lower_bound, result.excess
    return Best(*figures, statement, result.multipliers)


def _turn(request: AccuracyRequest, scene: Prepared) -> OverTheTurn:
    """The peaks and ceilings of :func:`optimizer.formulation.goals.cone_program`, as they pass over the turn."""
    response_weights, across = weights(request.machine, request.objective), request.objective.direction_weights
    return OverTheTurn(
        peaks=tuple(
            WeightedResponse(response, float(response_weights[response.name]), across.x, across.y)
            for response in scene.responses
            if response_weights[response.name] > 0
        ),
        combine=request.objective.combine,
        ceilings=tuple(
            (WeightedResponse(response, 1.0), allowed / scene.omega_squared)
            for response, allowed in limited(scene.responses, request.objective)
        ),
    )


def _run(task: LadderProgram, ways: Iterable[Method], repeats: int, earlier: FirstRun | None) -> list[Trial]:
    clock = Clock.of(LADDER_S)
    trials = survey(task, ways, clock, earlier)
    time_rounds(task, trials, repeats, clock)
    return trials


def _proven(judge: Judge, best: Best, bounds: list[float], objective: float, excess: float) -> float:
    """The sharpest bound; NaN where a value that was found is below it.

    A value is known to its rounding, and counterweights that exceed ceilings within the tolerance may gain what these
    cost, so a bound above the value by no more is lowered to it (docs/mathematics.md, section 5).
    """
    bound, slack = max(bounds), judge.rounding(best.unbalance)
    over = np.full(best.statement.ceilings.size.shape, max(excess, 0.0))
    slack += float(ceiling_allowance(best.statement, best.multipliers, over)) + best.level_prices * max(excess, 0.0)
    if bound <= objective + slack:
        return min(bound, objective)
    _LOG.error("a lower bound is above the value of an answer: %.17g above %.17g", bound, objective)
    return np.nan


def _judged(
    task: LadderProgram, trials: list[Trial], best: Best, rest: float, square: float
) -> tuple[Reference | None, tuple[AccuracyRow, ...]]:
    results = [result for trial in trials for result in trial.judged if result.excess <= CEILING_TOLERANCE]
    objective = min([best.objective, *(result.objective for result in results)])
    bounds = [best.lower_bound, *(result.bound for trial in trials for result in trial.judged)]
    excess = max([best.excess, *(result.excess for result in results)])
    bound = _proven(task.judge, best, bounds, objective, excess)
    if np.isnan(bound):
        return None, ()
    reference = _reference(objective, bound, rest, square, goals_before(task, square))
    figures = [_figures(trial, bound, rest, bool(task.judge.ceilings)) for trial in trials]
    points = [
        # a batch answers no single request in the time of one of its programs
        None
        if figure is None
        or figure.time_ms is None
        or trial.method.programs > 1
        or (figure.excess or 0.0) > CEILING_TOLERANCE
        else (figure.time_ms, figure.relative_error)
        for trial, figure in zip(trials, figures, strict=True)
    ]
    fastest = frontier(points, reference.resolution)
    return reference, tuple(_row(task, *arguments) for arguments in zip(trials, figures, fastest, strict=True))


class _MethodFigures(NamedTuple):
    """What the answer tells of a method, by its names."""

    time_ms: float | None
    relative_error: float
    as_drawn_error: float
    certified_gap: float | None
    claim_error: float | None
    excess: float | None


_NOTHING: Mapping[str, None] = dict.fromkeys(_MethodFigures._fields)


def _figures(trial: Trial, bound: float, rest: float, has_ceilings: bool) -> _MethodFigures | None:
    if trial.skipped is not None:
        return None
    gaps = [(result.objective - result.bound) / rest for result in trial.judged]
    claims = [(result.claimed - result.objective) / rest for result in trial.judged if result.claimed is not None]
    return _MethodFigures(
        median_ms(trial.times_s, trial.method.programs),
        (trial.worst.objective - bound) / rest,
        (trial.judged[0].objective - bound) / rest,
        max(gaps) if np.all(np.isfinite(gaps)) else None,
        max(claims, key=abs, default=None),
        max(result.excess for result in trial.judged) if has_ceilings else None,
    )


def _row(task: LadderProgram, trial: Trial, figures: _MethodFigures | None, on_frontier: bool) -> AccuracyRow:
    method, answered = trial.method, trial.skipped is None
    return AccuracyRow(
        method=method.name,
        setting=method.setting,
        first_ms=None if trial.first_s is None or not answered else trial.first_s * 1e3 / method.programs,
        programs=method.programs,
        on_frontier=on_frontier,
        runs=len(trial.times_s) if answered else 0,
        skipped=trial.skipped,
        goals=goal_errors(task, trial),
        **(_NOTHING if figures is None else figures._asdict()),
    )


def _reference(objective: float, bound: float, rest: float, square: float, goals: tuple[GoalBefore, ...]) -> Reference:
    return Reference(
        objective=objective * square,
        lower_bound=bound * square,
        objective_without_counterweights=rest * square,
        resolution=max((objective - bound) / rest, _ROUNDING) if rest > 0 else _ROUNDING,
        goals=goals,
    )


def _size(request: AccuracyRequest, judge: Judge, usable: np.ndarray) -> ProgramSize:
    machine = request.machine
    return ProgramSize(
        webs=int(np.sum(usable)),
        norm_terms=judge.terms,
        ceilings=judge.ceilings,
        sectors=int(np.sum(~judge.limits.free & usable)),
        mass_budget=machine.max_total_mass_kg is not None,
        rows=sum(len(throw.rows) for throw in machine.throws),
    )


def _environment() -> Environment:
    return Environment(
        versions={
            "python": platform.python_version(),
            "counterweight": package_version(),
            **{name: version(name) for name in _PACKAGES},
        },
        cpus=os.cpu_count() or 1,
    )
