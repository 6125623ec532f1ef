"""The drive's bearing carries what the pins do not; the work over a pitch; pins beside an Oldham ring."""

from typing import Any

import cvxpy as cp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from optimizer.mechanics.oldham import Oldham, keys
from optimizer.numerics.arrays import Real
from optimizer.pins.answer import pin_loads
from optimizer.pins.loads import levers
from schemas.scroll.pin_loads import PinLoadsAnswer, PinLoadsRequest
from tests.scroll.patterns import TABLE, TORQUE, ask, even, loads, pins_at, random_pins, seeds

RIGID = {"type": "rigid"}
UNEVEN = pins_at([0, 110, 250], radius_m=0.05)
COMPARISON: dict[str, Any] = {
    "speed_rpm": 3000,
    "pin_diameter_m": 0.008,
    "pin_friction_coefficient": 0.002,
    "oldham_ring": {"key_radius_m": 0.06, "friction_coefficient": 0.08},
}


def elastic(stiffness: float) -> dict[str, Any]:
    return {"type": "elastic", "stiffness_N_per_m": stiffness}


def rest(answer: PinLoadsAnswer) -> Real:
    assert answer.drive_bearing is not None
    return np.array(answer.drive_bearing.load_N, dtype=float)


def test_two_pins_not_on_one_line_run_on_a_rigid_bearing_analytic() -> None:
    """At 0 and 90 degrees sin^2 + cos^2 is 1: Q = T/R sin, and 12 N m on 50 mm make 240 N, without a dead point.

    The source (Liu, Zhao and Li 2006, section 2) says that two pins not on one line run, with uneven load.
    """
    pins = pins_at([0, 90], radius_m=0.05)
    answer = ask(pins=pins, drive_bearing=RIGID)
    assert answer.peak_N == pytest.approx(240.0, rel=1e-12)
    assert answer.dead_points_deg == ()
    assert answer.equilibrium.holds
    assert [warning.code for warning in answer.warnings] == ["uneven_load"]
    angle = np.deg2rad(answer.angle_deg)
    np.testing.assert_allclose(loads(answer), 240.0 * np.stack([np.sin(angle), -np.cos(angle)], -1), atol=1e-10)
    assert answer.drive_bearing is not None
    assert answer.drive_bearing.peak_N == pytest.approx(240.0 * np.sqrt(2.0))
    free = ask(pins=pins)
    assert free.dead_points_deg == pytest.approx([135.0, 315.0])
    assert free.peak_N is None


def test_uneven_three_carry_more_where_the_bearing_holds_independent() -> None:
    """Figures of a separate calculation on a grid of 0.01 degrees: 178.8 N free, 194.5 N rigid."""
    assert ask(pins=UNEVEN).peak_N == pytest.approx(178.8349, abs=1e-4)
    held = ask(pins=UNEVEN, drive_bearing=RIGID)
    assert held.peak_N == pytest.approx(194.4965, abs=1e-4)
    np.testing.assert_allclose(rest(held), -np.sum(loads(held), axis=-1), rtol=0, atol=1e-12)
    assert held.drive_bearing is not None
    assert held.drive_bearing.peak_N == pytest.approx(np.max(np.abs(rest(held))), rel=1e-3)


@given(seed=seeds, count=st.integers(2, 6), stiffness=st.floats(5.0, 9.0))
def test_least_strain_energy_with_the_bearing_independent(seed: int, count: int, stiffness: float) -> None:
    """The same quadratic program by a general solver: the bearing is one more spring, without a lever."""
    rng = np.random.default_rng(seed)
    pins, own = random_pins(rng, count), 10.0**stiffness
    request = {
        "pins": [
            {"angle_deg": float(np.rad2deg(np.angle(z))), "radius_m": abs(z), "stiffness_N_per_m": k}
            for z, k in zip(pins.place.tolist(), pins.stiffness.tolist(), strict=True)
        ],
        "rotation_torque_Nm": TORQUE,
        "drive_bearing": elastic(own),
        "angles": {"step_deg": 72},
    }
    answer = pin_loads(PinLoadsRequest.model_validate(request))
    lever = 1e3 * levers(pins.place, np.asarray(72.0))
    load, bearing, most = cp.Variable(count), cp.Variable(), max(own, float(np.max(pins.stiffness)))
    energy = cp.sum(cp.multiply(0.5 * most / pins.stiffness, cp.square(load))) + 0.5 * most / own * cp.square(bearing)
    cp.Problem(cp.Minimize(energy), [lever @ load == 1e3 * TORQUE, cp.sum(load) + bearing == 0]).solve(cp.CLARABEL)
    scale = float(np.max(np.abs(loads(answer)[1])))
    np.testing.assert_allclose(loads(answer)[1], load.value, rtol=0, atol=1e-5 * scale)
    assert rest(answer)[1] == pytest.approx(float(bearing.value), abs=1e-5 * scale)


def test_an_elastic_bearing_is_between_free_and_rigid_analytic() -> None:
    pins = pins_at([0, 110, 250], stiffness_N_per_m=1e7)
    soft, stiff = (ask(pins=pins, drive_bearing=elastic(k)) for k in (1e-4, 1e17))
    np.testing.assert_allclose(loads(soft), loads(ask(pins=pins)), rtol=0, atol=1e-7)
    np.testing.assert_allclose(loads(stiff), loads(ask(pins=pins, drive_bearing=RIGID)), rtol=0, atol=1e-6)


@pytest.mark.parametrize("bearing", [RIGID, elastic(3e7)])
def test_even_pins_give_the_bearing_nothing_analytic(bearing: dict[str, Any]) -> None:
    answer = even(5, drive_bearing=bearing)
    np.testing.assert_allclose(loads(answer), loads(even(5)), rtol=0, atol=1e-11)
    np.testing.assert_allclose(rest(answer), 0.0, atol=1e-11)


@pytest.mark.parametrize("bearing", [RIGID, elastic(3e7)])
def test_pins_on_a_line_through_the_centre_have_dead_points_analytic(bearing: dict[str, Any]) -> None:
    answer = even(2, drive_bearing=bearing)
    assert answer.dead_points_deg == (0.0, 180.0)
    assert not answer.equilibrium.holds
    assert answer.equilibrium.max_moment_error_Nm == TORQUE


@pytest.mark.parametrize("bearing", [RIGID, elastic(3e7)])
def test_small_clearances_return_the_elastic_answer_analytic(bearing: dict[str, Any]) -> None:
    def answer(clearance: float) -> PinLoadsAnswer:
        pins = pins_at([0, 80, 200], stiffness_N_per_m=1e7, clearance_m=clearance)
        return ask(pins=pins, drive_bearing=bearing)

    near, none = answer(1e-14), answer(0.0)
    np.testing.assert_allclose(loads(near), loads(none), rtol=0, atol=1e-5)
    np.testing.assert_allclose(rest(near), rest(none), rtol=0, atol=1e-5)
    wide = answer(2e-5)
    assert wide.equilibrium.holds
    assert wide.contact is not None
    assert wide.contact.fewest_pins < 3


@pytest.mark.parametrize("count", [1, 2, 3, 5])
def test_work_over_a_pitch_published(count: int) -> None:
    """Liu, Zhao and Li 2006, equation (2): W_Q = -pi Q_max R with Q_max = 2 T/(n R), W_F = T 2 pi/n."""
    energy = even(count).energy
    assert energy.pitch_deg == 360.0 / count
    assert energy.pins_work_J == pytest.approx(-2.0 * np.pi * TORQUE / count, rel=1e-12)
    assert energy.sum_J == pytest.approx(0.0, abs=1e-12)


def test_work_of_a_torque_that_changes_analytic() -> None:
    """0 to 120 degrees of a table, linear between 12 at 0, 20 at 70, 9 at 115, 15 at 260."""
    area = 70 * 16.0 + 45 * 14.5 + 5 * (9 + 0.5 * 6 * 5 / 145)
    energy = even(3, rotation_torque_Nm=TABLE).energy
    assert energy.torque_work_J == pytest.approx(np.deg2rad(area), rel=1e-12)
    assert energy.sum_J == pytest.approx(0.0, abs=1e-12)


def test_pins_lose_less_than_a_ring_analytic() -> None:
    """Constant torque, light ring: pins 4/pi mu d omega T/R, ring 4/pi mu e omega T/R; the source says the former."""
    answer = even(3, orbit_radius_m=0.005, comparison=COMPARISON)
    assert answer.comparison is not None
    omega = 100.0 * np.pi
    assert answer.comparison.pins_W == pytest.approx(4 / np.pi * 0.002 * 0.008 * omega * TORQUE / 0.06, rel=1e-9)
    ring = answer.comparison.oldham_ring
    assert ring.loss_W == pytest.approx(4 / np.pi * 0.08 * 0.005 * omega * TORQUE / 0.06, rel=1e-9)
    assert answer.comparison.ratio == pytest.approx(0.002 * 0.008 / (0.08 * 0.005), rel=1e-9)
    assert ring.peak_speed_m_s == pytest.approx(0.005 * omega)
    assert ring.peak_key_N == pytest.approx(TORQUE / 0.12)


@given(seed=seeds)
def test_the_keys_hold_the_ring_analytic(seed: int) -> None:
    """Newton on the ring: forces of the keys in the scroll move it, couples of both pairs cancel."""
    rng = np.random.default_rng(seed)
    orbit, reach, mass, axis, omega = rng.uniform(0.1, 2.0, (5, 4))
    angle, torque = rng.uniform(0.0, 6.0, (4, 9)), rng.uniform(-5.0, 5.0, (4, 9))
    forces = keys(Oldham(orbit, reach, mass, axis, omega), torque, angle)
    across = (axis[:, None] - angle, orbit[:, None] * omega[:, None])
    acceleration = -across[1] * omega[:, None] * np.cos(across[0])
    np.testing.assert_allclose(np.sum(forces.scroll, axis=-1), mass[:, None] * acceleration, atol=1e-12)
    couple = reach[:, None] * (forces.scroll[..., 0] - forces.scroll[..., 1])
    np.testing.assert_allclose(couple, torque, atol=1e-12)
    np.testing.assert_allclose(2.0 * reach[:, None] * forces.frame, torque, atol=1e-12)
    np.testing.assert_allclose(np.hypot(forces.frame_speed, forces.scroll_speed), across[1] + 0 * angle, atol=1e-12)


@pytest.mark.parametrize(
    ("body", "path"),
    [
        ({"drive_bearing": elastic(0.0)}, ("drive_bearing", "stiffness_N_per_m")),
        ({"drive_bearing": {"type": "elastic"}}, ("drive_bearing", "stiffness_N_per_m")),
        ({"drive_bearing": {"type": "rigid", "stiffness_N_per_m": 1e7}}, ("drive_bearing", "stiffness_N_per_m")),
        ({"pins": UNEVEN, "drive_bearing": elastic(1e7)}, ("pins", 0, "stiffness_N_per_m")),
        ({"comparison": COMPARISON}, ("orbit_radius_m",)),
    ],
)
def test_bad_input_is_named(body: dict[str, Any], path: tuple[Any, ...]) -> None:
    whole = {"pin_count": 3, "pin_circle_radius_m": 0.06} if "pins" not in body else {}
    with pytest.raises(ValidationError) as raised:
        PinLoadsRequest.model_validate({"rotation_torque_Nm": TORQUE, **whole, **body})
    locs = [
        (*error["loc"], *problem.path)
        for error in raised.value.errors()
        for problem in error.get("ctx", {}).get("problems", [()])
        if problem
    ] + [error["loc"] for error in raised.value.errors()]
    assert path in locs
