"""Bearing loads and bending moments as responses over the turn: the values of the samples, and closed forms."""

from dataclasses import replace

import numpy as np
import pytest

from optimizer.mechanics.bearings import (
    bending_moment,
    continuous_beam_influence,
    simple_spans_influence,
)
from optimizer.mechanics.gas import gas_forces, switching_angles
from optimizer.mechanics.kinematics import motion
from optimizer.mechanics.layout import Layout, layout
from optimizer.mechanics.rod import shaft_loads
from optimizer.mechanics.row_data import row_data
from optimizer.mechanics.shaft_curves import bearing_loads, bending_moments, stations
from optimizer.mechanics.whole_turn import break_angles, whole_turn
from optimizer.numerics.arrays import Real
from optimizer.responses.curve import floor
from schemas.machine.reciprocating import ReciprocatingMachine
from tests.analyze.driven import arrays, random_driven

MODELS = (simple_spans_influence, continuous_beam_influence)


def _single_throw(rod_length_m: float | None) -> Layout:
    """A crank of m r = 1 between two webs and two bearings, a rotating mass and a reciprocating one of 1 kg m each."""
    rod = {"length_m": rod_length_m, "mass_kg": 0.0, "reciprocating_share": 0.3}
    row = {"axis_deg": 0, "reciprocating_mass_kg": 1.0, "connecting_rod": rod}
    throw = {"position_m": 0.0, "crank_radius_m": 1.0, "crank_angle_deg": 0, "rotating_mass_kg": 1.0, "rows": [row]}
    webs = [
        {"name": name, "position_m": z, "counterweight_radius_m": 1.0, "max_mass_kg": 9.0}
        for name, z in (("a", -0.5), ("b", 0.5))
    ]
    body = {"kind": "reciprocating", "speed_rpm": 30.0 / np.pi, "throws": [throw], "webs": webs}
    return layout(ReciprocatingMachine.model_validate(body))


@pytest.mark.parametrize("model", MODELS)
def test_responses_have_the_values_of_the_samples(model) -> None:  # type: ignore[no-untyped-def]
    # independent: loads of the samples through the same influence, turned into the frame of the shaft
    plan, data = arrays(random_driven(5))
    turn = whole_turn(row_data(plan, True, None, data), break_angles(plan, switching_angles(data, plan)))
    planes = np.concatenate([plan.reciprocating.position, plan.rotating.position, plan.webs.position])
    places: Real = np.linspace(np.min(planes) - 0.1, np.max(planes) + 0.2, 3)
    angle = np.random.default_rng(0).uniform(0, 2 * np.pi, 60)
    moving = motion(plan, angle, True)
    force = plan.reciprocating.mass[:, None] * moving.acceleration + gas_forces(data, moving, plan).total
    where, loads = shaft_loads(force, moving, plan, angle)
    u = np.random.default_rng(1).normal(size=(plan.webs.position.size, 2)) @ [1, 1j]
    turned, square = np.exp(1j * plan.sense * angle), plan.omega**2
    where = np.concatenate([where, plan.webs.position])
    loads = np.concatenate([loads, square * u[:, None] * turned])
    carried = model(places, where) @ loads
    responses = bearing_loads(turn, plan, ("A", "B", "C"), places, model)
    for response, expected in zip(responses, carried, strict=True):
        offset = (response.at(angle) + response.offset(u)) * turned * square
        assert offset == pytest.approx(expected, rel=1e-9, abs=1e-9 * np.max(np.abs(carried)))
    bent = bending_moments(turn, plan, places, model)
    corners = np.array([float(response.name.removeprefix("bending:")) for response in bent])
    for response, expected in zip(bent, bending_moment(places, carried, where, loads, corners), strict=True):
        offset = (response.at(angle) + response.offset(u)) * turned * square
        assert offset == pytest.approx(expected, rel=1e-9, abs=1e-9 * np.max(np.abs(carried)))


@pytest.mark.parametrize(("rod", "share", "radius"), [(None, 0.5, 0.25), (3.0, 0.661, 0.346038)])
def test_one_throw_between_two_bearings(rod: float | None, share: float, radius: float) -> None:
    """Analytic: each bearing carries (m_rot + m_rec)/2 at most, and m_rec/4 with (m_rot + m_rec/2)/2 on each web.

    Published in the mathematics of this project for a rod ratio of 1/3: 0.346038 m_rec, at a share of 0.661.
    """
    plan = _single_throw(rod)
    turn = whole_turn(row_data(plan, True, None, None), break_angles(plan))
    for response in bearing_loads(turn, plan, "AB", np.array([-0.5, 0.5]), simple_spans_influence):
        lower_limit = floor(response, 1e-9)
        assert lower_limit.circle.radius == pytest.approx(radius, abs=5e-7)
        assert lower_limit.circle.centre == pytest.approx((1.0 + share) / 2, abs=5e-4)
        if rod is None:
            assert response.peak(0.0, 1e-12).upper == pytest.approx(1.0, rel=1e-9)


@pytest.mark.parametrize(
    ("places", "bent"),
    [
        # analytic: an end of the shaft and a bearing outside of all loads bend nothing
        ([-0.5, 0.5], [0.0]),
        ([-0.25, 0.25], [-0.25, 0.0, 0.25]),
        # every load on a bearing of its own: the first plane stands for all
        ([-0.5, 0.0, 0.5], [-0.5]),
    ],
)
def test_planes_in_which_the_shaft_is_bent(places: list[float], bent: list[float]) -> None:
    plan = _single_throw(None)
    turn = whole_turn(row_data(plan, True, None, None), break_angles(plan))
    responses = bending_moments(turn, plan, np.array(places), simple_spans_influence)
    assert [response.name for response in responses] == [f"bending:{plane!r}" for plane in bent]


def test_planes_that_coincide_in_every_design_count_once() -> None:
    """Analytic: webs at -0.5 and 0.5 m, a throw at 0, bearings below the webs; then the first web 0.1 m further in."""
    plan, places = _single_throw(None), np.array([-0.5, 0.5])
    assert stations(plan, places).tolist() == [-0.5, 0.0, 0.5]
    both = replace(plan, webs=replace(plan.webs, position=np.array([[-0.5, 0.5], [-0.4, 0.5]])))
    assert stations(both, places).tolist() == [[-0.5, -0.5, 0.0, 0.5], [-0.5, -0.4, 0.0, 0.5]]
