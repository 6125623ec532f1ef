"""Outlines of curves: cubics at some places of every piece, the smallest circles around these; compiled.

Shapes: J of the curves, P pieces, S places of each.
"""

from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.compiling import inner, inner_with_arrays
from optimizer.numerics.kernel.circle import length, smallest

#: at which the cubic of every piece is looked at
PLACES = np.linspace(-1.0, 1.0, 17)
#: how far the farthest places may be from these
BETWEEN = float(PLACES[1] - PLACES[0])
#: share of the largest distance by which others that may hold a circle are less
_ALIKE = 1e-3
#: share by which a square, or a distance, is less than another for certain
_CERTAIN = 1e-12
#: Newton's steps to the farthest place
_STEPS = 2


class Outlines(NamedTuple):
    """Of J curves.

    piece : (P',) those that have a width.
    values : (J, P' S) of the cubics at the places; of no meaning where a curve is proven to be smaller than another.
    centre, radius : (J,) of the smallest circles around them.
    lower, upper : (J,) what the radius of the smallest circle around the curve is not below, and what none of its
        points is farther than from the centre.
    curve, at, angle : (m,) which pieces and angles [rad] hold which circle.
    """

    piece: np.ndarray
    values: Complex
    centre: Complex
    radius: Real
    lower: Real
    upper: Real
    curve: np.ndarray
    at: np.ndarray
    angle: Real


class Circles(NamedTuple):
    """The smallest circles around points of J curves.

    support, weights, counts : (J, 3) which points hold each, with what weights, and (J,) how many.
    """

    centre: Complex
    radius: Real
    support: np.ndarray
    weights: Real
    counts: np.ndarray


@inner_with_arrays
def outlines(cubics, number, group):  # type: ignore[no-untyped-def]
    """Outlines of curves (J,), all of which have the same pieces; of each group (J,) only the largest counts.

    Between two places a cubic is no farther from its chord than an eighth of the square of their distance times its
    largest second derivative. A curve in a box that is smaller than the circle of another of its group has the circle
    around that box, and no places that hold it.
    """
    curves, share, wide = number.size, PLACES.size, _wide(cubics.half[number[0]])
    values = np.empty((curves, wide.size * share), np.complex128)
    centre, radius = np.empty(curves, np.complex128), np.empty(curves)
    lower, upper = np.empty(curves), np.empty(curves)
    count = 0
    curve, at, angle = np.empty(3 * curves, np.int64), np.empty(3 * curves, np.int64), np.empty(3 * curves)
    largest_of, bounds = np.full(curves, -1), np.full(curves, -np.inf)
    for j in range(curves):
        centre[j], radius[j] = _box(cubics, number[j], wide)
        if largest_of[group[j]] < 0 or radius[j] > radius[largest_of[group[j]]]:
            largest_of[group[j]] = j
    # the largest of each group first
    for n in range(2 * curves):
        j = n % curves
        if (largest_of[group[j]] == j) != (n < curves):
            continue
        if radius[j] < bounds[group[j]]:
            radius[j], lower[j], upper[j] = 0.0, 0.0, radius[j]
            continue
        for p in range(wide.size):
            _at_places(cubics.cubic[number[j], wide[p]], values[j, p * share : (p + 1) * share])
        centre[j], radius[j], support, _ = smallest(values[j])
        for k in range(support.size):
            there, place = wide[support[k] // share], PLACES[support[k] % share]
            curve[count], at[count] = j, there
            angle[count] = cubics.centre[number[j], there] + cubics.half[number[j], there] * place
            count += 1
        rest, most = 0.0, -np.inf
        for p in range(wide.size):
            beyond = cubics.rest[number[j], wide[p]]
            rest = max(rest, beyond)
            own, cubic = values[j, p * share : (p + 1) * share], cubics.cubic[number[j], wide[p]]
            most = max(most, _farthest_within(own, cubic, beyond, centre[j], most))
        lower[j], upper[j] = radius[j] - rest, most
        bounds[group[j]] = max(bounds[group[j]], lower[j])
    curve, at, angle = curve[:count].copy(), at[:count].copy(), angle[:count].copy()
    return Outlines(wide, values, centre, radius, lower, upper, curve, at, angle)


@inner_with_arrays
def _wide(half):  # type: ignore[no-untyped-def]
    """Which pieces (P',) have a width."""
    count, wide = 0, np.empty(half.size, np.int64)
    for p in range(half.size):
        if half[p] > 0.0:
            wide[count] = p
            count += 1
    return wide[:count].copy()


@inner
def _at_places(cubic, out):  # type: ignore[no-untyped-def]
    """Write a cubic (4,) at the places; part by part, for a product of two complex numbers takes twice as long."""
    for s in range(PLACES.size):
        at = PLACES[s]
        square = at * at
        cube = square * at
        along = cubic[0].real + cubic[1].real * at + cubic[2].real * square + cubic[3].real * cube
        out[s] = complex(along, cubic[0].imag + cubic[1].imag * at + cubic[2].imag * square + cubic[3].imag * cube)


@inner
def _farthest_within(values, cubic, rest, centre, most):  # type: ignore[no-untyped-def]
    """What a piece is not farther than from a centre, by its values at the places; less than the most of others where
    it is less for certain."""
    largest = 0.0
    for value in values:
        along, across = value.real - centre.real, value.imag - centre.imag
        largest = max(largest, along * along + across * across)
    second, third = abs(cubic[2].real) + abs(cubic[2].imag), abs(cubic[3].real) + abs(cubic[3].imag)
    reach = np.sqrt(largest) + 0.125 * BETWEEN**2 * (2.0 * second + 6.0 * third) + rest
    if reach * (1.0 + _CERTAIN) < most:
        return reach
    least, distance = largest * (1.0 - _CERTAIN), 0.0
    for value in values:
        along, across = value.real - centre.real, value.imag - centre.imag
        if not along * along + across * across < least:
            distance = max(distance, length(value - centre))
    return distance + 0.125 * BETWEEN**2 * (2.0 * abs(cubic[2]) + 6.0 * abs(cubic[3])) + rest


@inner
def _box(cubics, curve, wide):  # type: ignore[no-untyped-def]
    """Middle of a box around a curve, by how far its pieces reach from their middles, and half of its diagonal."""
    left, right, low, high = np.inf, -np.inf, np.inf, -np.inf
    for p in range(wide.size):
        cubic, along, across = cubics.cubic[curve, wide[p]], cubics.rest[curve, wide[p]], cubics.rest[curve, wide[p]]
        for k in range(1, 4):
            along += abs(cubic[k].real)
            across += abs(cubic[k].imag)
        left, right = min(left, cubic[0].real - along), max(right, cubic[0].real + along)
        low, high = min(low, cubic[0].imag - across), max(high, cubic[0].imag + across)
    return complex(0.5 * (left + right), 0.5 * (low + high)), 0.5 * np.hypot(right - left, high - low)


@inner_with_arrays
def farthest(cubics, number, outline, active, centre):  # type: ignore[no-untyped-def]
    """Where some outlines (n,) are about as far from centres (n,) as anywhere: of which of all outlines, their curves,
    pieces and half widths of these, angles (m,) rad."""
    share, pieces = PLACES.size, outline.piece
    most = outline.values.shape[1]
    square, owner = np.empty(most), np.empty(active.size * most, np.int64)
    piece, angle, count = np.empty(active.size * most, np.int64), np.empty((2, active.size * most)), 0
    for n in range(active.size):
        values, middle, largest = outline.values[active[n]], centre[n], 0.0
        for k in range(most):
            along, across = values[k].real - middle.real, values[k].imag - middle.imag
            square[k] = along * along + across * across
            largest = max(largest, square[k])
        least = (1.0 - _ALIKE) ** 2 * largest
        for k in range(most):
            if square[k] < least or square[k] < max(square[k - 1], square[k + 1 if k + 1 < most else 0]):
                continue
            curve, there = number[active[n]], pieces[k // share]
            at = _farthest(cubics.cubic[curve, there], centre[n], PLACES[k % share])
            owner[count], piece[count], angle[1, count] = active[n], there, cubics.half[curve, there]
            angle[0, count] = cubics.centre[curve, there] + cubics.half[curve, there] * at
            count += 1
    owner = owner[:count].copy()
    return owner, number[owner], piece[:count].copy(), angle[1, :count].copy(), angle[0, :count].copy()


@inner_with_arrays
def surround(of, points, active, circles):  # type: ignore[no-untyped-def]
    """Write the smallest circles around points (m,) of curves (m,), for some of these (n,)."""
    place, own = np.empty(of.size, np.int64), np.empty(of.size, np.complex128)
    for j in active:
        size = 0
        for k in range(of.size):
            if of[k] == j:
                place[size], own[size] = k, points[k]
                size += 1
        circles.centre[j], circles.radius[j], support, shares = smallest(own[:size])
        circles.counts[j] = support.size
        for k in range(support.size):
            circles.support[j, k], circles.weights[j, k] = place[support[k]], shares[k]


@inner_with_arrays
def nearer(cubics, curve, piece, angle, cubic, centre):  # type: ignore[no-untyped-def]
    """Angles (m,) rad near others (m,) at which curves (m,) are farthest from centres (m,) within their pieces (m,), by
    cubics (m, 4) about the others."""
    angles = np.empty(angle.size)
    for n in range(angle.size):
        middle, half = cubics.centre[curve[n], piece[n]], cubics.half[curve[n], piece[n]]
        at = angle[n] + half * _farthest(cubic[n], centre[n], 0.0)
        angles[n] = min(max(at, middle - half), middle + half)
    return angles


@inner
def _farthest(cubic, centre, place):  # type: ignore[no-untyped-def]
    """The place within [-1, 1], near another one, at which a cubic (4,) is farthest from a centre; by Newton."""
    constant, linear, square, cube = cubic[0] - centre, cubic[1], cubic[2], cubic[3]
    for _ in range(_STEPS):
        value = constant + place * (linear + place * (square + place * cube))
        slope = linear + place * (2.0 * square + 3.0 * place * cube)
        bend = 2.0 * square + 6.0 * place * cube
        first = value.real * slope.real + value.imag * slope.imag
        second = abs(slope) ** 2 + value.real * bend.real + value.imag * bend.imag
        step = -first / second if second < 0.0 else 0.0
        place = min(max(place + min(max(step, -BETWEEN), BETWEEN), -1.0), 1.0)
    return place
