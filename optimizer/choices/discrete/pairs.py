"""Sums of one half of the slots beside those of the other.

A sum of norms is no less than the Euclidean norm of all. So nothing outside a ball about what has to be cancelled is
better than the incumbent, and every pair inside it is evaluated.
"""

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from optimizer.choices.clock import Clock
from optimizer.choices.discrete.options import Incumbent
from optimizer.choices.discrete.sums import Half
from optimizer.numerics.arrays import SMALLEST, Complex, Real
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.program.statement import Statement

#: by which balls are larger than what they have to hold, and what sums may be off by as a share of their coordinates
_MARGIN, _OFF = 1.0 + 1e-9, 1e-14
#: of an objective that is evaluated from sums, in units of the sum of the magnitudes of what is summed
_ROUNDING = 1e-14
#: terms of pairs that are evaluated at once, between two looks at the time, and pairs at least
_AT_ONCE, _PAIRS_AT_ONCE = 800_000, 1_000
#: pairs that are evaluated first, twice as many each time: the best of them makes the ball smaller
_FIRST = 2_000
#: sums of a slab, and cells for each of them at most
_SLAB, _CELLS = 40_000, 8.0
#: shares of the sums of either half that are compared first, which makes the ball small, and sums at least
_SAMPLES, _FEWEST = (1.0 / 512.0, 1.0 / 64.0, 1.0 / 8.0, 1.0), 4_000
#: sums by which slabs are laid, and how many times wider they are than what is near
_SAMPLE, _WIDE, _SEED = 4_096, 16.0, 20_261_126
#: lines of cells that hold what is near
_LINES = 3.0
#: sums that are looked at between two looks at the time
_SUMS_A_LOOK = 20_000_000
#: sums that are looked at, for each sum of a half and each pair that may be evaluated
_LOOKS = 200


@record(frozen=True)
class Pairs:
    """Sums of one half beside those of the other."""

    statement: Statement
    first: Half
    second: Half
    lever: Real  # (J, s), what the coordinates do to the terms
    terms: Complex  # (J,) of what is fixed
    incumbent: Incumbent
    offered: Callable[[np.ndarray, np.ndarray], None]  # takes places of both halves

    @property
    def count(self) -> int:
        return self.first.size * self.second.size

    @cached_property
    def rounding(self) -> float:
        """What objectives from sums may be off by."""
        size = self.first.largest + self.second.largest
        magnitude = (
            np.sum(np.abs(self.lever) @ size) + np.sum(np.abs(self.terms)) + np.max(np.abs(self.statement.floor))
        )
        return _ROUNDING * float(magnitude)

    @property
    def at_once(self) -> int:
        """Pairs that are evaluated at once: over the turn each has hundreds of terms."""
        return max(_AT_ONCE // max(self.terms.size, 1), _PAIRS_AT_ONCE)

    def evaluated(self, i: np.ndarray, j: np.ndarray) -> None:
        """Offer those of some pairs that are no worse than the best."""
        sums = self.terms + (self.first.at(i) + self.second.at(j)) @ self.lever.T
        sizes = np.abs(self.statement.norms.counting(sums))
        near = self.statement.objective_of(sizes) <= self.incumbent.level + self.rounding
        if np.any(near):
            self.offered(i[near], j[near])

    def all(self, clock: Clock) -> bool:
        """Every pair; whether the time was enough."""
        step = max(1, self.at_once // self.first.size)
        for start in range(0, self.second.size, step):
            if start and clock.spent():
                return False
            part = np.arange(start, min(start + step, self.second.size))
            i, j = np.meshgrid(np.arange(self.first.size), part, indexing="ij")
            self.evaluated(i.ravel(), j.ravel())
        return True

    def near(self, most: int, clock: Clock) -> bool:
        """Every pair that can be no worse than the best; whether they were few enough for number and time."""
        # without a level all are as good, and without coordinates all are in one place
        if not np.isfinite(self.incumbent.level) or not self.lever.shape[-1]:
            return self.count <= most and self.all(clock)
        ball = self._ball()
        if ball is None:
            return True
        several, whole = min(self.first.size, self.second.size), True
        looks = _LOOKS * (self.first.size + self.second.size + most)
        for share in _SAMPLES:
            if share < 1.0 and share * several < _FEWEST:
                continue
            # a sample proves nothing
            whole = self._compared(ball, share, most, share * looks, clock)
            reach = self._radius(ball)
            if reach is not None and share < 1.0 and self.count * ball.share_beside(self.first.size, reach) > looks:
                return False
        return whole

    def _compared(self, ball: "_Ball", share: float, most: int, looks: float, clock: Clock) -> bool:
        """Whether every pair of a share of the sums that is in the ball was evaluated."""
        # the compiler is loaded at its first use
        from optimizer.choices.discrete.kernel.near_sums import ALL, gridded, near

        count, hits, at_once = share * self.first.size, 0, min(_FIRST, self.at_once)
        threshold = ALL if share == 1.0 else np.uint64(int(share * 2**64))
        reach = self._radius(ball)
        for slab in ball.slabs(count, reach):
            start = np.array([0, 0, -1, -1])
            reach = self._radius(ball)
            if reach is None:
                return True
            grid = ball.grid(slab, reach, count)
            first, sums, places = gridded(*ball.first.lists, grid.wide, *grid.cut, threshold)
            while start[0] < len(ball.second.outer):
                reach = self._radius(ball)
                if reach is None:
                    return True
                met, start, effort = near(
                    first, sums, *ball.second.lists, grid.slab, *grid.cut, threshold, start, reach**2,
                    np.array([at_once, _SUMS_A_LOOK]),
                )  # fmt: skip
                looks, hits, at_once = looks - effort, hits + met.shape[1], min(2 * at_once, self.at_once)
                if met.shape[1]:
                    self.evaluated(ball.first.place(*places[:, met[0]]), ball.second.place(met[1], met[2]))
                if hits > most or looks < 0 or clock.spent():
                    return False
        return True

    def _radius(self, ball: "_Ball") -> float | None:
        """Within which all sums that may be no worse than the best are near to one another; None: there are none.

        Rows of what is left of the level above their floor are no less than the Euclidean norm of their terms.
        """
        left = self.incumbent.left(self.rounding)
        if np.any(left < 0):
            return None
        square = float(np.sum((left / ball.unit) ** 2)) * _MARGIN - ball.beside / _MARGIN
        return None if square < 0 else float(np.sqrt(square)) * _MARGIN + ball.off

    def _ball(self) -> "_Ball | None":
        """Sums of either half as points, near to one another where they are good.

        Rows are in units of what is left of the level above their floor. None: no pair at all is good.
        """
        left = self.incumbent.left(self.rounding)
        if np.any(left < 0):
            return None
        # nothing of an objective is this small beside its terms
        unit = np.maximum(left, self.rounding + SMALLEST)
        units = unit[self.statement.row]
        lever: Real | Complex = self.lever / units[:, None]
        scaled: Real | Complex = self.terms / units
        scalar = np.array(self.statement.norms.scalar, dtype=bool)
        apart = bool(np.any(scalar))
        if apart:
            # of these only the real part, which is none of complex coordinates
            lever = np.concatenate([np.hstack([lever.real, -lever.imag]), np.hstack([lever.imag, lever.real])[~scalar]])
            scaled = np.concatenate([scaled.real, scaled.imag[~scalar]])
        turn, scale = np.linalg.qr(lever)
        centre = np.conj(turn.T) @ scaled
        beside = float(np.sum(np.abs(scaled - turn @ centre) ** 2))

        def points(z: Complex) -> Real:
            return _real((_real(z) if apart else z) @ scale.T)

        half = [points(sums.z) for sums in self.first]
        second = [-points(sums.z) for sums in self.second]
        second[0] = second[0] - _real(centre)
        # the widest first: they separate points best
        wide = sum(np.ptp(part, axis=0) for part in (*half, *second))
        order = np.argsort(-wide, kind="stable")
        return _Ball(_Points.of(*(p[:, order] for p in half)), _Points.of(*(p[:, order] for p in second)), unit, beside)


class _Points(NamedTuple):
    """Sums of half of the slots as points: outer ones (a, d), and inner ones (b, d) by their first coordinate."""

    outer: Real
    inner: Real
    order: np.ndarray  # (b,) places of the inner ones

    @classmethod
    def of(cls, outer: Real, inner: Real) -> "_Points":
        order = np.argsort(inner[:, 0], kind="stable")
        return cls(np.ascontiguousarray(outer), np.ascontiguousarray(inner[order]), order)

    @property
    def lists(self) -> tuple[Real, Real]:
        return self.outer, self.inner

    @property
    def box(self) -> tuple[Real, Real]:
        """Between what all of them lie (d,)."""
        low = np.min(self.outer, axis=0) + np.min(self.inner, axis=0)
        return low, np.max(self.outer, axis=0) + np.max(self.inner, axis=0)

    def place(self, i: np.ndarray, j: np.ndarray) -> np.ndarray:
        return i * len(self.inner) + self.order[j]


class _Grid(NamedTuple):
    """A slab of the first coordinate, and cells of two coordinates."""

    slab: Real  # (2,)
    wide: Real  # (2,) with all that is near to it
    axes: np.ndarray  # (2,) coordinates of the cells
    low: Real  # (2,)
    side: float
    cells: np.ndarray  # (2,)

    @property
    def cut(self) -> tuple[np.ndarray, Real, float, np.ndarray]:
        """How cells are cut."""
        return self.axes, self.low, self.side, self.cells


@record(frozen=True)
class _Ball:
    """Points of both halves, of which those of a good pair are near to one another."""

    first: _Points
    second: _Points
    unit: Real  # (rows,) of the rows of the objective
    beside: float  # square of what no sum can change

    @cached_property
    def off(self) -> float:
        """What distances may be off by."""
        size = sum(float(np.max(np.abs(part), initial=0.0)) for part in (*self.first.lists, *self.second.lists))
        return _OFF * size * self.first.outer.shape[1]

    def slabs(self, count: float, reach: float | None) -> Iterator[Real]:
        """Parts of the first coordinate of about as many sums each."""
        chance = np.random.default_rng(_SEED)
        outer, inner = (chance.choice(part[:, 0], _SAMPLE) for part in self.first.lists)
        edges = np.quantile(outer + inner, np.linspace(0.0, 1.0, self._how_many(count, reach) + 1))
        edges[0], edges[-1] = -np.inf, np.inf
        yield from np.stack([edges[:-1], edges[1:]], axis=-1)

    def _how_many(self, count: float, reach: float | None) -> int:
        """Slabs of so many sums together, none too narrow for what is near."""
        low, high = self.first.box
        most = np.inf if not reach else (high[0] - low[0]) / (_WIDE * reach)
        return max(1, int(min(count / _SLAB, most)))

    def share_beside(self, count: float, reach: float) -> float:
        """Share of the sums, about, that is looked at for one of the other half."""
        (low, *_), (high, *_), slabs = *self.first.box, self._how_many(count, reach)
        grid = self.grid(low + np.array([0.0, (high - low) / slabs]), reach, count)
        return float(np.prod(np.minimum(_LINES / grid.cells, 1.0))) / slabs

    def grid(self, slab: Real, reach: float, count: float) -> _Grid:
        """A slab with cells for about so many sums of the first half."""
        wide, d = slab + np.array([-reach, reach]), self.first.outer.shape[1]
        low, high = self.first.box
        low[0], high[0] = max(low[0], wide[0]), min(high[0], wide[1])
        # a slab is narrow already, the others are as wide as ever
        axes = np.array([1, 2] if d > 2 else [0, d - 1])
        span = np.maximum(high - low, 0.0)[axes] * [1.0, float(d > 1)]
        most = max(_CELLS * min(count, _SLAB), 1.0)
        side = max(reach, float(np.sqrt(span[0] * span[1] / most)), float(np.max(span)) / most, SMALLEST)
        return _Grid(slab, wide, axes, low[axes], side, np.floor(span / side).astype(np.int64) + 1)


def _real(vectors: Real | Complex) -> Real:
    return np.concatenate([vectors.real, vectors.imag], axis=-1)
