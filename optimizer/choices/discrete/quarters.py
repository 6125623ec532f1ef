"""Sums of four quarters of the slots that all but cancel, where the options come as close as one likes.

Where their hull reaches what no mass can undercut, no tree proves more. The search is then for sums that come near to
a point, among more sets than two halves hold (:mod:`optimizer.numerics.four_lists`).
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from optimizer.choices.clock import Clock
from optimizer.choices.discrete.options import Incumbent, Options
from optimizer.numerics.arrays import SMALLEST, Complex, Real
from optimizer.numerics.four_lists import nearest_sums

#: sums of a quarter, and quarters that are dealt out in a row without finding a better set
_SUMS, _PATIENCE = 400_000, 20
#: coordinates, each of two numbers, from which on a search near a point is no faster than a look at all
_MANY = 5
#: slots with a choice from which on quarters hold more than neighbourhoods do
_FEWEST = 12
#: options of a slot at least that are tried, where it has as many
_FEWEST_OPTIONS = 3
#: how far at most that place is moved from what is on the slots towards where most sums are
_SHIFT = 0.3
_SEED = 20_240_301


class _Quarter(NamedTuple):
    """All sums of some slots, as changes of what is on them."""

    slots: list[int]
    options: list[np.ndarray]  # (slots) their options
    points: Real  # (n, d)


def quarters(incumbent: Incumbent, enough: Callable[[], bool], clock: Clock) -> None:
    """Make the set better, by options near to those that are there."""
    options, chance = incumbent.options, np.random.default_rng(_SEED)
    few = np.sum(np.sum(options.exists, axis=-1) > 1) < _FEWEST
    # where there are no coordinates no set is better than another
    if few or not 0 < incumbent.coordinates[0].shape[-1] < _MANY:
        return
    left = _PATIENCE
    while left > 0 and incumbent.selection is not None and not enough() and not clock.spent():
        before, selection, measure = incumbent.least, incumbent.selection, _Measure(incumbent, incumbent.selection)
        near = _near(options, selection, _SUMS)
        dealt = [_quarter(measure, selection, slots, near) for slots in _dealt(near, _SUMS, chance)]
        middle = [np.mean(entry.points, axis=0) for entry in dealt]
        about = chance.random() * _SHIFT * (middle[0] + middle[1] + 0.5 * (measure.target - sum(middle)))
        orders = nearest_sums([entry.points for entry in dealt], about, measure.target)
        left -= 1
        if orders.size:
            sets = np.tile(selection, (orders.shape[1], 1))
            for quarter, place in zip(dealt, orders, strict=True):
                digits = np.unravel_index(place, [entry.size for entry in quarter.options])
                for slot, entry, digit in zip(quarter.slots, quarter.options, digits, strict=True):
                    sets[:, slot] = entry[digit]
            incumbent.offer(sets)
        if incumbent.least < before:
            left = _PATIENCE


class _Measure:
    """What the slots do to the terms, in real coordinates whose unit is what a row may still come to."""

    def __init__(self, incumbent: Incumbent, selection: np.ndarray) -> None:
        statement, self._options = incumbent.statement, incumbent.options
        lever, self._effect = incumbent.coordinates
        left = np.maximum(incumbent.left(0.0), SMALLEST)[statement.row]
        turn, self._scale = np.linalg.qr(lever / left[:, None])
        terms = statement.norms.at(self._options.carried(selection)) / left
        #: what the changes have to come to
        self.target = -_real(np.conj(turn.T) @ terms)

    def change(self, slot: int, choices: np.ndarray, now: int) -> Real:
        """What some options of a slot change in place of the one that is there (n, d)."""
        return _real((self._effect[slot, choices] - self._effect[slot, now]) @ self._scale.T)


def _dealt(near: list[np.ndarray], most: int, chance: np.random.Generator) -> list[list[int]]:
    """Four lists of slots with a choice, each of at most so many sums."""
    dealt: list[list[int]] = [[], [], [], []]
    size = np.ones(4)
    for slot in chance.permutation([k for k, options in enumerate(near) if options.size > 1]).tolist():
        smallest = int(np.argmin(size))
        if size[smallest] * near[slot].size <= most:
            dealt[smallest].append(slot)
            size[smallest] *= near[slot].size
    return dealt


def _near(options: Options, selection: np.ndarray, most: int) -> list[np.ndarray]:
    """Of every slot what is there and what is nearest to it, so few that quarters of all slots have so many sums."""
    useful = int(np.sum(np.sum(options.exists, axis=-1) > 1))
    count = max(int(most ** (4.0 / useful)), _FEWEST_OPTIONS)
    off = np.abs(options.unbalance - options.of(options.unbalance, selection)[:, None])
    order = np.argsort(np.where(options.exists, off, np.inf), axis=-1, kind="stable")[:, :count]
    return [row[exists[row]] for row, exists in zip(order, options.exists, strict=True)]


def _quarter(measure: _Measure, selection: np.ndarray, slots: list[int], near: list[np.ndarray]) -> _Quarter:
    points = np.zeros((1, measure.target.size))
    for slot in slots:
        change = measure.change(slot, near[slot], int(selection[slot]))
        points = (points[:, None] + change).reshape(-1, points.shape[1])
    return _Quarter(slots, [near[slot] for slot in slots], points)


def _real(vectors: Complex) -> Real:
    return np.concatenate([vectors.real, vectors.imag], axis=-1)
