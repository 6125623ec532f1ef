"""Curves with harmonics added: pieces enclose them, and their peaks are bracketed."""

import numpy as np
import pytest

from optimizer.responses.moving_curves import Harmonics, with_harmonics
from tests.responses.fourier import FourierCurves


@pytest.mark.parametrize("seed", range(4))
def test_peaks_of_moved_curves_are_those_of_a_fine_grid(seed: int) -> None:
    """Independent: a grid of 0.01 degrees."""
    rng = np.random.default_rng(seed)
    base = FourierCurves(np.array([0.0, 1.0, -2.0, 4.0]), rng.normal(size=(3, 4)) + 1j * rng.normal(size=(3, 4)))
    by = Harmonics(np.array([-2.0, 0.0, 1.0, -3.0]), rng.normal(size=4) + 1j * rng.normal(size=4))
    grid = np.linspace(0.0, 2.0 * np.pi, 36_001)
    for number in range(3):
        bracket = with_harmonics(base.pieces, number, by).peaks(np.zeros(1, complex), 1e-9)
        values = np.abs(base.at(grid)[number] + by.at(grid))
        assert bracket.lower[0] <= bracket.upper[0] <= bracket.lower[0] * (1.0 + 2e-9)
        assert np.max(values) <= bracket.upper[0] * (1.0 + 1e-12)
        assert bracket.lower[0] == pytest.approx(np.max(values), rel=1e-6)
        there = base.at(bracket.angle)[number] + by.at(bracket.angle)
        assert abs(there[0]) == pytest.approx(bracket.lower[0], rel=1e-9)


def test_a_curve_that_is_cancelled_but_for_one_harmonic_is_a_circle() -> None:
    # analytic
    base = FourierCurves(np.array([1.0, 2.0]), np.array([[3.0, 0.5j]]))
    by = Harmonics(np.array([1.0]), np.array([-3.0 + 0j]))
    bracket = with_harmonics(base.pieces, 0, by).peaks(np.zeros(1, complex), 1e-9)
    assert bracket.lower[0] == pytest.approx(0.5, rel=1e-12)
    assert bracket.upper[0] == pytest.approx(0.5, rel=1e-8)
