"""Which sums of two lists are near to which sums of two others; compiled.

Sums are made slab by slab of their first coordinate, so that those of a slab stay at hand: the first list beside the
part of the second, sorted by that coordinate, that leads into the slab (Schroeppel and Shamir 1981). They are dealt
into the cells of a plane grid, no narrower than what counts as near, so that what is near is in nine cells. The grid
is of two other coordinates, where there are as many, because a slab is narrow already.
"""

import numpy as np

from optimizer.numerics.compiling import inner, kernel
from optimizer.numerics.kernel.rising import first_no_less

#: the share that is all of them
ALL = np.uint64(0xFFFFFFFFFFFFFFFF)
_MIX = np.uint64(0x9E3779B97F4A7C15)


@kernel
def gridded(left, right, slab, axes, low, side, cells, share):  # type: ignore[no-untyped-def]
    """Sums of (a, d) and (b, d) in a slab, by cells.

    Parameters
    ----------
    right : sorted by the first coordinate.
    slab : (2,) of that coordinate, from the first number to below the second.
    axes : (2,) coordinates of the grid.
    low, side, cells : (2,) corner of the grid, width of a cell, (2,) numbers of cells; what is outside is in the last.
    share : of 2^64, of the sums that are taken, by chance of a fixed seed.

    Returns
    -------
    (cells + 1,) : the first sum in each cell.
    (n, d) : the sums.
    (2, n) : their places in the lists.
    """
    first, whole = np.zeros(cells[0] * cells[1] + 1, np.int64), share == ALL
    finer = 1.0 / side
    for i in range(len(left)):
        begin, end = _reach(left[i, 0], right, slab)
        for j in range(begin, end):
            if whole or _in_share(i, j, share):
                first[_cell(left, i, right, j, axes, low, finer, cells) + 1] += 1
    for c in range(first.size - 1):
        first[c + 1] += first[c]
    count, d, there = first[-1], left.shape[1], first[:-1].copy()
    sums, places = np.empty((count, d)), np.empty((2, count), np.int64)
    for i in range(len(left)):
        begin, end = _reach(left[i, 0], right, slab)
        for j in range(begin, end):
            if whole or _in_share(i, j, share):
                c = _cell(left, i, right, j, axes, low, finer, cells)
                n = there[c]
                there[c] += 1
                places[0, n], places[1, n] = i, j
                for k in range(d):
                    sums[n, k] = left[i, k] + right[j, k]
    return first, sums, places


@kernel
def near(first, sums, left, right, slab, axes, low, side, cells, share, start, square, most):  # type: ignore[no-untyped-def]
    """Sums of a grid that are near to sums of (a, d) and (b, d) in a slab.

    Parameters
    ----------
    first, sums, axes, low, side, cells : as of :func:`gridded`; ``side`` no less than the distance.
    start : (4,) what to begin with: places in these lists, a line of the grid and a place in it, -1 of the first ones.
    square : of the distance, within which sums are near.
    most : (2,) pairs, and sums that are looked at, after which it ends for now.

    Returns
    -------
    (3, k) : places in the grid, and in both lists.
    (4,) : what to go on with; the first is a where nothing is left.
    int : sums that were looked at.
    """
    matches, k, visits, d = np.empty((3, most[0]), np.int64), 0, 0, left.shape[1]
    after, at = np.full(4, -1), np.empty(d)
    columns, rows, line, n = cells[0], cells[1], start[2], start[3]
    whole, finer = share == ALL, 1.0 / side
    for i in range(start[0], len(left)):
        begin, end = _reach(left[i, 0], right, slab)
        for j in range(max(begin, start[1]) if i == start[0] else begin, end):
            if not (whole or _in_share(i, j, share)):
                continue
            if visits > most[1]:
                after[0], after[1] = i, j
                return matches[:, :k].copy(), after, visits
            for c in range(d):
                at[c] = left[i, c] + right[j, c]
            # what is outside of the grid is in its last cells
            column = min(max(np.int64(np.floor((at[axes[0]] - low[0]) * finer)), 0), columns - 1)
            row = min(max(np.int64(np.floor((at[axes[1]] - low[1]) * finer)), 0), rows - 1)
            line = max(column - 1, 0) if line < 0 else line
            while line < min(column + 2, columns):
                n, until = max(n, first[line * rows + max(row - 1, 0)]), first[line * rows + min(row + 2, rows)]
                visits += max(until - n, 0)
                while n < until:
                    off = 0.0
                    # the last coordinates first: by those before them all of a cell are near
                    for c in range(d - 1, -1, -1):
                        off += (sums[n, c] - at[c]) ** 2
                        if off > square:
                            break
                    if off <= square:
                        if k == most[0]:
                            after[0], after[1], after[2], after[3] = i, j, line, n
                            return matches, after, visits
                        matches[0, k], matches[1, k], matches[2, k] = n, i, j
                        k += 1
                    n += 1
                line, n = line + 1, -1
            line = -1
    after[0] = len(left)
    return matches[:, :k].copy(), after, visits


@inner
def _reach(at, values, slab):  # type: ignore[no-untyped-def]
    """The part of a sorted list that leads into a slab: its first place, and the one after its last."""
    return first_no_less(values, slab[0] - at), first_no_less(values, slab[1] - at)


@inner
def _cell(left, i, right, j, axes, low, finer, cells):  # type: ignore[no-untyped-def]
    a, b = axes[0], axes[1]
    column = np.int64(np.floor((left[i, a] + right[j, a] - low[0]) * finer))
    row = np.int64(np.floor((left[i, b] + right[j, b] - low[1]) * finer))
    return min(max(column, 0), cells[0] - 1) * cells[1] + min(max(row, 0), cells[1] - 1)


@inner
def _in_share(i, j, share):  # type: ignore[no-untyped-def]
    return (np.uint64(i) * _MIX ^ np.uint64(j)) * _MIX <= share
