"""Sums of four quarters of the slots that all but cancel, where the options come as close as one likes.

Where their hull reaches what no mass can undercut, no tree proves more: what is left is to find sums that come near to
a point, among more sets than two halves hold. Of two quarters those pairs are kept that come about to a share of it, of
the other two those that come about to the rest, and of these the nearest to one another (Schroeppel and Shamir 1981,
Wagner 2002).
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from optimizer.choices.clock import Clock
from optimizer.choices.discrete.options import Incumbent, Options
from optimizer.numerics.arrays import SMALLEST, Complex, Real

#: sums of a quarter, and quarters that are dealt out in a row without finding a better set
_SUMS, _PATIENCE = 400_000, 20
#: coordinates, each of two numbers, from which on what is near to a point is no quicker found than looked at
_MANY = 5
#: slots with a choice from which on quarters hold more than neighbourhoods do
_FEWEST = 12
#: sets of those found that are offered
_OFFERED = 64
#: options of a slot at least that are tried, where it has as many
_FEWEST_OPTIONS = 3
#: pairs of sums that are kept of two quarters, and pairs of these that are looked at
_PAIRS = 300_000
#: sides of cells that are tried
_SIDES = 3
#: how far at most that place is moved from what is on the slots towards where most sums are
_MOVED = 0.3
_SEED = 20_240_301


class _Quarter(NamedTuple):
    """All sums of some slots, as changes of what is on them."""

    slots: list[int]
    some: list[np.ndarray]  # (slots) their options
    points: Real  # (d, n)


class _Pairs(NamedTuple):
    """Sums of two quarters: which of them, and where they are."""

    quarters: tuple[_Quarter, _Quarter]
    which: tuple[np.ndarray, np.ndarray]  # (m,) each
    points: Real  # (d, m)

    def put(self, sets: np.ndarray, some: np.ndarray) -> None:
        """Some of them on their slots, in place."""
        for quarter, place in zip(self.quarters, self.which, strict=True):
            digits = np.unravel_index(place[some], [each.size for each in quarter.some])
            for slot, each, digit in zip(quarter.slots, quarter.some, digits, strict=True):
                sets[:, slot] = each[digit]


def quarters(incumbent: Incumbent, enough: Callable[[], bool], clock: Clock) -> None:
    """Make the set better, by options near to those that are there."""
    options, chance = incumbent.options, np.random.default_rng(_SEED)
    few = np.sum(np.sum(options.exists, axis=-1) > 1) < _FEWEST
    # where there are no coordinates no set is better than another
    if few or not 0 < incumbent.coordinates[0].shape[-1] < _MANY:
        return
    left = _PATIENCE
    while left > 0 and incumbent.chosen is not None and not enough() and not clock.spent():
        before, chosen, measure = incumbent.least, incumbent.chosen, _Measure(incumbent, incumbent.chosen)
        some = _near(options, chosen, _SUMS)
        a, b, c, d = (_quarter(measure, chosen, slots, some) for slots in _dealt(some, _SUMS, chance))
        middle = [np.mean(each.points, axis=-1) for each in (a, b, c, d)]
        off = 0.5 * (measure.wanted - sum(middle))
        moved = chance.random() * _MOVED
        one = _paired(a, b, moved * (middle[0] + middle[1] + off))
        other = _paired(c, d, (1.0 - moved) * measure.wanted + moved * (middle[2] + middle[3] + off))
        left -= 1
        i, j = _met(one.points, measure.wanted[:, None] - other.points)
        if i.size:
            apart = np.sum((one.points[:, i] + other.points[:, j] - measure.wanted[:, None]) ** 2, axis=0)
            best = np.argpartition(apart, min(_OFFERED, i.size) - 1)[:_OFFERED]
            sets = np.tile(chosen, (best.size, 1))
            one.put(sets, i[best])
            other.put(sets, j[best])
            incumbent.offer(sets)
        if incumbent.least < before:
            left = _PATIENCE


def _paired(left: _Quarter, right: _Quarter, about: Real) -> _Pairs:
    """Sums of two quarters that come near to a place."""
    here, there = _met(left.points, about[:, None] - right.points)
    return _Pairs((left, right), (here, there), left.points[:, here] + right.points[:, there])


def _met(left: Real, right: Real) -> tuple[np.ndarray, np.ndarray]:
    """Which points (d, n) and (d, m) are in the same cell of a grid: about as many pairs as are kept."""
    none, d = np.zeros(0, np.int64), left.shape[0]
    if not (left.size and right.size):
        return none, none
    low = np.maximum(np.min(left, axis=-1), np.min(right, axis=-1))[:, None]
    span = np.minimum(np.max(left, axis=-1), np.max(right, axis=-1))[:, None] - low
    if not np.all(span > 0):
        return none, none
    here, there = (np.flatnonzero(np.all((points >= low) & (points <= low + span), axis=0)) for points in (left, right))
    left, right = left[:, here] - low, right[:, there] - low
    # as if points were spread evenly, and then as they are
    side = float((_PAIRS * np.prod(span) / max(here.size * there.size, 1)) ** (1.0 / d))
    for _ in range(_SIDES):
        stride = np.cumprod(np.append(1.0, np.floor(span[:-1] / side) + 1.0))
        mine, theirs = (stride @ np.floor(points / side) for points in (left, right))
        order, orders = np.argsort(mine, kind="stable"), np.argsort(theirs, kind="stable")
        # places that are sought in their order are quickly found
        mine, theirs = mine[order], theirs[orders]
        first, last = (np.searchsorted(mine, theirs, end) for end in ("left", "right"))
        met = int(np.sum(last - first))
        if _PAIRS <= 2 * met <= 4 * _PAIRS:
            break
        side *= (_PAIRS / max(met, 1)) ** (1.0 / d)
    count = np.where(np.cumsum(last - first) <= 2 * _PAIRS, last - first, 0)
    place = np.repeat(first - np.cumsum(count) + count, count) + np.arange(int(np.sum(count)))
    return here[order[place]], there[np.repeat(orders, count)]


class _Measure:
    """What the slots do to the terms, in real coordinates whose unit is what a row may still come to."""

    def __init__(self, incumbent: Incumbent, chosen: np.ndarray) -> None:
        statement, self._options = incumbent.statement, incumbent.options
        lever, self._effect = incumbent.coordinates
        left = np.maximum(incumbent.left(0.0), SMALLEST)[statement.row]
        turn, self._scale = np.linalg.qr(lever / left[:, None])
        terms = statement.norms.at(self._options.carried(chosen)) / left
        #: what the changes have to come to
        self.wanted = -_real(np.conj(turn.T) @ terms)

    def change(self, slot: int, some: np.ndarray, now: int) -> Real:
        """What some options of a slot change in place of the one that is there (n, d)."""
        return _real((self._effect[slot, some] - self._effect[slot, now]) @ self._scale.T)


def _dealt(some: list[np.ndarray], most: int, chance: np.random.Generator) -> list[list[int]]:
    """Four lists of slots with a choice, each of at most so many sums."""
    dealt: list[list[int]] = [[], [], [], []]
    size = np.ones(4)
    for slot in chance.permutation([k for k, each in enumerate(some) if each.size > 1]).tolist():
        smallest = int(np.argmin(size))
        if size[smallest] * some[slot].size <= most:
            dealt[smallest].append(slot)
            size[smallest] *= some[slot].size
    return dealt


def _near(options: Options, chosen: np.ndarray, most: int) -> list[np.ndarray]:
    """Of every slot what is there and what is nearest to it, so few that quarters of all slots have so many sums."""
    useful = int(np.sum(np.sum(options.exists, axis=-1) > 1))
    each = max(int(most ** (4.0 / useful)), _FEWEST_OPTIONS)
    off = np.abs(options.unbalance - options.of(options.unbalance, chosen)[:, None])
    order = np.argsort(np.where(options.exists, off, np.inf), axis=-1, kind="stable")[:, :each]
    return [some[exists[some]] for some, exists in zip(order, options.exists, strict=True)]


def _quarter(measure: _Measure, chosen: np.ndarray, slots: list[int], some: list[np.ndarray]) -> _Quarter:
    points = np.zeros((measure.wanted.size, 1))
    for slot in slots:
        change = measure.change(slot, some[slot], int(chosen[slot]))
        points = (points[:, :, None] + change.T[:, None]).reshape(len(points), -1)
    return _Quarter(slots, [some[slot] for slot in slots], points)


def _real(vectors: Complex) -> Real:
    return np.concatenate([vectors.real, vectors.imag], axis=-1)
