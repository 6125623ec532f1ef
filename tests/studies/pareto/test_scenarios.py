"""Fronts of several scenarios: every point is the best worst case of all of them, and nobody is below."""

import itertools
import json
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from schemas.front.pareto import ParetoAnswer, ParetoRequest
from service.common.validation import InvalidRequest, check
from service.verification import checker
from tests.hard_turn.machines import twin
from tests.night import part
from tests.optimize.machines import machine, random_machine, throw, web
from tests.optimize.robust import answered, scenario, worst
from tests.studies.pareto.cases import OMEGA_SQUARED, RPM, ask, below_a_corner, front, straight, traded

SEEDS = st.integers(0, 10_000)
MACHINES = settings(max_examples=settings.default.max_examples // 8, deadline=None)
#: of the turning mass of :func:`straight`: 0.5 and 1.5 kg m
LIGHT, HEAVY = (scenario(name, throws__0__rotating_mass_kg=mass) for name, mass in (("light", 5.0), ("heavy", 15.0)))
#: whether the first crank stands elsewhere, weighs more, or turns faster and counts less
CASES = (
    lambda body: scenario("turned", throws__0__crank_angle_deg=body["throws"][0]["crank_angle_deg"] + 20.0),
    lambda body: scenario("heavy", throws__0__rotating_mass_kg=body["throws"][0]["rotating_mass_kg"] + 10.0),
    lambda body: scenario("fast", 0.6, speed_rpm=1.3 * body["speed_rpm"]),
)


def verdict(body: dict[str, Any], answer: ParetoAnswer) -> dict[str, Any]:
    result: dict[str, Any] = checker().verify(body, json.loads(answer.model_dump_json()))
    return result


def test_a_light_and_a_heavy_machine() -> None:
    """Analytic: F = max(|0.5 - x|, 1.5 - x) and M = 2 x with u = -x, so that nothing is gained beyond x = 1."""
    answer = front(straight(), points=6, scenarios=[LIGHT, HEAVY])
    assert (answer.status, answer.reason, answer.knee, len(answer.points)) == ("optimal", None, None, 6)
    x = np.linspace(1.0, 0.0, 6)
    peaks = np.array([traded(point) for point in answer.points]) / OMEGA_SQUARED
    assert peaks == pytest.approx(np.stack([1.5 - x, 2.0 * x], axis=-1), abs=6e-6)
    for point, there in zip(answer.points, x, strict=True):
        # the unchanged machine is in none of them
        assert point.force_peak_N / OMEGA_SQUARED == pytest.approx(1.0 - there, abs=3e-6)
        assert point.worst_case is not None
        worst_peaks = (point.worst_case.force_peak_N, point.worst_case.moment_peak_Nm)
        assert worst_peaks == pytest.approx(traded(point), rel=1e-12, abs=1e-9)


def test_a_scenario_counts_by_its_speed_and_its_weight() -> None:
    """Analytic: at twice the speed and half the weight F = 2 (1 - x) and M = 4 x; without weights twice as much."""
    fast = scenario("fast", 0.5, speed_rpm=2.0 * RPM)
    answer = front(straight(), points=3, scenarios=[scenario("as it is"), fast])
    peaks = np.array([traded(point) for point in answer.points]) / OMEGA_SQUARED
    assert peaks == pytest.approx(np.array([[0.0, 4.0], [1.0, 2.0], [2.0, 0.0]]), abs=1e-5)
    for point, (force, moment) in zip(answer.points, peaks, strict=True):
        assert point.worst_case is not None
        assert point.worst_case.force_peak_N / OMEGA_SQUARED == pytest.approx(2.0 * force, abs=1e-9)
        assert point.worst_case.moment_peak_Nm / OMEGA_SQUARED == pytest.approx(2.0 * moment, abs=1e-9)


def test_a_ceiling_holds_in_every_scenario() -> None:
    """Analytic: F = 1.5 - x up to 0.7, and below 0.5 there is nothing; of the light machine alone there is."""
    two, ceiling = [LIGHT, HEAVY], 0.7 * OMEGA_SQUARED
    answer = front(straight(), points=3, scenarios=two, objective={"force_ceiling_N": ceiling})
    assert [point.weighted_force_peak_N for point in answer.points] == pytest.approx(
        np.array([0.5, 0.6, 0.7]) * OMEGA_SQUARED, abs=3e-6 * OMEGA_SQUARED
    )
    assert answer.points[-1].active_limits == ("force_ceiling",)
    low = {"force_ceiling_N": 0.4 * OMEGA_SQUARED}
    none = front(straight(), scenarios=two, objective=low)
    assert (none.status, none.points) == ("infeasible", ())
    assert none.infeasibility is not None
    assert none.infeasibility.conflict == ("force_ceiling_N",)
    assert {*none.infeasibility.scenarios} == {"light", "heavy"}
    assert front(straight(), scenarios=[LIGHT], objective=low).status == "optimal"


@given(SEEDS, st.sampled_from(range(3)), st.floats(-2, 2))
@MACHINES
def test_no_best_worst_case_is_below_the_front(seed: int, first: int, exponent: float) -> None:
    """Property: the best worst case of one answer is below no corner, nor is a point below it; the checker agrees."""
    body = random_machine(seed)
    scenarios = [scenario("as it is"), CASES[first](body), CASES[(first + 1) % 3](body)]
    request = {"machine": body, "points": 4, "scenarios": scenarios, "multipliers": True}
    answer = ask(body, points=4, scenarios=scenarios, multipliers=True)
    (pareto,) = answer.fronts
    assert pareto.scale is not None
    assert verdict(request, answer)["verdict"] == "held"
    goal = {
        "combine": "max",
        "force_weight": 1.0 / pareto.scale.force_N,
        "moment_weight": 10.0**exponent / pareto.scale.moment_Nm,
    }
    best = answered(body, objective=goal, scenarios=scenarios)
    assert best.certificate is not None
    for force, moment in map(traded, pareto.points):
        objective = max(goal["force_weight"] * force, goal["moment_weight"] * moment)
        assert objective >= best.certificate.lower_bound * (1 - 1e-12)
    # of unit weights the worst case of that answer is what the front trades
    alike = [{**case, "weight": 1.0} for case in scenarios]
    plain, reply = front(body, points=4, scenarios=alike), answered(body, objective=goal, scenarios=alike)
    assert reply.worst_case is not None
    assert not below_a_corner(reply.worst_case.force_peak_N, reply.worst_case.moment_peak_Nm, plain, 1e-12)


@given(SEEDS, st.sampled_from(range(3)))
@MACHINES
def test_the_ends_are_the_best_worst_cases_of_each_peak_alone(seed: int, first: int) -> None:
    body = random_machine(seed)
    scenarios = [scenario("as it is"), CASES[first](body)]
    answer = front(body, points=2, scenarios=scenarios)
    assert answer.ends is not None
    assert answer.scale is not None
    ends = (answer.ends.smallest_force_N, answer.ends.smallest_moment_Nm)
    for weights, smallest, size in zip(
        ((1.0, 0.0), (0.0, 1.0)), ends, (answer.scale.force_N, answer.scale.moment_Nm), strict=True
    ):
        goal = dict(zip(("force_weight", "moment_weight"), weights, strict=True))
        assert smallest == pytest.approx(worst(answered(body, objective=goal, scenarios=scenarios)), abs=3e-6 * size)


@pytest.mark.parametrize("weight", [1.0, 0.7])
def test_choices_are_those_that_no_other_beats_in_the_worst_scenario(weight: float) -> None:
    """Independent: the worst cases of all sets of two webs, one by one, of two machines with other turning masses."""
    webs = [web("a", 0.3, 20.0, 0.2), web("b", 0.9, 20.0, 0.2)]
    throws = [throw(0.0, 0.0, [], radius=0.1, rotating=30.0), throw(1.0, 90.0, [], radius=0.1, rotating=20.0)]
    body = machine(throws, webs, reference_plane_m=0.2)
    stock = {"masses_kg": [8.0, 14.0], "angle_step_deg": 90.0}
    cases = [scenario("as it is"), scenario("changed", weight, throws__0__rotating_mass_kg=12.0)]
    answer = front({**body, "catalogue": stock}, points=200, scenarios=cases)
    assert (answer.status, answer.reason) == ("optimal", "complete")
    options = [(0.0, 0.0), *itertools.product((8.0, 14.0), (0.0, 90.0, 180.0, 270.0))]
    u = np.array([[0.2 * mass * np.exp(1j * np.deg2rad(angle)) for mass, angle in pair]
                  for pair in itertools.product(options, options)])  # fmt: skip
    arms = np.array([[1.0, 1.0], [0.1, 0.7]])
    rest = np.array([[first + 2.0j, -0.2 * first + 0.8 * 2.0j] for first in (3.0, 1.2)])
    peaks = np.max(np.array([1.0, weight])[:, None, None] * np.abs(rest[:, None] + u @ arms.T), axis=0)
    best = {
        (round(force, 9), round(moment, 9))
        for force, moment in peaks
        if not np.any((peaks[:, 0] <= force) & (peaks[:, 1] <= moment) & np.any(peaks < [force, moment], axis=-1))
    }
    actual = np.array([traded(point) for point in answer.points]) / OMEGA_SQUARED
    assert actual == pytest.approx(np.array(sorted(best)), abs=2e-3)


@pytest.mark.parametrize("responses", part(1, [("objective", "mass"), ("bearings", "mass")]))
@pytest.mark.parametrize("tolerances", part(2, [None, {"mass_relative": 0.02, "reciprocating_mass_relative": 0.05}]))
def test_a_point_of_named_responses_is_the_best_worst_case_of_its_mass(
    responses: tuple[str, str], tolerances: dict[str, float] | None
) -> None:
    body = twin()
    cases = [scenario("as it is"), scenario("fast", 0.9, speed_rpm=1.4 * body["speed_rpm"])]
    alone = {"force_weight": 0.0, "moment_weight": 0.0, "bearing_weight": 1.0} if "bearings" in responses else {}
    (front,) = ask(body, points=3, scenarios=cases, tolerances=tolerances, responses=responses).trades
    assert front.status == "optimal"
    objective, mass = front.points[1].values
    best = answered({**body, "max_total_mass_kg": mass}, objective=alone, scenarios=cases, tolerances=tolerances)
    assert best.certificate is not None
    assert objective == pytest.approx(best.certificate.objective, abs=3e-6 * front.responses[0].yardstick)
    assert front.points[1].nominal_values is not None
    assert front.points[1].nominal_values[0] < objective


@pytest.mark.parametrize("least", ["objective", "mass"])
def test_counts_are_of_the_worst_scenario(least: str) -> None:
    """Independent: the least of all sets of so many counterweights that keep the ceiling on both machines."""
    stock = {"masses_kg": [8.0, 14.0], "angle_step_deg": 90.0}
    throws = [throw(0.0, 0.0, [], radius=0.1, rotating=30.0), throw(1.0, 90.0, [], radius=0.1, rotating=20.0)]
    body = {**machine(throws, [web("a", 0.3, 20.0, 0.2), web("b", 0.9, 20.0, 0.2)]), "catalogue": stock}
    cases = [scenario("as it is"), scenario("light", throws__0__rotating_mass_kg=20.0)]
    goal = {"force_ceiling_N": 2.5 * OMEGA_SQUARED, "moment_weight": 0.0}
    (front,) = ask(body, scenarios=cases, objective=goal, counts={"of": "weights", "least": least}).counts
    options = [(0.0, 0.0), *itertools.product((8.0, 14.0), (0.0, 90.0, 180.0, 270.0))]
    sets = np.array([*itertools.product(options, options)])
    mass, u = sets[..., 0], np.sum(0.2 * sets[..., 0] * np.exp(1j * np.deg2rad(sets[..., 1])), axis=-1)
    force = np.max(np.abs(np.array([[3.0 + 2.0j], [2.0 + 2.0j]]) + u), axis=0)
    values = force * OMEGA_SQUARED if least == "objective" else np.sum(mass, axis=-1)
    assert [point.at_most for point in front.points][:2] == [0, 1]
    assert front.points[0].status == "infeasible"
    for point in front.points[1:]:
        few = (np.sum(mass > 0, axis=-1) <= point.at_most) & (force <= 2.5)
        assert (point.status, point.value) == ("optimal", pytest.approx(np.min(values[few]), rel=1e-3))


def test_a_falsified_worst_case_is_broken() -> None:
    request = {"machine": random_machine(1), "points": 3, "multipliers": True}
    request["scenarios"] = [scenario("as it is"), CASES[1](request["machine"])]
    answer = ask(request["machine"], **{name: request[name] for name in ("points", "multipliers", "scenarios")})
    document = json.loads(answer.model_dump_json())
    assert checker().verify(request, document)["verdict"] == "held"
    for field in ("weighted_force_peak_N", "weighted_moment_peak_Nm", "force_peak_N"):
        text = json.loads(json.dumps(document))
        text["fronts"][0]["points"][1][field] *= 0.999
        assert checker().verify(request, text)["verdict"] == "broken", field
    text = json.loads(json.dumps(document))
    text["fronts"][0]["points"][1]["worst_case"]["force_peak_N"] *= 0.999
    assert checker().verify(request, text)["verdict"] == "broken"
    # another scenario has another worst case
    lighter = [scenario("as it is"), {**request["scenarios"][1], "weight": 0.5}]
    assert checker().verify({**request, "scenarios": lighter}, document)["verdict"] == "broken"


@pytest.mark.parametrize(
    ("more", "field"),
    [
        ({"scenarios": [scenario("a"), scenario("a")]}, "scenarios.1.name"),
        ({"scenarios": [scenario("a", throws__0__rotating_mass_kg=-1.0)]}, "scenarios.0.changes.0.value"),
        ({"scenarios": [scenario("a", webs__0__max_mass_kg=1.0)]}, "scenarios.0.changes.0.path"),
        ({"scenarios": [scenario("a", nothing=1.0)]}, "scenarios.0.changes.0.path"),
        ({"scenarios": [{"name": "a", "changes": [{"path": "/objective/force_weight", "value": 1.0}]}]},
         "scenarios.0.changes.0.path"),
        ({"scenarios": [scenario("a")], "alternatives": [0.1]}, "alternatives"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_refused_by_its_field(more: dict[str, Any], field: str) -> None:
    with pytest.raises(InvalidRequest) as refusal:
        check(ParetoRequest, {"machine": straight(), **more})
    assert field in [".".join(map(str, problem.path)) for problem in refusal.value.problems]
