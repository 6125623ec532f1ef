"""Bearing loads and bending moments that are known in closed form: what the crank itself needs."""

from typing import Any

import numpy as np
import pytest

from optimizer.effects.registry import run
from optimizer.mechanics.layout import layout
from schemas.answer.dynamics import MainBearings
from schemas.request.scene import Fidelity
from tests.analyze.driven import ask
from tests.builders import machine, row, throw

OMEGA_SQUARED = (60.0 * np.pi / 30.0) ** 2


def _main_bearings(*throws: Any, bearings: tuple[float, ...], **rest: Any) -> MainBearings:
    """m r = 1 kg m on every crank at 60 rpm; loads and moments are over omega^2."""
    places = [{"name": str(k), "position_m": place} for k, place in enumerate(bearings)]
    design = machine(*throws, speed_rpm=60.0, bearings=places)
    return ask(design.model_dump(), "main_bearings", step_deg=30.0, **rest).main_bearings


def _cranks(*degrees: float) -> list[Any]:
    return [throw(degree, z=float(k), rotating_kg=1.0, radius_m=1.0) for k, degree in enumerate(degrees)]


@pytest.mark.parametrize(
    ("cranks", "internal"),
    [
        ((0, 180, 180, 0), 1.0),
        ((0, 120, 240, 240, 120, 0), np.sqrt(3.0)),
        ((0, 180, 90, 270, 270, 90, 180, 0), np.sqrt(2.0)),
    ],
)
def test_internal_moments_of_balanced_cranks(cranks: tuple[float, ...], internal: float) -> None:
    # analytic: forces and couples cancel, so that bearings at the ends carry nothing and the shaft all
    bearings = _main_bearings(*_cranks(*cranks), bearings=(-1.0, float(len(cranks))))
    assert bearings.bending.peak_Nm / OMEGA_SQUARED == pytest.approx(internal, rel=1e-9)
    assert max(bearing.before.peak_N for bearing in bearings.bearings) == pytest.approx(0.0, abs=1e-9 * OMEGA_SQUARED)


def test_the_couple_of_a_cross_plane_crank() -> None:
    # analytic: sqrt(10) F a, held by bearings half a pitch outside: sqrt(10)/4 F on each, half a pitch from the throws
    bearings = _main_bearings(*_cranks(0, 90, 270, 180), bearings=(-0.5, 3.5))
    assert [bearing.before.peak_N / OMEGA_SQUARED for bearing in bearings.bearings] == pytest.approx(
        [np.sqrt(10.0) / 4.0] * 2
    )
    assert bearings.bending.peak_Nm / OMEGA_SQUARED == pytest.approx(0.3952847, rel=1e-6)


@pytest.mark.parametrize(("rod_ratio", "floor"), [(0.0, 0.25), (1.0 / 3.0, 0.346038)])
def test_floor_of_a_single_throw(rod_ratio: float, floor: float) -> None:
    # analytic for an infinite rod: the counter-rotating half of the reciprocating mass, half of it on each bearing;
    # independent for 1/3: brute force over angles and counterweights
    line = row(0.0, 1.0, length_m=None if rod_ratio == 0.0 else 1.0 / rod_ratio)
    bearings = _main_bearings(throw(40.0, line, rotating_kg=2.0, radius_m=1.0), bearings=(-1.0, 1.0))
    for bearing in bearings.bearings:
        assert bearing.before.floor_N / OMEGA_SQUARED == pytest.approx(floor, rel=2e-6)
    if rod_ratio == 0.0:
        assert bearings.bearings[0].before.peak_N / OMEGA_SQUARED == pytest.approx(1.5, rel=1e-9)


@pytest.mark.parametrize(
    ("rod_ratio", "orders"), [(0.2, (0.510310, 0.489690, 0.010362)), (0.3, (0.524142, 0.475858, 0.024420))]
)
def test_side_forces_make_the_shaft_load_uneven(rod_ratio: float, orders: tuple[float, ...]) -> None:
    # independent: orders +1, -1 and -3 of the load of a row on its crank, over m r omega^2
    design = machine(throw(0.0, row(0.0, 1.0, length_m=1.0 / rod_ratio), radius_m=1.0))
    whole = run(design, layout(design), ("whole_turn",), Fidelity(), np.zeros(1))["whole_turn"]
    angle = np.arange(64) * (2.0 * np.pi / 64)
    (load,) = whole.curves("on_shaft", np.ones((1, 1, 1))).at(angle) / layout(design).omega ** 2
    # as the shaft sees them, one order less
    means = [np.mean(load * np.exp(-1j * (order - 1) * angle)).real for order in (1, -1, -3)]
    assert means == pytest.approx(orders, abs=1e-6)
