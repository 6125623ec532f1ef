"""Curves over the turn as sums over the rows, piece by piece; compiled.

Shapes: N designs of C curves, J in all, R rows, P pieces; m curves at angles within pieces.
"""

from typing import NamedTuple

import numpy as np

from optimizer.mechanics.kernel.readings import READINGS, WITHOUT_GAS, row_series
from optimizer.mechanics.kernel.rows import Places, row_functions
from optimizer.numerics.arrays import Complex
from optimizer.numerics.compiling import inner, inner_with_arrays, kernel

#: of each reading
_WITHOUT_GAS = np.array([reading in WITHOUT_GAS for reading in READINGS])
#: angles of each place, as numpy's integer like all else that is handed on
_SINGLE = np.int64(1)
#: so many rows at places cost less than to look which places are alike
_FEW = 64
#: rows times places that are expanded at once, which bounds the memory
_AT_ONCE = 50_000


class Sums(NamedTuple):
    """J curves, each a sum of one force of the rows.

    reading : (J,) which.
    weights, constant : (J, R), (J,).
    """

    reading: np.ndarray
    weights: Complex
    constant: Complex


@kernel
def sums_of_rows(weights, constant, points, bounds, radius, half):  # type: ignore[no-untyped-def]
    """Pieces of N C curves: cubics (N C, P, 4) in units of half widths, what they leave out (N C, P), and the size
    (N C,) of what is added up.

    Parameters
    ----------
    weights, constant : (N, C, R), (N, C).
    points : (1 or 2, 4, N, R, P) coefficients of the rows, of vectors real and imaginary parts.
    bounds, radius : (1 or 2, 1, N, R, P), (N, R, P) enclosures of the fourth.
    half : (N, P) rad.
    """
    number, curves, rows = weights.shape
    parts, pieces = points.shape[0], half.shape[1]
    cubic = np.empty((number * curves, pieces, 4), np.complex128)
    rest, size = np.empty((number * curves, pieces)), np.empty(number * curves)
    # coefficients and the bound's middle, each real and imaginary
    total, length = np.empty((2, 5, pieces)), np.empty((rows, pieces))
    added, off = np.empty(pieces), np.empty(pieces)
    for n in range(number):
        for r in range(rows):
            for p in range(pieces):
                length[r, p] = _length(points[0, 0, n, r, p], points[1, 0, n, r, p] if parts > 1 else 0.0)
        for c in range(curves):
            total[:], added[:], off[:] = 0.0, 0.0, 0.0
            for r in range(rows):
                weight = weights[n, c, r]
                if weight == 0.0:
                    continue
                share = abs(weight)
                for p in range(pieces):
                    added[p] += share * length[r, p]
                    off[p] += share * radius[n, r, p]
                for k in range(5):
                    one = points[0, k, n, r] if k < 4 else bounds[0, 0, n, r]
                    for p in range(pieces):
                        total[0, k, p] += weight.real * one[p]
                    if weight.imag != 0.0:
                        for p in range(pieces):
                            total[1, k, p] += weight.imag * one[p]
                    if parts > 1:
                        other = points[1, k, n, r] if k < 4 else bounds[1, 0, n, r]
                        for p in range(pieces):
                            total[0, k, p] -= weight.imag * other[p]
                            total[1, k, p] += weight.real * other[p]
            curve, largest = n * curves + c, 0.0
            for p in range(pieces):
                wide = 1.0
                for k in range(4):
                    cubic[curve, p, k] = complex(total[0, k, p] * wide, total[1, k, p] * wide)
                    wide *= half[n, p]
                cubic[curve, p, 0] += constant[n, c]
                rest[curve, p] = (_length(total[0, 4, p], total[1, 4, p]) + off[p]) * wide
                largest = max(largest, added[p])
            size[curve] = largest + abs(constant[n, c])
    return cubic, rest, size


@inner
def _length(along, across):  # type: ignore[no-untyped-def]
    """Magnitude of a vector; of a scalar for less."""
    return abs(along) if across == 0.0 else np.hypot(along, across)


@kernel
def series_of_curves(rows, sums, middle, curve, piece, angle, half, order):  # type: ignore[no-untyped-def]
    """Coefficients (m, order + 1) of curves (m,) at angles (m,) rad within pieces, and nothing (0,).

    Over half widths (m,) the middle of the last alone, (m, 1), and its radius (m,). All rows are expanded about an
    angle once, whatever curves ask for it.

    Parameters
    ----------
    middle : (N, P) rad, an angle within each piece, which says what process counts; J / N curves of each design.
    half : (0,) for coefficients at points.
    """
    bounded, count, terms = half.size > 0, curve.size, 1 if half.size > 0 else order + 1
    cubic, off = np.zeros((count, terms), np.complex128), np.zeros(count if bounded else 0)
    of_design = max(sums.weights.shape[0] // middle.shape[0], 1)
    number, first = _alike(sums.weights.shape[1], curve // of_design, piece, angle, half)
    wanted, pressed = _wanted(sums, curve)
    step = max(1, _AT_ONCE // max(sums.weights.shape[1], 1))
    for start in range(0, first.size, step):
        stop = min(start + step, first.size)
        design, centre, within = np.empty(stop - start, np.int64), np.empty(stop - start), np.empty(stop - start)
        wide = np.empty(stop - start if bounded else 0)
        for q in range(stop - start):
            one = first[start + q]
            design[q], centre[q] = curve[one] // of_design, angle[one]
            within[q] = middle[design[q], piece[one]]
            if bounded:
                wide[q] = half[one]
        functions = row_functions(rows, Places(design, centre, wide, within), order, pressed)
        for reading in range(wanted.size):
            if not wanted[reading]:
                continue
            series, radius = row_series(rows, functions, design, _SINGLE, reading)
            for n in range(count):
                q = number[n] - start
                if sums.reading[curve[n]] != reading or q < 0 or q >= stop - start:
                    continue
                for r in range(sums.weights.shape[1]):
                    weight = sums.weights[curve[n], r]
                    for k in range(terms):
                        cubic[n, k] += weight * _vector(series, k, q, r)
                    if bounded:
                        off[n] += abs(weight) * radius[q, r, 0]
    if not bounded:
        for n in range(count):
            cubic[n, 0] += sums.constant[curve[n]]
    return cubic, off


@inner_with_arrays
def _alike(rows, design, piece, angle, half):  # type: ignore[no-untyped-def]
    """Of places (m,) the number of each among those that differ, and which is the first of these."""
    count = angle.size
    number, first = np.arange(count), np.arange(count)
    if count * rows <= _FEW:
        return number, first
    order, different, last = np.argsort(angle), 0, 0
    for k in range(count):
        one = order[k]
        other = k == 0 or angle[one] != angle[last] or piece[one] != piece[last] or design[one] != design[last]
        if other or (half.size > 0 and half[one] != half[last]):
            first[different] = one
            different += 1
        number[one], last = different - 1, one
    return number, first[:different].copy()


@inner_with_arrays
def _wanted(sums, curve):  # type: ignore[no-untyped-def]
    """Which readings curves (m,) are sums of, and whether gas is a part of any."""
    wanted, pressed = np.zeros(_WITHOUT_GAS.size, np.bool_), False
    for n in range(curve.size):
        reading = sums.reading[curve[n]]
        wanted[reading] = True
        pressed = pressed or not _WITHOUT_GAS[reading]
    return wanted, pressed


@inner
def _vector(series, k, n, r):  # type: ignore[no-untyped-def]
    """A coefficient (1 or 2, k, N, R, 1) as one number."""
    return complex(series[0, k, n, r, 0], series[1, k, n, r, 0] if series.shape[0] > 1 else 0.0)
