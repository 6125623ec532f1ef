"""Which points of two lists are near to one another; compiled."""

import numpy as np

from optimizer.numerics.compiling import inner, kernel

#: bits of a chain of points
_CHAINS = 18
_MIX = np.uint64(0x9E3779B97F4A7C15)
_TURN, _TO_CHAIN = np.uint64(29), np.uint64(64 - _CHAINS)


@kernel
def met(left, right, side, most):  # type: ignore[no-untyped-def]
    """Points (n, d) and (m, d) that are in the same cell of a grid: numbers of both (2, k), of so many pairs at most.

    Parameters
    ----------
    side : of a cell, in every coordinate.
    """
    first, after = np.full(1 << _CHAINS, -1), np.empty(len(left), np.int64)
    cells, pairs, k = np.empty(len(left), np.uint64), np.empty((2, most), np.int64), 0
    for i in range(len(left)):
        cells[i] = _cell(left, i, side)
        chain = cells[i] >> _TO_CHAIN
        after[i], first[chain] = first[chain], i
    for j in range(len(right)):
        cell = _cell(right, j, side)
        i = first[cell >> _TO_CHAIN]
        while i >= 0:
            if cells[i] == cell:
                if k == most:
                    return pairs
                pairs[0, k], pairs[1, k] = i, j
                k += 1
            i = after[i]
    return pairs[:, :k].copy()


@inner
def _cell(points, i, side):  # type: ignore[no-untyped-def]
    """A number of the cell; others may have the same, which costs a look."""
    number = np.uint64(0)
    for c in range(points.shape[1]):
        number = (number ^ (number >> _TURN) ^ np.uint64(np.int64(np.floor(points[i, c] / side)))) * _MIX
    return number
