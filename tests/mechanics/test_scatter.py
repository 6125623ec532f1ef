"""Reciprocating masses that scatter: the worst of all corners is among the few that are looked at."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.mechanics.inertia import reciprocating
from optimizer.mechanics.layout import layout
from optimizer.mechanics.scatter import changed, row_parts, weighted, worst_signs
from optimizer.responses.response import Phasors
from tests.builders import inline, machine, row, throw


def _corners(rows: int) -> np.ndarray:
    return np.array(list(itertools.product([-1.0, 1.0], repeat=rows)))


def _parts(mass: np.ndarray, crank: np.ndarray, axis: np.ndarray) -> Phasors:
    return Phasors(mass * np.exp(1j * crank), mass * np.exp(1j * (2 * axis - crank)))


@given(
    rows=st.integers(1, 8),
    seed=st.integers(0, 10**6),
    even=st.booleans(),
    weights=st.sampled_from([(1.0, 1.0), (1.0, 0.3), (0.2, 1.0), (1.0, 0.0), (0.0, 1.0)]),
)
def test_no_corner_of_all_is_worse(rows: int, seed: int, even: bool, weights: tuple[float, float]) -> None:
    """Independent: all 2^n corners, of any cranks and axes, or of such as coincide and stand across each other."""
    rng = np.random.default_rng(seed)
    angles = np.deg2rad(45.0 * rng.integers(0, 8, (2, rows))) if even else rng.uniform(0, 2 * np.pi, (2, rows))
    parts = _parts(rng.uniform(0, 2, rows) * rng.choice([-1, 1], rows), *angles)
    base = Phasors(*(rng.normal(size=(2, 2)) @ [1, 1j]))
    few, all_of = (
        weighted(base + changed(parts, signs, 0.3), *weights).peak
        for signs in (worst_signs(parts, *weights), _corners(rows))
    )
    assert np.max(few) == pytest.approx(np.max(all_of), rel=1e-12)


def test_twelve_rows_have_few_corners_that_matter() -> None:
    """Independent: all 4096 corners; the sum of what every row could add by itself is more than any of them."""
    rng = np.random.default_rng(12)
    parts = _parts(np.ones(12), rng.uniform(0, 2 * np.pi, 12), rng.uniform(0, np.pi, 12))
    signs = worst_signs(parts, 1.0, 1.0)
    assert len(signs) <= 2 * 12**2
    base = Phasors(np.sum(parts.co), np.sum(parts.counter))
    few, all_of = ((base + changed(parts, values, 0.01)).peak for values in (signs, _corners(12)))
    assert np.max(few) == pytest.approx(np.max(all_of), rel=1e-13)
    assert base.peak < np.max(few) < base.peak + 0.01 * 24.0


def test_alternate_rows_of_an_opposed_pair_are_the_worst() -> None:
    # analytic: two rows on one axis, cranks opposite: balanced as they are, 2 p m r with one heavy and one light
    parts = _parts(np.ones(2), np.array([0.0, np.pi]), np.zeros(2))
    peaks = changed(parts, worst_signs(parts, 1.0, 1.0), 0.1).peak
    assert np.max(peaks) == pytest.approx(2 * 0.1 * 2.0)


def test_parts_of_rows_sum_to_the_force_of_all() -> None:
    plan = layout(machine(*inline([0.0, 120.0, 240.0], [0.0, 1.0, 2.5]), throw(40.0, row(10.0), row(70.0, 4.0), z=3.0)))
    parts, whole = row_parts(plan), reciprocating(plan, 1)
    for force, second_force in ((parts.force, whole.force), (parts.moment, whole.moment)):
        assert force.co.shape == (5,)
        assert np.sum(force.co) == pytest.approx(second_force.co)
        assert np.sum(force.counter) == pytest.approx(second_force.counter)
