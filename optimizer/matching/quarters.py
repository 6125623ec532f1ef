"""What sets of the parts come to in quarters of the places, in every order; compiled.

Up to four coordinates lie in one word, 16 bits each, modulo 2^16: one addition adds all, and what one carries into
the next is a unit.
"""

from typing import NamedTuple

import numpy as np

from optimizer.arrays import Real
from optimizer.compiling import inner, kernel

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
    """What the parts of a set come to in a quarter, in every order."""

    word: np.ndarray  # (4, sets, p)
    height: Real  # (4, sets, p) along the plane
    low: Real  # (4, sets) the smallest of these


@kernel
def tabled(quarters, mass, lanes, lever):  # type: ignore[no-untyped-def]
    """The fields of :class:`Tables`.

    Parameters
    ----------
    mass : (n,) of the parts.
    lanes : (LANES, n) what a kilogram at a place adds to a coordinate, in units.
    lever : (n,) and to the height.
    """
    shape = 4, np.max(quarters.number) + 1, quarters.orders.shape[1]
    word, height, low = np.zeros(shape, np.uint64), np.zeros(shape), np.full(shape[:2], np.inf)
    put, begin = np.zeros(mass.size), 0
    for q in range(4):
        end = begin + quarters.size[q]
        for some in range(quarters.taken.size):
            if quarters.taken[some] != quarters.size[q]:
                continue
            number = quarters.number[some]
            for p in range(quarters.ways[q]):
                put_on(quarters, q, p, some, mass, begin, put)
                for lane in range(LANES):
                    total = 0.0
                    for place in range(begin, end):
                        total += put[place] * lanes[lane, place]
                    word[q, number, p] |= packed(total, lane)
                total = 0.0
                for place in range(begin, end):
                    total += put[place] * lever[place]
                height[q, number, p] = total
                low[q, number] = min(low[q, number], total)
        begin = end
    return word, height, low


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
