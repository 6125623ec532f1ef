"""Two lists of sums that all but cancel, set by set of the parts; compiled.

The places of a class are dealt into two halves. Of the sums of either only those are listed that the other reaches in
every coordinate. A map of the cells of space that those of the first half lie in tells which of the second may cancel
one, and a map of the cells that those want which of the first; what is left of both is compared pair by pair. Sums of
a half are those of its quarters (:mod:`optimizer.studies.matching.kernel.quarters`).
"""

from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.compiling import inner, kernel
from optimizer.studies.matching.kernel.quarters import BITS, LANE, LANES, packed, put_on

#: bits of a place in the maps
MAP = 18
#: units that a sum may be off: roundings of the words of all quarters, and what they carry
_OFF = 8.0
#: orders of a quarter, of at most four places, and bits that number them
_ORDERS, _ORDER = 24, 5
#: sums of a half: sets on its first quarter, in every order of both
_SUMS = 70 * _ORDERS * _ORDERS
#: bits of a chain of sums that met
_CHAINS = 12
_TOPS = np.uint64(0x8000800080008000)
_MIX = np.uint64(0x9E3779B97F4A7C15)
_TO_MAP, _TO_CHAIN = np.uint64(64 - MAP), np.uint64(64 - _CHAINS)
_SIX, _LOW, _LOWEST_BIT = np.uint64(6), np.uint64(63), np.uint64(1)


class Window(NamedTuple):
    """Which sums are wanted: from anchor level - down slack to anchor level + up slack, slack = level - least."""

    cell: np.uint64  # bits of a word that number its cell
    inside: np.uint64  # bits that tell where in its cell it is; coordinates that are not used have neither
    start: Real  # (C,) what is there without the parts
    anchor: Real  # (C,)
    down: Real  # (C,)
    up: Real  # (C,)


class Sets(NamedTuple):
    """Sets of parts on the first half."""

    parts: np.ndarray  # (N,) as bits
    least: Real  # (N,) height that no assignment with one is below
    low: Real  # (N, 2, C) the smallest that the parts of either half come to, in units
    high: Real  # (N, 2, C) and the largest


class Peaks(NamedTuple):
    """The largest of some weighted sums of lengths of start + effect m."""

    start: Complex  # (J,)
    effect: Complex  # (J, n)
    weight: Real  # (K, J)
    mass: Real  # (n,) of the parts


class Work(NamedTuple):
    """What one set after another is worked out in."""

    places: np.ndarray  # (2, 2^MAP / 64) bits of cells: of sums of the first half, and of those that the second wants
    word: np.ndarray  # (2, w) what is left of either half
    code: np.ndarray  # (2, w) where that is from: set on the first quarter as bits, its order, that of the others
    within: np.ndarray  # (p,) which orders of the others lie between
    begin: Real  # (2, C) what a sum of a half has to be above
    end: Real  # (2, C) and below
    first: np.ndarray  # (2^_CHAINS,) the first sum in each chain, -1 where there is none
    after: np.ndarray  # (w,) the next in its chain
    put: Real  # (n,) masses place by place
    best: Real  # (n,) of the smallest peak


@kernel
def joined(quarters, tables, window, peaks, sets, level, most):  # type: ignore[no-untyped-def]
    """The smallest peak below a level of all assignments that have one of these sets on the first half.

    Parameters
    ----------
    sets : with heights below the level.
    level : that the peak is to be below.
    most : pairs that are looked at.

    Returns
    -------
    float : that peak, or the level where there is none below it.
    int : how many sets were looked at, fewer than all where they have more pairs.
    (n,) : masses place by place, where there is one.
    """
    left, everything, used = most, quarters.taken.size - 1, window.start.size
    work = Work(
        np.zeros((2, 1 << (MAP - 6)), np.uint64),
        np.zeros((2, _SUMS + 1), np.uint64),
        np.zeros((2, _SUMS + 1), np.int64),
        np.zeros(_ORDERS, np.bool_),
        np.zeros((2, used)),
        np.zeros((2, used)),
        np.full(1 << _CHAINS, -1),
        np.zeros(_SUMS, np.int64),
        np.zeros(peaks.mass.size),
        np.zeros(peaks.mass.size),
    )
    for s in range(sets.parts.size):
        if sets.least[s] >= level:
            continue
        half = sets.parts[s]
        rest = everything - half
        corner, wide = _corner(window, level, level - sets.least[s], sets.low[s], sets.high[s], work)
        first, second = _listed(quarters, tables, 0, half, work), _listed(quarters, tables, 2, rest, work)
        _mapped(first, window.cell, work)
        survivors = _survivors(second, window, corner, wide, work)
        met = _met(first, window.cell, work)
        level, left = _compared(quarters, window, peaks, (half, rest), (met, survivors), wide, (level, left), work)
        if left < 0:
            return level, s, work.best
    return level, sets.parts.size, work.best


@inner
def _corner(window, level, slack, low, high, work):  # type: ignore[no-untyped-def]
    """Of what is wanted the least word, and how wide it is; and between what the sums of either half have to lie."""
    corner, wide = np.uint64(0), np.uint64(0)
    for lane in range(window.start.size):
        begin = window.anchor[lane] * level - window.down[lane] * slack - window.start[lane] - _OFF
        width = (window.down[lane] + window.up[lane]) * slack + 2.0 * _OFF
        corner |= packed(begin, lane)
        wide |= packed(width, lane)
        for side in range(2):
            work.begin[side, lane] = begin - high[1 - side, lane]
            work.end[side, lane] = begin + width - low[1 - side, lane]
    for lane in range(window.start.size, LANES):
        wide |= packed(-1.0, lane)
    return corner, wide


@inner
def _listed(quarters, tables, q, half, work):  # type: ignore[no-untyped-def]
    """Sums of the parts of a half, and where they are from, that the other half reaches: how many."""
    count, one, side, within = 0, half, q // 2, work.within
    lanes, orders = tables.units.shape[2], quarters.ways[q + 1]
    while True:
        if quarters.taken[one] == quarters.size[q]:
            number, rest = quarters.number[one], quarters.number[half ^ one]
            for order in range(quarters.ways[q]):
                fits = True
                for lane in range(lanes):
                    begin = work.begin[side, lane] - tables.units[q, number, lane, order]
                    end = work.end[side, lane] - tables.units[q, number, lane, order]
                    fits &= (tables.high[q + 1, rest, lane] >= begin) & (tables.low[q + 1, rest, lane] <= end)
                if not fits:
                    continue
                for k in range(orders):
                    within[k] = True
                for lane in range(lanes):
                    begin = work.begin[side, lane] - tables.units[q, number, lane, order]
                    end = work.end[side, lane] - tables.units[q, number, lane, order]
                    for k in range(orders):
                        at = tables.units[q + 1, rest, lane, k]
                        within[k] &= (at >= begin) & (at <= end)
                base, code = tables.word[q, number, order], (one << _ORDER | order) << _ORDER
                for k in range(orders):
                    work.word[side, count], work.code[side, count] = base + tables.word[q + 1, rest, k], code | k
                    count += within[k]
        if one == 0:
            return count
        one = (one - 1) & half


@inner
def _mapped(count, cell, work):  # type: ignore[no-untyped-def]
    """Mark the cells of all sums of the first half."""
    work.places[:] = 0
    for i in range(count):
        _mark(work.places, 0, work.word[0, i] & cell)


@inner
def _survivors(count, window, corner, wide, work):  # type: ignore[no-untyped-def]
    """Sums of the second half, as what is wanted beside them, that have a marked cell: how many; mark theirs."""
    number, cell = 0, window.cell
    for i in range(count):
        wanted = corner - work.word[1, i]
        over = _over(window, wanted, wide)
        some = over
        while not _marked(work.places, 0, _plus(wanted & cell, some)):
            if some == 0:
                break
            some = (some - _LOWEST_BIT) & over
        else:
            work.word[1, number], work.code[1, number] = wanted, work.code[1, i]
            number += 1
            some = over
            while True:
                _mark(work.places, 1, _plus(wanted & cell, some))
                if some == 0:
                    break
                some = (some - _LOWEST_BIT) & over
    return number


@inner
def _met(count, cell, work):  # type: ignore[no-untyped-def]
    """Sums of the first half in cells that the second has marked: how many, chained by their cells."""
    met = 0
    for i in range(count):
        word = work.word[0, i]
        if _marked(work.places, 1, word & cell):
            chain = _chain(word & cell)
            work.word[0, met], work.code[0, met] = word, work.code[0, i]
            work.after[met], work.first[chain] = work.first[chain], met
            met += 1
    return met


@inner
def _compared(quarters, window, peaks, halves, counts, wide, state, work):  # type: ignore[no-untyped-def]
    """The level, or the smallest peak below it of pairs in the window, and how many more may be looked at."""
    (met, kept), (level, left), cell = counts, state, window.cell
    for i in range(kept):
        wanted = work.word[1, i]
        over = _over(window, wanted, wide)
        some = over
        while left >= 0:
            cells = _plus(wanted & cell, some)
            j = work.first[_chain(cells)]
            while j >= 0:
                left -= 1
                if work.word[0, j] & cell == cells and _within(work.word[0, j], wanted, wide):
                    _assigned(quarters, halves[0], 0, work.code[0, j], peaks.mass, work)
                    _assigned(quarters, halves[1], 2, work.code[1, i], peaks.mass, work)
                    value = _peak(peaks, work.put)
                    if value < level:
                        level = value
                        for place in range(work.put.size):
                            work.best[place] = work.put[place]
                j = work.after[j]
            if some == 0:
                break
            some = (some - _LOWEST_BIT) & over
    for j in range(met):
        work.first[_chain(work.word[0, j] & cell)] = -1
    return level, left


@inner
def _mark(places, side, cells):  # type: ignore[no-untyped-def]
    place = (cells * _MIX) >> _TO_MAP
    places[side, place >> _SIX] |= _LOWEST_BIT << (place & _LOW)


@inner
def _marked(places, side, cells):  # type: ignore[no-untyped-def]
    place = (cells * _MIX) >> _TO_MAP
    return (places[side, place >> _SIX] >> (place & _LOW)) & _LOWEST_BIT != 0


@inner
def _over(window, word, wide):  # type: ignore[no-untyped-def]
    """The coordinates in which a window from a word on reaches the next cell, as a cell."""
    return ((word & window.inside) + (wide & (window.cell | window.inside))) & window.cell


@inner
def _chain(cells):  # type: ignore[no-untyped-def]
    return (cells * _MIX) >> _TO_CHAIN


@inner
def _plus(cells, some):  # type: ignore[no-untyped-def]
    """Cells farther on by one in some coordinates, each by itself."""
    return ((cells & ~_TOPS) + (some & ~_TOPS)) ^ ((cells ^ some) & _TOPS)


@inner
def _within(word, corner, wide):  # type: ignore[no-untyped-def]
    """Whether every coordinate is in the window."""
    for lane in range(LANES):
        shift = np.uint64(BITS * lane)
        if ((word >> shift) - (corner >> shift)) & LANE > (wide >> shift) & LANE:
            return False
    return True


@inner
def _assigned(quarters, half, q, code, mass, work):  # type: ignore[no-untyped-def]
    """The parts of a set on the places of a half."""
    begin, orders = 0, (1 << _ORDER) - 1
    one = code >> 2 * _ORDER
    for before in range(q):
        begin += quarters.size[before]
    put_on(quarters, q, code >> _ORDER & orders, one, mass, begin, work.put)
    put_on(quarters, q + 1, code & orders, half ^ one, mass, begin + quarters.size[q], work.put)


@inner
def _peak(peaks, put):  # type: ignore[no-untyped-def]
    largest = 0.0
    for row in range(peaks.weight.shape[0]):
        total = 0.0
        for j in range(peaks.start.size):
            if peaks.weight[row, j] > 0.0:
                v = peaks.start[j]
                for place in range(put.size):
                    v += peaks.effect[j, place] * put[place]
                total += peaks.weight[row, j] * abs(v)
        largest = max(largest, total)
    return largest
