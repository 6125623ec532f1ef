"""The ladder of the last of several goals: all methods are given the limits of the goals before it."""

from functools import cache
from io import StringIO

import numpy as np
import pytest
from rich.console import Console

from optimizer.formulation.task import Task
from optimizer.optimize import optimize
from optimizer.outputs.registry import prepare
from optimizer.outputs.requirements import effects_of_objective
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.studies.accuracy.uncertain import whole_problem
from schemas.request.accuracy import AccuracyAnswer, AccuracyRequest
from service.report.chapters.accuracy import ladders
from service.report.terminal import terminal
from tests.night import at_night, part
from tests.pairs.asking import body_of
from tests.studies.accuracy.test_tolerances import by_name, measured

#: machine, and features of tests/pairs
CASES = [
    ("vee", ("priorities",)),
    ("twin", ("priorities",)),
    ("vee", ("priorities", "balance shaft backwards")),
    ("twin", ("priorities", "tolerances of rows")),
    ("twin", ("priorities", "orders all", "scenario of masses")),
]


@cache
def request_of(base: str, features: tuple[str, ...]) -> AccuracyRequest:
    return AccuracyRequest.model_validate((body_of(base, features) or {}) | {"repeats": 1})


@cache
def ladder(base: str, features: tuple[str, ...]) -> AccuracyAnswer:
    request = request_of(base, features)
    return measured(request.machine.model_dump(exclude_unset=True), **_rest(request))


def _rest(request: AccuracyRequest) -> dict[str, object]:
    fields = request.model_dump(mode="json", exclude_unset=True)
    return {name: value for name, value in fields.items() if name not in ("machine", "repeats")}


@pytest.mark.parametrize(("base", "features"), part(5, CASES, rows=True))
def test_no_row_that_keeps_the_limits_is_below_the_bound(base: str, features: tuple[str, ...]) -> None:
    answer = ladder(base, features)
    assert answer.status == "measured"
    assert answer.reference is not None
    assert [goal.goal for goal in answer.reference.goals] == ["external", "bearings"]
    rows = [row for row in answer.ladder if row.skipped is None]
    assert {row.method for row in rows} >= {"orders", "sampled_angles", "cuts", "service"}
    for row in rows:
        assert row.relative_error is not None
        assert row.excess is not None
        over = [
            error.relative_error - (goal.limit - goal.lower_bound) / goal.without_counterweights
            for error, goal in zip(row.goals, answer.reference.goals, strict=True)
        ]
        # the largest excess is that of a goal, as there are no ceilings; of a grid it may be in another position
        assert row.excess >= max(over) - 1e-11
        assert row.method == "sampled_angles" or row.excess == pytest.approx(max(over), abs=1e-11)
        if row.excess <= CEILING_TOLERANCE:
            assert row.relative_error >= -1e-12
        if row.method == "service":
            assert row.excess <= CEILING_TOLERANCE
            assert row.certified_gap is not None
            assert row.certified_gap <= float(row.setting.split()[-1])
    assert answer.reference.resolution < 1e-8


@pytest.mark.parametrize(("base", "features"), part(5, CASES, rows=True))
def test_the_reference_is_the_answer_of_the_service(base: str, features: tuple[str, ...]) -> None:
    """Independent of the ladder: the goals of an answer in their order, and its last as objective."""
    request, reference = request_of(base, features), ladder(base, features).reference
    assert reference is not None
    goal = request.objective.model_copy(update={"least_mass": False})
    answer = optimize(request.model_copy(update={"objective": goal}))
    assert answer.certificate is not None
    size = reference.objective_without_counterweights
    assert answer.certificate.objective == pytest.approx(reference.objective, abs=3e-6 * size)
    for before, reached in zip(reference.goals, answer.certificate.goals, strict=False):
        assert before.limit == pytest.approx(reached.limit, rel=1e-7)
        assert before.lower_bound <= before.value


def test_nothing_within_the_limits_is_below_the_bound_independent() -> None:
    """Of many random counterweights, near the optimum and far, those that keep the limits of the goals before."""
    request, reference = request_of("vee", ("priorities",)), ladder("vee", ("priorities",)).reference
    assert reference is not None
    task = Task.of(request)
    scene = prepare(request, ("residual",), effects_of_objective(task.objective))
    problem, square = whole_problem(task, scene), scene.omega_squared
    best = optimize(request.model_copy(update={"outputs": ("residual",)})).counterweights
    about = np.array([complex(weight.x_kg_m, weight.y_kg_m) for weight in best])
    chance, limits, seen = np.random.default_rng(7), [goal.limit for goal in reference.goals], 0
    for share in np.repeat([1e-5, 1e-4, 1e-3, 1e-2, 0.1], 40):
        step = share * problem.limits.reach * (chance.normal(size=2) + 1j * chance.normal(size=2))
        *before, last = problem.values(problem.limits.into(about + step), 1e-9).goals * square
        if np.all(np.array(before) <= limits):
            seen += 1
            assert last >= reference.lower_bound
    assert seen > 10


@at_night
def test_a_goal_before_the_mass_is_the_only_one() -> None:
    # the minimum mass is off in a ladder: property
    ordered = ladder("vee", ("external, then mass",))
    alone = measured(request_of("vee", ()).machine.model_dump(exclude_unset=True))
    assert ordered.reference is not None
    assert alone.reference is not None
    assert ordered.reference.goals == ()
    assert ordered.reference.objective == pytest.approx(alone.reference.objective, rel=1e-12)


def test_the_report_names_the_goals_before() -> None:
    answer, console = ladder("vee", ("priorities",)), Console(file=StringIO(), width=160)
    console.print(terminal(ladders(request_of("vee", ("priorities",)), answer)))
    shown = console.file.getvalue()  # type: ignore[attr-defined]
    for text in ("under the limits of the goals before it", "external", "bearings", "limit"):
        assert text in shown
    assert by_name(answer)["polygonal_cones", "none"].goals == ()
