"""Peaks, axes and components of the ellipse, against a dense grid of angles."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.numerics.arrays import Complex
from optimizer.responses.response import Phasors

GRID = np.linspace(0.0, 2.0 * np.pi, 20001)
#: a maximum on the grid lies below the true one by at most half a step squared over two
GRID_ERROR = 0.5 * (GRID[1] / 2.0) ** 2

VECTORS = st.builds(complex, st.floats(-1e3, 1e3, allow_subnormal=False), st.floats(-1e3, 1e3, allow_subnormal=False))


def phasors(co: complex, counter: complex) -> Phasors:
    return Phasors(np.asarray(co), np.asarray(counter))


def over_a_turn(pair: Phasors) -> Complex:
    return pair.co * np.exp(1j * GRID) + pair.counter * np.exp(-1j * GRID)


@given(VECTORS, VECTORS, st.floats(0.0, 2.0 * np.pi))
def test_extremes_independent(co: complex, counter: complex, toward: float) -> None:
    pair = phasors(co, counter)
    size = abs(co) + abs(counter)
    vectors = over_a_turn(pair)
    assert pair.peak == pytest.approx(np.abs(vectors).max(), abs=4.0 * GRID_ERROR * size + 1e-12)
    # near a line the smallest magnitude is reached in a valley as steep as the peak is high
    assert pair.minor <= np.abs(vectors).min() + 1e-9 * size
    assert pair.minor == pytest.approx(np.abs(vectors).min(), abs=GRID[1] * size + 1e-12)
    along = np.exp(1j * toward)
    component = (vectors * np.conj(along)).real
    assert pair.peak_along(np.asarray(along)) == pytest.approx(component.max(), abs=4.0 * GRID_ERROR * size + 1e-12)


@given(VECTORS, VECTORS)
def test_major_axis_is_where_the_peak_points_analytic(co: complex, counter: complex) -> None:
    pair = phasors(co, counter)
    axis = float(pair.major_axis_deg)
    assert 0.0 <= axis < 180.0
    if co != 0 and counter != 0:
        toward = np.asarray(np.exp(1j * np.deg2rad(axis)))
        assert pair.peak_along(toward) == pytest.approx(float(pair.peak), rel=1e-9)
        assert pair.peak_along(1j * toward) == pytest.approx(float(pair.minor), abs=1e-9 * float(pair.peak))


@given(VECTORS, VECTORS, st.integers(1, 6))
def test_at_is_the_sum_of_both_phasors_analytic(co: complex, counter: complex, order: int) -> None:
    vectors = phasors(co, counter).at(GRID[::1000], order)
    expected = co * np.exp(1j * order * GRID[::1000]) + counter * np.exp(-1j * order * GRID[::1000])
    np.testing.assert_allclose(vectors, expected, atol=1e-9)


@pytest.mark.parametrize(
    ("co", "counter", "axis"),
    [
        pytest.param(1.0, 1.0, 0.0, id="analytic-along-x"),
        pytest.param(1.0, -1.0, 90.0, id="analytic-along-y"),
        pytest.param(1j, 1.0, 45.0, id="analytic-along-45"),
        pytest.param(1.0, 0.0, 0.0, id="analytic-circle-has-none"),
        pytest.param(0.0, 1j, 0.0, id="analytic-backward-circle-has-none"),
        pytest.param(0.0, 0.0, 0.0, id="analytic-nothing"),
        pytest.param(np.exp(-1e-18j), np.exp(-1e-18j), 0.0, id="analytic-never-180"),
    ],
)
def test_major_axis(co: complex, counter: complex, axis: float) -> None:
    assert phasors(co, counter).major_axis_deg == pytest.approx(axis)


def test_everything_broadcasts() -> None:
    rng = np.random.default_rng(1)
    co, counter = rng.normal(size=(2, 3, 4)) + 1j * rng.normal(size=(2, 3, 4))
    pair = Phasors(co, counter)
    for index in np.ndindex(3, 4):
        harmonics = phasors(co[index], counter[index])
        for name in ("peak", "minor", "major_axis_deg"):
            assert getattr(pair, name)[index] == getattr(harmonics, name)
        assert pair.peak_along(np.asarray(1j))[index] == harmonics.peak_along(np.asarray(1j))


def test_arithmetic() -> None:
    pair = phasors(1 + 2j, 3.0) + phasors(1j, -1.0)
    assert (pair.co, pair.counter) == (1 + 3j, 2.0)
    doubled = 2.0 * pair
    assert (doubled.co, doubled.counter) == (2 + 6j, 4.0)
