"""The smallest circles around curves over the turn, from their pieces to their proofs; compiled.

Shapes: J of the curves, m points of them.
"""

import numpy as np

from optimizer.mechanics.kernel.curves import series_of_curves
from optimizer.mechanics.kernel.search import search
from optimizer.numerics.compiling import inner, inner_with_arrays
from optimizer.numerics.kernel.circle import length
from optimizer.responses.kernel.motion import into_motion
from optimizer.responses.kernel.outlines import Circles, farthest, nearer, outlines, surround
from optimizer.responses.kernel.parts import Best, Members
from optimizer.responses.piecewise_cubics import NEARLY_NOTHING, ROUNDING

#: points added to those of the pieces for the smallest circle around a curve, at most
_MOST_POINTS = 50
#: a circle this share of what is added up in a curve is a point: what cancels leaves its rounding
_ROUNDING = 256 * np.finfo(float).eps
#: orders, as numpy's integers like all else that is handed on
_VALUE, _CUBIC = np.int64(0), np.int64(3)
#: numbers of a circle: its radius, what no point of the curve is farther away than from the centre, how many points
#: hold it. Then how often its points were searched, and the angles and the weights of those that hold it
RADIUS, UPPER, COUNT, ROUNDS, ANGLES, WEIGHTS, _NUMBERS = 0, 1, 2, 3, 4, 7, 10


@inner_with_arrays
def circles(cubics, members, rows, sums, middle, motion):  # type: ignore[no-untyped-def]
    """The smallest circles around curves (J,): centres and the curves where they hold the circles (J, 4), and numbers
    (J, 10), as named above.

    Parameters
    ----------
    members : which curves, and of each group of them only the largest radius counts. Its share is how much of a radius
        may be left open (1,), its rounding the size of what is added up in each.
    """
    number, group, tolerance, size = members.curve, members.group, members.share[0], members.rounding
    count = number.size
    outline = outlines(cubics, number, group)
    centre, radius, upper = outline.centre.copy(), outline.radius.copy(), outline.upper.copy()
    result = Circles(
        centre.copy(), np.empty(count), np.zeros((count, 3), np.int64), np.zeros((count, 3)), np.zeros(count, np.int64)
    )
    mask, largest = np.empty(count, np.bool_), np.empty(count)
    _largest(outline.lower, group, largest)
    for j in range(count):
        result.radius[j] = max(outline.lower[j], 0.0)
        mask[j] = upper[j] >= largest[group[j]]
    active = _indices(mask)
    # the first points of a curve are those that hold its outline
    first = np.empty(outline.curve.size, np.bool_)
    for k in range(first.size):
        first[k] = mask[outline.curve[k]]
    of, at, angle = outline.curve[first], outline.at[first], outline.angle[first]
    points, numbers = np.empty(0, np.complex128), np.zeros((count, _NUMBERS))
    for _ in range(_MOST_POINTS if active.size > 0 else 0):
        # all points that may hold a circle about this centre, not only the farthest
        owner, curve, piece, half, near = farthest(cubics, number, outline, active, centre[active])
        cubic = _series(rows, sums, middle, motion, curve, piece, near, half, _CUBIC)
        near = nearer(cubics, curve, piece, near, cubic, centre[owner])
        if points.size == 0:
            owner, piece, near = np.concatenate((of, owner)), np.concatenate((at, piece)), np.concatenate((angle, near))
            curve, of, angle = number[owner], of[:0].copy(), angle[:0].copy()
        there = _series(rows, sums, middle, motion, curve, piece, near, np.zeros(near.size), _VALUE)[:, 0]
        of, angle, points = np.concatenate((of, owner)), np.concatenate((angle, near)), np.concatenate((points, there))
        surround(of, points, active, result)
        _keep(result, active, centre, radius)
        peak, value = _peaks(cubics, number, size, tolerance, active, centre, rows, sums, middle, motion)
        _largest(radius, group, largest)
        beyond = np.zeros(active.size, np.bool_)
        for k in range(active.size):
            j, most = active[k], peak.upper[k]
            upper[j] = most
            numbers[j, ROUNDS] += 1.0
            least = max(tolerance * NEARLY_NOTHING, _ROUNDING) * size[j]
            open_ = most > radius[j] * (1.0 + tolerance) + least
            beyond[k] = open_ and most > largest[group[j]]
        active = active[beyond]
        if active.size == 0:
            break
        of, angle, points = (
            np.concatenate((of, active)),
            np.concatenate((angle, peak.angle[beyond])),
            np.concatenate((points, value[beyond])),
        )
        surround(of, points, active, result)
        _keep(result, active, centre, radius)
    vectors = np.zeros((count, 4), np.complex128)
    for j in range(count):
        vectors[j, 0], numbers[j, RADIUS], numbers[j, UPPER] = result.centre[j], result.radius[j], upper[j]
        numbers[j, COUNT] = result.counts[j]
        for k in range(result.counts[j]):
            point = result.support[j, k]
            vectors[j, k + 1], numbers[j, ANGLES + k] = points[point], angle[point]
            numbers[j, WEIGHTS + k] = result.weights[j, k]
    return vectors, numbers


@inner_with_arrays
def _series(rows, sums, middle, motion, curve, piece, angle, half, order):  # type: ignore[no-untyped-def]
    """Coefficients (m, 4) of curves in motion about angles (m,), in units of half widths (m,)."""
    series, _ = series_of_curves(rows, sums, middle, curve + motion.first, piece, angle, np.empty(0), order)
    cubic = np.zeros((curve.size, 4), np.complex128)
    for n in range(curve.size):
        wide = 1.0
        for k in range(order + 1):
            cubic[n, k] = series[n, k] * wide
            wide *= half[n]
        into_motion(motion, curve[n], cubic[n], 0.0, angle[n], half[n])
    return cubic


@inner_with_arrays
def _peaks(  # type: ignore[no-untyped-def]
    cubics, number, size, tolerance, active, centre, rows, sums, middle, motion
):
    """Peaks of some curves (n,) about their centres, and the curves there."""
    count = active.size
    terms = np.empty(count)  # size of what is added up in each, its centre with it
    members = Members(
        number[active], np.arange(count), -centre[active], np.empty(count), np.empty(count), np.zeros(count)
    )
    for k in range(count):
        terms[k] = length(centre[active[k]]) + size[active[k]]
        members.share[k] = 0.5 * tolerance
        members.rounding[k] = max(0.5 * tolerance * NEARLY_NOTHING, ROUNDING) * terms[k]
    best = Best(
        np.full(count, np.nan),
        np.full(count, -np.inf),
        np.zeros(count),
        np.zeros(count, np.int64),
        np.zeros(count, np.int64),
    )
    value = search(cubics, members, best, rows, sums, middle, motion)
    cubic = np.zeros(4, np.complex128)
    for k in range(count):
        best.upper[k] += ROUNDING * terms[k]
        cubic[:] = 0.0
        cubic[0] = value[k]
        into_motion(motion, members.curve[k], cubic, 0.0, best.angle[k], 0.0)
        value[k] = cubic[0]
    return best, value


@inner
def _keep(result, active, centre, radius):  # type: ignore[no-untyped-def]
    for j in active:
        centre[j], radius[j] = result.centre[j], result.radius[j]


@inner
def _largest(values, group, out):  # type: ignore[no-untyped-def]
    """Write the largest of some values (n,) of each group."""
    out[:] = -np.inf
    for j in range(values.size):
        out[group[j]] = max(out[group[j]], values[j])


@inner_with_arrays
def _indices(mask):  # type: ignore[no-untyped-def]
    """Numbers of those that are true."""
    count, indices = 0, np.empty(mask.size, np.int64)
    for j in range(mask.size):
        if mask[j]:
            indices[count] = j
            count += 1
    return indices[:count].copy()
