"""Peaks of pins with clearances and errors, beside dead points and at them."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings

from tests.scroll.patterns import ask, loads, pins_at, seeds

MICRON = 1e-6
STIFFNESS = 2e7


def random_body(seed: int) -> dict[str, Any]:
    """Pins with play and errors, half of them on one line, under a torque that is 0 where that has dead points."""
    rng = np.random.default_rng(seed)
    count, line = int(rng.integers(2, 6)), bool(rng.integers(0, 2))
    along = 15.0 * float(rng.integers(0, 12))
    pins = pins_at(
        along + 180.0 * rng.integers(0, 2, count) if line else rng.uniform(0.0, 360.0, count),
        radius_m=rng.uniform(0.03, 0.09, count).tolist(),
        stiffness_N_per_m=(10.0 ** rng.uniform(6.0, 8.0, count)).tolist(),
        clearance_m=(10.0 * MICRON * rng.uniform(0.0, 1.0, count) * rng.integers(0, 2, count)).tolist(),
        eccentricity_error_m=(10.0 * MICRON * rng.uniform(-1.0, 1.0, count) * rng.integers(0, 2, count)).tolist(),
    )
    angles = np.sort(np.mod(along + np.array([0.0, 70.0, 180.0, 290.0]), 360.0))
    torque = rng.uniform(-20.0, 20.0, 4) * rng.integers(0, 2)
    if line:
        torque = np.where(np.mod(angles - along, 180.0) == 0.0, 0.0, torque)
    bearing = ({"type": "free"}, {"type": "rigid"}, {"type": "elastic", "stiffness_N_per_m": 3e7})
    return {
        "pins": pins,
        "rotation_torque_Nm": {"angle_deg": angles.tolist(), "torque_Nm": torque.tolist()},
        "drive_bearing": bearing[int(rng.integers(0, 3))],
        "angles": {"step_deg": float(rng.choice([1.0, 2.5, 7.5, 15.0]))},
    }


@settings(max_examples=60)
@given(seed=seeds)
def test_no_sample_is_above_its_peak_analytic(seed: int) -> None:
    answer = ask(**random_body(seed))
    carriers = [*answer.pins, *([] if answer.drive_bearing is None else [answer.drive_bearing])]
    for carrier in carriers:
        largest = max(abs(load) for load in carrier.load_N if load is not None)
        assert carrier.peak_N is None or largest <= carrier.peak_N * (1.0 + 1e-9)


@pytest.mark.parametrize("along", [0.0, 15.0, 37.123])
def test_an_error_strains_pins_at_a_dead_point_without_torque_analytic(along: float) -> None:
    """Two springs in a row carry k eps / 2 where the eccentric lies along them; elsewhere the scroll turns by eps."""
    pins = pins_at([along, along + 180.0], stiffness_N_per_m=STIFFNESS, eccentricity_error_m=[4.0 * MICRON, 0.0])
    answer = ask(pins=pins, rotation_torque_Nm=0.0, angles={"step_deg": 1})
    expected = STIFFNESS * 2.0 * MICRON
    assert answer.dead_points_deg == pytest.approx((along, along + 180.0), rel=1e-12)
    assert answer.peak_N == pytest.approx(expected, rel=1e-12)
    for pin in answer.pins:
        assert (pin.peak_N, pin.peak_angle_deg) == pytest.approx((expected, along), rel=1e-12)
    if along % 1.0 == 0.0:
        load = loads(answer)[int(along)]
        np.testing.assert_allclose(load, [-expected, expected], rtol=1e-12)
        assert answer.contact is not None
        assert answer.contact.scroll_rotation_deg[int(along)] == 0.0
    assert answer.equilibrium.holds


def test_pins_without_a_load_have_their_peak_at_angle_0_analytic() -> None:
    pins = pins_at([0.0, 120.0, 240.0], stiffness_N_per_m=STIFFNESS, clearance_m=MICRON)
    answer = ask(pins=pins, rotation_torque_Nm=0.0)
    assert [(pin.peak_N, pin.peak_angle_deg) for pin in answer.pins] == [(0.0, 0.0)] * 3


@pytest.mark.parametrize("angle", [1e-160, 1e-309, 5e-324])
@pytest.mark.parametrize("bearing", ["free", "rigid"])
@pytest.mark.parametrize("clearance", [0.0, MICRON])
def test_levers_below_all_numbers_hold_no_torque_analytic(angle: float, bearing: str, clearance: float) -> None:
    """Regression: a torque over the squares of such levers was beyond all numbers."""
    pins = pins_at([angle, 180.0], stiffness_N_per_m=STIFFNESS, clearance_m=clearance)
    answer = ask(pins=pins, drive_bearing={"type": bearing})
    assert answer.dead_points_deg[0] == pytest.approx(0.0, abs=1e-9)
    assert answer.pins[0].load_N[0] is None
    assert answer.peak_N is None
