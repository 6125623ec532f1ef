"""Where curves over the turn cross a level: by the cubics of their pieces, and then by the curves; compiled.

Shapes: N curves of P pieces each.
"""

import numpy as np

from optimizer.mechanics.kernel.curves import series_of_curves
from optimizer.numerics.compiling import inner, inner_with_arrays

#: halvings of an interval, between which Newton's method takes over
_STEPS = 24
#: of the secant method by the curves themselves, from the roots and slopes of their cubics
_EXACT_STEPS = 5
#: order of what is read of a curve, as numpy's integer like all else that is handed on
_VALUE = np.int64(0)


@inner_with_arrays
def crossings(cubics, level, rows, sums, middle):  # type: ignore[no-untyped-def]
    """Angles (N, n) at which curves cross levels (N,), jumps included, and what their integrals up to there may be off
    by (N,); where a curve has fewer crossings than another its angles are 0.

    Parameters
    ----------
    cubics : of the curves (N, P); pieces without half widths are none.
    rows, sums, middle : what the curves are sums of.
    """
    curve, piece, place, between, jumped, at = _by_cubics(cubics.cubic, cubics.half, level)
    centre, half = np.empty(curve.size), np.empty(curve.size)
    for k in range(curve.size):
        centre[k], half[k] = cubics.centre[curve[k], piece[k]], cubics.half[curve[k], piece[k]]
    slope, step, before = np.empty(curve.size), np.zeros(curve.size), np.zeros(curve.size)
    for number in range(_EXACT_STEPS if curve.size > 0 else 0):
        angle = centre + half * place
        value = series_of_curves(rows, sums, middle, curve, piece, angle, np.empty(0), _VALUE)[0]
        for k in range(curve.size):
            above = value[k, 0].real - level[curve[k]]
            if number == 0:
                slope[k] = _slope(cubics.cubic[curve[k], piece[k]].real, place[k])
            elif step[k] != 0.0:
                slope[k] = (above - before[k]) / step[k]
            to = place[k] - above / (np.inf if slope[k] == 0.0 else slope[k])
            to = min(max(to, between[0, k]), between[1, k])
            step[k], place[k], before[k] = to - place[k], to, above
        if not step.any():
            # they stay where they are
            break
    error, count = np.zeros(level.size), np.zeros(level.size, np.int64)
    for k in range(curve.size):
        # the integral is flat there
        error[curve[k]] = max(error[curve[k]], 2.0 * abs(before[k] * step[k] * half[k]))
        count[curve[k]] += 1
    for k in range(jumped.size):
        count[jumped[k]] += 1
    most = 0
    for n in range(count.size):
        # numba's own maximum takes a fifth of a second to compile
        most = max(most, count[n])
    # never a single angle, for which numpy would add the rows in another order
    angles = np.zeros((level.size, most + 2))
    count[:] = 0
    for k in range(curve.size):
        angles[curve[k], count[curve[k]]] = centre[k] + half[k] * place[k]
        count[curve[k]] += 1
    for k in range(jumped.size):
        n, p = jumped[k], at[k]
        angles[n, count[n]] = cubics.centre[n, p] - cubics.half[n, p]
        count[n] += 1
    return angles, error


@inner_with_arrays
def _by_cubics(cubic, half, level):  # type: ignore[no-untyped-def]
    """Curves (m,), pieces, places from -1 to 1 and the bounds of these (2, m) at which cubics (N, P, 4) are levels.

    Then the curves and pieces at whose first ends they jump across.
    """
    number, pieces = half.shape
    curve, piece = np.empty(3 * number * pieces, np.int64), np.empty(3 * number * pieces, np.int64)
    place, between = np.empty(curve.size), np.empty((2, curve.size))
    jumped, at = np.empty(number * pieces, np.int64), np.empty(number * pieces, np.int64)
    ends, value, polynomial = np.empty(4), np.empty(4), np.empty(4)
    count, jumps = 0, 0
    for n in range(number):
        before = np.nan
        # what comes before the first piece is the last that has a width
        for p in range(pieces):
            if half[n, p] > 0.0:
                _shifted(cubic[n, p], level[n], polynomial)
                before = _at(polynomial, 1.0)
        for p in range(pieces):
            if not half[n, p] > 0.0:
                continue
            _shifted(cubic[n, p], level[n], polynomial)
            _turning(polynomial, ends)
            for k in range(4):
                value[k] = _at(polynomial, ends[k])
            if before * value[0] <= 0.0:
                jumped[jumps], at[jumps] = n, p
                jumps += 1
            before = value[3]
            # between its ends and where it turns a cubic has at most one root
            for k in range(3):
                if value[k] * value[k + 1] < 0.0:
                    curve[count], piece[count] = n, p
                    between[0, count], between[1, count] = ends[k], ends[k + 1]
                    place[count] = _root(polynomial, ends[k], ends[k + 1], value[k])
                    count += 1
    jumped, at = jumped[:jumps].copy(), at[:jumps].copy()
    return curve[:count].copy(), piece[:count].copy(), place[:count].copy(), between[:, :count].copy(), jumped, at


@inner
def _shifted(cubic, level, out):  # type: ignore[no-untyped-def]
    """A cubic (4,), of which the real part counts, above a level."""
    for k in range(4):
        out[k] = cubic[k].real
    out[0] -= level


@inner
def _at(cubic, place):  # type: ignore[no-untyped-def]
    return cubic[0] + place * (cubic[1] + place * (cubic[2] + place * cubic[3]))


@inner
def _slope(cubic, place):  # type: ignore[no-untyped-def]
    return cubic[1] + place * (2.0 * cubic[2] + place * 3.0 * cubic[3])


@inner
def _turning(cubic, ends):  # type: ignore[no-untyped-def]
    """Both ends of a piece and where its cubic turns between, rising; where it does not, an end."""
    slope, bend, third = cubic[1], cubic[2], cubic[3]
    square = bend * bend - 3.0 * slope * third
    # the larger root first, the smaller by it: nothing cancels
    larger = -(bend + np.copysign(np.sqrt(max(square, 0.0)), bend))
    root, second = larger / (3.0 * third), slope / larger
    root = min(max(root, -1.0), 1.0) if square > 0.0 and np.isfinite(root) else 1.0
    second = min(max(second, -1.0), 1.0) if square > 0.0 and np.isfinite(second) else 1.0
    ends[0], ends[1], ends[2], ends[3] = -1.0, min(root, second), max(root, second), 1.0


@inner
def _root(cubic, low, high, at_low):  # type: ignore[no-untyped-def]
    """Root of a cubic that changes its sign once between low and high."""
    place = 0.5 * (low + high)
    for _ in range(_STEPS):
        value = _at(cubic, place)
        if value * at_low > 0.0:
            low = place
        else:
            high = place
        slope = _slope(cubic, place)
        step = place - value / (1.0 if slope == 0.0 else slope)
        place = step if low < step < high else 0.5 * (low + high)
    return place
