"""Exhaustion in halves: all sums of half the slots in a tree of points, searched near those of the other half.

A sum of norms is no less than the Euclidean norm of all, so nothing outside a ball about what has to be cancelled is
better than the best that is known, and every pair inside it is evaluated.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from optimizer.choices.discrete.clock import Clock, Pace
from optimizer.choices.discrete.options import EQUAL, Incumbent, Options
from optimizer.numerics.arrays import SMALLEST, Complex, Real
from optimizer.program.statement import Statement

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

#: sums nearer than this share of the largest are one
_SAME = 1e-12
#: by which balls are larger than what they have to hold
_MARGIN = 1.0 + 1e-9
#: of an objective that is evaluated from sums, in units of the sum of the magnitudes of what is summed
_ROUNDING = 1e-14
#: terms of pairs that are evaluated at once, between two looks at the time, and pairs at least
_AT_ONCE, _PAIRS_AT_ONCE = 800_000, 1_000
#: points whose nearest neighbours are sought at once, and whose neighbours are counted: far from all it takes a while
_SOUGHT, _COUNTED = 2_000, 64
#: pairs up to which all are evaluated
_FEW = 20_000
#: how many times more sums than a half may have are made on the way, most of them too heavy
_WIDEST = 40
#: part numbers that fit into the bits of a whole number
_BITS = 62


class Sums(NamedTuple):
    """Sums of some slots, each once and the first of its kind in the order among equals."""

    z: Complex  # (n, s) in coordinates of what all slots together can do
    mass: Real  # (n,) kg
    square: Real  # (n,) sum of |u|^2
    fitted: np.ndarray  # (n,) counterweights, 0 where they are not limited
    parts: np.ndarray  # (n,) bits of the part numbers, 0 where they are not limited
    code: np.ndarray  # (n,) which options


class Halves(NamedTuple):
    """All sums of the slots, those of one half of them beside those of the other."""

    one: Sums
    other: Sums
    lever: Real  # (J, s) what the coordinates of the sums do to the terms
    terms: Complex  # (J,) of slots that take one option
    fixed: np.ndarray  # (K,) the first option of every slot
    sides: tuple[list[int], list[int]]  # slots of either half, of more options than one
    which: Sequence[np.ndarray]  # (K) options of every slot

    def sets(self, i: np.ndarray, j: np.ndarray) -> np.ndarray:
        """The options (M, K) of pairs of sums, by their places (M,) in either half."""
        sets = np.tile(self.fixed, (i.size, 1))
        for side, sums, place in zip(self.sides, (self.one, self.other), (i, j), strict=True):
            code = sums.code[place]
            for k in reversed(side):
                code, digit = np.divmod(code, len(self.which[k]))
                sets[:, k] = self.which[k][digit]
        return sets


def halves(
    options: Options,
    which: Sequence[np.ndarray],
    incumbent: Incumbent,
    most_sums: int,
    clock: Clock,
    most_kg: float = np.inf,
) -> Halves | None:
    """The sums of either half; None where they are more than so many, or than there is time for.

    Parameters
    ----------
    which : (K) options of every slot, at least one each.
    most_kg : mass of a half, kg, beyond which its sums are left out.
    """
    if options.limits_parts and np.max(options.part) > _BITS:
        return None
    many = sorted((k for k, some in enumerate(which) if len(some) > 1), key=lambda k: -len(which[k]))
    sides = many[::2], many[1::2]
    lever, effect = incumbent.coordinates
    fixed = np.array([some[0] for some in which], dtype=int)
    single = np.ones(options.slots, bool)
    single[many] = False
    rest = np.sum(options.of(effect, fixed)[single], axis=0)
    pace = Pace(clock)
    one = sums_of(options, effect, which, sides[0], pace, most_sums, most_kg)
    other = None if one is None else sums_of(options, effect, which, sides[1], pace, most_sums, most_kg)
    if one is None or other is None:
        return None
    terms = incumbent.statement.norms.constant + lever @ rest
    return Halves(one, other, lever, terms, fixed, sides, which)


def exhaust(
    options: Options,
    which: Sequence[np.ndarray],
    incumbent: Incumbent,
    most_sums: int,
    most_pairs: int,
    clock: Clock,
) -> bool:
    """Offer all that can be best; whether all were offered.

    Parameters
    ----------
    which : (K) options of every slot that are to be tried, at least one each.
    most_sums, most_pairs : sums of a half, and pairs of them, beyond which it is given up.
    clock : what is left of the time; what there is not enough for is given up.
    """
    split = halves(options, which, incumbent, most_sums, clock)
    if split is None:
        return False
    one, other = split.one, split.other
    if not one.code.size or not other.code.size:
        return True

    def offered(i: np.ndarray, j: np.ndarray) -> None:
        incumbent.offer(split.sets(i, j))

    pairs = Pairs(incumbent.statement, one.z, other.z, split.lever, split.terms, incumbent, offered)
    # without coordinates all pairs are in one place, and none is nearer than another
    if not np.isfinite(incumbent.level) or pairs.count <= _FEW or not split.lever.shape[-1]:
        return pairs.count <= most_pairs and pairs.all(clock)
    pairs.nearest(clock)
    return pairs.near(most_pairs, clock)


def sums_of(
    options: Options,
    effect: Complex,
    which: Sequence[np.ndarray],
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
    if not np.isfinite(most_kg) and np.prod([float(len(which[k])) for k in side]) > 4.0 * most:
        return None
    sums = Sums(np.zeros((1, effect.shape[-1]), complex), *np.zeros((2, 1)), *np.zeros((3, 1), np.int64))
    for k in side:
        some = which[k]
        count = sums.code.size * some.size
        # more than the next ones are still to come: pairs, and of the first half the other one
        if pace.most(2 * count) < 2 * count or count > _WIDEST * most:
            return None
        fitted = options.webs[k] * (some > 0) if options.limits_fitted else np.zeros(some.size, np.int64)
        bits = np.where(options.part[k, some] >= 0, 1 << np.maximum(options.part[k, some], 0), 0)
        bits = bits if options.limits_parts else np.zeros_like(bits)
        longer = Sums(
            # of no coordinates, where nothing changes the objective, no number of rows follows
            (sums.z[:, None] + effect[k, some]).reshape(count, effect.shape[-1]),
            (sums.mass[:, None] + options.mass[k, some]).ravel(),
            (sums.square[:, None] + options.webs[k] * np.abs(options.unbalance[k, some]) ** 2).ravel(),
            (sums.fitted[:, None] + fitted).ravel(),
            (sums.parts[:, None] | bits).ravel(),
            (sums.code[:, None] * some.size + np.arange(some.size)).ravel(),
        )
        within: np.ndarray = _counted(options, longer) & (longer.mass <= most_kg)
        sums = _merged(Sums(*(each[within] for each in longer)))
        pace.took(max(count, 1))
    return None if sums.code.size > most else sums


def _counted(options: Options, sums: Sums) -> np.ndarray:
    """Which sums (n,) take no more counterweights and part numbers than all slots together may."""
    within = np.ones(sums.code.size, bool)
    if options.limits_fitted:
        within &= sums.fitted <= options.most_fitted
    if options.limits_parts:
        within &= np.bitwise_count(sums.parts) <= options.most_parts
    return within


def _merged(sums: Sums) -> Sums:
    """Of sums that do the same with the same parts the first in the order among equals."""
    size = float(np.max(np.abs(sums.z), initial=0.0)) or 1.0
    parts = np.concatenate([sums.z.real, sums.z.imag], axis=-1) / (_SAME * size)
    keys = np.column_stack([np.round(parts).astype(np.int64), sums.fitted, sums.parts])
    mass = np.round(sums.mass / (EQUAL * (float(np.max(sums.mass, initial=0.0)) or 1.0)))
    order = np.lexsort((sums.square, mass, *keys.T))
    keys = keys[order]
    new = np.concatenate([np.ones(min(order.size, 1), bool), np.any(keys[1:] != keys[:-1], axis=-1)])
    kept = np.sort(order[new])
    return Sums(*(each[kept] for each in sums))


@dataclass(frozen=True)
class Pairs:
    """Sums of one half beside those of the other."""

    statement: Statement
    one: Complex  # (n, s)
    other: Complex  # (m, s)
    lever: Real  # (J, s), what the coordinates do to the terms
    terms: Complex  # (J,) of what is fixed
    incumbent: Incumbent
    offered: Callable[[np.ndarray, np.ndarray], None]  # takes places of both halves

    @property
    def count(self) -> int:
        return self.one.shape[0] * self.other.shape[0]

    @cached_property
    def rounding(self) -> float:
        """What objectives from sums may be off by."""
        size = sum(np.max(np.abs(z), axis=0, initial=0.0) for z in (self.one, self.other))
        each = np.sum(np.abs(self.lever) @ size) + np.sum(np.abs(self.terms)) + np.max(np.abs(self.statement.floor))
        return _ROUNDING * float(each)

    @property
    def at_once(self) -> int:
        """Pairs that are evaluated at once: over the turn each has hundreds of terms."""
        return max(_AT_ONCE // max(self.terms.size, 1), _PAIRS_AT_ONCE)

    def evaluated(self, i: np.ndarray, j: np.ndarray) -> None:
        """Offer those of some pairs that are no worse than the best."""
        sums = self.terms + (self.one[i] + self.other[j]) @ self.lever.T
        sizes = np.abs(self.statement.norms.counting(sums))
        near = self.statement.objective_of(sizes) <= self.incumbent.level + self.rounding
        if np.any(near):
            self.offered(i[near], j[near])

    def all(self, clock: Clock) -> bool:
        """Every pair; whether the time was enough."""
        step = max(1, self.at_once // self.one.shape[0])
        for start in range(0, self.other.shape[0], step):
            if start and clock.spent():
                return False
            part = np.arange(start, min(start + step, self.other.shape[0]))
            i, j = np.meshgrid(np.arange(self.one.shape[0]), part, indexing="ij")
            self.evaluated(i.ravel(), j.ravel())
        return True

    def nearest(self, clock: Clock) -> None:
        """To every sum of one half the nearest of the other, which mostly makes the ball small."""
        ball = self._ball()
        if ball is None:
            return
        tree, points, radius = ball
        for start in range(0, len(points), _SOUGHT):
            off, place = tree.query(points[start : start + _SOUGHT], distance_upper_bound=radius)
            found = np.flatnonzero(np.isfinite(off))
            self.evaluated(place[found], start + found)
            if clock.spent():
                return

    def near(self, most: int, clock: Clock) -> bool:
        """Every pair that can be no worse than the best; whether they were few enough for number and time."""
        ball = self._ball()
        if ball is None:
            return True
        tree, points, radius = ball
        counts = np.zeros(len(points), np.int64)
        for start in range(0, len(points), _COUNTED):
            few = points[start : start + _COUNTED]
            counts[start : start + _COUNTED] = tree.query_ball_point(few, radius, return_length=True)
            if int(np.sum(counts[start : start + _COUNTED])) > most or clock.spent():
                return False
        if int(np.sum(counts)) > most:
            return False
        some = np.flatnonzero(counts)
        for part in np.split(some, np.flatnonzero(np.diff(np.cumsum(counts[some]) // self.at_once)) + 1):
            if part.size:
                pairs = _tree(points[part]).sparse_distance_matrix(tree, radius, output_type="ndarray")
                self.evaluated(pairs["j"], part[pairs["i"]])
            if clock.spent():
                return False
        return True

    def _ball(self) -> tuple["cKDTree", Real, float] | None:
        """One half as a tree, centres from the other one, and a radius: no pair outside is as good as the best.

        Rows of what is left of the level above their floor are 1; a row is no less than the Euclidean norm of its
        terms. None: no pair at all is.
        """
        left = self.incumbent.left(self.rounding)
        if np.any(left < 0):
            return None
        each = np.maximum(left, SMALLEST)[self.statement.row]
        lever: Real | Complex = self.lever / each[:, None]
        scaled: Real | Complex = self.terms / each
        one: Real | Complex = self.one
        other: Real | Complex = self.other
        scalar = np.array(self.statement.norms.scalar, dtype=bool)
        if np.any(scalar):
            # of these only the real part, which is none of complex coordinates
            lever = np.concatenate([np.hstack([lever.real, -lever.imag]), np.hstack([lever.imag, lever.real])[~scalar]])
            scaled = np.concatenate([scaled.real, scaled.imag[~scalar]])
            one, other = _real(one), _real(other)
        turn, scale = np.linalg.qr(lever)
        centre = np.conj(turn.T) @ scaled
        beside = np.sum(np.abs(scaled - turn @ centre) ** 2)
        square = left.size * _MARGIN - beside / _MARGIN
        if square < 0:
            return None
        radius = float(np.sqrt(square)) * _MARGIN
        return _tree(_real(one @ scale.T)), -_real(centre + other @ scale.T), radius


def _tree(points: Real) -> "cKDTree":
    # takes a fifth of the time in which all else is loaded, and few have catalogues
    from scipy.spatial import cKDTree

    return cKDTree(points)


def _real(vectors: Real | Complex) -> Real:
    return np.concatenate([vectors.real, vectors.imag], axis=-1)
