"""Curves of several forces of the rows of one machine, so that all that is asked of them is searched together.

Whatever is asked for at an angle, the rows are expanded about it once, and each force is read from that once.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from optimizer.mechanics.row_series import RowSeries, Taylor
from optimizer.mechanics.whole_turn import TurnCurves, WholeTurn
from optimizer.numerics.arrays import Complex, Real
from optimizer.responses.piecewise_cubics import Index, Pieces


@dataclass(frozen=True)
class CurveBatch:
    """Curves of one turn of one machine, those of one part after those of another."""

    parts: tuple[TurnCurves, ...]

    @cached_property
    def first(self) -> Index:
        """Number of the first curve of each part, and how many there are in all."""
        return np.cumsum([0, *(len(part.weights[0]) for part in self.parts)])

    @cached_property
    def pieces(self) -> Pieces:
        """The curves piece by piece (J, P)."""
        each = [part.pieces for part in self.parts]
        centre, half, cubic, rest, size = (
            np.concatenate([getattr(one, name) for one in each]) for name in ("centre", "half", "cubic", "rest", "size")
        )
        return Pieces(centre, half, cubic, rest, size, source=self)

    def cubics(self, curve: Index, piece: Index, centre: Real, half: Real) -> Complex:
        """Series about centres (m,) within pieces, as :meth:`TurnCurves.cubics`."""
        results = np.empty((curve.size, 4), complex)
        for some, weights, constant, series, place in self._by_part(curve, (piece, centre), 3):
            results[some] = np.einsum("mr,krm->mk", weights, series.middle[:, 0][..., place])
            results[some, 0] += constant
        results *= half[:, None] ** np.arange(4)
        return results

    def rests(self, curve: Index, piece: Index, centre: Real, half: Real) -> Real:
        """Bounds within half widths (m,) rad about centres."""
        result = np.empty(curve.size)
        for some, weights, _, series, place in self._by_part(curve, (piece, centre, half), 4):
            assert series.radius is not None  # enclosures have one
            middle, radius = series.middle[0, 0][:, place].T, series.radius[0][:, place].T
            result[some] = np.abs(np.sum(weights * middle, axis=-1)) + np.sum(np.abs(weights) * radius, axis=-1)
        bounds: Real = result * half**4
        return bounds

    def values(self, curve: Index, piece: Index, angle: Real) -> Complex:
        """The curves at angles (m,) within pieces, ends included."""
        result = np.empty(curve.size, complex)
        for some, weights, constant, series, place in self._by_part(curve, (piece, angle), 0):
            result[some] = np.sum(weights * series.middle[0, 0][:, place].T, axis=-1) + constant
        return result

    def _by_part(
        self, curve: Index, places: tuple[NDArray[Any], ...], order: int
    ) -> Iterator[tuple[Index, Complex | Real, Complex | Real, Taylor, Index]]:
        """Of every part of which there are curves: which (n,), their weights (n, R) and constants (n,), the series of
        its force about all places, and at which of them each is."""
        first, number = _alike(places)
        piece, angle, *half = (each[first] for each in places)
        within = self._turn.centre[:, piece]
        wide = half[0][None] if half else None
        series = RowSeries(self._turn.rows, angle[None], wide, within, order)
        of = np.searchsorted(self.first, curve, side="right") - 1
        for k, part in enumerate(self.parts):
            some = np.flatnonzero(of == k)
            if some.size:
                own = curve[some] - self.first[k]
                yield some, part.weights[0, own], part.constant[0, own], series.of(part.reading), number[some]

    @property
    def _turn(self) -> WholeTurn:
        return self.parts[0].whole


def _alike(places: tuple[NDArray[Any], ...]) -> tuple[Index, Index]:
    """Which of places (m,) are the first of those that are alike, and which of these each is."""
    order = np.lexsort(places)
    other = np.ones(order.size, dtype=bool)
    other[1:] = np.logical_or.reduce([each[order[1:]] != each[order[:-1]] for each in places])
    number = np.empty_like(order)
    number[order] = np.cumsum(other) - 1
    return order[other], number
