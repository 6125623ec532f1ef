"""Vectors of the checker at their worst, circles around them, and curves of few harmonics: in closed form."""

import cmath
import math
from itertools import product
from types import SimpleNamespace as Fields
from typing import Any

import numpy as np
import pytest

from tests.verification.test_curves import part

#: no two are alike in size, direction or sign of a component; the last two are along the axis
_VECTORS = (3.0 + 1.0j, -1.0 + 2.0j, 0.5 - 4.0j, 0.7 + 0.0j, -0.2 + 0.0j)
#: of masses beside which a number of the code is small, and large
_SCALES = (1e-7, 1.0, 1e7)


def _hull(points: list[complex], way: complex) -> float:
    return max((point * way.conjugate()).real for point in points)


_WAYS = [cmath.rect(1.0, 0.1 + 0.7 * n) for n in range(9)]


@pytest.mark.parametrize("scale", _SCALES)
@pytest.mark.parametrize("count", [1, 2, 5])
def test_corners_of_a_zonotope_are_sums_of_both_signs(count: int, scale: float) -> None:
    """Independent: all sums; analytic: a zonotope of n directions has 2 n corners."""
    vectors = [scale * vector for vector in _VECTORS[:count]]
    corners = part("misplacement").zonotope(vectors)
    every = [sum(sign * vector for sign, vector in zip(signs, vectors, strict=True))
             for signs in product((1, -1), repeat=count)]  # fmt: skip
    assert len(corners) == 2 * count
    assert all(min(abs(corner - phasor) for phasor in every) <= 1e-14 * scale for corner in corners)
    for way in _WAYS:
        assert _hull(corners, way) == pytest.approx(_hull(every, way), rel=1e-13)


def test_nothing_has_no_corners() -> None:
    assert part("misplacement").zonotope([]) == []
    assert part("misplacement").zonotope([0j, 0j]) == []
    assert part("misplacement").rotation_outline([0j]) == []


@pytest.mark.parametrize("start", [0j, 2.0 - 7.0j, -30.0 + 1.0j])
@pytest.mark.parametrize("scale", _SCALES)
def test_masses_are_worst_at_a_corner(start: complex, scale: float) -> None:
    """Independent: all corners one after the other."""
    start, vectors = scale * start, [scale * vector for vector in _VECTORS]
    worst = max(
        abs(start + sum((1 + sign * 0.05) * vector for sign, vector in zip(signs, vectors, strict=True)))
        for signs in product((1, -1), repeat=len(vectors))
    )
    assert part("prices").worst_by_mass(start, vectors, 0.05) == pytest.approx(worst, rel=1e-13)


@pytest.mark.parametrize("start", [0j, 2.0 - 7.0j, -30.0 + 1.0j])
@pytest.mark.parametrize("scale", _SCALES)
@pytest.mark.parametrize("angle", [0.02, 0.4])
def test_angles_are_worst_at_an_end_or_along_what_is_left(start: complex, angle: float, scale: float) -> None:
    """Independent: the support of all arcs and of the start, in twenty thousand directions."""
    worst = part("prices").worst_by_angle(scale * start, [scale * vector for vector in _VECTORS], angle)
    ways = np.linspace(0.0, 2.0 * np.pi, 20_001)
    support = (start * np.exp(-1j * ways)).real
    for arrow in _VECTORS:
        away = np.abs((ways - cmath.phase(arrow) + np.pi) % (2.0 * np.pi) - np.pi)
        support += abs(arrow) * np.cos(np.maximum(away - angle, 0.0))
    assert np.max(support) <= worst / scale * (1.0 + 1e-12)
    assert worst / scale == pytest.approx(np.max(support), rel=1e-6)


def test_one_vector_turns_by_all_of_the_angle() -> None:
    """Analytic: 5 j and 4 at 0.1 rad from there are as long as the sum of both at that angle, 0.3 rad towards it."""
    prices = part("prices")
    for side in (1.0, -1.0):
        worst_by_angle = prices.worst_by_angle(5j, [cmath.rect(4.0, math.pi / 2 + 0.4 * side)], 0.1)
        assert worst_by_angle == pytest.approx(abs(5.0 + cmath.rect(4.0, 0.3)), rel=1e-13)
    assert prices.worst_by_angle(3j, [], 0.1) == 3.0
    assert prices.worst_by_angle(5j, [cmath.rect(4.0, math.pi / 2 + 0.05)], 0.1) == pytest.approx(9.0, rel=1e-13)


@pytest.mark.parametrize("scale", _SCALES)
def test_an_outline_is_around_all_arcs_and_near_them(scale: float) -> None:
    """Analytic: tangents at the ends and in the middle leave an arc of 2 a by 1 / cos(a / 2) - 1 of its radius."""
    misplacement = part("misplacement")
    vectors = [scale * vector for vector in _VECTORS]
    corners = misplacement.rotation_outline(vectors)
    assert len(corners) == 4 * len(vectors)
    wide = sum(map(abs, vectors)) * (1.0 / math.cos(misplacement.ANGLE / 2.0) - 1.0)
    for way in [cmath.rect(1.0, 0.003 * n) for n in range(0, 2095, 7)]:
        arcs = 0.0
        for arrow in vectors:
            off = (cmath.phase(arrow) - cmath.phase(way) + math.pi) % (2.0 * math.pi) - math.pi
            least = max(abs(off) - misplacement.ANGLE, 0.0)
            arcs += abs(arrow) * (math.cos(least) - math.cos(off))
        assert arcs - 1e-13 * scale <= _hull(corners, way) <= arcs + wide * (1.0 + 1e-9)


@pytest.mark.parametrize(
    ("points", "radius", "middle", "count"),
    [
        ([1 + 2j, 5 + 5j], 2.5, 3 + 3.5j, 2),
        # 3, 4 and 5: of a right angle the longest side is enough
        ([0j, 3 + 0j, 4j], 2.5, 1.5 + 2j, 2),
        ([4j, 0j, 3 + 0j], 2.5, 1.5 + 2j, 2),
        # sides of 13, 14 and 15: a b c / (4 area) = 2730 / 336
        ([0j, 14 + 0j, 5 + 12j], 8.125, 7 + 4.125j, 3),
        ([5 + 12j, 0j, 14 + 0j], 8.125, 7 + 4.125j, 3),
        ([14 + 0j, 5 + 12j, 0j], 8.125, 7 + 4.125j, 3),
        ([14 + 0j, 0j, 5 + 12j], 8.125, 7 + 4.125j, 3),
        # an obtuse angle at each of three places
        ([0j, 10 + 0j, 5 + 1j], 5.0, 5 + 0j, 2),
        ([5 + 1j, 10 + 0j, 0j], 5.0, 5 + 0j, 2),
        ([10 + 0j, 5 + 1j, 0j], 5.0, 5 + 0j, 2),
        # on a line, one inside, and one twice
        ([0j, 1j, 4j], 2.0, 2j, 2),
        ([0j, 14 + 0j, 5 + 12j, 7 + 4j], 8.125, 7 + 4.125j, 3),
        ([7 + 4j, 0j, 14 + 0j, 5 + 12j], 8.125, 7 + 4.125j, 3),
    ],
)  # fmt: skip
def test_circles_around_triangles(points: list[complex], radius: float, middle: complex, count: int) -> None:
    """Analytic: of whole numbers."""
    for scale in (1e-6, 1.0, 1e6):
        actual = part("circle").around([scale * point for point in points])
        assert actual[0] == pytest.approx(scale * radius, rel=1e-13)
        assert actual[1] == pytest.approx(scale * middle, rel=1e-13)
        assert len(actual[2]) == count


@pytest.mark.parametrize(
    ("harmonics", "low", "middle"),
    [
        # an ellipse of half-axes 5 and 1 about 2 - 3 j, turned by 0.3: its long axis is the diameter
        ({0: 2 - 3j, 1: 3 * cmath.rect(1, 0.2), -1: 2 * cmath.rect(1, 0.4)}, 5.0, 2 - 3j),
        # a circle
        ({0: -1j, 1: 2.5 + 0j}, 2.5, -1j),
        # a hypocycloid of three cusps
        ({0: 1 + 1j, 1: 2 + 0j, -2: 1 + 0j}, 3.0, 1 + 1j),
    ],
)
def test_the_smallest_circle_around_a_curve(harmonics: dict[int, complex], low: float, middle: complex) -> None:
    """Analytic."""
    for scale in (1e-6, 1.0, 1e6):
        curve = part("harmonics").Curve({k: scale * harmonic for k, harmonic in harmonics.items()})
        minimum = part("circle").smallest(curve)
        assert minimum.low <= scale * low * (1 + 1e-12)
        assert minimum.low == pytest.approx(scale * low, rel=3e-8)
        assert minimum.high == pytest.approx(scale * low, rel=3e-8)
        assert minimum.middle == pytest.approx(scale * middle, abs=3e-4 * scale)
        # of no interest up to more than that
        assert part("circle").smallest(curve, scale * 2.0 * low).high <= scale * 2.0 * low
    assert minimum.high >= minimum.low


_CURVE = {0: 0.3 - 0.7j, 1: 2 + 1j, -2: -1 + 3j, 3: 0.5j}


@pytest.mark.parametrize("angle", [0.0, 0.4, 2.0, -1.3])
def test_what_a_curve_is_made_of(angle: float) -> None:
    """Analytic: the sum of its harmonics; seen along the axes of the frame, which it turns against."""
    curve = part("harmonics").Curve(_CURVE)
    exact = sum(phasor * cmath.exp(1j * k * angle) for k, phasor in _CURVE.items())
    assert curve.at(angle) == pytest.approx(exact, rel=1e-14)
    assert curve.sides(angle) == [curve.at(angle)]
    assert curve.length(angle) == pytest.approx(abs(exact), rel=1e-14)
    on_frame = exact * cmath.exp(1j * angle)
    for axis, component in (("x", on_frame.real), ("y", on_frame.imag)):
        assert curve.along(axis).at(angle) == pytest.approx(complex(component), rel=1e-13)
    assert curve.plus(1 - 2j).at(angle) == pytest.approx(exact + 1 - 2j, rel=1e-14)
    turning = curve.plus(1 - 2j, 5).plus(3j, -2)
    more = (1 - 2j) * cmath.exp(5j * angle) + 3j * cmath.exp(-2j * angle)
    assert turning.at(angle) == pytest.approx(exact + more, rel=1e-13)
    scalar = part("harmonics").Curve(_CURVE, scalar=True)
    assert scalar.at(angle) == pytest.approx(complex(exact.real), rel=1e-13)
    assert scalar.plus(1 - 2j).at(angle) == pytest.approx(complex(exact.real + 1), rel=1e-13)
    twice = part("harmonics").total([(2.0, _CURVE), (0.0, {9: 1j}), (-3.0, {1: 1j, 4: 2 + 0j})])
    assert twice.at(angle) == pytest.approx(2 * exact - 3j * cmath.exp(1j * angle) - 6 * cmath.exp(4j * angle))
    assert 9 not in twice.harmonics


def test_sizes_means_and_squares_of_a_curve() -> None:
    """Analytic: Parseval."""
    curve = part("harmonics").Curve({0: 3 - 4j, 2: 5 + 12j, -1: 8j})
    assert (curve.mean, curve.size) == (3 - 4j, 26.0)
    assert curve.rms == pytest.approx(math.sqrt(25 + 169 + 64), rel=1e-15)
    nothing = part("harmonics").Curve({})
    assert (nothing.mean, nothing.size, nothing.at(1.0), nothing.peak()) == (0j, 0.0, 0j, (0.0, 0.0, 0.0))


@pytest.mark.parametrize("scale", [1e-9, 1.0, 1e9])
def test_where_a_peak_is(scale: float) -> None:
    """Analytic: an ellipse of half-axes 3 + 2 is longest where both phasors meet; of three phasors at 0."""
    curve = part("harmonics").Curve({1: scale * 3 * cmath.rect(1, 0.5), -1: scale * 2 * cmath.rect(1, -0.3)})
    peak = curve.peak()
    assert peak.low <= 5 * scale <= peak.high * (1 + 1e-14)
    assert peak.high == pytest.approx(5 * scale, rel=3e-10)
    # 0.5 + t = -0.3 - t, or half a revolution on
    assert (peak.angle + 0.4) % math.pi == pytest.approx(math.pi, abs=1e-4) or (
        (peak.angle + 0.4) % math.pi == pytest.approx(0.0, abs=1e-4)
    )
    assert curve.length(peak.angle) == peak.low
    assert curve.peak(6 * scale).high <= 6 * scale * (1 + 1e-10) + 1e-13 * scale


def test_sums_of_values_in_two_halves() -> None:
    """Independent: numpy."""
    values = [complex(n * n % 7, n % 3) for n in range(16)]
    np.testing.assert_allclose(part("harmonics").transform(values), np.fft.fft(values), atol=1e-12)


def test_couples_of_what_is_on_one_side() -> None:
    """Analytic: 5 N at -1 m and 13 N at 2 m about a plane at 0.5 m, with and against the shaft."""
    forces = [(-1.0, 3 + 4j, 1j), (2.0, -5 + 12j, 0j), (0.5, 100 + 0j, 7j)]
    inside = part("inside")
    assert inside._couple(forces, 0.5, 1) == pytest.approx(1.5 * 5 + 1.5)
    assert inside._couple(forces, 0.5, -1) == pytest.approx(1.5 * 13)
    # both at once: 2.25 m and 0.75 m
    assert inside._couple(forces, 1.25, 1) == pytest.approx(abs(2.25 * (3 + 4j) + 75.0) + abs(2.25j + 0.75 * 7j))


@pytest.mark.parametrize("turn", [0.0, 1.0, 3.0, -2.0])
def test_what_a_pull_takes_off_in_a_sector(turn: float) -> None:
    """Analytic: its length inside the sector, cos of what it is off beside it, nothing beyond a right angle."""
    support, pull = part("prices")._support, cmath.rect(2.0, turn)
    centre = math.degrees(turn)
    assert support(pull, None) == 2.0
    for off, share in ((0.0, 1.0), (19.0, 1.0), (-19.0, 1.0), (50.0, math.cos(math.radians(30.0))), (115.0, 0.0)):
        assert support(pull, (centre + off, 20.0)) == pytest.approx(2.0 * share, abs=1e-12)
        assert support(pull, (centre - off, 20.0)) == pytest.approx(2.0 * share, abs=1e-12)


def _corners(count: int) -> list[Any]:
    """Statements whose only length differs."""
    numbers = part("numbers")
    starts = (1.0, -3.0, 2.0)[:count]
    return [
        Fields(terms={("force", "co"): Fields(start=numbers.real(start), row="a")}, floor={"a": numbers.real(floor)})
        for start, floor in zip(starts, (0.5, 0.1, 0.2), strict=False)
    ]


def test_cuts_are_judged_where_they_prove_most() -> None:
    """Analytic: y times the start and 10 times the floor; what no corner knows is named by its first cut."""
    numbers, worst = part("numbers"), part("cuts").Part.worst
    corners = _corners(3)
    of = Fields(corners=corners, statements=corners, exact="exact")

    def cuts(bound: float, *responses: str) -> list[Any]:
        return [
            numbers.Place({"response": text, "part": "co", "x": bound, "y": 5.0}, "answer", k)
            for k, text in enumerate(responses)
        ]

    assert worst(of, cuts(1.0, "force"), numbers.ZERO) is corners[2]
    assert worst(of, cuts(-1.0, "force"), numbers.ZERO) is corners[1]
    assert worst(of, cuts(1.0, "force"), numbers.real(10.0)) is corners[0]
    with pytest.raises(numbers.NotCovered) as refused:
        worst(of, cuts(1.0, "force", "moment"), numbers.ZERO)
    assert refused.value.args[0].path == ("answer", 0)
    assert worst(Fields(corners=[], exact="exact"), cuts(1.0, "moment"), numbers.ZERO) == "exact"
