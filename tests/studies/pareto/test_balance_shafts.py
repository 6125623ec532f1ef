"""Fronts of machines with balance shafts: every point holds what they carry, and its proof counts with it."""

import json
from copy import deepcopy
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.errors import MissingInput
from optimizer.studies.pareto.pareto import pareto
from schemas.front.pareto import ParetoAnswer, ParetoFront, ParetoRequest
from schemas.front.trade import TradedFront
from service.report.chapters.pareto import traded as chapters
from service.verification import checker
from tests.night import by_day, part
from tests.optimize.machines import throw, web
from tests.optimize.shafts import WHOLE, at, in_line_four, rolled, shaft, single
from tests.studies.pareto.cases import ask, below_a_corner, front
from tests.verification.checking import broken

#: out of the plane of the cylinder, so that what takes the force makes a moment
ARM = 0.3
BESIDE = single([shaft("back", -1, ARM, 4.0)])
FOUR = in_line_four([shaft("a", 2, 0.2, y_m=0.3), shaft("b", -2, x_m=0.1, y_m=-0.1)], ratio=0.25)
ANGLES = range(0, 360, 2)


def inclined(rotation: str = "ccw", **more: Any) -> dict[str, Any]:
    """Two cylinders askew on two throws, counterweights that are too small, and shafts in other planes."""
    rows = [
        {"axis_deg": axis, "reciprocating_mass_kg": mass, "connecting_rod": {"length_m": 0.35}}
        for axis, mass in ((50.0, 12.0), (110.0, 7.0))
    ]
    throws = [throw(0.0, 20.0, rows[:1], rotating=3.0), throw(0.4, 150.0, rows[1:], rotating=1.0)]
    sector = {"centre_deg": 250.0, "half_angle_deg": 30.0}
    body = single([shaft("p", 1, 0.1, 1.0), shaft("q", -1, 0.5, 3.0, sector=sector), shaft("r", -1, -0.2, 4.0)])
    return body | {"throws": throws, "webs": [web("a", -0.1, 4.0), web("b", 0.6, 2.0)], "rotation": rotation, **more}


def sound(body: dict[str, Any], **more: Any) -> tuple[ParetoAnswer, dict[str, Any]]:
    """A front with its multipliers, none of whose claims the independent checker breaks; and as JSON."""
    request = {"machine": body, "points": 5, "multipliers": True, **more}
    answer = pareto(ParetoRequest.model_validate(request))
    document = json.loads(answer.model_dump_json())
    assert not broken(request, document)
    return answer, document


def trades(body: dict[str, Any], responses: list[str], points: int = 4, **more: Any) -> TradedFront:
    (trade,) = ask(body, points=points, responses=responses, **more).trades
    return trade


def over_turn(body: dict[str, Any], point: dict[str, Any], first: bool) -> np.ndarray:
    """Independent: force and couple at every angle, masses times accelerations (n, 2)."""
    return np.array([at(body, point, theta, first) for theta in ANGLES])


def test_a_lanchester_shaft_leaves_nothing_to_trade() -> None:
    # published: half of the reciprocating mass on either shaft, opposite the crank, cancels the first order
    (pareto_front,) = sound(single([shaft("back", -1, radius=0.05)]))[0].fronts
    (point,) = pareto_front.points
    assert (pareto_front.status, pareto_front.reason) == ("optimal", "reached_together")
    assert point.force_peak_N <= 1e-6 * WHOLE
    assert point.moment_peak_Nm == 0.0
    assert point.total_mass_kg == pytest.approx(5.0, rel=1e-6)
    assert point.balance_shafts_mass_kg == pytest.approx(10.0, rel=3e-6)
    assert point.certificate.mass_lower_bound_kg == pytest.approx(15.0, rel=3e-6)
    assert point.balance_shafts[0].counterweights[0].angle_deg == pytest.approx(270.0, abs=1e-4)


@pytest.mark.parametrize("rotation", ["ccw", "cw"])
def test_a_shaft_beside_the_cylinder_trades_along_a_straight_line(rotation: str) -> None:
    # analytic: of the 5 kg that turn backwards m are taken, F = (5 - m) and M = m d of 0.1 omega^2, up to 4 kg
    pareto_front = front(BESIDE | {"rotation": rotation}, points=5)
    assert (pareto_front.status, pareto_front.knee) == ("optimal", None)
    for point, share in zip(pareto_front.points, np.linspace(0.1, 0.5, 5), strict=True):
        assert point.force_peak_N == pytest.approx(share * WHOLE, rel=1e-5)
        assert point.moment_peak_Nm == pytest.approx((0.5 - share) * ARM * WHOLE, abs=1e-5 * WHOLE)
        assert point.force_peak_N + point.moment_peak_Nm / ARM == pytest.approx(0.5 * WHOLE, rel=1e-6)
        assert point.total_mass_kg == pytest.approx(5.0, rel=1e-4)
        assert point.balance_shafts_mass_kg == pytest.approx(10.0 * (0.5 - share), abs=1e-4)


@pytest.mark.parametrize("rotation", part(2, ["ccw", "cw"]))
@pytest.mark.parametrize(
    "goal",
    part(
        2,
        [
            {},
            {"direction_weights": {"x": 1, "y": 0.3}},
            {"moment_ceiling_y_Nm": 700.0},
            {"force_ceiling_x_N": 1500.0, "least_mass": False},
        ],
    ),
)
def test_points_are_what_masses_times_accelerations_come_to(rotation: str, goal: dict[str, Any]) -> None:
    """Independent: the pistons' first order and all unbalances of a point, at every angle."""
    body = inclined(rotation)
    answer, reply = sound(body, objective=goal)
    (pareto_front,) = answer.fronts
    assert pareto_front.status == "optimal"
    across = goal.get("direction_weights", {"x": 1.0, "y": 1.0})
    for point, there in zip(pareto_front.points, reply["fronts"][0]["points"], strict=True):
        turn = over_turn(body, there, first=True)
        weighted = across["x"] * turn.real + 1j * across["y"] * turn.imag
        plain = (point.force_peak_N, point.moment_peak_Nm)
        assert np.max(np.abs(turn), axis=0) == pytest.approx(plain, rel=2e-3)
        assert np.all(np.max(np.abs(turn), axis=0) <= np.array(plain) * (1 + 1e-9))
        traded = (point.weighted_force_peak_N, point.weighted_moment_peak_Nm)
        assert np.max(np.abs(weighted), axis=0) == pytest.approx(traded, rel=2e-3)
        assert np.max(np.abs(turn[:, 1].imag)) <= goal.get("moment_ceiling_y_Nm", np.inf) * (1 + 1e-9)
        assert np.max(np.abs(turn[:, 0].real)) <= goal.get("force_ceiling_x_N", np.inf) * (1 + 1e-9)


@cache
def inclined_front() -> ParetoFront:
    return front(inclined(), points=5)


@by_day(5)
@given(st.integers(0, 10**6))
def test_nobody_is_below_a_corner(seed: int) -> None:
    """Property: whatever crankshaft and balance shafts carry within their limits."""
    body, pareto_front, rng = inclined(), inclined_front(), np.random.default_rng(seed)
    places = [body["webs"], *(balance_shaft["webs"] for balance_shaft in body["balance_shafts"])]
    near = [pareto_front.points[int(rng.integers(len(pareto_front.points)))].model_dump()]
    fitted = [
        near[0]["counterweights"],
        *(balance_shaft["counterweights"] for balance_shaft in near[0]["balance_shafts"]),
    ]
    scale = rng.choice([0.01, 0.3, 3.0])
    for webs, weights in zip(places, fitted, strict=True):
        for place, weight in zip(webs, weights, strict=True):
            weight["mass_kg"] = float(np.clip(weight["mass_kg"] + scale * rng.normal(), 0.0, place["max_mass_kg"]))
            angle = weight["angle_deg"] + 60.0 * scale * rng.normal()
            sector = place.get("sector")
            weight["angle_deg"] = float(np.clip(angle, 220.0, 280.0)) if sector else angle
    force, moment = np.max(np.abs(over_turn(body, near[0], first=True)), axis=0)
    # samples are up to 0.1 % below the peak
    assert not below_a_corner(float(force) * 1.001, float(moment) * 1.001, pareto_front)


@pytest.mark.parametrize("turned", part(2, [137.0, 90.0]))
def test_a_machine_that_is_turned_or_mirrored_has_the_same_front(turned: float) -> None:
    """Property: all angles on by the same, or all of them backwards with the rotation."""
    body = inclined()
    plain = front(body, points=4)
    for sign, by in ((1.0, turned), (-1.0, 0.0)):
        second_machine = deepcopy(body)
        for crank in second_machine["throws"]:
            crank["crank_angle_deg"] = sign * crank["crank_angle_deg"] + by
            for row in crank["rows"]:
                row["axis_deg"] = sign * row["axis_deg"] + by
        for balance_shaft in second_machine["balance_shafts"]:
            for place in balance_shaft["webs"]:
                if "sector" in place:
                    place["sector"]["centre_deg"] = sign * place["sector"]["centre_deg"] + by
        second_machine["rotation"] = "ccw" if sign > 0 else "cw"
        again = front(second_machine, points=4)
        for point, two in zip(plain.points, again.points, strict=True):
            # where a front falls like a square root, a gap of 1e-6 is more of the other peak
            assert two.force_peak_N == pytest.approx(point.force_peak_N, rel=1e-4)
            assert two.moment_peak_Nm == pytest.approx(point.moment_peak_Nm, rel=1e-4)
            assert two.balance_shafts_mass_kg == pytest.approx(point.balance_shafts_mass_kg, rel=1e-3)


def test_fixed_weights_and_groups_stand_beside_shafts() -> None:
    body = inclined(rotation="cw")
    body["webs"] = [
        web("a", -0.1, 4.0, throw=0), web("b", 0.6, 4.0, throw=1),
        web("c", 0.2, None, fixed={"mass_kg": 1.5, "angle_deg": 40.0}),
    ]  # fmt: skip
    body["web_groups"] = [{"name": "ends", "webs": ["a", "b"]}]
    answer, _ = sound(body)
    (pareto_front,) = answer.fronts
    assert pareto_front.status == "optimal"
    for point in pareto_front.points:
        first, second, there = point.counterweights
        assert first.mass_kg == second.mass_kg
        assert first.angle_from_crank_deg == pytest.approx(second.angle_from_crank_deg, abs=1e-9)
        assert (there.mass_kg, there.fixed) == (1.5, True)


def test_shafts_without_limits_and_without_counterweights_have_a_front() -> None:
    body = single([shaft("back", -1, ARM, None), shaft("on", 1, 0.1, None)], webs=0)
    answer, _ = sound(body)
    (pareto_front,) = answer.fronts
    assert pareto_front.status == "optimal"
    assert {"back web", "on web"} <= pareto_front.implied_max_mass_kg.keys()
    assert all(point.total_mass_kg == 0.0 for point in pareto_front.points)


def test_ceilings_out_of_reach_are_named_with_what_comes_closest() -> None:
    answer, _ = sound(single([shaft("back", -1, ARM, 2.0)], webs=0), objective={"force_ceiling_y_N": 0.1 * WHOLE})
    (pareto_front,) = answer.fronts
    assert (answer.status, pareto_front.status) == ("infeasible", "infeasible")
    assert pareto_front.infeasibility is not None
    assert pareto_front.infeasibility.conflict == ("force_ceiling_y_N",)
    # analytic: 2 of the 5 kg that turn backwards
    assert pareto_front.infeasibility.closest.balance_shafts[0].total_mass_kg == pytest.approx(2.0, rel=1e-6)


@pytest.mark.parametrize(("orders", "most"), [("first", 0.5), ("all", 0.5)])
def test_force_against_the_mass_of_all_shafts(orders: str, most: float) -> None:
    # independent: masses times accelerations; analytic: the mass that is traded is that of all shafts
    traded_front = trades(BESIDE, ["force", "mass"], objective={"orders": orders, "moment_weight": 0})
    assert traded_front.status == "optimal"
    for point in traded_front.points:
        force = np.max(np.abs(over_turn(BESIDE, point.model_dump(), first=orders == "first")[:, 0]))
        assert force == pytest.approx(point.values[0], rel=2e-3)
        assert point.values[1] == pytest.approx(point.total_mass_kg + point.balance_shafts_mass_kg, rel=1e-12)
    if orders == "first":
        # analytic: 0.1 of the force is left where 5 and 4 kg are taken
        assert traded_front.responses[0].smallest == pytest.approx(0.1 * WHOLE, rel=1e-5)
        assert traded_front.points[0].values[1] == pytest.approx(9.0, rel=1e-4)


@pytest.mark.parametrize("machine", part(2, [FOUR, FOUR | {"rotation": "cw"}]))
def test_the_roll_moment_is_traded(machine: dict[str, Any]) -> None:
    """Independent: torque about the shaft, and forces of all orders, from their definitions."""
    goal = {"orders": "all", "roll_weight": 7.0, "moment_ceiling_Nm": 500.0}
    traded_front = trades(machine, ["force", "roll"], objective=goal)
    assert traded_front.status == "optimal"
    assert [response.unit for response in traded_front.responses] == ["N", "N m"]
    for point in traded_front.points:
        fields = point.model_dump()
        turn = over_turn(machine, fields, first=False)
        torque = np.array([rolled(machine, fields, theta) for theta in np.arange(0.0, 360.0, 0.5)])
        assert np.max(np.abs(turn[:, 0])) == pytest.approx(point.values[0], rel=2e-3)
        assert np.max(np.abs(torque)) == pytest.approx(point.values[1], rel=2e-3)
        assert np.max(np.abs(turn[:, 1])) <= 500.0 * (1 + 1e-9)
    first, last = traded_front.points[0], traded_front.points[-1]
    assert first.values[0] < last.values[0]
    assert first.values[1] > last.values[1]


def test_the_roll_of_the_first_order_counts_a_shaft_that_turns_backwards() -> None:
    """Independent: its web stands for its mirror image beside responses of the first order."""
    body = single([shaft("back", -1, y_m=0.2, radius=0.05)])
    traded_front = trades(body, ["force", "roll", "mass"], points=6)
    assert traded_front.status == "optimal"
    for point in traded_front.points:
        torque = [rolled(body, point.model_dump(), theta) for theta in np.arange(0.0, 360.0, 0.5)]
        assert np.max(np.abs(torque)) == pytest.approx(point.values[1], rel=2e-3, abs=1e-6)
        force = np.max(np.abs(over_turn(body, point.model_dump(), first=True)[:, 0]))
        assert force == pytest.approx(point.values[0], rel=2e-3, abs=1e-5 * WHOLE)


def test_bearings_and_the_objective_are_traded_beside_shafts() -> None:
    bearings = [{"name": "A", "position_m": -0.2}, {"name": "B", "position_m": 0.2}]
    body = single([shaft("back", -1, ARM, 4.0)], bearings=bearings)
    of_loads = trades(body, ["bearings", "force"], points=3)
    assert of_loads.status == "optimal"
    weighed = trades(body, ["objective", "mass"], points=3)
    assert weighed.status == "optimal"
    # analytic: a moment weighs its force times d / 1 m, so that the shaft is worth its moment where d < 1
    assert weighed.responses[0].smallest == pytest.approx((0.1 + 0.4 * ARM) * WHOLE, rel=1e-5)


def _refused(body: dict[str, Any]) -> list[tuple[str | int, ...]]:
    with pytest.raises(ValueError, match=r".") as refused:
        ParetoRequest.model_validate(body)
    return [problem.path for error in refused.value.errors() for problem in error["ctx"]["problems"]]


def test_what_does_not_go_with_shafts_is_refused_by_its_field() -> None:
    assert _refused({"machine": BESIDE, "total_mass_budgets_kg": [5.0]}) == [("total_mass_budgets_kg",)]
    assert _refused({"machine": BESIDE, "objective": {"force_ceiling_N": 500.0}}) == [("objective", "force_ceiling_N")]
    assert _refused({"machine": BESIDE, "objective": {"orders": "all"}}) == [("objective", "orders")]
    assert _refused({"machine": BESIDE, "objective": {"roll_weight": 1.0}}) == [("objective", "roll_weight")]
    mixed = {"machine": BESIDE, "objective": {"roll_weight": 1.0}, "responses": ["objective", "mass"]}
    assert _refused(mixed) == [("objective", "roll_weight")]
    bare = {"machine": single([]), "responses": ["mass", "roll"]}
    assert _refused(bare) == [("responses", 1)]
    rodless = deepcopy(BESIDE)
    del rodless["throws"][0]["rows"][0]["connecting_rod"]
    with pytest.raises(MissingInput) as lacking:
        ask(rodless, responses=["roll", "mass"])
    assert [problem.path[-1] for problem in lacking.value.problems] == ["connecting_rod"]


@pytest.mark.parametrize(
    "path",
    [
        ("balance_shafts", 0, "counterweights", 0, "mass_kg"),
        ("balance_shafts", 0, "total_mass_kg"),
        ("balance_shafts_mass_kg",),
        ("total_mass_kg",),
        ("force_peak_N",),
        ("certificate", "force_N"),
        ("certificate", "mass_lower_bound_kg"),
    ],
)
def test_a_figure_that_is_made_up_is_broken(path: tuple[str | int, ...]) -> None:
    body = {"machine": BESIDE, "points": 3, "multipliers": True}
    answer = json.loads(pareto(ParetoRequest.model_validate(body)).model_dump_json())
    place = answer["fronts"][0]["points"][1]
    for step in path[:-1]:
        place = place[step]
    place[path[-1]] *= 1.001
    assert broken(body, answer)
    del place[path[-1]]
    tools = checker()
    try:
        judgements = {claim["verdict"] for claim in tools.verify(body, answer)["claims"]}
    except tools.Unreadable:
        return
    assert judgements != {"held"}


def test_a_table_says_what_every_shaft_carries() -> None:
    request = ParetoRequest.model_validate({"machine": BESIDE, "points": 3})
    _, of_front = chapters(request, pareto(request))
    block = of_front.blocks[0]
    assert [column.title for column in block.columns if "kg" in column.title] == [
        "mass on the crankshaft, kg",
        "on balance shafts, kg",
    ]
    assert "largest mass of back web" in str(block.rows[0])
