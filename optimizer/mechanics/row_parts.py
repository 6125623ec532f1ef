"""What the inertia of every row by itself adds to curves over the turn: what changes where its mass does.

Gas and friction do not depend on masses, so that a curve is affine in them, row by row.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from optimizer.mechanics.expansions import Expansions
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
        result: Real = np.abs(self.weights) @ reach
        return result

    def fourth(self, curve: Index, piece: Index) -> Real:
        """Bounds (m, R) on the fourth coefficients of the parts all over pieces."""
        return np.abs(self.weights[curve]) * self._fourth[:, piece].T

    def cubics(self, curve: Index, piece: Index, centre: Real, half: Real) -> Complex:
        """Taylor polynomials (m, R, 4) about centres (m,) rad within pieces, in units of half widths (m,)."""
        design = np.zeros_like(piece)
        result = np.moveaxis(self._expansions.cubics(design, piece, centre), 0, -1)
        parts: Complex = self.weights[curve][..., None] * result * half[:, None, None] ** np.arange(4)
        return parts

    def values(self, curve: Index, piece: Index, angle: Real) -> Complex:
        """Values (m, R) at angles (m,) rad within pieces, ends included."""
        result: Complex = self.weights[curve] * self._expansions.values(np.zeros_like(piece), piece, angle)
        return result

    def at(self, curve: int, angle: Real) -> Complex:
        """Values (n, R) at angles (n,) rad."""
        result: Complex = self.weights[curve] * self._series(angle, None, 0).middle[0, 0].T
        return result

    @cached_property
    def _fourth(self) -> Real:
        """The same bounds for the forces of the rows, (R, P)."""
        bounds = self._series(self.centre, self.half, 4)
        assert bounds.radius is not None  # enclosures have one
        result: Real = np.abs(bounds.middle[-1, 0]) + bounds.radius[0]
        return result

    @cached_property
    def _expansions(self) -> Expansions:
        return Expansions(self._inertia, self.centre[None], self.reading)

    @cached_property
    def _inertia(self) -> RowData:
        """The rows without gas and friction."""
        return replace(self.rows, friction=np.zeros_like(self.rows.friction), area=None, traces=())

    def _series(self, angle: Real, half: Real | None, order: int) -> Taylor:
        wide = None if half is None else half[None]
        return RowSeries(self._inertia, angle[None], wide, angle[None], order).of(self.reading)
