"""Brackets of peaks over the turn: exact for series whose peaks are known, never beaten by brute force."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.responses.curve import TurnResponse, floor, floors, peaks
from tests.night import by_day
from tests.responses.fourier import FourierCurves

TURN = 2.0 * np.pi


def _response(orders: list[float], coefficients: list[complex], period_deg: float = 360.0) -> TurnResponse:
    curves = FourierCurves(np.array(orders, dtype=float), np.array([coefficients], dtype=complex), period_deg)
    return TurnResponse("force", "N", np.array([1.0]), curves, 0)


def test_the_peak_of_an_ellipse_is_the_sum_of_its_phasors() -> None:
    # analytic: |f| + |b|
    response = _response([0, -2], [1.0 + 2.0j, -0.3 + 0.4j])
    bracket = response.peak(0.5 - 1.0j, 1e-12)
    exact = abs(1.5 + 1.0j) + 0.5
    assert bracket.lower <= exact * (1 + 1e-15)
    assert bracket.upper >= exact * (1 - 1e-15)
    assert bracket.upper - bracket.lower <= 2e-12 * exact
    assert abs(response.at(np.array([bracket.angle]))[0] + 0.5 - 1.0j) == pytest.approx(float(bracket.lower), rel=1e-13)


def test_a_magnitude_that_does_not_change_is_bracketed_as_well() -> None:
    # analytic: a circle about the origin has the same magnitude everywhere
    bracket = _response([0, -2], [3.0, 2.0j]).peak(-3.0, 1e-10)
    assert bracket.lower == pytest.approx(2.0, rel=1e-10)
    assert 0 <= bracket.upper - bracket.lower <= 2e-10


@by_day(20, 40)
@given(st.integers(0, 10**6), st.sampled_from([360.0, 720.0]))
def test_brute_force_never_beats_the_bracket(seed: int, period_deg: float) -> None:
    # independent: 36,000 angles a turn, whose chords miss at most h^2/8 of the sum of |coefficient order^2|
    rng = np.random.default_rng(seed)
    orders = np.arange(-8, 9) if period_deg == 360.0 else np.arange(-8, 9) / 2
    coefficient = rng.normal(size=orders.size) + 1j * rng.normal(size=orders.size)
    coefficient *= 10.0 ** rng.uniform(-3, 0, orders.size)
    response = _response(orders.tolist(), coefficient.tolist(), period_deg)
    offset = complex(rng.normal(), rng.normal())
    bracket = response.peak(offset, 1e-9)
    angle = np.arange(0.0, np.deg2rad(period_deg), np.deg2rad(0.01))
    brute = np.max(np.abs(response.at(angle) + offset))
    missed = np.deg2rad(0.01) ** 2 / 8.0 * np.sum(np.abs(coefficient) * orders**2)
    assert bracket.upper - bracket.lower <= 2e-9 * bracket.lower
    assert brute <= bracket.upper
    assert bracket.lower <= brute + missed


def test_mean_and_variance_are_those_of_the_series() -> None:
    # analytic: the coefficient of order 0, and Parseval's sum of the others
    response = _response([0, -1, 3], [1.0 - 1.0j, 0.5j, 0.25])
    assert response.mean == pytest.approx(1.0 - 1.0j, rel=1e-14)
    assert response.variance == pytest.approx(0.25 + 0.0625, rel=1e-14)


def test_responses_of_different_curves_come_back_in_their_order() -> None:
    # analytic: |f| + |b| of each, with what the counterweights add
    pair = FourierCurves(np.array([0.0, -2.0]), np.array([[1.0, 0.5], [2.0, 0.25]], dtype=complex))
    curves = FourierCurves(np.array([0.0, -2.0]), np.array([[4.0, 1.0]], dtype=complex), 720.0)
    influence = np.array([1.0, 0.5j])
    responses = [
        TurnResponse("a", "N", influence, pair, 1),
        TurnResponse("b", "N", influence, curves, 0),
        TurnResponse("c", "N", 2.0 * influence, pair, 0),
    ]
    bracket = peaks(responses, np.array([0.5, 2.0]), 1e-10)
    exact = [abs(2.5 + 1.0j) + 0.25, abs(4.5 + 1.0j) + 1.0, abs(2.0 + 2.0j) + 0.5]
    assert bracket.lower == pytest.approx(exact, rel=1e-9)
    assert bracket.upper == pytest.approx(exact, rel=1e-9)


def test_the_floor_of_an_ellipse_is_its_counter_rotating_phasor() -> None:
    # analytic: a circle of radius |b| about f, whatever the counterweights
    lower_limit = floor(_response([0, -2], [1.0 + 2.0j, 0.5j]), 1e-9)
    assert lower_limit.circle.radius == pytest.approx(0.5, rel=1e-9)
    assert lower_limit.circle.centre == pytest.approx(1.0 + 2.0j, rel=1e-9)
    assert lower_limit.upper == pytest.approx(0.5, rel=1e-8)


def test_the_floor_of_a_flat_curve_is_half_its_length() -> None:
    # analytic: cos(theta) along a line turns about its middle with amplitude 3
    lower_limit = floor(_response([1, -1], [1.5, 1.5]), 1e-9)
    assert lower_limit.circle.radius == pytest.approx(3.0, rel=1e-9)
    off = np.abs(np.mod(np.rad2deg(lower_limit.angle) + 90.0, 180.0) - 90.0)
    assert np.all(off <= 1e-2)


@pytest.mark.parametrize("seed", range(4))
def test_of_a_group_only_the_largest_floor_is_sought(seed: int) -> None:
    # independent: each floor by itself; brute force holds the upper figure of those that were let go
    rng = np.random.default_rng(seed)
    orders = np.arange(-4.0, 5.0)
    size = 10.0 ** rng.uniform(-1, 0, (12, 1))
    curves = FourierCurves(orders, size * (rng.normal(size=(12, 9)) + 1j * rng.normal(size=(12, 9))))
    group = np.array([0, 1, *[2] * 10])
    alone, together = floors(curves, 1e-9), floors(curves, 1e-9, None, group)
    assert together.radius[:2] == pytest.approx(alone.radius[:2], rel=1e-9)
    assert np.max(together.radius[2:]) == pytest.approx(np.max(alone.radius[2:]), rel=1e-9)
    assert np.all(together.radius <= alone.radius * (1.0 + 1e-9))
    values = curves.at(np.linspace(0.0, TURN, 2000))
    assert np.all(np.max(np.abs(values - together.centre[:, None]), axis=1) <= together.upper * (1.0 + 1e-12))
