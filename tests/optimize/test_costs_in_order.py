"""Mass, number and sizes of castings among goals in their order: against every set, and what is refused."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from optimizer.choices.feasible_set import Choice
from optimizer.optimize import optimize
from optimizer.solve.costs import Costs
from schemas.answer.answers import OptimizeAnswer
from schemas.base.target import pointer
from schemas.request.requests import OptimizeRequest
from service.common.validation import InvalidRequest, check
from tests.night import part
from tests.optimize.choices import DEGREE, FAST, SLOW, Loads, certified, every_set, request_body, two_webs
from tests.optimize.choices import twin as turning_twin
from tests.optimize.machines import web
from tests.optimize.test_catalogue import every_set as every_set_analysed
from tests.optimize.test_catalogue import twin
from tests.verification.checking import optimized, verdict
from tests.verification.every import unchecked

Sets = list[tuple[float, dict[str, float]]]
WEIGHTS = {"force_weight": 1.0, "moment_weight": 2.0}


def small(**more: Any) -> dict[str, Any]:
    webs = [web(name, z, 60.0, 0.12) for name, z in zip("abd", (-0.4, -0.2, 0.4), strict=True)]
    return twin(webs, catalogue={"masses_kg": [3, 7.5, 16], "angle_step_deg": 180}, **more)


def order_of(*goals: tuple[str, float]) -> list[dict[str, Any]]:
    return [{"goal": goal, "allowance": allowance} for goal, allowance in goals]


@pytest.fixture(scope="module")
def sets() -> Sets:
    """Independent: every set with what it comes to and costs, by the analysis of each."""
    values = []
    for some, after in every_set_analysed(small(), [[0.0, 180.0], [0.0, 180.0], [90.0, 270.0]]):
        masses = [mass for mass, _ in some if mass > 0]
        objective = after.force.peak_N + 2.0 * after.moment.peak_Nm
        cost = {"mass": sum(masses), "pieces": len(masses), "sizes": len(set(masses)), "moment": after.moment.peak_Nm}
        values.append((objective, cost))
    return values


def by_hand(sets: Sets, order: list[dict[str, Any]]) -> list[float]:
    """Independent: what goals come to one after the other."""
    rest, levels = max(objective for objective, cost in sets if cost["pieces"] == 0), []
    for priority in order:
        goal, allowance = priority["goal"], priority["allowance"]
        figure: Callable[[tuple[float, dict[str, float]]], float] = (
            (lambda pair: pair[0]) if goal == "external" else lambda value, goal=goal: value[1][goal]  # type: ignore[misc]
        )
        least = min(map(figure, sets))
        levels.append(least)
        most = least + allowance * (rest if goal == "external" else least)
        sets = [pair for pair in sets if figure(pair) <= most * (1 + 1e-9) + 1e-9]
    return levels


ORDERS = [
    [("external", 0.1), ("pieces", 0.0)],
    [("external", 0.1), ("mass", 0.0)],
    [("external", 0.2), ("sizes", 0.0), ("mass", 0.0)],
    [("external", 0.1), ("pieces", 0.5), ("sizes", 0.0), ("mass", 0.0)],
    [("external", 0.3), ("mass", 0.2), ("pieces", 0.0)],
    [("pieces", 0.0), ("external", 0.0)],
    [("mass", 0.0), ("external", 0.0), ("sizes", 0.0)],
]


@pytest.mark.parametrize("order", part(2, ORDERS), ids=lambda order: ", ".join(goal for goal, _ in order))
@pytest.mark.parametrize("ceiling", [None, 0.35])
def test_every_level_is_that_of_all_sets(order: list[tuple[str, float]], ceiling: float | None, sets: Sets) -> None:
    """Independent: all sets, level by level; a stranger holds what is claimed of the last one."""
    goals, more = order_of(*order), {}
    if ceiling is not None:
        most = ceiling * max(cost["moment"] for _, cost in sets)
        more["moment_ceiling_Nm"] = most * (1 + 1e-6)
        sets = [pair for pair in sets if pair[1]["moment"] <= most]
    rest = next((objective for objective, cost in sets if cost["pieces"] == 0), None)
    body = {
        "machine": small(),
        "objective": {**WEIGHTS, "priorities": goals, **more},
        "accuracy": {"relative_gap": 1e-9, "time_limit_s": 30},
    }
    answer = optimized(body)
    assert answer.status == "optimal", answer.status_reason
    assert answer.certificate is not None
    if rest is None:
        # of a ceiling that nothing keeps without weights, the allowance is a share of what is there without
        sets = [*sets, (answer.certificate.objective_without_counterweights, {"pieces": 0, "mass": 0, "sizes": 0})]
        levels = _under(sets, goals)
    else:
        levels = by_hand(sets, goals)
    actual_goals = answer.certificate.goals
    assert [actual_goal.goal for actual_goal in actual_goals] == [goal for goal, _ in order]
    for level, least in zip(actual_goals, levels, strict=True):
        assert level.value == pytest.approx(least, rel=1e-9)
        assert level.lower_bound == pytest.approx(least, rel=1e-7)
        assert level.limit >= level.value * (1 - 1e-12)
    assert holds_levels(answer, {actual_goal.goal: actual_goal.limit for actual_goal in actual_goals})
    assert verdict(body, answer.model_dump(mode="json")) != "broken"


def _under(sets: Sets, goals: list[dict[str, Any]]) -> list[float]:
    *actual_sets, (rest, _) = sets
    levels = []
    for priority in goals:
        goal, allowance = priority["goal"], priority["allowance"]
        figures = [objective if goal == "external" else cost[goal] for objective, cost in actual_sets]
        least = min(figures)
        levels.append(least)
        most = least + allowance * (rest if goal == "external" else least)
        actual_sets = [
            actual_set for actual_set, figure in zip(actual_sets, figures, strict=True) if figure <= most * (1 + 1e-9)
        ]
    return levels


def holds_levels(answer: OptimizeAnswer, limits: dict[str, float]) -> bool:
    """Whether the answer keeps all levels."""
    masses = [counterweight.mass_kg for counterweight in answer.counterweights if counterweight.mass_kg > 0]
    assert answer.certificate is not None
    own = {"mass": sum(masses), "pieces": len(masses), "sizes": len(set(masses))}
    own["external"] = answer.certificate.objective
    return all(own[goal] <= limit * (1 + 1e-9) for goal, limit in limits.items())


def test_the_mass_of_any_masses_uses_what_is_allowed() -> None:
    """Independent: a budget of the mass that is proven leaves no more than the allowance, and a smaller one does."""
    machine = {name: value for name, value in small().items() if name != "catalogue"}
    goals = order_of(("external", 0.1), ("mass", 0.0))
    body = {"machine": machine, "objective": {**WEIGHTS, "priorities": goals}}
    answer = optimized(body)
    assert answer.status == "optimal"
    assert answer.certificate is not None
    external, mass = answer.certificate.goals
    assert answer.certificate.objective == pytest.approx(external.limit, rel=1e-6)
    assert mass.lower_bound == pytest.approx(mass.value, rel=1e-4)
    assert verdict(body, answer.model_dump(mode="json")) != "broken"
    for share, over in ((1.001, False), (0.99, True)):
        budget = {**machine, "max_total_mass_kg": share * mass.value}
        least = optimized({"machine": budget, "objective": WEIGHTS}).certificate
        assert least is not None
        assert (least.objective > external.limit * (1 + 1e-9)) == over


def test_over_the_turn_and_in_scenarios() -> None:
    """Independent: all sets at 360 angles by statics, in the worst of two speeds."""
    machine = turning_twin()
    machine["webs"] = machine["webs"][:2]
    goals = order_of(("bearings", 0.1), ("pieces", 0.0), ("mass", 0.0))
    goal = {"bearing_weight": 1, "force_weight": 0, "moment_weight": 0, "priorities": goals}
    _, proof = certified(request_body(machine, **goal) | {"scenarios": [FAST, SLOW]})
    _, u = every_set(machine)
    cases = ((1.0, Loads(machine)), (0.5, Loads(machine | {"speed_rpm": 1300})))
    objective = np.max([weight * loads.peak(u) for weight, loads in cases], axis=0)
    pieces = np.count_nonzero(np.abs(u) > 0, axis=-1)
    mass = np.sum(np.abs(u) / 0.12, axis=-1)
    most = float(np.min(objective)) + 0.1 * float(objective[0])
    bearings, few, light = proof.goals
    assert bearings.value == pytest.approx(float(np.min(objective)), rel=DEGREE)
    assert bearings.limit == pytest.approx(most, rel=DEGREE)
    within = objective <= most * (1 - DEGREE)
    assert few.value == few.lower_bound == np.min(pieces[within])
    assert light.value == pytest.approx(float(np.min(mass[within & (pieces == few.value)])), rel=1e-9)
    assert light.lower_bound == pytest.approx(light.value, rel=1e-5)


def test_cheaper_choices_over_the_turn() -> None:
    """Independent: all sets at 360 angles by statics."""
    machine = turning_twin()
    body = request_body(machine, bearing_weight=1, force_weight=0, moment_weight=0) | {"alternatives": [0.05, 0.3]}
    optimum, proof = certified(body)
    _, u = every_set(machine)
    objective = Loads(machine).peak(u)
    pieces = np.count_nonzero(np.abs(u) > 0, axis=-1)
    for alternative in optimum.alternatives:
        most = proof.objective * (1 + alternative.allowance)
        assert alternative.objective <= most * (1 + 1e-9)
        if alternative.minimised == "pieces":
            assert alternative.pieces == np.min(pieces[objective <= most * (1 - DEGREE)])
            assert alternative.lower_bound == alternative.pieces
    assert {"mass", "pieces"} <= {optimum_alternative.minimised for optimum_alternative in optimum.alternatives}


def test_groups_count_each_of_their_castings() -> None:
    """Analytic: a group of two webs is no counterweights or two."""
    machine = small()
    machine["web_groups"] = [{"name": "g", "webs": ["a", "b"]}]
    for place in machine["webs"]:
        place["throw"] = 0
    goals = order_of(("external", 0.3), ("pieces", 0.0))
    answer = optimized({"machine": machine, "objective": {**WEIGHTS, "priorities": goals}})
    assert answer.certificate is not None
    masses = {counterweight.web: counterweight.mass_kg for counterweight in answer.counterweights}
    assert masses["a"] == masses["b"]
    assert answer.certificate.goals[1].value == sum(mass > 0 for mass in masses.values())


def test_least_fitted_masses_are_made_light() -> None:
    """Independent: masses of a fine grid of one web; the other carries nothing."""
    machine = two_webs()
    goals = order_of(("external", 0.2), ("mass", 0.0))
    body = request_body(machine, 1e-4, priorities=goals, moment_weight=0.0)
    # the mass stays open to the last digit, however long it is searched
    body["accuracy"]["time_limit_s"] = 0.5
    answer = optimized(body)
    assert answer.certificate is not None
    external, mass = answer.certificate.goals
    assert all(counterweight.mass_kg == 0.0 or counterweight.mass_kg >= 14.0 for counterweight in answer.counterweights)
    assert answer.certificate.objective <= external.limit * (1 + 1e-9)
    assert mass.lower_bound is not None
    assert mass.lower_bound <= mass.value * (1 + 1e-9)
    loads = Loads(machine)
    turned = np.exp(1j * np.linspace(0, 2 * np.pi, 721))
    values = [m * 0.12 * turned for m in (0.0, *np.linspace(14, 16, 21))]
    options = np.unique(np.concatenate(values))
    u = np.array([[option, 0] for option in options] + [[0, option] for option in options])
    force, _ = loads.frame(u, answer.reference_plane_m)
    light = np.sum(np.abs(u), axis=-1) / 0.12
    within = light[force <= external.limit]
    assert mass.value <= float(np.min(within, initial=np.inf)) * (1 + 1e-6)


@pytest.mark.parametrize(
    ("machine", "goals", "field", "words"),
    [
        (
            {"catalogue": None},
            [("external", 0.1), ("pieces", 0)],
            "/objective/priorities/1/goal",
            "give a catalogue too",
        ),
        (
            {"catalogue": None},
            [("external", 0.1), ("sizes", 0)],
            "/objective/priorities/1/goal",
            "give a catalogue too",
        ),
        ({"catalogue": None}, [("mass", 0), ("external", 0)], "/objective/priorities/0/goal", "the mass comes last"),
        ({}, [("pieces", 0)], "/objective/priorities/0/goal", "give a goal beside pieces"),
        ({}, [("external", -0.1), ("pieces", 0)], "/objective/priorities/0/allowance", "at least 0"),
        ({}, [("external", 0), ("pieces", 0), ("pieces", 0)], "/objective/priorities/2/goal", "named already"),
    ],
)
def test_refusals_name_the_field(
    machine: dict[str, Any], goals: list[tuple[str, float]], field: str, words: str
) -> None:
    refused({**small(), **machine}, order_of(*goals), field, words)


def test_more_sizes_than_counterweights_are_refused() -> None:
    body = small(max_counterweights=1)
    body["catalogue"] = {**body["catalogue"], "max_part_numbers": 2}
    refused(body, [], "/machine/catalogue/max_part_numbers", "more sizes than counterweights")


def refused(machine: dict[str, Any], goals: list[dict[str, Any]], field: str, words: str) -> None:
    with pytest.raises(InvalidRequest) as error:
        check(OptimizeRequest, {"machine": machine, "objective": {"priorities": goals}})
    messages = {pointer(problem.path): problem.message for problem in error.value.problems}
    assert field in messages
    assert words in messages[field]


def test_a_bound_above_its_value_is_said_and_proves_nothing(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    least = Costs.least

    def contradicted(costs: Costs, *arguments: Any) -> tuple[Choice | None, float]:
        choice, bound = least(costs, *arguments)
        return choice, 2.0 * bound

    monkeypatch.setattr(Costs, "least", contradicted)
    body = small()
    order = order_of(("external", 0.05), ("mass", 0.0))
    answer = unchecked(optimize)(
        OptimizeRequest.model_validate({"machine": body, "objective": {**WEIGHTS, "priorities": order}})
    )
    assert answer.status == "inaccurate"
    assert answer.certificate is not None
    level = answer.certificate.goals[-1]
    assert level.lower_bound is not None
    assert level.lower_bound == pytest.approx(2.0 * level.value)
    assert "is above the value of" in caplog.text
