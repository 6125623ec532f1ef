"""What the inertia of every row by itself adds to curves over the turn: what changes where its mass does.

Gas and friction do not depend on masses, so that a curve is affine in them, row by row.
"""

from dataclasses import replace

import numpy as np

from optimizer.mechanics.curve_series import forces
from optimizer.mechanics.reading import Reading
from optimizer.mechanics.row_data import RowData
from optimizer.mechanics.row_series import RowSeries
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.responses.piecewise_cubics import Index


@record(frozen=True)
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
        middle = self._forces(self.centre, None, 3)
        reach = np.abs(self._fourth) * self.half**4
        for k in range(4):
            reach = reach + np.abs(middle[..., k]) * self.half**k
        total: Real = np.abs(self.weights) @ reach
        return total

    def fourth(self, curve: Index, piece: Index) -> Real:
        """Bounds (m, R) on the fourth coefficients of the parts all over pieces."""
        return np.abs(self.weights[curve]) * self._fourth[:, piece].T

    def cubics(self, curve: Index, piece: Index, centre: Real, half: Real) -> Complex:
        """Taylor polynomials (m, R, 4) about centres (m,) rad within pieces, in units of half widths (m,)."""
        coefficients = np.moveaxis(self._forces(centre, None, 3, piece), 0, 1) * half[:, None, None] ** np.arange(4)
        parts: Complex = self.weights[curve][..., None] * coefficients
        return parts

    def values(self, curve: Index, piece: Index, angle: Real) -> Complex:
        """Values (m, R) at angles (m,) rad within pieces, ends included."""
        parts: Complex = self.weights[curve] * self._forces(angle, None, 0, piece)[..., 0].T
        return parts

    def at(self, curve: int, angle: Real) -> Complex:
        """Values (n, R) at angles (n,) rad."""
        values: Complex = self.weights[curve] * self._forces(angle, None, 0)[..., 0].T
        return values

    @cached_property
    def _fourth(self) -> Real:
        """The same bounds for the forces of the rows, (R, P)."""
        return self._forces(self.centre, self.half, 4).real

    @cached_property
    def _inertia(self) -> RowData:
        """The rows without gas and friction."""
        return replace(self.rows, friction=np.zeros_like(self.rows.friction), area=None, traces=())

    def _forces(self, angle: Real, half: Real | None, order: int, piece: Index | None = None) -> Complex | Real:
        """Of the rows about angles (n,) of pieces (n,): (R, n, order + 1), or what the last coefficient is at most in
        widths (R, n)."""
        within, wide = angle if piece is None else self.centre[piece], None if half is None else half[None]
        series = RowSeries(self._inertia, angle[None], wide, within[None], order)
        return forces(series, self.reading, bounded=half is not None)[0]
