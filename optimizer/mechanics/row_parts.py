"""What the inertia of every row by itself adds to curves over the turn: what changes where its mass does.

Gas and friction do not depend on masses, so that a curve is affine in them, row by row.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from optimizer.mechanics.curve_series import CurveSeries
from optimizer.mechanics.row_data import RowData
from optimizer.mechanics.row_series import Reading, RowSeries, Taylor
from optimizer.numerics.arrays import Complex, Real
from optimizer.responses.piecewise_cubics import Index


@dataclass(frozen=True)
class RowParts:
    """Parts of J curves of one machine by its R rows, over the P pieces of the curves.

    rows : of one machine.
    centre, half : (P,) rad; half is 0 where breaks coincide.
    reading : which force of the rows.
    weights : (J, R).
    """

    rows: RowData
    centre: Real
    half: Real
    reading: Reading
    weights: Complex

    @cached_property
    def largest(self) -> Real:
        """What all parts of a curve come to together at most, (J, P)."""
        middle = self._series(self.centre, None, 3).middle[:, 0]
        reach = np.abs(self._fourth) * self.half**4
        for k in range(4):
            reach = reach + np.abs(middle[k]) * self.half**k
        found: Real = np.abs(self.weights) @ reach
        return found

    def fourth(self, curve: Index, piece: Index) -> Real:
        """Bounds (m, R) on the fourth coefficients of the parts all over pieces."""
        return np.abs(self.weights[curve]) * self._fourth[:, piece].T

    def cubics(self, curve: Index, piece: Index, centre: Real, half: Real) -> Complex:
        """Taylor polynomials (m, R, 4) about centres (m,) rad within pieces, in units of half widths (m,)."""
        found = self._of_rows.cubics(*self._by_row(piece, centre, half)).reshape(piece.size, self.weights.shape[1], 4)
        parts: Complex = self.weights[curve][..., None] * found
        return parts

    def values(self, curve: Index, piece: Index, angle: Real) -> Complex:
        """Values (m, R) at angles (m,) rad within pieces, ends included."""
        found = self._of_rows.values(*self._by_row(piece, angle)).reshape(piece.size, self.weights.shape[1])
        parts: Complex = self.weights[curve] * found
        return parts

    def at(self, curve: int, angle: Real) -> Complex:
        """Values (n, R) at angles (n,) rad."""
        found: Complex = self.weights[curve] * self._series(angle, None, 0).middle[0, 0].T
        return found

    @cached_property
    def _fourth(self) -> Real:
        """The same bounds for the forces of the rows, (R, P)."""
        bounds = self._series(self.centre, self.half, 4)
        found: Real = np.abs(bounds.middle[-1, 0]) + bounds.radius[0]
        return found

    @cached_property
    def _of_rows(self) -> CurveSeries:
        """The force of every row by itself."""
        count = self.weights.shape[1]
        return CurveSeries(self._inertia, self.centre[None], (self.reading,), np.eye(count), np.zeros(count))

    def _by_row(self, *places: NDArray[Any]) -> tuple[NDArray[Any], ...]:
        """Every row, and places (m,), at each of these all rows: (m R,)."""
        count = self.weights.shape[1]
        return np.tile(np.arange(count), places[0].size), *(np.repeat(place, count) for place in places)

    @cached_property
    def _inertia(self) -> RowData:
        """The rows without gas and friction."""
        return replace(self.rows, friction=np.zeros_like(self.rows.friction), area=None, traces=())

    def _series(self, angle: Real, half: Real | None, order: int) -> Taylor:
        wide = None if half is None else half[None]
        return RowSeries(self._inertia, angle[None], wide, angle[None], order).of(self.reading)
