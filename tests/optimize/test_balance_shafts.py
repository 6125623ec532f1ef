"""Balance shafts of the first order: one backwards takes what no counterweight on the crankshaft can."""

from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from optimizer.analyze import analyze
from optimizer.formulation.balance_shafts import fitted, placement_of
from schemas.answer.answers import OptimizeAnswer
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.objective import Objective
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from tests.night import part
from tests.optimize.machines import throw, web
from tests.optimize.shafts import WHOLE, at, in_line_four, shaft, single
from tests.verification.checking import optimized


def answer(body: dict[str, Any], **objective: Any) -> OptimizeAnswer:
    return optimized({"machine": body, "objective": objective})


def test_one_shaft_backwards_takes_the_other_half_of_a_single_cylinder() -> None:
    # published: half of the reciprocating mass on either shaft, opposite the crank, cancels the first order
    optimum = answer(single([shaft("back", -1, radius=0.05)]))
    (back,) = optimum.balance_shafts
    (on_shaft,) = back.counterweights
    assert optimum.status == "optimal"
    assert optimum.residual.after.force.peak_N <= 2e-6 * WHOLE
    assert optimum.certificate.lower_bound >= 0.0
    assert optimum.total_mass_kg == pytest.approx(5.0, rel=3e-6)
    assert optimum.balance_shafts_mass_kg == back.total_mass_kg == pytest.approx(10.0, rel=3e-6)
    assert on_shaft.angle_deg == pytest.approx(270.0, abs=1e-4)
    assert on_shaft.centrifugal_force_N == pytest.approx(0.5 * WHOLE, rel=3e-6)
    assert (on_shaft.throw, on_shaft.angle_from_crank_deg) == (None, None)
    assert back.gearing.startswith("Turns against the crankshaft at its speed")
    assert (optimum.floor.force_N, optimum.floor.moment_Nm) == (0.0, 0.0)
    # the least mass of all shafts together
    assert optimum.certificate.mass_lower_bound_kg == pytest.approx(15.0, rel=3e-6)


@pytest.mark.parametrize(("ratio", "left"), [(1, 0.5), (-1, 0.5), (2, 1.0), (-2, 1.0)])
def test_a_shaft_answers_its_own_phasor_alone(ratio: int, left: float) -> None:
    # analytic: without counterweights on the crankshaft
    optimum = answer(single([shaft("one", ratio)], webs=0))
    assert optimum.residual.after.force.peak_N == pytest.approx(left * WHOLE, rel=2e-6)
    assert optimum.balance_shafts_mass_kg == pytest.approx(5.0 if abs(ratio) == 1 else 0.0, rel=1e-5)
    assert optimum.floor.force_N == pytest.approx(0.0 if ratio == -1 else 0.5 * WHOLE)


@pytest.mark.parametrize(
    ("ratio", "words"),
    [
        (1, "Turns with the crankshaft at its speed"),
        (-1, "Turns against the crankshaft at its speed"),
        (2, "Turns with the crankshaft at twice its speed"),
        (-2, "Turns against the crankshaft at twice its speed"),
    ],
)
def test_how_a_shaft_is_geared_and_stands_is_said(ratio: int, words: str) -> None:
    # analytic: what is fitted is named by its angle, however light, and nothing where nothing is
    machine = ReciprocatingMachine.model_validate(single([shaft("one", ratio)], webs=2))
    there = fitted(machine, np.array([1.0, 1.0, 0.25]), np.array([0.0, 0.0, 30.0])).balance_shafts[0]
    assert there.gearing == f"{words}; at shaft angle 0 one web at 30.00 deg."
    nothing = fitted(machine, np.array([1.0, 1.0, 0.0]), np.zeros(3)).balance_shafts[0]
    assert nothing.gearing == f"{words}; at shaft angle 0 it carries nothing."


def test_limits_of_a_shaft_are_kept_and_priced() -> None:
    # analytic: 2 kg of the 5 that the shaft needs
    optimum = answer(single([shaft("back", -1, max_mass=2.0)]))
    assert optimum.residual.after.force.peak_N == pytest.approx(0.3 * WHOLE, rel=1e-5)
    (price,) = optimum.shadow_prices
    assert (price.web, price.limit) == ("back web", "max_mass")
    assert price.value == pytest.approx(0.1 * WHOLE, rel=1e-6)
    # 270 degrees is best, 220 the nearest that the sector allows; what stands across is left
    body = single([shaft("back", -1, sector={"centre_deg": 200.0, "half_angle_deg": 20.0})])
    (on_shaft,) = answer(body).balance_shafts[0].counterweights
    assert on_shaft.angle_deg == pytest.approx(220.0, abs=1e-6)
    assert on_shaft.active_limits == ("sector",)
    # the objective is flat there, and the lightest of the optima is taken
    assert on_shaft.mass_kg == pytest.approx(5.0 * np.cos(np.deg2rad(50.0)), rel=5e-3)


def _inclined(rotation: str) -> dict[str, Any]:
    """Two cylinders askew on two throws, counterweights that are too small, and three shafts in other planes."""
    rows = [
        {"axis_deg": axis, "reciprocating_mass_kg": mass, "connecting_rod": {"length_m": 0.35}}
        for axis, mass in ((50.0, 12.0), (110.0, 7.0))
    ]
    throws = [throw(0.0, 20.0, rows[:1], rotating=3.0), throw(0.4, 150.0, rows[1:], rotating=1.0)]
    body = single([shaft("p", 1, 0.1, 1.0), shaft("q", -1, 0.5, 3.0), shaft("r", -1, -0.2, 4.0)])
    return body | {"throws": throws, "webs": [web("a", -0.1, 4.0), web("b", 0.6, 2.0)], "rotation": rotation}


@pytest.mark.parametrize("rotation", part(2, ["ccw", "cw"]))
@pytest.mark.parametrize(
    "objective",
    [{}, {"combine": "max"}, {"direction_weights": {"x": 1, "y": 0.3}}, {"moment_weight": 0, "force_ceiling_y_N": 900}],
)
def test_figures_are_those_of_masses_times_accelerations(rotation: str, objective: dict[str, Any]) -> None:
    """Independent: what the returned unbalances and the pistons' first order come to over the turn."""
    body = _inclined(rotation)
    optimum = answer(body, **objective)
    assert optimum.status == "optimal"
    turn = np.array([at(body, optimum.model_dump(), theta, first=True) for theta in np.arange(0.0, 360.0, 0.25)])
    after = optimum.residual.after
    assert after.force.peak_N == pytest.approx(np.max(np.abs(turn[:, 0])), rel=1e-5)
    assert after.moment.peak_Nm == pytest.approx(np.max(np.abs(turn[:, 1])), rel=1e-5)
    assert after.force.peak_y_N == pytest.approx(np.max(np.abs(turn[:, 0].imag)), rel=1e-5)
    # nobody near is better
    rest = optimum.certificate.objective_without_counterweights
    assert optimum.certificate.objective - optimum.certificate.lower_bound <= 1e-6 * rest


def test_given_unbalances_are_counted_at_the_order_of_their_shaft() -> None:
    body = in_line_four([shaft("up", 2, 0.18), shaft("low", -2, 0.18)])
    counterweights = [
        {"web": "up web", "mass_kg": 1.0, "angle_deg": 30.0},
        {"web": "low web", "mass_kg": 2.0, "angle_deg": 300.0},
    ]
    payload = {"machine": body, "counterweights": counterweights, "outputs": ["residual", "orders"]}
    analysis = analyze(AnalyzeRequest.model_validate(payload))
    # analytic: (2 omega)^2 m R, beside m r A_2 / 2 of four cylinders along y either way
    second, was = analysis.residual.orders.after[1], analysis.residual.orders.before[1]
    for sense, mass, degrees in (("co_rotating", 1.0, 30.0), ("counter_rotating", 2.0, 300.0)):
        left, there = getattr(second.force, sense), getattr(was.force, sense)
        added = complex(left.real_N - there.real_N, left.imag_N - there.imag_N)
        assert added == pytest.approx(4.0 * mass * 0.1 * WHOLE * np.exp(1j * np.deg2rad(degrees)), rel=1e-12)
    assert analysis.orders.after[1] == second
    assert analysis.residual.orders.after[0] == analysis.residual.orders.before[0]
    assert [balance_shaft.total_mass_kg for balance_shaft in analysis.balance_shafts] == [1.0, 2.0]
    assert analysis.balance_shafts_mass_kg == 3.0


def _refused(model: type, body: dict[str, Any]) -> tuple[Any, ...]:
    with pytest.raises(ValidationError) as refused:
        model.model_validate(body)
    (error,) = refused.value.errors()
    return error["ctx"]["problems"][0].path if error["type"] == "cross_field" else error["loc"]


def test_what_a_balance_shaft_cannot_be_is_refused_by_name() -> None:
    odd = single([shaft("odd", -1) | {"speed_ratio": 3}])
    assert _refused(OptimizeRequest, {"machine": odd})[-3:] == ("balance_shafts", 0, "speed_ratio")
    bare = single([shaft("one", -1) | {"webs": []}])
    assert _refused(OptimizeRequest, {"machine": bare})[-3:] == ("balance_shafts", 0, "webs")
    twice = single([shaft("one", -1), shaft("two", 1)])
    twice["balance_shafts"][1]["webs"][0]["name"] = "a"
    assert _refused(OptimizeRequest, {"machine": twice}) == ("balance_shafts", 1, "webs", 0, "name")
    named = single([shaft("one", -1), shaft("one", 1) | {"webs": [web("else", 0.0)]}])
    assert _refused(OptimizeRequest, {"machine": named}) == ("balance_shafts", 1, "name")
    cranked = single([shaft("one", -1)])
    cranked["balance_shafts"][0]["webs"][0]["throw"] = 0
    assert _refused(OptimizeRequest, {"machine": cranked}) == ("balance_shafts", 0, "webs", 0, "throw")
    limited = single([shaft("one", -1)], max_total_mass_kg=5.0)
    assert _refused(OptimizeRequest, {"machine": limited}) == ("max_total_mass_kg",)


def test_what_is_not_done_with_balance_shafts_is_refused_by_name() -> None:
    body = {"machine": single([shaft("one", -1)])}
    for field in ("force_ceiling_N", "moment_ceiling_Nm"):
        assert _refused(OptimizeRequest, {**body, "objective": {field: 100.0}}) == ("objective", field)

    forward = {"machine": single([shaft("one", 1)]), "objective": {"force_ceiling_N": 0.7 * WHOLE}}
    assert optimized(forward).status == "optimal"


# ---- all orders, by cuts whose influence turns


def turned(body: dict[str, Any], optimum: OptimizeAnswer, step: float = 0.25) -> np.ndarray:
    """Independent: force and couple over the turn, of masses times accelerations (n, 2)."""
    answered = optimum.model_dump()
    return np.array([at(body, answered, theta) for theta in np.arange(0.0, 360.0, step)])


@pytest.mark.parametrize(
    ("shafts", "webs", "expected"),
    [
        # analytic: 1 + lambda; the least that a web can, at 0.603531; lambda / sqrt(1 - lambda^2)
        ((), 0, 1.3),
        ((), 1, 0.6964692),
        ((-1,), 1, 0.3 / np.sqrt(1.0 - 0.09)),
        # independent: brute force
        ((2,), 1, 0.6112893),
    ],
)
def test_a_single_cylinder_over_all_orders(shafts: tuple[int, ...], webs: int, expected: float) -> None:
    body = single([shaft(f"at {ratio}", ratio) for ratio in shafts], webs)
    optimum = answer(body, orders="all")
    assert optimum.status == "optimal"
    # an optimum may be above it by a millionth of 1.3
    assert optimum.certificate.objective / WHOLE == pytest.approx(expected, abs=1.5e-6)
    assert optimum.certificate.objective - optimum.certificate.lower_bound <= 1e-6 * 1.3 * WHOLE
    assert np.max(np.abs(turned(body, optimum)[:, 0])) == pytest.approx(optimum.certificate.objective, rel=1e-5)
    if webs and not shafts:
        assert optimum.counterweights[0].mass_radius_kg_m == pytest.approx(0.603531, abs=1e-5)


def _lanchester(**objective: Any) -> tuple[dict[str, Any], OptimizeAnswer]:
    body = in_line_four([shaft("with", 2, 0.18), shaft("against", -2, 0.18)])
    return body, answer(body, orders="all", moment_weight=0, **objective)


def test_lanchesters_pair_takes_the_second_order_of_an_in_line_four() -> None:
    body, optimum = _lanchester()
    sizes = [
        counterweight.mass_radius_kg_m
        for balance_shaft in optimum.balance_shafts
        for counterweight in balance_shaft.counterweights
    ]
    # analytic: m r A_2 / 2 on each, opposite the outer cranks, a hair more where the fourth order counts too
    assert sizes == pytest.approx([0.1535253] * 2, rel=1e-3)
    assert [balance_shaft.counterweights[0].angle_deg for balance_shaft in optimum.balance_shafts] == pytest.approx(
        [270.0] * 2, abs=0.01
    )
    assert np.max(np.abs(turned(body, optimum)[:, 0])) == pytest.approx(optimum.certificate.objective, rel=1e-5)
    # what the second order was, and that all is told as it is
    assert optimum.residual.orders.before[1].force.peak_N == pytest.approx(8.0 * 0.1535253 * WHOLE, rel=1e-6)
    assert optimum.residual.orders.after[1].force.peak_N <= 2e-3 * WHOLE
    assert [warning.code for warning in optimum.warnings if warning.code == "second_order_remains"] == []
    counterweights = [{"web": f"{name} web", "mass_kg": 1.5352532, "angle_deg": 270.0} for name in ("with", "against")]
    payload = {"machine": body, "counterweights": counterweights, "outputs": ["residual"]}
    exact = analyze(AnalyzeRequest.model_validate(payload)).residual.orders.after[1]
    assert exact.force.peak_N <= 1e-6 * WHOLE


def test_what_shafts_at_twice_the_speed_could_do_is_said() -> None:
    body, _ = _lanchester()
    (caution,) = [warning for warning in answer(body).warnings if warning.code == "second_order_remains"]
    assert "ask for all orders" in caution.message
    body["balance_shafts"][1]["webs"][0]["max_mass_kg"] = 0.5
    (actual_caution,) = [
        warning for warning in answer(body, orders="all").warnings if warning.code == "second_order_remains"
    ]
    assert "balance shafts at twice the speed leave" in actual_caution.message


def test_ceilings_over_all_orders_count_the_shafts() -> None:
    body, free = _lanchester()
    whole = free.certificate.objective_without_counterweights
    # out of the middle, so that what takes the force makes a moment
    beside = in_line_four([shaft("with", 2, 0.1), shaft("against", -2, 0.1)])
    optimum = answer(beside, orders="all", moment_weight=1, force_weight=0.01, force_ceiling_N=0.3 * whole)
    assert (optimum.status, optimum.active_limits) == ("optimal", ("force_ceiling",))
    assert np.max(np.abs(turned(beside, optimum)[:, 0])) == pytest.approx(0.3 * whole, rel=1e-5)
    refused = answer(body, orders="all", force_ceiling_N=0.5 * free.certificate.objective)
    assert refused.status == "infeasible"
    assert refused.infeasibility.conflict == ("force_ceiling_N",)
    (reached,) = refused.infeasibility.smallest
    assert reached.smallest == pytest.approx(free.certificate.objective, rel=1e-4)
    assert len(refused.infeasibility.closest.balance_shafts) == 2


def test_bearings_are_not_loaded_by_balance_shafts() -> None:
    body = single([shaft("back", -1)], bearings=[{"name": "A", "position_m": -0.2}, {"name": "B", "position_m": 0.2}])
    with_them = answer(body, bearing_weight=1, force_weight=0, moment_weight=0)
    without = answer({**body, "balance_shafts": []}, bearing_weight=1, force_weight=0, moment_weight=0)
    assert with_them.certificate.objective == pytest.approx(without.certificate.objective, rel=2e-6)
    assert with_them.balance_shafts_mass_kg == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("rotation", ["ccw", "cw"])
def test_nobody_near_is_better_over_all_orders(rotation: str) -> None:
    body = _inclined(rotation)
    body["balance_shafts"] += [shaft("t", 2, 0.3, 0.4), shaft("u", -2, 0.1, 0.5)]
    optimum = answer(body, orders="all", combine="max")
    assert optimum.status == "optimal"
    # independent: sampled, and unbalances moved at random
    weight = 1.0 / 0.7

    def sampled(answered: dict[str, Any]) -> float:
        turn = np.array([at(body, answered, theta) for theta in np.arange(0.0, 360.0, 2.0)])
        return max(float(np.max(np.abs(turn[:, 0]))), weight * float(np.max(np.abs(turn[:, 1]))))

    best = optimum.model_dump()
    assert sampled(best) == pytest.approx(optimum.certificate.objective, rel=2e-3)
    rng = np.random.default_rng(7)
    places = [*body["webs"], *(place for balance_shaft in body["balance_shafts"] for place in balance_shaft["webs"])]
    for scale in (1e-3, 1e-2, 0.1):
        second_answer = optimum.model_dump()
        fitted = [
            *second_answer["counterweights"],
            *(
                counterweight
                for balance_shaft in second_answer["balance_shafts"]
                for counterweight in balance_shaft["counterweights"]
            ),
        ]
        for place, max_masses_kg in zip(places, fitted, strict=True):
            max_masses_kg["mass_kg"] = min(
                place["max_mass_kg"], max_masses_kg["mass_kg"] * (1.0 + scale * rng.normal())
            )
            max_masses_kg["angle_deg"] += 90.0 * scale * rng.normal()
        assert sampled(second_answer) >= optimum.certificate.lower_bound * (1.0 - 2e-3)


@pytest.mark.parametrize(
    ("ratio", "orders", "drawn"), [(-1, "first", 330.0), (-1, "all", 30.0), (1, "first", 30.0), (-2, "first", 30.0)]
)
def test_a_shaft_that_turns_backwards_is_drawn_as_the_mirror_image_of_its_phasor(
    ratio: int, orders: str, drawn: float
) -> None:
    """Analytic: its unbalance at shaft angle 0 is the conjugate of what the program of the first order adds up."""
    machine = ReciprocatingMachine.model_validate(single([shaft("one", ratio)]))
    objective = Objective.model_validate({"orders": orders})
    (there,) = placement_of(machine, objective, np.array([1.0, 0.25]), np.array([70.0, 30.0])).balance_shafts
    assert there.counterweights[0].angle_deg == pytest.approx(drawn, abs=1e-12)
    assert there.counterweights[0].mass_kg == 0.25
