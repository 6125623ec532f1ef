"""The whole flow: rules of the field, limits, and answers re-simulated by other means."""

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from optimizer.errors import MissingInput
from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from tests.optimize.asking import OMEGA_SQUARED, answer, single
from tests.optimize.machines import first_order, machine, random_machine, row, throw, web

# ---- rules of docs/mathematics.md section 6, all analytic: m = 20 kg, r = R = 0.1 m


def test_single_row_takes_half_the_reciprocating_mass_and_keeps_half_the_peak() -> None:
    optimum = answer(single([(90.0, 20.0)], rotating=6.0))
    full = 20.0 * 0.1 * OMEGA_SQUARED
    assert optimum.total_mass_kg == pytest.approx(6.0 + 10.0, rel=1e-5)
    assert optimum.residual.after.force.peak_N == pytest.approx(full / 2, rel=1e-5)
    assert optimum.floor.force_N == pytest.approx(full / 2, rel=1e-12)


@pytest.mark.parametrize(
    "rows",
    [
        pytest.param([(0.0, 20.0), (-90.0, 20.0)], id="V 90 equal"),
        pytest.param([(60.0, 20.0), (0.0, 20.0), (-60.0, 20.0)], id="W 60"),
        pytest.param([(72.0 * k, 20.0) for k in range(5)], id="star of five"),
    ],
)
def test_complete_balance(rows: list[tuple[float, float]]) -> None:
    optimum = answer(single(rows))
    assert optimum.floor.force_N == 0.0
    assert optimum.residual.after.force.peak_N <= 1.1e-6 * optimum.residual.before.force.peak_N
    assert optimum.status == "optimal"


def test_unequal_v_leaves_half_the_difference() -> None:
    optimum = answer(single([(0.0, 24.0), (-90.0, 14.0)]))
    assert optimum.residual.after.force.peak_N == pytest.approx(0.5 * 10.0 * 0.1 * OMEGA_SQUARED, rel=1e-5)


@pytest.mark.parametrize(
    ("angles", "least", "rule"),
    [
        pytest.param([0, 120, 240], math.sqrt(3) / 2, 1.5, id="three cranks at 120"),
        pytest.param([0, 180, 90, 270], math.sqrt(2) / 3, 2.0, id="four cranks at 90"),
    ],
)
def test_free_masses_need_a_fraction_of_the_iron_of_the_rule(angles: list[float], least: float, rule: float) -> None:
    # the rule puts half the reciprocating mass opposite every crank; both remove all that can be removed
    throws = [throw(float(k), float(angle), [row(0.0, 20.0)]) for k, angle in enumerate(angles)]
    webs = [web(str(k), float(k)) for k in range(len(angles))]
    optimum = answer(machine(throws, webs))
    unit = 20.0  # m r / R
    assert optimum.total_mass_kg == pytest.approx(least * unit, rel=1e-4)
    assert least < rule
    assert optimum.residual.after.moment.peak_Nm == pytest.approx(optimum.floor.moment_Nm, rel=1e-5)
    by_rule = [{"web": str(k), "mass_kg": 10.0, "angle_deg": angle + 180} for k, angle in enumerate(angles)]
    peak = np.max(np.abs(first_order(machine(throws, webs), by_rule, np.arange(360.0))[1]))
    assert peak == pytest.approx(optimum.floor.moment_Nm, rel=1e-3)


def test_direction_weights_give_the_transfers_of_seed_002() -> None:
    # vertical row: 20-30 % is turned across when the weaker, horizontal, direction is weighed more
    body = single([(90.0, 20.0)])
    full = 20.0 * 0.1 * OMEGA_SQUARED
    shares = []
    for weight in (1.0, 1.5, 2.0, 3.0, 4.0):
        after = answer(body, direction_weights={"x": weight, "y": 1}).residual.after
        share = after.force.peak_x_N / full
        # analytic: |k w| = |1 - k| at the optimum
        assert share == pytest.approx(1 / (1 + weight), rel=1e-4)
        shares.append(share)
    assert all(a > b for a, b in pairwise(shares))
    assert any(0.2 <= share <= 0.3 for share in shares)


def test_a_direction_of_weight_zero_is_given_up() -> None:
    body = single([(90.0, 20.0)])
    optimum = answer(body, direction_weights={"x": 0, "y": 1})
    full = 20.0 * 0.1 * OMEGA_SQUARED
    assert optimum.residual.after.force.peak_y_N <= 2e-6 * full
    assert optimum.residual.after.force.peak_x_N == pytest.approx(full, rel=1e-5)


# ---- re-simulation by other means


@pytest.mark.parametrize("seed", range(25))
@pytest.mark.parametrize("combine", ["sum", "max"])
def test_answers_hold_when_simulated_anew(seed: int, combine: str) -> None:
    body = random_machine(seed)
    optimum = answer(body, combine=combine)
    assert optimum.status == "optimal"
    assert optimum.certificate.relative_gap <= 1e-6
    weights = [weight.model_dump() for weight in optimum.counterweights]
    for state, fitted in ((optimum.residual.before, []), (optimum.residual.after, weights)):
        turn = first_order(body, fitted, np.arange(0.0, 360.0, 0.5))
        for index, ellipse, unit in ((0, state.force, "N"), (1, state.moment, "Nm")):
            values = turn[index]
            for name, sampled in (
                ("peak", np.abs(values)),
                ("peak_x", np.abs(values.real)),
                ("peak_y", np.abs(values.imag)),
            ):
                stated = getattr(ellipse, f"{name}_{unit}")
                assert sampled.max() <= stated * (1 + 1e-9) + 1e-9
                assert sampled.max() == pytest.approx(stated, rel=1e-4, abs=1e-6)
            assert np.abs(values).min() >= getattr(ellipse, f"minor_{unit}") * (1 - 1e-9) - 1e-9


@pytest.mark.parametrize("seed", range(25))
def test_counterweights_respect_the_machine(seed: int) -> None:
    body = random_machine(seed)
    optimum = answer(body)
    for weight, place in zip(optimum.counterweights, body["webs"], strict=True):
        assert weight.web == place["name"]
        assert 0 <= weight.mass_kg <= place["max_mass_kg"] * (1 + 1e-15)
        assert 0 <= weight.angle_deg < 360
        assert complex(weight.x_kg_m, weight.y_kg_m) == pytest.approx(
            weight.mass_kg * place["counterweight_radius_m"] * np.exp(1j * np.deg2rad(weight.angle_deg)), abs=1e-12
        )
        if place["sector"] and weight.mass_kg:
            off = (weight.angle_deg - place["sector"]["centre_deg"] + 180) % 360 - 180
            assert abs(off) <= place["sector"]["half_angle_deg"] + 1e-9
    total = sum(weight.mass_kg for weight in optimum.counterweights)
    assert optimum.total_mass_kg == pytest.approx(total, rel=1e-15)
    assert total <= (body["max_total_mass_kg"] or math.inf) * (1 + 1e-15)
    assert optimum.certificate.mass_lower_bound_kg <= total


@pytest.mark.parametrize("seed", range(10))
def test_no_random_counterweights_beat_the_bound(seed: int) -> None:
    body = random_machine(seed)
    optimum = answer(body)
    rng = np.random.default_rng(seed)
    planes = [part["position_m"] for part in (*body["throws"], *body["webs"])]
    span = max(planes) - min(planes)
    for _ in range(30):
        weights, left = [], body["max_total_mass_kg"] or math.inf
        for place in body["webs"]:
            sector = place["sector"] or {"centre_deg": 0, "half_angle_deg": 180}
            mass = min(place["max_mass_kg"] * rng.random(), left)
            left -= mass
            angle = sector["centre_deg"] + sector["half_angle_deg"] * rng.uniform(-1, 1)
            weights.append({"web": place["name"], "mass_kg": mass, "angle_deg": angle})
        peaks = np.max(np.abs(first_order(body, weights, np.arange(0.0, 360.0, 2.0))), axis=-1)
        objective = peaks[0] + peaks[1] / span
        assert objective >= optimum.certificate.lower_bound * (1 - 1e-3)  # the grid of 2 degrees sees 1e-3 less


# ---- ordinary cases that are easily forgotten


def test_no_webs_webs_of_limit_zero_and_budget_zero() -> None:
    body = single([(90.0, 20.0)])
    nothing = [
        body | {"webs": []},
        body | {"webs": [web("a", 0.0, 0.0)]},
        body | {"max_total_mass_kg": 0.0},
    ]
    for fields in nothing:
        optimum = answer(fields)
        assert optimum.status == "optimal"
        assert optimum.total_mass_kg == 0.0
        assert optimum.residual.after == optimum.residual.before
        assert optimum.certificate.relative_gap <= 1e-12


def test_a_balanced_machine_needs_nothing() -> None:
    throws = [throw(float(k), angle, [row(90.0, 5.0)]) for k, angle in enumerate([0, 120, 240, 240, 120, 0])]
    optimum = answer(machine(throws, [web("a", 0.0), web("b", 5.0)]))
    assert optimum.status == "optimal"
    assert optimum.total_mass_kg == 0.0
    assert optimum.residual.before.force.peak_N == 0.0
    assert optimum.residual.before.moment.peak_Nm == pytest.approx(0.0, abs=1e-9)
    assert optimum.certificate.relative_gap == 0.0


def test_default_moment_weight_is_one_over_the_span() -> None:
    body = random_machine(5)
    planes = [part["position_m"] for part in (*body["throws"], *body["webs"])]
    span = max(planes) - min(planes)
    certificate = answer(body, moment_weight=1 / span).certificate
    assert answer(body).certificate.objective == pytest.approx(certificate.objective, rel=1e-12)


def test_only_the_effects_called_for_run_and_missing_rods_are_named() -> None:
    body = single([(90.0, 20.0)])
    optimum = answer(body)
    assert optimum.effects["rotating_inertia"].simulated
    assert not optimum.effects["higher_orders"].simulated
    assert optimum.effects["higher_orders"].needed_by == ()
    assert (optimum.orders, optimum.stages, optimum.hodograph) == (None, None, None)
    with pytest.raises(MissingInput) as caught:
        optimize(OptimizeRequest.model_validate({"machine": body, "outputs": ["orders", "stages"]}))
    assert [problem.path for problem in caught.value.problems] == [
        ("machine", "throws", 0, "rows", 0, "connecting_rod")
    ]


@pytest.mark.parametrize("anti_rotation", [
    {"type": "crank_pins", "count": 3, "pin_circle_radius_m": 0.05, "eccentric_mass_kg": 0.02, "position_m": 0.03},
    {"type": "oldham", "mass_kg": 0.4, "axis_deg": 30.0, "position_m": 0.03},
])  # fmt: skip
def test_scroll_machines_use_the_same_program(anti_rotation: dict[str, Any]) -> None:
    body = {
        "kind": "scroll",
        "speed_rpm": 3000.0,
        "orbit_radius_m": 0.005,
        "orbiting_mass_kg": 1.2,
        "orbiting_position_m": 0.05,
        "anti_rotation": anti_rotation,
        "webs": [web("upper", 0.02, 1.0, 0.02), web("lower", -0.1, 1.0, 0.02)],
    }
    optimum = answer(body)
    ring = anti_rotation.get("mass_kg", 0.0) * 0.005 * (3000 * math.pi / 30) ** 2
    # analytic: two planes remove all that turns with the shaft; half of the ring's force turns against it
    assert optimum.status == "optimal"
    assert optimum.floor.force_N == pytest.approx(ring / 2, rel=1e-12)
    assert optimum.residual.after.force.peak_N == pytest.approx(ring / 2, abs=2e-3)


def test_two_planes_balance_an_orbiting_scroll_with_the_closed_form_masses() -> None:
    # analytic: u1 + u2 = -m r, z1 u1 + z2 u2 = -z m r, so u1 = -m r (z - z2)/(z1 - z2)
    body = {
        "kind": "scroll",
        "speed_rpm": 3000.0,
        "orbit_radius_m": 0.005,
        "orbiting_mass_kg": 1.2,
        "orbiting_position_m": 0.05,
        "anti_rotation": {"type": "crank_pins", "count": 3, "pin_circle_radius_m": 0.05, "position_m": 0.03},
        "webs": [web("near", 0.02, 2.0, 0.02), web("far", -0.1, 2.0, 0.02)],
    }
    near, far = answer(body).counterweights
    assert near.mass_kg == pytest.approx(1.2 * 0.005 / 0.02 * (0.05 + 0.1) / 0.12, rel=1e-5)
    assert far.mass_kg == pytest.approx(1.2 * 0.005 / 0.02 * (0.05 - 0.02) / 0.12, rel=1e-5)
    assert near.angle_deg == pytest.approx(180.0)
    assert far.angle_deg % 360.0 == pytest.approx(0.0, abs=1e-3)
