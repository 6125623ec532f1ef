"""Harmonics of the slider-crank, against quadrature, derivatives and published figures."""

from functools import cache

import mpmath
import numpy as np
import pytest

from optimizer.mechanics.slider_crank import acceleration_harmonic, acceleration_harmonic_order_2

#: 0.65 and 0.66 are on either side of where the series is left
RATIOS = [1e-6, 0.01, 0.1, 0.2, 0.3, 0.5, 0.65, 0.66, 0.8, 0.95]


#: of the trapezoidal rule, and its digits
POINTS, DIGITS = 1200, 60


@cache
def cosines(order: int) -> list[mpmath.mpf]:
    """At all points."""
    with mpmath.workdps(DIGITS):
        return [mpmath.cos(2 * mpmath.pi * order * i / POINTS) for i in range(POINTS)]


@cache
def displacements(ratio: float) -> list[mpmath.mpf]:
    """x / r at all points."""
    with mpmath.workdps(DIGITS):
        lam = mpmath.mpf(ratio)
        return [c + mpmath.sqrt(1 - lam**2 * (1 - c**2)) / lam for c in cosines(1)]


def by_quadrature(order: int, ratio: float) -> float:
    """A_k from the displacement of the pin, in 50 digits.

    x / r = cos phi + sqrt(1 - lam^2 sin^2 phi) / lam, and a displacement c_k cos k phi is an acceleration k^2 c_k.
    The trapezoidal rule converges geometrically for a periodic function; 600 points give 50 digits up to lam = 0.95.
    """
    with mpmath.workdps(DIGITS):
        return float(order**2 * 2 * mpmath.fdot(displacements(ratio), cosines(order)) / POINTS)


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("order", [1, 2, 3, 4, 6, 8])
def test_harmonics_independent(order: int, ratio: float) -> None:
    harmonic = float(acceleration_harmonic(order, np.asarray(ratio)))
    assert harmonic == pytest.approx(by_quadrature(order, ratio), rel=1e-13, abs=1e-40)


@pytest.mark.parametrize(
    ("order", "expected"),
    [
        pytest.param(1, 1.0, id="published-1"),
        pytest.param(2, 0.202038, id="published-2"),
        pytest.param(4, -0.0020618, id="published-4"),
    ],
)
def test_rod_ratio_of_one_fifth(order: int, expected: float) -> None:
    assert float(acceleration_harmonic(order, np.asarray(0.2))) == pytest.approx(expected, rel=2e-5)


@pytest.mark.parametrize("ratio", [0.0, 1e-300, 1e-12, 1e-4, 1e-3])
def test_long_rods_analytic(ratio: float) -> None:
    """Leading terms of the series: A2 = lam + lam^3/4, A4 = -lam^3/4, A6 = 9 lam^5/128."""
    lam = np.asarray(ratio)
    assert acceleration_harmonic(2, lam) == pytest.approx(ratio + ratio**3 / 4, rel=1e-12)
    assert acceleration_harmonic(4, lam) == pytest.approx(-(ratio**3) / 4, rel=2e-6, abs=0)
    assert acceleration_harmonic(6, lam) == pytest.approx(9 * ratio**5 / 128, rel=2e-6, abs=0)


def test_an_infinite_rod_has_one_harmonic() -> None:
    assert [float(acceleration_harmonic(k, np.asarray(0.0))) for k in range(1, 8)] == [1, 0, 0, 0, 0, 0, 0]


def test_the_shortest_rod_analytic() -> None:
    """At lam = 1 the pin is at r (cos phi + |cos phi|): c_2n = (4/pi) (-1)^(n+1) / (4 n^2 - 1)."""
    for n in (1, 2, 3):
        limit = 4 * n**2 * (4 / np.pi) * (-1) ** (n + 1) / (4 * n**2 - 1)
        assert float(acceleration_harmonic(2 * n, np.asarray(1.0))) == pytest.approx(limit, rel=1e-12)
        # the approach is like (1 - lam) log(1 - lam)
        assert float(acceleration_harmonic(2 * n, np.asarray(1 - 1e-7))) == pytest.approx(limit, rel=1e-3)


def test_a_rod_that_is_not_given() -> None:
    ratios = np.array([np.nan, 0.2])
    for order in (2, 4):
        values = acceleration_harmonic(order, ratios)
        assert np.isnan(values[0])
        assert values[1] == acceleration_harmonic(order, np.asarray(0.2))
    assert np.array_equal(acceleration_harmonic(1, ratios), [1.0, 1.0])
    assert np.isnan(acceleration_harmonic_order_2(2, ratios)[0])


@pytest.mark.parametrize("ratio", [0.05, 0.2, 0.35, 0.6])
@pytest.mark.parametrize("angle_deg", [0.0, 17.0, 90.0, 133.0, 180.0, 271.0])
def test_the_sum_of_all_harmonics_is_the_acceleration_independent(ratio: float, angle_deg: float) -> None:
    """Second derivative of the displacement by 40-digit differentiation."""
    phi = np.deg2rad(angle_deg)
    with mpmath.workdps(40):
        lam = mpmath.mpf(ratio)
        curve = mpmath.diff(lambda a: mpmath.cos(a) + mpmath.sqrt(1 - (lam * mpmath.sin(a)) ** 2) / lam, phi, 2)
    orders = [1, *range(2, 60, 2)]
    total = sum(float(acceleration_harmonic(k, np.asarray(ratio))) * np.cos(k * phi) for k in orders)
    assert total == pytest.approx(-float(curve), abs=1e-12)


def test_the_series_of_order_2_published() -> None:
    """Seed 000 eq (1): cos phi + lam cos 2 phi."""
    ratios = np.array([0.0, 0.2, 1.0])
    assert np.array_equal(acceleration_harmonic_order_2(1, ratios), [1, 1, 1])
    assert np.array_equal(acceleration_harmonic_order_2(2, ratios), ratios)
    for order in (3, 4, 6):
        assert np.array_equal(acceleration_harmonic_order_2(order, ratios), [0, 0, 0])
    acceleration_harmonic_order_2(2, ratios)[0] = 7.0
    assert ratios[0] == 0.0  # the caller's array is not handed back
