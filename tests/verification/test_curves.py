"""Curves over a revolution in the checker: harmonics, peaks, spans and circles against other code."""

import sys
from fractions import Fraction
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from optimizer.mechanics.bearings import continuous_beam_influence, simple_spans_influence
from optimizer.numerics.enclosing_circle import smallest_circle
from service.verification import checker


def part(name: str) -> ModuleType:
    """One of the files of the checker."""
    checker()
    return sys.modules[f"verify_{name}"]


@pytest.mark.parametrize("ratio", [0.0, 0.01, 0.2, 0.5, 0.9])
def test_harmonics_are_those_of_the_crank_gear(ratio: float) -> None:
    """Analytic: the acceleration of the piston, and the force of the rod on the crank."""
    curve = part("harmonics").Curve({k: complex(value) for k, value in part("harmonics").rod(ratio).items()})
    for angle in np.linspace(0.0, 6.0, 13):
        cosine, sine = np.cos(angle), np.sin(angle)
        root = np.sqrt(1 - (ratio * sine) ** 2)
        outward = cosine + ratio * (cosine**2 - sine**2) / root + ratio**3 * (cosine * sine) ** 2 / root**3
        assert abs(curve.at(angle) - outward * (1 - 1j * ratio * sine / root)) < 1e-11


_VECTORS = st.dictionaries(
    st.integers(-6, 6), st.complex_numbers(max_magnitude=1e3, allow_nan=False, allow_infinity=False), min_size=1
)


@given(_VECTORS, st.booleans())
def test_a_peak_is_enclosed(harmonics: dict[int, complex], scalar: bool) -> None:
    """Independent: the curve at many angles."""
    curve = part("harmonics").Curve(harmonics, scalar)
    peak = curve.peak()
    assert peak.high <= peak.low * (1 + 1e-9) + 1e-12 * curve.size
    angles = np.linspace(0.0, 2 * np.pi, 2_000)
    values = sum(harmonic * np.exp(1j * k * angles) for k, harmonic in harmonics.items())
    lengths = np.abs(np.real(values) if scalar else values)
    assert np.max(lengths) <= peak.high + 1e-12 * curve.size
    # between two of them the length rises by no more than the curve moves
    steepest = sum(abs(k * harmonic) for k, harmonic in harmonics.items())
    assert peak.low <= np.max(lengths) + steepest * np.pi / 1_999 + 1e-12 * curve.size


@pytest.mark.parametrize("continuous", [False, True])
@pytest.mark.parametrize("count", [2, 3, 6])
def test_bearings_carry_what_the_service_has_them_carry(continuous: bool, count: int) -> None:
    """Independent: the influences of the mechanics."""
    rng = np.random.default_rng(count)
    places = np.sort(rng.uniform(-1, 1, count))
    loads = np.append(rng.uniform(-1.5, 1.5, 8), places)
    influence = continuous_beam_influence if continuous else simple_spans_influence
    spans = part("spans").Spans([Fraction(place) for place in places], continuous)
    shares = [[float(share) for share in spans.shares(Fraction(load))] for load in loads]
    # lengths of spans may differ by far
    np.testing.assert_allclose(shares, influence(places, loads).T, atol=1e-9)


@given(st.lists(st.complex_numbers(max_magnitude=10, allow_nan=False), min_size=2, max_size=4, unique=True))
def test_the_smallest_circle_around_a_few_points(points: list[complex]) -> None:
    """Independent: the circle of the optimizer."""
    radius, middle, _ = part("circle").around(points)
    assert radius == pytest.approx(smallest_circle(np.array(points)).radius, rel=1e-6, abs=1e-9)
    assert max(abs(point - middle) for point in points) == pytest.approx(radius, rel=1e-6, abs=1e-9)


@given(_VECTORS)
def test_no_middle_is_nearer_to_a_curve_than_its_circle(harmonics: dict[int, complex]) -> None:
    curve = part("harmonics").Curve(harmonics)
    minimum = part("circle").smallest(curve)
    if minimum is not None:
        assert minimum.low <= minimum.high <= minimum.low * (1 + 1e-7) + 1e-11 * curve.size
        for way in (1, 1j, -1, -1j):
            moved = curve.plus(-minimum.middle - way * 0.01 * curve.size).peak()
            assert moved.high >= minimum.low * (1 - 1e-9)


@pytest.mark.parametrize("depth", [1e-1, 1e-2, 1e-3])
def test_a_steep_curve_is_integrated_in_halves_of_halves(depth: float) -> None:
    """Analytic: 1 / (x + d) from 0 to 1 is the logarithm of 1 + 1 / d; e^{jx} / (x + d) by scipy."""
    exact = float(np.log1p(1.0 / depth))
    integral = part("pistons").integral(lambda x: 1.0 / (x + depth), 0.0, 1.0, exact)
    assert integral == pytest.approx(exact, rel=1e-12)
    curve = SimpleNamespace(value=lambda x, within: complex(np.exp(1j * x)) / (x + depth) * within)
    whole, square = part("pressed")._integrals(curve, 0.0, 1.0, 2.0, 1.0)
    sides = [quad(lambda x, f=f: 2.0 * f(x) / (x + depth), 0.0, 1.0, epsabs=1e-13)[0] for f in (np.cos, np.sin)]
    assert whole == pytest.approx(complex(*sides), rel=1e-9)
    assert square == pytest.approx(4.0 / depth - 4.0 / (1.0 + depth), rel=1e-6)


def test_nodes_integrate_polynomials() -> None:
    """Analytic: n nodes are exact to the degree 2 n - 1, from 0 to 1."""
    for count in (2, 5, 10):
        nodes = part("gas").gauss(count)
        for degree in range(2 * count):
            assert sum(share * place**degree for place, share in nodes) == pytest.approx(1.0 / (degree + 1), rel=1e-13)
        assert sum(share * place ** (2 * count) for place, share in nodes) != pytest.approx(
            1.0 / (2 * count + 1), rel=1e-13
        )


def test_what_rounds_a_weighed_peak_is_all_that_may_cancel_in_it() -> None:
    """Analytic: |3 + 4 j| and 2, seen along x and y by their weights of 1 and 0.3, at half a newton metre each."""
    real, turned = part("numbers").real, part("numbers").J
    responses = {"moment": (real(3.0) + turned * real(4.0), real(2.0))}
    namespace, weighed = SimpleNamespace(x=real(1.0), y=real(0.3)), SimpleNamespace(weights={"moment": real(0.5)})
    size = part("cuts").Part.size(weighed, namespace, responses, "moment")
    assert float(size) == pytest.approx(7.0 * 1.3 * 0.5, rel=1e-15)
