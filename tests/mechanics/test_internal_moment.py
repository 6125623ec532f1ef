"""The moment inside the shaft."""

import numpy as np
import pytest

from optimizer.mechanics.internal_moment import internal_moment
from optimizer.mechanics.layout import layout
from tests.builders import RADIUS, inline, machine, throw, web


def test_two_opposed_throws_bend_by_their_distance() -> None:
    """Analytic: one to the left of the other is m r d."""
    plan = layout(machine(throw(0.0, z=0.1, rotating_kg=3.0), throw(180.0, z=0.5, rotating_kg=3.0)))
    assert internal_moment(plan) == pytest.approx(3.0 * RADIUS * 0.4, rel=1e-12)


def test_counterweights_on_the_throws_leave_none() -> None:
    """Analytic."""
    webs = (web("a", 0.1, radius_m=0.2), web("b", 0.5, radius_m=0.2))
    plan = layout(machine(throw(0.0, z=0.1, rotating_kg=3.0), throw(180.0, z=0.5, rotating_kg=3.0), webs=webs))
    assert internal_moment(plan, np.array([-3.0, 3.0]) * RADIUS + 0j) == pytest.approx(0.0, abs=1e-12)


def test_it_is_the_same_from_both_ends() -> None:
    """Metamorphic: the throws in the opposite order, balanced or not."""
    cranks, places = [0.0, 40.0, 170.0, 200.0], [0.0, 0.3, 0.5, 1.1]
    first_layout = layout(machine(*inline(cranks, places)))
    second_layout = layout(machine(*inline(cranks[::-1], [1.1 - place for place in places[::-1]])))
    assert internal_moment(first_layout) == pytest.approx(internal_moment(second_layout), rel=1e-12)


def test_rows_in_line_swing_and_masses_turn() -> None:
    """Analytic: 10 kg of each on mirrored cranks of six; root 3 pitches of either, in step at their largest."""
    plan = layout(machine(*inline([0.0, 120.0, 240.0, 240.0, 120.0, 0.0], [0.2 * k for k in range(6)])))
    assert internal_moment(plan) == pytest.approx(np.sqrt(3.0) * 20.0 * RADIUS * 0.2, rel=1e-12)
