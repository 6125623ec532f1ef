"""Forces of the rows of many designs over the pieces of their turns, a few designs at a time; compiled.

What the forces of a few designs are made of fits the cache. Rows that are the same in all designs are expanded once
over the pieces that these designs have in common.

Shapes: N designs, R rows, P pieces; b designs of a block, m of their places.
"""

import numpy as np

from optimizer.mechanics.kernel.curves import series_and_bounds
from optimizer.mechanics.kernel.readings import ON_FRAME, ON_SHAFT
from optimizer.mechanics.kernel.rows import Functions, Places, row_functions
from optimizer.numerics.compiling import inner, inner_with_arrays

#: order of a cubic, as numpy's integers like all else that is handed on
_CUBIC = np.int64(3)
#: angles of each place, and what is counted from
_SINGLE, _NONE = np.int64(1), np.int64(0)
#: rows times pieces of a block of designs: what their forces are made of fits the cache; and designs of it at most
_AT_ONCE, _MOST = 1_500, 32


@inner_with_arrays
def design_forces(rows, selection, centre, half, order, with_gas):  # type: ignore[no-untyped-def]
    """Coefficients (M, 4, N, R, P) of forces about centres (N, P), the middles (M, 1, N, R, P) of what bounds them to
    an order over half widths (N, P), and the radii of these (K N R, P); as :func:`readings.row_series` makes them.

    Parameters
    ----------
    selection : which of the readings: K of them with M parts, one after the other.
    with_gas : whether gas is a part of any.
    """
    (designs, pieces), count = centre.shape, rows.motion.shape[1]
    of_parts, readings = _NONE, _NONE
    for reading in range(selection.size):
        if selection[reading]:
            readings += 1
            of_parts += 2 if reading in (ON_SHAFT, ON_FRAME) else 1
    points, bounds = np.empty((of_parts, 4, designs, count, pieces)), np.empty((of_parts, 1, designs, count, pieces))
    radius = np.empty((readings * designs * count, pieces))
    common, everywhere = np.zeros(count, np.bool_), np.empty((0, 0), np.bool_)
    common_count, mask = _common_rows(rows, designs, common), everywhere
    once = rows.motion.shape[0] == 1 and rows.traces.table.shape[1] == 1 and _equal_pieces(centre, half, 0, designs)
    # rows whose forces of the first design are those of all, and rows that are not read by designs side by side
    equal, rest = common.copy(), common.copy()
    if once:
        common_count, common[:], rest[:] = 0, False, False
    else:
        equal[:] = False
    every_design, every_place = np.arange(designs), np.arange(designs * pieces)
    block = max(1, min(_AT_ONCE // max((count - common_count) * pieces, 1), _MOST))
    for first in range(0, designs, block):
        stop = min(first + block, designs)
        number = every_design[first:stop]
        if common_count < count and (first == 0 or not once):
            places, of_rest = every_place[first * pieces : (first + 1 if once else stop) * pieces], everywhere
            if common_count > 0:
                of_rest = np.empty((count, places.size), np.bool_)
                _mark(common, False, of_rest)
            middle, around, _ = _functions(rows, places, centre, half, order, with_gas, of_rest)
        # rows that are the same in all designs, over what differs from the first piece of the block
        slot = np.empty((stop - first, pieces), np.int64)
        storage = np.empty(slot.size if common_count > 0 else 0, np.int64)
        different = _place_list(centre, half, first, storage, slot)
        own = storage[:different]
        of_own = np.empty((count, different), np.bool_)
        _mark(common, True, of_own)
        if different > 0:
            same, beside, design = _functions(rows, own, centre, half, order, with_gas, of_own)
        if once and first > 0:
            mask, rest = np.empty((count, pieces), np.bool_), equal
            _mark(equal, False, mask)
        part, k = _NONE, _NONE
        for reading in range(selection.size):
            if not selection[reading]:
                continue
            if common_count < count:
                of_rows = series_and_bounds(rows, (middle, around), number, pieces, reading, order, mask)
                _put(rest, of_rows, (points, bounds, radius), part, k, first)
            if different > 0:
                of_rows = series_and_bounds(rows, (same, beside), design, _SINGLE, reading, order, everywhere)
                _put_from(common, of_rows, slot, (points, bounds, radius), part, k, first)
            part, k = part + (2 if reading in (ON_SHAFT, ON_FRAME) else 1), k + 1
    _repeat(equal, block, points, bounds, radius, readings)
    return Functions(points, bounds, radius)


@inner_with_arrays
def _functions(rows, places, centre, half, order, with_gas, mask):  # type: ignore[no-untyped-def]
    """What forces are made of about the centres of places (m,), and bounded to an order over their half widths."""
    design, about, wide = np.empty(places.size, np.int64), np.empty(places.size), np.empty(places.size)
    _find(places, centre, half, design, about, wide)
    middle = row_functions(rows, Places(design, about, np.empty(0), about), _CUBIC, with_gas, mask)
    return middle, row_functions(rows, Places(design, about, wide, about), order, with_gas, mask), design


@inner
def _find(places, centre, half, design, about, wide):  # type: ignore[no-untyped-def]
    """Write of which design places (m,) are, and where they are."""
    for q in range(places.size):
        n, p = places[q] // centre.shape[1], places[q] % centre.shape[1]
        design[q], about[q], wide[q] = n, centre[n, p], half[n, p]


@inner
def _equal_pieces(centre, half, first, stop):  # type: ignore[no-untyped-def]
    """Whether designs have the same pieces."""
    for n in range(first + 1, stop):
        for p in range(centre.shape[1]):
            if centre[n, p] != centre[first, p] or half[n, p] != half[first, p]:
                return False
    return True


@inner
def _common_rows(rows, designs, common):  # type: ignore[no-untyped-def]
    """Write which rows (R,) are the same in all designs; how many are."""
    chambers, traces, number = rows.gas.shape[2], rows.traces, 0
    for r in range(common.size):
        common[r] = True
        for n in range(1, designs):
            same = True
            for k in range(4 if rows.motion.shape[0] > 1 else 0):
                same = same and rows.motion[n, r, k] == rows.motion[0, r, k]
            for k in range(2 if rows.scale.shape[0] > 1 else 0):
                same = same and rows.scale[n, r, k] == rows.scale[0, r, k]
            for c in range(chambers):
                for k in range(8 if rows.gas.shape[0] > 1 else 0):
                    same = same and rows.gas[n, r, c, k] == rows.gas[0, r, c, k]
                same = same and (rows.area.shape[0] == 1 or rows.area[n, r, c] == rows.area[0, r, c])
                trace = rows.trace[r, c]
                if trace >= 0 and traces.table.shape[1] > 1:
                    same = same and traces.table[trace, n] == traces.table[trace, 0]
                    same = same and traces.lead[trace, n] == traces.lead[trace, 0]
            if not same:
                common[r] = False
                break
        number += common[r]
    return number


@inner
def _mark(common, value, mask):  # type: ignore[no-untyped-def]
    """Write at which places (R, m) rows count: at all, where they are the same in all designs or where they are not."""
    for r in range(common.size):
        for q in range(mask.shape[1]):
            mask[r, q] = common[r] == value


@inner
def _place_list(centre, half, first, out, slot):  # type: ignore[no-untyped-def]
    """Write the places of a block (m,) that differ from those of its first design, and which of them each is (b, P);
    how many there are. None where there is no room for any."""
    pieces, different = slot.shape[1], 0
    for n in range(slot.shape[0] if out.size > 0 else 0):
        for p in range(pieces):
            if n > 0 and centre[first + n, p] == centre[first, p] and half[first + n, p] == half[first, p]:
                slot[n, p] = slot[0, p]
            else:
                out[different], slot[n, p] = (first + n) * pieces + p, different
                different += 1
    return different


@inner
def _put(common, of_rows, results, part, k, first):  # type: ignore[no-untyped-def]
    """Write the forces of the rows of a block (parts, terms, b, R, P) that differ between designs."""
    (series, bound, off), (points, bounds, radius) = of_rows, results
    parts, terms, number, count, pieces = series.shape
    designs = points.shape[2]
    for n in range(number):
        for r in range(count):
            if common[r]:
                continue
            for p in range(pieces):
                radius[(k * designs + first + n) * count + r, p] = off[n, r, p]
            for i in range(parts):
                for p in range(pieces):
                    bounds[part + i, 0, first + n, r, p] = bound[i, 0, n, r, p]
                for t in range(terms):
                    for p in range(pieces):
                        points[part + i, t, first + n, r, p] = series[i, t, n, r, p]


@inner
def _repeat(equal, block, points, bounds, radius, readings):  # type: ignore[no-untyped-def]
    """Write the forces of rows that are equal in all designs, from those of the first, beyond the first block."""
    of_parts, terms, designs, count, pieces = points.shape
    for r in range(count):
        for n in range(block if equal[r] else designs, designs):
            for i in range(of_parts):
                for p in range(pieces):
                    bounds[i, 0, n, r, p] = bounds[i, 0, 0, r, p]
                for t in range(terms):
                    for p in range(pieces):
                        points[i, t, n, r, p] = points[i, t, 0, r, p]
            for k in range(readings):
                for p in range(pieces):
                    radius[(k * designs + n) * count + r, p] = radius[k * designs * count + r, p]


@inner
def _put_from(common, of_rows, slot, results, part, k, first):  # type: ignore[no-untyped-def]
    """Write the forces of the other rows, of places (parts, terms, m, R, 1)."""
    (series, bound, off), (points, bounds, radius) = of_rows, results
    parts, terms, designs, count = series.shape[0], series.shape[1], points.shape[2], points.shape[3]
    for n in range(slot.shape[0]):
        for r in range(count):
            if not common[r]:
                continue
            own = slot[n]
            for p in range(own.size):
                radius[(k * designs + first + n) * count + r, p] = off[own[p], r, 0]
            for i in range(parts):
                for p in range(own.size):
                    bounds[part + i, 0, first + n, r, p] = bound[i, 0, own[p], r, 0]
                for t in range(terms):
                    for p in range(own.size):
                        points[part + i, t, first + n, r, p] = series[i, t, own[p], r, 0]
