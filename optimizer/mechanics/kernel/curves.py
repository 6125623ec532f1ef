"""Curves over the turn as sums over the rows, piece by piece; compiled.

Shapes: N designs of C curves, J in all, R rows, P pieces; m curves at angles within pieces.
"""

from typing import NamedTuple

import numpy as np

from optimizer.mechanics.kernel.readings import row_series
from optimizer.mechanics.kernel.rows import Functions, Places, row_functions
from optimizer.mechanics.reading import READINGS, WITHOUT_GAS
from optimizer.numerics.arrays import Complex
from optimizer.numerics.compiling import inner, inner_with_arrays

#: of each reading
_WITHOUT_GAS = np.array([reading in WITHOUT_GAS for reading in READINGS])
#: angles of each place, as numpy's integer like all else that is handed on
_SINGLE = np.int64(1)
#: so many rows at places cost less than to look which places are alike
_FEW = 64
#: rows times places that are expanded at once, which bounds the memory
_AT_ONCE = 50_000


#: of readings where all of them count
_ANY = np.int64(-1)
#: what no forces are made of
NOTHING = Functions(np.zeros((0, 0, 0, 0, 0)), np.zeros((0, 0, 0, 0, 0)), np.zeros((0, 0)))


class Sums(NamedTuple):
    """J curves, each a sum of one force of the rows.

    reading : (J,) which.
    weights, constant : (J, R), (J,).
    """

    reading: np.ndarray
    weights: Complex
    constant: Complex


@inner_with_arrays
def sums_of_rows(  # type: ignore[no-untyped-def]
    rows, sums, curve, points, bounds, order, design, angles, half, forces, kinds
):
    """Some curves (m,) over P angles of each of N designs (N,), m / N of each: coefficients (m, P, order + 1) in units
    of half widths (N, P); and beside bounds what these leave out (m, P), and the size (m,) of what is added up.

    Parameters
    ----------
    curve : (m,) which of the curves that are sums.
    points : what forces are made of, to one order.
    bounds : the same bounded, to an order above it or more. Of either there may be none, :data:`NOTHING`.
    order : up to which bounds count, -1 where there are none.
    forces : whether points are forces of one reading instead, (parts, 4, N, R, P), (parts, 1, N, R, P), (N R, P).
    kinds : kinds of the rows, of which the first rows have functions alone, and how many angles later each row does
        what that does, (2, R); (2, 0) where all rows have some.
    """
    count, terms = sums.weights.shape[1], points.middle.shape[1 if forces else 3]
    curves = curve.size
    cubic = np.empty((curves, angles, terms), np.complex128)
    sized = terms > 0 and order >= 0
    rest, size = np.empty((curves, angles if order >= 0 else 0)), np.empty(curves if sized else 0)
    # coefficients and at last the bound's middle, each real and imaginary
    last = terms + 1 if order >= 0 else terms
    with_functions = count if kinds.shape[1] == 0 else rows.motion.shape[1]
    room = np.empty((2, last, angles)), np.empty((with_functions, angles)), np.empty((2, angles))
    (readings, _), everywhere = _readings_of(sums, curve), np.empty((0, 0), np.bool_)
    for reading in range(readings.size):
        if not readings[reading]:
            continue
        if forces:
            of_rows = points.middle, points.radius, points.way.reshape((design.size, count, angles))
        else:
            of_rows = series_and_bounds(rows, (points, bounds), design, angles, reading, order, everywhere)
        _add_rows(sums, curve, reading, of_rows, order, half, kinds, room, (cubic, rest, size))
    return cubic, rest, size


@inner_with_arrays
def series_and_bounds(rows, functions, design, angles, reading, order, mask):  # type: ignore[no-untyped-def]
    """What rows come to by one reading, of functions at points and bounded to an order; as of :func:`row_series`."""
    points, bounds = functions
    series, _ = row_series(rows, points, design, angles, reading, points.middle.shape[3], mask)
    bound, radius = row_series(rows, bounds, design, angles, reading, order + 1, mask)
    return series, bound, radius


@inner
def _add_rows(sums, curve, reading, of_rows, order, half, kinds, room, results):  # type: ignore[no-untyped-def]
    """Write what the curves (m,) of one reading come to, of what the rows come to; nothing is made here, for to count
    who holds an array takes longer than to use it.

    Parameters
    ----------
    room : for the sums of a curve and the bound's middle, each real and imaginary, for the sizes of the rows, and for
        what is added up and what it may be off by.
    """
    (series, bound, radius), (total, length, beside), (cubic, rest, size) = of_rows, room, results
    count, (curves, angles, terms) = sums.weights.shape[1], cubic.shape
    last, bounded, sized, magnitudes, off = total.shape[1], order >= 0, size.size > 0, beside[0], beside[1]
    parts, of_lengths, share = max(series.shape[0], bound.shape[0]), -1, max(curves // max(half.shape[0], 1), 1)
    for j in range(curves):
        if sums.reading[curve[j]] != reading:
            continue
        n = j // share
        if sized and n != of_lengths:
            of_lengths = n
            for r in range(length.shape[0]):
                for p in range(angles):
                    length[r, p] = _length(series[0, 0, n, r, p], series[1, 0, n, r, p] if parts > 1 else 0.0)
        total[:], beside[:] = 0.0, 0.0
        for r in range(count):
            weight = sums.weights[curve[j], r]
            if weight == 0.0:
                continue
            most, kind, cut = abs(weight), r, angles
            if kinds.shape[1] > 0:
                kind, cut = kinds[0, r], angles - kinds[1, r]
            if sized:
                _add(most, length[kind], cut, magnitudes)
            if bounded:
                _add(most, radius[n, kind], cut, off)
            for k in range(last):
                component = series[0, k, n, kind] if k < terms else bound[0, 0, n, kind]
                if parts > 1:
                    second_part = series[1, k, n, kind] if k < terms else bound[1, 0, n, kind]
                    _add_components(weight, component, second_part, cut, total[0, k], total[1, k])
                else:
                    _add(weight.real, component, cut, total[0, k])
                    if weight.imag != 0.0:
                        _add(weight.imag, component, cut, total[1, k])
        constant, largest = sums.constant[curve[j]], 0.0
        for p in range(angles):
            wide = 1.0
            for k in range(max(terms, order)):
                if k < terms:
                    cubic[j, p, k] = complex(total[0, k, p] * wide, total[1, k, p] * wide)
                wide *= half[n, p]
            if terms > 0:
                cubic[j, p, 0] += constant
            if bounded:
                rest[j, p] = (_length(total[0, terms, p], total[1, terms, p]) + off[p]) * wide
            largest = max(largest, magnitudes[p])
        if sized:
            size[j] = largest + abs(constant)


@inner
def _add(weight, numbers, cut, total):  # type: ignore[no-untyped-def]
    """Numbers (P,) times a weight to a sum; what is beyond the cut of the sum comes first in them."""
    if cut == numbers.size:
        _add_scalars(weight, numbers, total)
        return
    beyond = numbers.size - cut
    _add_scalars(weight, numbers[beyond:], total[:cut])
    _add_scalars(weight, numbers[:beyond], total[cut:])


@inner
def _add_components(weight, first, second, cut, along, across):  # type: ignore[no-untyped-def]
    """The same of vectors with both of their parts."""
    if cut == first.size:
        _add_vectors(weight, first, second, along, across)
        return
    beyond = first.size - cut
    _add_vectors(weight, first[beyond:], second[beyond:], along[:cut], across[:cut])
    _add_vectors(weight, first[:beyond], second[:beyond], along[cut:], across[cut:])


@inner
def _add_scalars(weight, numbers, total):  # type: ignore[no-untyped-def]
    for p in range(numbers.size):
        total[p] += weight * numbers[p]


@inner
def _add_vectors(weight, first, second, along, across):  # type: ignore[no-untyped-def]
    """All at once, as to fetch the sum takes longer than to add."""
    if weight.imag == 0.0:
        for p in range(first.size):
            along[p] += weight.real * first[p]
            across[p] += weight.real * second[p]
    else:
        for p in range(first.size):
            along[p] = along[p] + weight.real * first[p] - weight.imag * second[p]
            across[p] = across[p] + weight.imag * first[p] + weight.real * second[p]


@inner
def _length(along, across):  # type: ignore[no-untyped-def]
    """Magnitude of a vector; of a scalar for less."""
    return abs(along) if across == 0.0 else np.hypot(along, across)


@inner_with_arrays
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
    number, first = _alike(sums.weights, curve, curve // of_design, piece, angle, half)
    readings, with_gas = _readings_of(sums, curve)
    count_of_rows = sums.weights.shape[1]
    step = max(1, _AT_ONCE // max(count_of_rows, 1))
    for start in range(0, first.size, step):
        stop = min(start + step, first.size)
        design, centre, within = np.empty(stop - start, np.int64), np.empty(stop - start), np.empty(stop - start)
        wide, mask = np.empty(stop - start if bounded else 0), np.zeros((count_of_rows, stop - start), np.bool_)
        for q in range(stop - start):
            place = first[start + q]
            design[q], centre[q] = curve[place] // of_design, angle[place]
            within[q] = middle[design[q], piece[place]]
            if bounded:
                wide[q] = half[place]
        _count(sums, curve, _ANY, number, start, mask)
        functions = row_functions(rows, Places(design, centre, wide, within), order, with_gas, mask)
        for reading in range(readings.size):
            if not readings[reading]:
                continue
            _count(sums, curve, reading, number, start, mask)
            series, radius = row_series(rows, functions, design, _SINGLE, reading, order + 1, mask)
            _add_places(sums, curve, reading, (series, radius), number, start, stop, (cubic, off))
    if not bounded:
        for n in range(count):
            cubic[n, 0] += sums.constant[curve[n]]
    return cubic, off


@inner
def _count(sums, curve, reading, number, start, mask):  # type: ignore[no-untyped-def]
    """Write which rows count at which of some places (R, places), for one reading or all of them."""
    mask[:] = False
    for n in range(curve.size):
        q = number[n] - start
        if q >= 0 and q < mask.shape[1] and (reading < 0 or reading == sums.reading[curve[n]]):
            for r in range(mask.shape[0]):
                mask[r, q] = mask[r, q] or sums.weights[curve[n], r] != 0.0


@inner
def _add_places(sums, curve, reading, of_rows, number, start, stop, results):  # type: ignore[no-untyped-def]
    """Write what the curves (m,) of one reading come to at those of their places that are from start to stop."""
    (series, radius), (cubic, off) = of_rows, results
    for n in range(curve.size):
        q = number[n] - start
        if sums.reading[curve[n]] != reading or q < 0 or q >= stop - start:
            continue
        for r in range(sums.weights.shape[1]):
            weight = sums.weights[curve[n], r]
            if weight == 0.0:
                continue
            for k in range(cubic.shape[1]):
                cubic[n, k] += weight * _vector(series, k, q, r)
            if off.size > 0:
                off[n] += abs(weight) * radius[q, r, 0]


@inner_with_arrays
def _alike(weights, curve, design, piece, angle, half):  # type: ignore[no-untyped-def]
    """Of places (m,) the number of each among those that differ, and which is the first of these; those of curves of
    which the same row counts first stand side by side: rows that no curve of a block counts are not expanded there."""
    count, rows = angle.size, weights.shape[1]
    number, first = np.arange(count), np.arange(count)
    if count * rows <= _FEW:
        return number, first
    kind = np.empty(count, np.int64)
    for n in range(count):
        kind[n] = _kind(weights[curve[n]])
    order, different, last = _rising(angle), 0, -1
    for row in range(rows + 1):
        for k in range(count):
            place = order[k]
            if kind[place] != row:
                continue
            differs = last < 0 or kind[last] != row or angle[place] != angle[last] or piece[place] != piece[last]
            if differs or design[place] != design[last] or (half.size > 0 and half[place] != half[last]):
                first[different] = place
                different += 1
            number[place], last = different - 1, place
    return number, first[:different].copy()


@inner_with_arrays
def _rising(values):  # type: ignore[no-untyped-def]
    """Numbers of values (m,) in rising order, by Shell's sort: that of numba takes a second to compile."""
    order = np.arange(values.size)
    gap = values.size
    while gap > 1:
        # a factor of 2.2 between gaps (Tokuda)
        gap = max(int(gap / 2.2), 1)
        for k in range(gap, order.size):
            number, place = order[k], k
            while place >= gap and values[order[place - gap]] > values[number]:
                order[place] = order[place - gap]
                place -= gap
            order[place] = number
    return order


@inner
def _kind(weights):  # type: ignore[no-untyped-def]
    """The first row that counts; how many rows there are where none does."""
    for r in range(weights.size):
        if weights[r] != 0.0:
            return r
    return weights.size


@inner_with_arrays
def _readings_of(sums, curve):  # type: ignore[no-untyped-def]
    """Which readings curves (m,) are sums of, and whether gas is a part of any."""
    readings, with_gas = np.zeros(_WITHOUT_GAS.size, np.bool_), False
    for n in range(curve.size):
        reading = sums.reading[curve[n]]
        readings[reading] = True
        with_gas = with_gas or not _WITHOUT_GAS[reading]
    return readings, with_gas


@inner
def _vector(series, k, n, r):  # type: ignore[no-untyped-def]
    """A coefficient (1 or 2, k, N, R, 1) as one number."""
    return complex(series[0, k, n, r, 0], series[1, k, n, r, 0] if series.shape[0] > 1 else 0.0)
