"""Sums of what the options of some slots do."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from optimizer.choices.clock import Pace
from optimizer.choices.discrete.options import EQUAL, Options
from optimizer.numerics.arrays import Complex, Real

#: sums nearer than this share of the largest are one
_SAME = 1e-12
#: powers of an odd number, multiplied by keys modulo 2^64, are unlike for unlike keys but for chance
_ODD = np.uint64(0x9E3779B97F4A7C15)
#: a list without the mass as a limit is this many times shorter, at most, for equal sums that are one
SHORTER = 4.0
#: size of intermediate lists as a multiple of the last one; most of their sums are too heavy
_WIDEST = 40


class Sums(NamedTuple):
    """Sums of some slots, each once and the first of its kind in the order among equals."""

    z: Complex  # (n, s) in coordinates of what all slots together can do
    mass: Real  # (n,) kg
    square: Real  # (n,) sum of |u|^2
    fitted: np.ndarray  # (n,) counterweights, 0 where they are not limited
    parts: np.ndarray  # (n,) bits of the part numbers, 0 where they are not limited
    code: np.ndarray  # (n,) which options


class Half(NamedTuple):
    """Sums of half of the slots, each of one sum of its outer slots and one of its inner ones; they are not listed."""

    outer: Sums
    inner: Sums

    @property
    def size(self) -> int:
        return self.outer.code.size * self.inner.code.size

    @property
    def largest(self) -> Real:
        """The largest of every coordinate (s,), at most."""
        extent: Real = sum(np.max(np.abs(sums.z), axis=0, initial=0.0) for sums in self)
        return extent

    def at(self, place: np.ndarray) -> Complex:
        """Sums (M, s) by their places (M,)."""
        i, j = np.divmod(place, self.inner.code.size)
        return self.outer.z[i] + self.inner.z[j]

    def mass(self, place: np.ndarray) -> Real:
        """Their masses (M,), kg."""
        i, j = np.divmod(place, self.inner.code.size)
        return self.outer.mass[i] + self.inner.mass[j]

    def codes(self, place: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Which options of outer and inner slots they take (M,)."""
        i, j = np.divmod(place, self.inner.code.size)
        return self.outer.code[i], self.inner.code[j]


def sums_of(
    options: Options,
    effect: Complex,
    candidates: Sequence[np.ndarray],
    side: Sequence[int],
    pace: Pace,
    most: float = np.inf,
    most_kg: float = np.inf,
) -> Sums | None:
    """All sums of the slots of a side that the counts of all slots together leave.

    None where they are more than so many, or than there is time for.

    Parameters
    ----------
    most_kg : mass of a sum, kg, beyond which it is left out.
    """
    if not np.isfinite(most_kg) and np.prod([float(len(candidates[k])) for k in side]) > SHORTER * most:
        return None
    sums = Sums(np.zeros((1, effect.shape[-1]), complex), *np.zeros((2, 1)), *np.zeros((3, 1), np.int64))
    for k in side:
        choices = candidates[k]
        count = sums.code.size * choices.size
        # more than the next ones are still to come: pairs, and of the first half the other one
        if pace.most(2 * count) < 2 * count or count > _WIDEST * most:
            return None
        fitted = options.webs[k] * (choices > 0) if options.limits_fitted else np.zeros(choices.size, np.int64)
        bits = np.where(options.part[k, choices] >= 0, 1 << np.maximum(options.part[k, choices], 0), 0)
        bits = bits if options.limits_parts else np.zeros_like(bits)
        longer = Sums(
            # of no coordinates, where nothing changes the objective, no number of rows follows
            (sums.z[:, None] + effect[k, choices]).reshape(count, effect.shape[-1]),
            (sums.mass[:, None] + options.mass[k, choices]).ravel(),
            (sums.square[:, None] + options.webs[k] * np.abs(options.unbalance[k, choices]) ** 2).ravel(),
            (sums.fitted[:, None] + fitted).ravel(),
            (sums.parts[:, None] | bits).ravel(),
            (sums.code[:, None] * choices.size + np.arange(choices.size)).ravel(),
        )
        within: np.ndarray = _within_counts(options, longer) & (longer.mass <= most_kg)
        sums = _distinct(Sums(*(column[within] for column in longer)))
        pace.took(max(count, 1))
    return None if sums.code.size > most else sums


def _within_counts(options: Options, sums: Sums) -> np.ndarray:
    """Which sums (n,) take no more counterweights and part numbers than all slots together may."""
    within = np.ones(sums.code.size, bool)
    if options.limits_fitted:
        within &= sums.fitted <= options.most_fitted
    if options.limits_parts:
        within &= np.bitwise_count(sums.parts) <= options.most_parts
    return within


def _distinct(sums: Sums) -> Sums:
    """Of sums that do the same with the same parts the first in the order among equals."""
    size = float(np.max(np.abs(sums.z), initial=0.0)) or 1.0
    parts = np.concatenate([sums.z.real, sums.z.imag], axis=-1) / (_SAME * size)
    keys = np.column_stack([np.round(parts).astype(np.int64), sums.fitted, sums.parts])
    # few have an equal, which numbers made of the keys tell sooner than to sort by all keys
    number = (keys.astype(np.uint64) * _ODD ** np.arange(1, keys.shape[-1] + 1, dtype=np.uint64)).sum(axis=-1)
    rising = np.sort(number)
    equal = np.unique(rising[1:][rising[1:] == rising[:-1]])
    if not equal.size:
        return sums
    alike = np.flatnonzero(np.isin(number, equal))
    mass = np.round(sums.mass[alike] / (EQUAL * (float(np.max(sums.mass, initial=0.0)) or 1.0)))
    keys = keys[alike]
    order = np.lexsort((sums.square[alike], mass, *keys.T))
    keys = keys[order]
    again = np.concatenate([np.zeros(1, bool), np.all(keys[1:] == keys[:-1], axis=-1)])
    mask: np.ndarray = np.ones(number.size, bool)
    mask[alike[order[again]]] = False
    return Sums(*(column[mask] for column in sums))
