"""Sums of one half of the slots beside those of the other.

A sum of norms is no less than the Euclidean norm of all, so nothing outside a ball about what has to be cancelled is
better than the best that is known, and every pair inside it is evaluated.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from optimizer.choices.discrete.clock import Clock
from optimizer.choices.discrete.options import Incumbent
from optimizer.numerics.arrays import SMALLEST, Complex, Real
from optimizer.program.statement import Statement

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

#: by which balls are larger than what they have to hold
_MARGIN = 1.0 + 1e-9
#: of an objective that is evaluated from sums, in units of the sum of the magnitudes of what is summed
_ROUNDING = 1e-14
#: terms of pairs that are evaluated at once, between two looks at the time, and pairs at least
_AT_ONCE, _PAIRS_AT_ONCE = 800_000, 1_000
#: points whose nearest neighbours are sought at once, and whose neighbours are counted: far from all it takes a while
_SOUGHT, _COUNTED = 2_000, 64


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
