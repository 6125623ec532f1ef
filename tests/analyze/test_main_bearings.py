"""Main bearings of a posted machine: they carry the shaft's loads, and counterweights as much as they weigh."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from optimizer.mechanics.friction import reciprocating_friction, share_of_losses
from optimizer.mechanics.gas import gas_forces, indicated_work
from optimizer.mechanics.kinematics import motion
from optimizer.mechanics.rod import shaft_loads
from optimizer.numerics.arrays import Complex, Real
from schemas.answer.dynamics import BearingLoad, MainBearings
from tests.analyze.driven import STYLES, arrays, ask, random_driven

STEP = 10.0
THETA = np.deg2rad(np.arange(0.0, 360.0, STEP))
FITTED = [{"web": "a", "mass_kg": 12.0, "angle_deg": 70.0}, {"web": "b", "mass_kg": 30.0, "angle_deg": -160.0}]
SHAFTS = ("simple_spans", "continuous")


def vector(load: BearingLoad) -> Complex:
    return np.array(load.force_x_N) + 1j * np.array(load.force_y_N)


def bearings(body: dict[str, Any], shaft: str = "simple_spans", fitted: Any = FITTED) -> MainBearings:
    return ask(body, "main_bearings", step_deg=STEP, counterweights=fitted, fidelity={"shaft": shaft}).main_bearings


def loads_on_the_shaft(body: dict[str, Any]) -> tuple[Real, Complex]:
    """Planes and loads from the mechanics, put together by hand."""
    plan, data = arrays(body)
    moving, stroke = motion(plan, THETA), 2.0 * plan.reciprocating.crank_radius
    friction = body["friction"]
    indicated = indicated_work(data, plan).sum(axis=-1) * plan.omega / (2.0 * np.pi)
    efficiency, share = (np.asarray(friction[k]) for k in ("mechanical_efficiency", "reciprocating_share"))
    magnitude, _ = share_of_losses(indicated, efficiency, share, stroke, plan.omega)
    force = gas_forces(data, moving, plan).total + reciprocating_friction(moving, magnitude)
    force = force + plan.reciprocating.mass[:, None] * moving.acceleration
    return shaft_loads(force, moving, plan, THETA)


@pytest.mark.parametrize("shaft", SHAFTS)
@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("seed", range(2))
def test_bearings_carry_all_of_the_shaft_loads(seed: int, style: str, shaft: str) -> None:
    body = random_driven(seed, style)
    supports = bearings(body, shaft)
    planes, loads = loads_on_the_shaft(body)
    carried = np.array([vector(bearing.before) for bearing in supports.bearings])
    places = np.array([bearing.position_m for bearing in supports.bearings])
    scale = np.abs(loads).max()
    # analytic: force and couple are in balance at every instant
    np.testing.assert_allclose(carried.sum(axis=0), loads.sum(axis=0), atol=1e-11 * scale)
    np.testing.assert_allclose(places @ carried, planes @ loads, atol=1e-11 * scale)
    for support in supports.bearings:
        for load in (support.before, support.after):
            size = np.abs(vector(load))
            low, high = load.peak_bracket_N
            # the peak of the turn, not of the samples
            assert size.max() <= high
            assert load.peak_N == low >= (1.0 - 1e-8) * high
            assert load.rms_N <= load.peak_N
            assert load.floor_N <= high
    assert supports.shaft == shaft


@pytest.mark.parametrize("shaft", SHAFTS)
@pytest.mark.parametrize("rotation", ["ccw", "cw"])
@pytest.mark.parametrize("seed", range(3))
def test_counterweights_add_their_centrifugal_force(seed: int, rotation: str, shaft: str) -> None:
    body = random_driven(seed, "v", rotation=rotation)
    supports = bearings(body, shaft)
    added = np.array([vector(bearing.after) - vector(bearing.before) for bearing in supports.bearings])
    sense, omega = (1.0 if rotation == "ccw" else -1.0), body["speed_rpm"] * np.pi / 30.0
    places = {web["name"]: web["position_m"] for web in body["webs"]}
    # analytic: m R w^2 outward, turning with the shaft
    iron = np.array(
        [
            counterweight["mass_kg"]
            * 0.2
            * omega**2
            * np.exp(1j * (np.deg2rad(counterweight["angle_deg"]) + sense * THETA))
            for counterweight in FITTED
        ]
    )
    scale = max(bearing.before.peak_N for bearing in supports.bearings) + np.abs(iron).max()
    np.testing.assert_allclose(added.sum(axis=0), iron.sum(axis=0), atol=1e-11 * scale)
    arms = np.array([bearing.position_m for bearing in supports.bearings])
    couple = np.array([places[fields["web"]] for fields in FITTED]) @ iron
    np.testing.assert_allclose(arms @ added, couple, atol=1e-11 * scale)
    # they turn with the shaft: the same on every bearing at every angle, but for the direction
    np.testing.assert_allclose(np.abs(added), np.abs(added[:, :1]) * np.ones(THETA.size), atol=1e-11 * scale)


@pytest.mark.parametrize("shaft", SHAFTS)
def test_no_counterweights_change_nothing(shaft: str) -> None:
    supports = bearings(random_driven(0), shaft, [])
    for bearing in supports.bearings:
        np.testing.assert_allclose(
            vector(bearing.after), vector(bearing.before), rtol=1e-13, atol=1e-9 * bearing.before.peak_N
        )
    np.testing.assert_allclose(supports.bending.after_Nm, supports.bending.before_Nm, rtol=1e-12, atol=1e-6)


@pytest.mark.parametrize("style", STYLES)
def test_with_two_bearings_both_shafts_are_one(style: str) -> None:
    body = random_driven(3, style)
    body["bearings"] = [{"name": "A", "position_m": 1.7}, {"name": "B", "position_m": -0.5}]
    hinged, continuous = (bearings(body, shaft) for shaft in SHAFTS)
    # analytic: statics alone; the order in which bearings come is theirs
    assert [bearing.name for bearing in hinged.bearings] == ["A", "B"]
    for first_bearing, second_bearing in zip(hinged.bearings, continuous.bearings, strict=True):
        for state in ("before", "after"):
            expected = vector(getattr(first_bearing, state))
            near = {"rtol": 1e-11, "atol": 1e-11 * np.abs(expected).max()}
            np.testing.assert_allclose(vector(getattr(second_bearing, state)), expected, **near)
    scale = max(hinged.bending.before_Nm)
    np.testing.assert_allclose(continuous.bending.before_Nm, hinged.bending.before_Nm, atol=1e-10 * scale)


def test_one_row_between_two_bearings() -> None:
    body = random_driven(2, "single", throws=1)
    throw, row = body["throws"][0], body["throws"][0]["rows"][0]
    throw.update(position_m=0.0, rotating_mass_kg=0.0)
    row["offset_m"] = 0.0
    body["bearings"] = [{"name": "A", "position_m": -0.3}, {"name": "B", "position_m": 0.6}]
    supports = bearings(body, fitted=[])
    _, loads = loads_on_the_shaft(body)
    total = loads.sum(axis=0)
    # analytic: the lever rule, and P a b / l under the load
    for bearing, share in zip(supports.bearings, (2.0 / 3.0, 1.0 / 3.0), strict=True):
        np.testing.assert_allclose(vector(bearing.before), share * total, rtol=1e-11)
    at = supports.bending.position_m.index(0.0)
    first, second = (support.before.peak_N for support in supports.bearings)
    assert first == pytest.approx(2.0 * second, rel=1e-8)
    assert supports.bending.before_Nm[at] == pytest.approx(first * 0.3, rel=1e-8)
    assert supports.bending.peak_Nm == supports.bending.before_Nm[at]
    assert supports.bending.peak_position_m == 0.0
    assert supports.bending.position_m == tuple(sorted(supports.bending.position_m))


def test_a_counterweight_against_the_rotating_mass_relieves_the_bearings() -> None:
    body = random_driven(1, "single", throws=1)
    throw = body["throws"][0]
    throw.update(position_m=0.3, rotating_mass_kg=40.0, rows=[])
    unbalance = 40.0 * throw["crank_radius_m"]
    fitted = [{"web": "b", "mass_kg": unbalance / 0.2, "angle_deg": throw["crank_angle_deg"] + 180.0}]
    supports = bearings({**body, "friction": None}, fitted=fitted)
    for bearing in supports.bearings:
        assert bearing.before.peak_N > 0.0
        assert bearing.after.peak_N == pytest.approx(0.0, abs=1e-9 * 40.0 * (body["speed_rpm"] * np.pi / 30.0) ** 2)
        # analytic: a load that turns with the shaft can be taken away altogether
        assert bearing.before.floor_N == pytest.approx(0.0, abs=1e-12 * bearing.before.peak_N)
        assert bearing.before.rms_N == pytest.approx(bearing.before.peak_N, rel=1e-12)


@pytest.mark.parametrize("step_deg", [1.0, 10.0, 90.0])
def test_the_peak_is_that_of_the_turn_whatever_the_step(step_deg: float) -> None:
    # regression: 103,070.04 N, where samples at 10 degrees read 99.3 kN, those at 1 degree 103.0;
    # independent: 103,068.59 N at 0.01 degrees, from the functions of the samples
    body = json.loads((Path(__file__).parents[2] / "examples" / "2d12.json").read_text())["machine"]
    first, middle, last = ask(body, "main_bearings", step_deg=step_deg).main_bearings.bearings
    for bearing, peak in ((first, 103070.0374), (middle, 17134.6446), (last, 103059.7026)):
        assert bearing.before.peak_N == pytest.approx(peak, rel=1e-8)
        assert bearing.before.peak_bracket_N[1] == pytest.approx(peak, rel=1e-8)
