"""Sums of four quarters of the slots that all but cancel, where the options come as close as one likes.

Where their hull reaches what no mass can undercut, no tree proves more: what is left is to find sums that come near to
a point, among more sets than two halves hold. Of two quarters those pairs are kept that come about to a share of it, of
the other two those that come about to the rest, and of these the nearest to one another (Schroeppel and Shamir 1981,
Wagner 2002).
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from optimizer.arrays import SMALLEST, Complex, Real
from optimizer.discrete.options import Incumbent, Options

#: sums of a quarter, and quarters that are dealt out in a row without finding a better set: many small ones, then large
_COURSE = ((10_000, 40), (100_000, 10))
#: coordinates, each of two numbers, from which on what is near to a point is no quicker found than looked at
_MANY = 5
#: slots with a choice from which on quarters hold more than neighbourhoods do
_FEWEST = 12
#: sets of those found that are offered
_OFFERED = 64
#: distance of a pair from where it is sought, in units of what points are apart
_NEAR = 2.0
#: how far at most that place is moved from what is on the slots towards where most sums are
_MOVED = 0.3
_SEED = 20_240_301


class _Quarter(NamedTuple):
    """All sums of some slots, as changes of what is on them."""

    slots: list[int]
    code: np.ndarray  # (n, slots) the options
    points: Real  # (n, d)


class _Pairs(NamedTuple):
    """Sums of two quarters: which of them, and where they are."""

    quarters: tuple[_Quarter, _Quarter]
    which: tuple[np.ndarray, np.ndarray]  # (m,) each
    points: Real  # (m, d)

    def put(self, sets: np.ndarray, some: np.ndarray) -> None:
        """Some of them on their slots, in place."""
        for quarter, place in zip(self.quarters, self.which, strict=True):
            sets[:, quarter.slots] = quarter.code[place[some]]


def quarters(incumbent: Incumbent, enough: Callable[[], bool], spent: Callable[[], bool]) -> None:
    """Make the set better, three to five slots of each quarter at a time."""
    from scipy.spatial import cKDTree

    options, chance = incumbent.options, np.random.default_rng(_SEED)
    few = np.sum(np.sum(options.exists, axis=-1) > 1) < _FEWEST
    if few or incumbent.coordinates[0].shape[-1] >= _MANY:
        return
    for sums, patience in _COURSE:
        left = patience
        while left > 0 and incumbent.chosen is not None and not enough() and not spent():
            before, chosen, measure = incumbent.least, incumbent.chosen, _Measure(incumbent)
            a, b, c, d = (_quarter(options, measure, chosen, slots) for slots in _dealt(options, sums, chance))
            middle = [np.mean(each.points, axis=0) for each in (a, b, c, d)]
            off = 0.5 * (measure.wanted - sum(middle))
            moved = chance.random() * _MOVED
            one = _paired(a, b, moved * (middle[0] + middle[1] + off))
            other = _paired(c, d, (1.0 - moved) * measure.wanted + moved * (middle[2] + middle[3] + off))
            left -= 1
            if len(one.points) and len(other.points):
                apart, place = cKDTree(one.points).query(measure.wanted - other.points)
                best = np.argsort(apart, kind="stable")[:_OFFERED]
                sets = np.tile(chosen, (best.size, 1))
                one.put(sets, place[best])
                other.put(sets, best)
                incumbent.offer(sets)
            if incumbent.least < before:
                left = patience


def _paired(one: _Quarter, other: _Quarter, about: Real) -> _Pairs:
    """For the sums of one quarter the nearest of another that comes with it to a place, where one does about so."""
    from scipy.spatial import cKDTree

    n, d = one.points.shape
    wide = float(np.sqrt(np.sum(np.var(one.points, axis=0)))) * n ** (-1.0 / d)
    off, near = cKDTree(one.points).query(about - other.points, distance_upper_bound=_NEAR * wide)
    far = np.flatnonzero(np.isfinite(off))
    return _Pairs((one, other), (near[far], far), one.points[near[far]] + other.points[far])


class _Measure:
    """What the slots do to the terms, in real coordinates whose unit is what a row may still come to."""

    def __init__(self, incumbent: Incumbent) -> None:
        statement, self._options = incumbent.statement, incumbent.options
        lever, self._effect = incumbent.coordinates
        left = np.maximum(incumbent.left(0.0), SMALLEST)[statement.row]
        turn, self._scale = np.linalg.qr(lever / left[:, None])
        assert incumbent.chosen is not None  # it is what is made better
        terms = statement.norms.at(self._options.carried(incumbent.chosen)) / left
        #: what the changes have to come to
        self.wanted = -_real(np.conj(turn.T) @ terms)

    def change(self, slot: int, now: int) -> Real:
        """What every option of a slot changes in place of the one that is there (O, d)."""
        effect = self._effect[slot, self._options.exists[slot]]
        return _real((effect - self._effect[slot, now]) @ self._scale.T)


def _dealt(options: Options, most: int, chance: np.random.Generator) -> list[list[int]]:
    """Four lists of slots with a choice, each of at most so many sums."""
    count = np.sum(options.exists, axis=-1)
    dealt: list[list[int]] = [[], [], [], []]
    size = np.ones(4)
    for slot in chance.permutation(np.flatnonzero(count > 1)).tolist():
        smallest = int(np.argmin(size))
        if size[smallest] * count[slot] <= most:
            dealt[smallest].append(slot)
            size[smallest] *= count[slot]
    return dealt


def _quarter(options: Options, measure: _Measure, chosen: np.ndarray, slots: list[int]) -> _Quarter:
    points, code = np.zeros((1, measure.wanted.size)), np.zeros((1, 0), int)
    for slot in slots:
        change = measure.change(slot, int(chosen[slot]))
        points = (points[:, None] + change).reshape(-1, points.shape[-1])
        digits = np.tile(np.arange(len(change)), len(code))[:, None]
        code = np.concatenate([np.repeat(code, len(change), axis=0), digits], axis=1)
    return _Quarter(slots, code, points)


def _real(vectors: Complex) -> Real:
    return np.concatenate([vectors.real, vectors.imag], axis=-1)
