"""Losses of pins and of an Oldham ring, and its largest key load, are those of the whole revolution."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.mechanics.oldham import Oldham, keys, largest_key
from optimizer.pins.loads import PeriodicTable
from optimizer.pins.pattern import pattern_of
from schemas.scroll.pin_loads import PinLoadsRequest
from tests.night import by_day
from tests.scroll.patterns import ask, seeds
from tests.scroll.test_brackets import loaded_body

COUNT = 100_000
TURN = (np.arange(COUNT) + 0.5) * 360.0 / COUNT


def compared_body(seed: int, has_play: bool) -> dict[str, Any]:
    rng = np.random.default_rng(seed)
    body = loaded_body(seed) | {"orbit_radius_m": 0.005, "drive_bearing": {"type": "rigid"}}
    for pin in body["pins"]:
        pin |= {} if has_play else {"clearance_m": 0.0, "eccentricity_error_m": 0.0}
    ring = {"key_radius_m": 0.06, "friction_coefficient": 0.08, "mass_kg": rng.uniform(0.0, 2.0), "axis_deg": 33.0}
    body["comparison"] = {"speed_rpm": 3000, "pin_diameter_m": 0.008, "pin_friction_coefficient": 0.002}
    body["comparison"]["oldham_ring"] = ring
    return body


@by_day(6)
@given(seed=seeds, has_play=st.booleans())
def test_losses_are_the_mean_of_many_samples_independent(seed: int, has_play: bool) -> None:
    """Loads change their signs, and pins begin to bear, between the panels of the integral."""
    body = compared_body(seed, has_play)
    losses = ask(**body).comparison
    assert losses is not None
    omega, table = 100.0 * np.pi, body["rotation_torque_Nm"]
    torques = PeriodicTable(np.array(table["angle_deg"]), np.array(table["torque_Nm"]))
    torque = torques.at(TURN)
    pattern = pattern_of(PinLoadsRequest.model_validate(body))
    carried = np.mean(np.sum(np.abs(pattern.loads(torque, TURN)[:, : pattern.count]), axis=-1))
    assert losses.pins_W == pytest.approx(0.002 * 0.008 * omega * carried, rel=1e-6)
    ring = body["comparison"]["oldham_ring"]
    frame, own = torque / 0.12, np.deg2rad(TURN - ring["axis_deg"])
    pull = 0.5 * ring["mass_kg"] * 0.005 * omega**2 * np.cos(own)
    scroll = np.abs(frame - pull) + np.abs(frame + pull)
    rate = 2.0 * np.abs(frame * np.sin(own)) + scroll * np.abs(np.cos(own))
    assert losses.oldham_ring.loss_W == pytest.approx(0.08 * 0.005 * omega * np.mean(rate), rel=1e-7)
    # its corners lie between these samples
    at_corners = np.abs(np.cos(np.deg2rad(torques.angle_deg - ring["axis_deg"])))
    corners = np.abs(torques.value) / 0.12 + 0.5 * ring["mass_kg"] * 0.005 * omega**2 * at_corners
    largest = max(np.max(np.abs(frame) + np.abs(pull)), np.max(corners))
    assert largest <= losses.oldham_ring.peak_key_N * (1.0 + 1e-12)
    assert largest == pytest.approx(losses.oldham_ring.peak_key_N, rel=1e-6)


def test_the_largest_key_load_is_level_where_couple_and_inertia_change_alike_analytic() -> None:
    """A torque that rises by 2 R A / 2 a radian: sin of the angle from the axis is 1/2 there."""
    ring = Oldham(np.array(0.01), np.array(0.05), np.array(2.0), np.array(0.0), np.array(10.0))
    inertia = 0.5 * 2.0 * 0.01 * 100.0
    slope = 2.0 * 0.05 * inertia * 0.5
    angle, torque = np.array([0.0, 2.0]), np.array([0.0, 2.0 * slope])
    at_level = slope * np.pi / 6.0 / 0.1 + inertia * np.cos(np.pi / 6.0)
    falling = -2.0 * slope / (2.0 * np.pi - 2.0)
    steep = np.arcsin(falling / (2.0 * 0.05 * inertia))
    where = np.pi + steep
    after = (2.0 * slope + falling * (where - 2.0)) / 0.1 + inertia * np.abs(np.cos(where))
    assert float(largest_key(ring, torque, angle)) == pytest.approx(max(at_level, after), rel=1e-12)


@given(seed=seeds)
def test_largest_keys_of_many_rings_are_above_all_samples_independent(seed: int) -> None:
    rng = np.random.default_rng(seed)
    ring = Oldham(*rng.uniform(0.1, 2.0, (5, 3)))
    angle = np.sort(rng.uniform(0.0, 2.0 * np.pi, (3, 5)), axis=-1)
    torque = rng.uniform(-2.0, 2.0, (3, 5))
    turn = np.linspace(0.0, 2.0 * np.pi, 4001)
    for k, largest in enumerate(largest_key(ring, torque, angle)):
        part = Oldham(ring.orbit_radius[k], ring.key_radius[k], ring.mass[k], ring.axis[k], ring.omega[k])
        value = keys(part, np.interp(turn, angle[k], torque[k], period=2.0 * np.pi), turn)
        sampled = max(np.max(np.abs(value.frame)), np.max(np.abs(value.scroll)))
        assert sampled <= largest * (1.0 + 1e-12)
        assert sampled == pytest.approx(largest, rel=1e-2)


@pytest.mark.parametrize("apart_deg", [-1.3, 0.45])
def test_a_pin_that_changes_its_sign_twice_at_once_independent(apart_deg: float) -> None:
    """Regression: torque and lever of the second of seven pins are 0 within a panel, a millionth of the loss."""
    zero = 360.0 / 7.0 + apart_deg
    torques = {"angle_deg": [zero - 3.0, zero + 3.0], "torque_Nm": [-10.0, 10.0]}
    body = compared_body(0, False) | {"rotation_torque_Nm": torques, "drive_bearing": {"type": "free"}}
    del body["pins"]
    losses = ask(**body | {"pin_count": 7, "pin_circle_radius_m": 0.06}).comparison
    assert losses is not None
    phases = 360.0 / 7.0 * np.arange(7)
    kinks = [*phases, *phases + 180.0, *torques["angle_deg"], zero, zero + 180.0, 0.0]
    edges = np.unique([*np.mod(kinks, 360.0).tolist(), 360.0])
    nodes, weights = np.polynomial.legendre.leggauss(20)
    half = 0.5 * np.diff(edges)[:, None]
    angle = (edges[:-1, None] + half + half * nodes).ravel()
    torque = np.interp(angle, torques["angle_deg"], torques["torque_Nm"], period=360.0)
    load = 2.0 * torque[:, None] / (7.0 * 0.06) * np.sin(np.deg2rad(angle[:, None] - phases))
    mean = np.sum((half * weights).ravel() * np.sum(np.abs(load), axis=-1)) / 360.0
    assert losses.pins_W == pytest.approx(mean * 0.008 * 0.002 * 100.0 * np.pi, rel=1e-12)
