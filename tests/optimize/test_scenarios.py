"""Scenarios: the best worst case of several machines, certified."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from optimizer.errors import MissingInput
from optimizer.program.kernel.finer_numbers import Precision
from optimizer.program.methods import stage_ends
from schemas.answer.answers import OptimizeAnswer
from schemas.front.pareto import ParetoRequest
from schemas.request.accuracy import AccuracyRequest
from schemas.request.requests import OptimizeRequest
from schemas.sweep.request import SweepRequest
from tests.night import part
from tests.optimize.machines import machine, random_machine, row, throw, web
from tests.optimize.robust import answered, crank, scenario, worst
from tests.optimize.whole_turn import single_throw
from tests.pairs.machines import BASES


def test_between_two_cranks_the_counterweight_is_in_the_middle() -> None:
    """Analytic: of 200 N at 0 and at 60 degrees half of their difference remains, 100 N, with u opposite their mean."""
    two = [scenario("as it is"), scenario("turned", throws__0__crank_angle_deg="60 deg")]
    answer = answered(crank(), scenarios=two)
    assert answer.status == "optimal"
    assert worst(answer) == pytest.approx(100.0, abs=2e-4)
    (counterweight,) = answer.counterweights
    assert (counterweight.mass_kg, counterweight.angle_deg) == pytest.approx(
        (20.0 * np.cos(np.pi / 6), 210.0), rel=2e-3
    )
    price = answer.price_of_robustness
    assert price is not None
    # the nominal optimum leaves nothing of the one and all of the difference of the other
    assert price.nominal == pytest.approx(100.0, abs=1e-2)
    assert price.nominal_optimum == pytest.approx(0.0, abs=3e-4)
    assert price.nominal_optimum_worst_case == pytest.approx(200.0, abs=1e-3)
    # the proof leans on both alike
    assert answer.certificate is not None
    rows = {multiplier.name: multiplier.value for multiplier in answer.certificate.multipliers.objective.rows}
    assert rows == pytest.approx({"sum in as it is": 0.5, "sum in turned": 0.5}, abs=1e-3)
    force = [term for term in answer.certificate.multipliers.objective.terms if term.response == "force"]
    assert [multiplier.scenario for multiplier in force] == ["as it is", "turned"]


def test_weights_say_which_scenario_gets_more() -> None:
    """Analytic: weights 1 and 3 leave distances 3 : 1 on the straight line between two points 200 N apart."""
    two = [scenario("a"), scenario("b", 3.0, throws__0__crank_angle_deg=60)]
    answer = answered(crank(), scenarios=two)
    assert worst(answer) == pytest.approx(150.0, abs=1e-3)


def test_of_several_speeds_the_highest_decides_and_ceilings_hold_in_each() -> None:
    """Analytic: the same machine at twice the speed has four times the forces; the slow one adds nothing."""
    design = random_machine(3)
    fast, slow = 2.0 * design["speed_rpm"], 0.5 * design["speed_rpm"]
    alone = answered(design)
    both = answered(design, scenarios=[scenario("fast", speed_rpm=fast), scenario("slow", speed_rpm=slow)])
    assert alone.certificate is not None
    assert both.certificate is not None
    assert worst(both) == pytest.approx(4.0 * alone.certificate.objective, abs=8e-6 * alone.certificate.yardstick)
    assert both.certificate.yardstick == pytest.approx(4.0 * alone.certificate.yardstick)
    assert both.total_mass_kg == pytest.approx(alone.total_mass_kg, rel=2e-3)
    assert alone.residual.after is not None
    peak = alone.residual.after.force.peak_N
    answer = answered(
        design, objective={"force_ceiling_N": 4.0 * peak * 1.001}, scenarios=[scenario("fast", speed_rpm=fast)]
    )
    assert answer.status == "optimal"
    assert answer.worst_case is not None
    assert answer.worst_case.force_peak_N <= 4.0 * peak * 1.001 * (1 + 1e-9)


def test_scenarios_that_conflict_are_named() -> None:
    """Analytic: 90 N is more than the 0 N that each can have, and less than the 100 N that both can have."""
    two = [scenario("as it is"), scenario("turned", throws__0__crank_angle_deg=60)]
    for fields in two:
        assert answered(crank(), objective={"force_ceiling_N": 90}, scenarios=[fields]).status == "optimal"
    answer = answered(crank(), objective={"force_ceiling_N": 90}, scenarios=[*two, scenario("again")])
    assert answer.status == "infeasible"
    infeasibility = answer.infeasibility
    assert infeasibility is not None
    assert set(infeasibility.scenarios) >= {"turned"}
    assert set(infeasibility.scenarios) <= {"as it is", "turned", "again"}
    assert len(infeasibility.scenarios) >= 2
    assert infeasibility.conflict == ("force_ceiling_N",)
    assert infeasibility.smallest_force_N == pytest.approx(100.0, abs=1e-4)
    assert infeasibility.smallest_force_lower_bound_N == pytest.approx(100.0, abs=1e-4)
    assert (answer.worst_case, answer.price_of_robustness, answer.sensitivity) == (None, None, None)
    # one that cannot be kept by itself is the only one that is named
    heavy = scenario("heavy", throws__0__rotating_mass_kg=200)
    small = crank(max_mass=20.0)
    answer = answered(small, objective={"force_ceiling_N": 150}, scenarios=[two[0], heavy])
    assert answer.infeasibility is not None
    assert answer.infeasibility.scenarios == ("heavy",)


@settings(max_examples=10)
@given(seed=st.integers(0, 40), order=st.permutations(range(3)), factor=st.sampled_from([0.25, 8.0]))
def test_scenarios_in_another_order_twice_or_all_weighed_more_are_the_same(
    seed: int, order: list[int], factor: float
) -> None:
    design = random_machine(seed)
    three = [
        scenario("a"),
        scenario("b", 0.5, speed_rpm=1.3 * design["speed_rpm"]),
        scenario("c", throws__0__crank_angle_deg=design["throws"][0]["crank_angle_deg"] + 10.0),
    ]
    answer = answered(design, scenarios=three)
    assert answer.certificate is not None
    near = 2e-6 * answer.certificate.yardstick
    second_answer = answered(design, scenarios=[*(three[n] for n in order), {**three[0], "name": "again"}])
    assert worst(second_answer) == pytest.approx(worst(answer), abs=near)
    scaled = answered(design, scenarios=[{**fields, "weight": factor * fields["weight"]} for fields in three])
    assert worst(scaled) == pytest.approx(factor * worst(answer), abs=factor * near)
    assert scaled.certificate is not None
    assert scaled.certificate.lower_bound is not None
    assert scaled.certificate.lower_bound <= factor * worst(answer) * (1 + 1e-12)


def test_the_longest_names_have_room_in_the_proof() -> None:
    fields, name = single_throw(), "n" * 64
    for n, bearing in enumerate(fields["bearings"]):
        bearing["name"] = f"{n}{name[1:]}"
    answer = answered(fields, objective={"bearing_weight": 1}, scenarios=[scenario(name), scenario("b", speed_rpm=8.7)])
    assert answer.certificate is not None
    assert max(len(multiplier.name) for multiplier in answer.certificate.multipliers.objective.rows) > 128


def test_force_and_bearings_of_the_worst_scenario_are_summed_there() -> None:
    """Analytic: one throw of m r = 1 and an infinite rod, at 1 and at 2 rad/s: four times the optimum at 1 rad/s."""
    fields, goal = single_throw(), {"moment_weight": 0, "bearing_weight": 1, "least_mass": False}
    alone = answered(fields, objective=goal)
    both = answered(fields, objective=goal, scenarios=[scenario("slow"), scenario("fast", speed_rpm="2 rad/s")])
    assert alone.certificate is not None
    assert worst(both) == pytest.approx(4.0 * alone.certificate.objective, rel=1e-5)
    ceiling = {**goal, "bearing_ceiling_N": 0.1}
    refused = answered(fields, objective=ceiling, scenarios=[scenario("slow"), scenario("fast", speed_rpm="2 rad/s")])
    assert refused.infeasibility is not None
    assert refused.infeasibility.conflict == ("bearing_ceiling_N",)
    # half of 1/4 of the reciprocating mass is left at the least, 0.25 N at 1 rad/s and four times that at 2
    smallest = refused.infeasibility.smallest
    assert smallest
    assert [peak.smallest for peak in smallest] == pytest.approx([1.0] * len(smallest), abs=1e-5)


@pytest.mark.parametrize(
    ("scenarios", "pointer"),
    [
        ([{"name": "a"}, {"name": "a"}], "1/name"),
        ([{"name": "a", "weight": 0}], "0/weight"),
        ([scenario("a", throws=2)], "0/changes/0/path"),
        ([scenario("a"), scenario("b", speed_rpm=1, throws__7__crank_radius_m=1)], "1/changes/1/path"),
        ([scenario("a", speed=2)], "0/changes/0/path"),
        ([{"name": "a", "changes": [{"path": "/objective/force_weight", "value": 2}]}], "0/changes/0/path"),
        ([{"name": "a", "changes": [{"path": "speed", "value": 2}]}], "0/changes/0/path"),
        ([scenario("a", webs__0__max_mass_kg=2)], "0/changes/0/path"),
        ([scenario("a", webs__0__counterweight_radius_m=2)], "0/changes/0/path"),
        ([scenario("a", max_total_mass_kg=2)], "0/changes/0/path"),
        ([scenario("a", speed_rpm=0)], "0/changes/0/value"),
        ([scenario("a", speed_rpm=None)], "0/changes/0/value"),
        ([scenario("a", speed_rpm="5 kg")], "0/changes/0/value"),
        ([scenario("a", speed_rpm=True)], "0/changes/0/value"),
        ([{"name": "a", "changes": [scenario("", speed_rpm=5)["changes"][0]] * 2}], "0/changes/1/path"),
        ([scenario("a", throws__0__rows__0__connecting_rod__length_m=0.05)], "0/changes/0/value"),
        ([scenario("a", throws__0__crank_radius_m=0.9)], "0/changes"),
    ],
)
def test_scenarios_that_are_none_are_refused_by_name(scenarios: list[dict[str, Any]], pointer: str) -> None:
    rod = {"length_m": 0.5}
    design = machine([throw(0.0, 0.0, [row(0.0, 5.0, connecting_rod=rod)])], [web("a", 0.0)])
    with pytest.raises(ValidationError) as caught:
        OptimizeRequest.model_validate({"machine": design, "scenarios": scenarios})
    texts = {
        "/".join(map(str, (*error["loc"], *problem)))
        for error in caught.value.errors()
        for problem in ([program.path for program in error.get("ctx", {}).get("problems", [])] or [()])
    }
    assert any(f"scenarios/{pointer}" in text for text in texts), texts


def test_scenarios_that_decide_nothing_cost_no_finer_numbers(monkeypatch: pytest.MonkeyPatch) -> None:
    """Property: of ten scenarios of 1e-9 to 1e12 times a mass those alone are solved in 50 digits that may decide."""
    norms, own = list[int](), stage_ends.solve_in

    def counted(precision: Precision) -> Any:
        def solved(until: float, data: Any, *rest: Any) -> Any:
            norms.append(data.row.size)
            return own(precision)(until, data, *rest)

        return solved

    monkeypatch.setattr(stage_ends, "solve_in", counted)
    rng, design = np.random.default_rng(148), random_machine(28)
    scenarios = []
    for n in range(int(rng.integers(8, 32))):
        t = int(rng.integers(len(design["throws"])))
        rows = design["throws"][t]["rows"]
        r = int(rng.integers(len(rows))) if rows else 0
        mass = rows[r]["reciprocating_mass_kg"] if rows else design["throws"][t]["rotating_mass_kg"]
        path = f"throws__{t}__rows__{r}__reciprocating_mass_kg" if rows else f"throws__{t}__rotating_mass_kg"
        factor = 10.0 ** float(rng.choice([0, 3, 6, 9, 12, -9]))
        weight = float(rng.choice([1, 1e-9, 1e6, 0.5]))
        scenarios.append(scenario(f"s{n}", weight, **{path: mass * factor}))
    for web_of in design["webs"] if rng.integers(2) else ():
        if rng.integers(2):
            web_of["max_mass_kg"] = None
    goal = {"combine": "max", "direction_weights": {"x": 1.0, "y": 0.3}}
    answer = answered(design, objective=goal, scenarios=scenarios)
    assert answer.status == "optimal"
    # all have 40, which takes 14 s
    assert norms
    assert max(norms) <= 8


def test_scenarios_go_with_sweeps_fronts_and_the_ladder() -> None:
    body = {"machine": crank(), "scenarios": [{"name": "a"}]}
    axis = {"path": "/machine/speed_rpm", "values": [100.0]}
    assert SweepRequest.model_validate({"base": body, "axes": [axis]}).separate
    assert ParetoRequest.model_validate(body).uncertain
    assert AccuracyRequest.model_validate(body).scenarios


def test_tolerances_go_with_sweeps_fronts_and_the_ladder() -> None:
    body = {"machine": crank(), "tolerances": {}}
    axis = {"path": "/machine/speed_rpm", "values": [100.0]}
    assert SweepRequest.model_validate({"base": body, "axes": [axis]}).separate
    assert ParetoRequest.model_validate(body).uncertain
    assert AccuracyRequest.model_validate(body).tolerances is not None


def test_what_a_scenario_lacks_is_asked_for_in_its_name() -> None:
    design = single_throw()
    broken = scenario("a", throws__0__rows__0__connecting_rod__length_m=None)
    goal = {"bearing_weight": 1}
    assert answered(design, objective=goal, scenarios=[broken]).status == "optimal"
    design["throws"][0]["rows"][0].pop("connecting_rod")
    with pytest.raises(MissingInput):
        answered(design, objective=goal, scenarios=[scenario("a")])


@pytest.mark.parametrize(
    ("design", "objective", "ceiling", "share", "slower"),
    part(
        2,
        [
            (BASES["twin"]["machine"], {"moment_weight": 0.2}, "bearing_ceiling_N", 0.97, 1.0),
            (random_machine(1), {"moment_weight": 0.0}, "moment_ceiling_Nm", 0.8, 1.0),
            # the slow machine decides the objective, and the fast one is under the ceiling
            (random_machine(1), {"moment_weight": 0.0}, "moment_ceiling_Nm", 0.8, 2.0),
        ],
        rows=True,
    ),
)
def test_the_multiplier_of_a_ceiling_is_what_it_costs_at_its_own_speed(
    design: dict[str, Any], objective: dict[str, float], ceiling: str, share: float, slower: float
) -> None:
    """Independent: the central difference of certified objectives."""
    several = [scenario("slow", slower), scenario("fast", speed_rpm=1.25 * design["speed_rpm"])]

    def under(cap: float) -> OptimizeAnswer:
        goal = {**objective, ceiling: cap}
        return answered(design, objective=goal, scenarios=several, accuracy={"relative_gap": 1e-9})

    free = under(1e12).worst_case
    cap = share * getattr(free, ceiling.replace("ceiling", "peak"))
    step = 1e-3 * cap
    below, at, above = (under(cap + off).certificate for off in (-step, 0.0, step))
    assert below is not None
    assert at is not None
    assert above is not None
    multipliers = [
        multiplier for multiplier in at.multipliers.objective.ceilings if np.hypot(multiplier.x, multiplier.y) > 1e-9
    ]
    assert {multiplier.scenario for multiplier in multipliers} == {"fast"}
    cost = sum(np.hypot(multiplier.x, multiplier.y) for multiplier in multipliers)
    assert cost == pytest.approx((below.objective - above.objective) / (2 * step), rel=1e-4)
