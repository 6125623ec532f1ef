"""Series of curves about angles within pieces of the turn: all rows are expanded about an angle once, whatever curves
ask for it."""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from optimizer.mechanics.row_data import RowData, compact
from optimizer.mechanics.row_series import Reading
from optimizer.numerics.arrays import Complex, Real, in_order
from optimizer.responses.piecewise_cubics import Index

if TYPE_CHECKING:
    from optimizer.mechanics.kernel.curves import Sums
    from optimizer.responses.kernel.motion import Motion
    from optimizer.responses.kernel.parts import Asked, Best, Known

#: of what is expanded at points
_NO_WIDTHS = np.zeros(0)


@dataclass(frozen=True)
class CurveSeries:
    """J curves, each a sum of one force of the rows over weights, and a constant; N designs of J / N curves each.

    middle : (N, P) rad, an angle within each piece, which says what process counts.
    readings : (J,) or one for all.
    weights, constant : (J, R), (J,).
    """

    rows: RowData
    middle: Real
    readings: tuple[Reading, ...]
    weights: Complex | Real
    constant: Complex | Real

    def values(self, curve: Index, piece: Index, angle: Real) -> Complex:
        """Values (m,) at angles (m,) rad within pieces, ends included."""
        return self._about(curve, piece, angle, 0)[:, 0]

    def cubics(self, curve: Index, piece: Index, centre: Real, half: Real) -> Complex:
        """Taylor polynomials (m, 4) about centres (m,) rad within pieces, in units of half widths (m,)."""
        return self._about(curve, piece, centre, 3) * half[:, None] ** np.arange(4)

    @cached_property
    def sums(self) -> "Sums":
        """What is compiled takes them as."""
        from optimizer.mechanics.kernel.curves import Sums
        from optimizer.mechanics.kernel.readings import READINGS

        number = np.empty(len(self.weights), np.int64)
        number[:] = [READINGS.index(reading) for reading in self.readings]
        return Sums(number, *(in_order(np.asarray(each, complex)) for each in (self.weights, self.constant)))

    def search(self, known: "Known", asked: "Asked", best: "Best", motion: "Motion | None") -> Complex:
        """Peaks of the curves, or of one of them in motion, from their pieces, and the curves there, at rest."""
        from optimizer.mechanics.kernel.search import search
        from optimizer.responses.kernel.motion import STILL

        moving = STILL if motion is None else motion
        found: Complex = search(known, asked, best, self.rows.packed, self.sums, self._within, moving)
        return found

    def _about(self, curve: Index, piece: Index, angle: Real, order: int) -> Complex:
        """Coefficients (m, order + 1) at angles (m,) rad."""
        from optimizer.mechanics.kernel.curves import series_of_curves

        where = _integers(curve), _integers(piece), compact(angle), _NO_WIDTHS
        found: Complex = series_of_curves(self.rows.packed, self.sums, self._within, *where, order)[0]
        return found

    @cached_property
    def _within(self) -> Real:
        return compact(self.middle)


def _integers(values: Index) -> Index:
    """Numbers as what is compiled takes them: of any other layout it would be compiled once more."""
    return in_order(np.asarray(values, np.int64))
