"""Components on the frame of what the shaft sees: pieces enclose them, and their peaks are bracketed."""

from dataclasses import replace

import numpy as np
import pytest

from optimizer.responses.component import component
from optimizer.responses.curve import TurnResponse, peaks
from tests.responses.fourier import FourierCurves


@pytest.mark.parametrize("sense", [1.0, -1.0])
@pytest.mark.parametrize("axis", ["x", "y"])
@pytest.mark.parametrize("seed", range(3))
def test_peaks_are_those_of_a_fine_grid(seed: int, axis: str, sense: float) -> None:
    """Independent: a grid of 0.01 degrees, turned back by hand."""
    rng = np.random.default_rng(seed)
    curves = FourierCurves(np.array([0.0, 1.0, -2.0, 4.0]), rng.normal(size=(3, 4)) + 1j * rng.normal(size=(3, 4)))
    turning = np.array([0.0, -2.0 * sense])
    u = rng.normal(size=2) + 1j * rng.normal(size=2)
    grid = np.linspace(0.0, 2.0 * np.pi, 36_001)
    for number in range(3):
        whole = TurnResponse("force", "N", np.array([1.5, 4.0]), curves, number, turning)
        for response in (whole, replace(whole, influence=np.array([1.5, 0.0]), turning=None)):
            added = np.sum(response.influence[:, None] * u[:, None] * np.exp(1j * turning[:, None] * grid), axis=0)
            vector = np.exp(1j * sense * grid) * (curves.at(grid)[number] + added)
            values = np.abs(vector.real if axis == "x" else vector.imag)
            along = component(response, axis, sense)
            bracket = peaks([along], u, 1e-9)
            assert along.name == f"force:{axis}"
            assert bracket.lower[0] <= bracket.upper[0] <= bracket.lower[0] * (1.0 + 2e-9)
            assert np.max(values) <= bracket.upper[0] * (1.0 + 1e-12)
            assert bracket.lower[0] == pytest.approx(np.max(values), rel=1e-6)
            assert abs((along.at(bracket.angle) + along.contribution(u, bracket.angle))[0].real) == pytest.approx(
                bracket.lower[0]
            )


def test_mean_squares_are_those_of_a_fine_grid() -> None:
    """Independent: the trapezoidal rule, exact for a finite series."""
    rng = np.random.default_rng(7)
    curves = FourierCurves(np.array([0.0, -1.0, 3.0]), rng.normal(size=(1, 3)) + 1j * rng.normal(size=(1, 3)))
    along = component(TurnResponse("force", "N", np.ones(1), curves, 0), "y", 1.0)
    grid = np.linspace(0.0, 2.0 * np.pi, 720, endpoint=False)
    values = (np.exp(1j * grid) * curves.at(grid)[0]).imag
    assert along.mean == pytest.approx(np.mean(values), abs=along.rms_error)
    assert np.sqrt(along.variance) == pytest.approx(np.std(values), abs=along.rms_error)
    assert along.rms_error < 3e-6
