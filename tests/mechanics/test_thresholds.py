"""Analytic: what is a hair, and what is nothing, from both sides of the line between them."""

from dataclasses import replace

import numpy as np
import pytest

from optimizer.mechanics import balance_rate, bearings, friction, weight
from optimizer.mechanics.envelope import AnnularSector, Segment, opened_for
from optimizer.mechanics.foundation import foundation_load
from optimizer.mechanics.indicated import Trace
from optimizer.mechanics.inertia import Wrench
from optimizer.mechanics.kinematics import motion
from optimizer.mechanics.layout import layout
from optimizer.mechanics.plates import Plates
from optimizer.mechanics.row_data import row_data
from optimizer.mechanics.whole_turn import break_angles, whole_turn
from optimizer.responses.response import Phasors
from tests.builders import machine, row, throw

#: one row whose crank points along its axis at shaft angle 0
_ONE = layout(machine(throw(90.0, row(90.0))))


@pytest.mark.parametrize(("beside", "share"), [(0.0, 0.0), (1e-14, 0.0), (1e-9, 1.0), (1e-3, 1.0)])
def test_friction_acts_up_to_a_hair_beside_the_dead_centres(beside: float, share: float) -> None:
    angle = np.array([beside, np.pi - beside, np.pi + beside, -beside])
    force = friction.reciprocating_friction(motion(_ONE, angle), np.array([7.0]))
    # pi in doubles is 1e-16 short of itself
    np.testing.assert_array_equal(force[0], 7.0 * share * np.array([1.0, 1.0, -1.0, -1.0]))


@pytest.mark.parametrize(("leaning", "share"), [(1e-14, 0.0), (1e-9, 1.0), (1e-4, 1.0)])
def test_a_row_that_leans_by_a_hair_presses_on_its_guide(leaning: float, share: float) -> None:
    axis = np.exp(1j * np.array([leaning]))
    pressed = weight.guides(np.array([2.0]), axis, np.asarray(1.0), np.asarray(-1.0 + 0j)).weight
    assert pressed[0] == pytest.approx(2.0 * 9.80665 * leaning * share, rel=1e-6)


@pytest.mark.parametrize(("nearer", "shares"), [(1e-10, [0.5, 0.5]), (1e-6, [1.0, 0.0])])
def test_webs_between_two_throws_belong_to_both_but_for_a_hair(nearer: float, shares: list[float]) -> None:
    web_shares = balance_rate.web_shares(np.array([0.0, 1.0]), np.array([0.5 - nearer]))
    assert web_shares[:, 0].tolist() == shares


@pytest.mark.parametrize("influence", [bearings.simple_spans_influence, bearings.continuous_beam_influence])
def test_bearings_a_hair_apart_are_two(influence) -> None:  # type: ignore[no-untyped-def]
    at = np.array([0.5])
    with pytest.raises(ValueError, match="place"):
        influence(np.array([0.0, 1e-10, 1.0]), at)
    actual_influence = influence(np.array([0.0, 1e-6, 1.0]), at)
    assert np.sum(actual_influence) == pytest.approx(1.0, rel=1e-9)


@pytest.mark.parametrize(("apart", "count"), [(1e-14, 0), (1e-9, 1), (1e-4, 1)])
def test_entries_of_a_table_a_hair_apart_are_two_breaks(apart: float, count: int) -> None:
    angle = np.array([[-1.0, 1.0, 1.0 + apart, 2.0 * np.pi - 1.0, 2.0 * np.pi + 1.0]])
    trace = Trace(0, 0, 1, angle, np.array([[1.0, 2.0, 3.0, 1.0, 2.0]]), np.zeros((), int), np.zeros(()))
    angles = break_angles(_ONE, (), (trace,))
    near = angles[np.abs(angles - 1.0) < 0.1]
    assert near.size == 1 + count
    data = replace(row_data(_ONE, True, None, None), traces=(trace,))
    half = whole_turn(data, angles[None]).half
    # what is left of it is a piece of its own
    assert np.count_nonzero((half > 0.0) & (half < 1e-3)) == count


@pytest.mark.parametrize("share", [0.0, 1e-310, 5e-4, 0.02])
def test_a_small_hub_is_taken_off(share: float) -> None:
    plate, disc = Segment(0.3 * share, 0.3, 200.0, 1.2), Segment(0.0, 0.3, 200.0, 1.2)
    # of chords below the hub all of it is off
    whole = Segment(0.3 * share, 0.3, 200.0, np.pi / 2)
    hub = 200.0 * np.pi * (0.3 * share) ** 2 / 2
    assert float(disc.mass(np.pi / 2) - whole.mass(np.pi / 2)) == pytest.approx(hub, rel=1e-6, abs=1e-300)
    assert plate.mass(1.0) == disc.mass(1.0)


def test_openings_near_a_right_angle_are_told_by_masses() -> None:
    """Property: whatever is opened is what the mass and its radius come to."""
    right = np.pi / 2
    parts = [(np.array([0]), Segment(0.03, 0.2, 300.0, right)), (np.array([1]), AnnularSector(0.03, 0.2, 300.0, right))]
    plates = Plates(np.array([0, 1]), np.array([0, 1]), parts)
    for angle in (1.2, 1.505, 1.52, 1.55, right - 1e-5, right):
        both = np.full(2, angle)
        mass = plates.mass(both)
        opened_by_mass = plates.opened_by_mass(mass, plates.unbalance(both) / mass)
        np.testing.assert_allclose(opened_by_mass, both, rtol=0, atol=2e-11 if angle > 1.5 else 1e-12)
        np.testing.assert_allclose(plates.opened_for(mass), both, rtol=0, atol=1e-14)


@pytest.mark.parametrize("shape", [AnnularSector, Segment])
def test_more_than_a_plate_holds_is_a_full_plate(shape) -> None:  # type: ignore[no-untyped-def]
    plate = shape(0.03, 0.2, 300.0, 1.1)
    full, load = plate.mass(1.1), plate.unbalance(1.1)
    assert [float(opened_for(plate, share * full)) for share in (1.0, 1.5)] == [1.1, 1.1]
    assert [float(plate.opened(share * load)) for share in (1.0, 1.5)] == [1.1, 1.1]


def test_what_is_no_more_than_rounding_leaves_is_no_load() -> None:
    size = np.asarray(2.0 + 0j)
    wrench = Wrench(Phasors(size, 0.0 * size), Phasors(1.5 * size, 0.0 * size))
    for least, force, couple in ((1.9, 2.0, 3.0), (2.0, 0.0, 3.0), (3.0, 0.0, 0.0)):
        load = foundation_load(wrench, 1, np.asarray(1.0), np.asarray(30.0), (np.asarray(least), np.asarray(least)))
        amplitudes = [float(oscillation.amplitude) for oscillation in load]
        assert amplitudes == [force, force, couple, couple]
        assert float(load.force_x.phase_deg) == (330.0 if force else 0.0)
