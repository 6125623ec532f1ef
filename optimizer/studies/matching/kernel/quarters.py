"""What sets of the parts come to in quarters of the places, in every order; compiled.

Up to four coordinates lie in one word, 16 bits each, modulo 2^16: one addition adds all, and what one carries into
the next is a unit.
"""

from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.numerics.compiling import inner, kernel

#: coordinates in a word, and bits of each
LANES = 4
BITS = 16
LANE = np.uint64((1 << BITS) - 1)


class Quarters(NamedTuple):
    """The n places of a class in four quarters, one after another, two of either half."""

    size: np.ndarray  # (4,) places of each
    orders: np.ndarray  # (4, p, size) place of the k-th part of a set, in every order
    ways: np.ndarray  # (4,) orders of each
    taken: np.ndarray  # (2^n,) how many parts a set has, as bits
    number: np.ndarray  # (2^n,) of a set among those of as many parts


class Tables(NamedTuple):
    """What the parts of a set come to in a quarter, in every order, along C <= LANES coordinates."""

    word: np.ndarray  # (4, sets, p)
    units: Real  # (4, sets, C, p) the same, not rounded
    low: Real  # (4, sets, C) the smallest of these
    high: Real  # (4, sets, C) the largest


@kernel
def tabled(quarters, mass, lanes):  # type: ignore[no-untyped-def]
    """The fields of :class:`Tables`.

    Parameters
    ----------
    mass : (n,) of the parts.
    lanes : (C, n) what a kilogram at a place adds to a coordinate, in units.
    """
    sets, used, most = np.max(quarters.number) + 1, lanes.shape[0], quarters.orders.shape[1]
    word, units = np.zeros((4, sets, most), np.uint64), np.zeros((4, sets, used, most))
    low, high = np.full((4, sets, used), np.inf), np.full((4, sets, used), -np.inf)
    part, begin = np.zeros(mass.size), 0
    for q in range(4):
        size = quarters.size[q]
        for some in range(quarters.taken.size):
            if quarters.taken[some] != size:
                continue
            number, k = quarters.number[some], 0
            for each in range(mass.size):
                if some >> each & 1:
                    part[k] = mass[each]
                    k += 1
            for p in range(quarters.ways[q]):
                for lane in range(used):
                    total = 0.0
                    for k in range(size):
                        total += part[k] * lanes[lane, begin + quarters.orders[q, p, k]]
                    word[q, number, p] |= packed(total, lane)
                    units[q, number, lane, p] = total
                    low[q, number, lane] = min(low[q, number, lane], total)
                    high[q, number, lane] = max(high[q, number, lane], total)
        begin += size
    return word, units, low, high


@inner
def packed(total, lane):  # type: ignore[no-untyped-def]
    """A number of units as a coordinate of a word."""
    return (np.uint64(np.int64(np.floor(total))) & LANE) << np.uint64(BITS * lane)


@inner
def put_on(quarters, q, order, some, mass, begin, put):  # type: ignore[no-untyped-def]
    """The parts of a set on the places of a quarter, in an order."""
    k = part = 0
    while some >> part:
        if some >> part & 1:
            put[begin + quarters.orders[q, order, k]] = mass[part]
            k += 1
        part += 1
