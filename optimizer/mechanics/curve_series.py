"""Series of curves about angles within pieces of the turn: all rows are expanded about an angle once, whatever curves
ask for it."""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from optimizer.mechanics.row_data import RowData, compact
from optimizer.mechanics.row_series import AT_ONCE, Reading, pressures
from optimizer.numerics.arrays import Complex, Real, spread
from optimizer.responses.piecewise_cubics import Index

if TYPE_CHECKING:
    from optimizer.mechanics.kernel.curves import Sums
    from optimizer.mechanics.kernel.rows import Places

#: so many rows at places cost less than to look which places are alike
_FEW = 64


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
        return self._about(curve, piece, angle, None, 0)[0][:, 0]

    def cubics(self, curve: Index, piece: Index, centre: Real, half: Real) -> Complex:
        """Taylor polynomials (m, 4) about centres (m,) rad within pieces, in units of half widths (m,)."""
        return self._about(curve, piece, centre, None, 3)[0] * half[:, None] ** np.arange(4)

    def rests(self, curve: Index, piece: Index, centre: Real, half: Real) -> Real:
        """Bounds (m,) on what these leave out within half widths (m,) rad about centres."""
        middle, radius = self._about(curve, piece, centre, half, 4)
        found: Real = (np.abs(middle[:, 0]) + radius) * half**4
        return found

    @cached_property
    def sums(self) -> "Sums":
        """What is compiled takes them as."""
        from optimizer.mechanics.kernel.curves import Sums
        from optimizer.mechanics.kernel.readings import READINGS

        number = np.empty(len(self.weights), np.int64)
        number[:] = [READINGS.index(reading) for reading in self.readings]
        return Sums(number, *(np.require(each, complex, ("C", "W")) for each in (self.weights, self.constant)))

    def _about(self, curve: Index, piece: Index, angle: Real, half: Real | None, order: int) -> tuple[Complex, Real]:
        """Coefficients (m, order + 1) at angles (m,) rad; over half widths that of the last (m, 1) and its radius."""
        from optimizer.mechanics.kernel.curves import series_of_curves

        curve, (curves, rows), designs = _integers(curve), self.weights.shape, len(self.middle)
        design: Index = curve // max(curves // designs, 1)
        places: tuple[NDArray[Any], ...] = (piece, angle) if half is None else (piece, angle, half)
        number: Index = np.arange(curve.size)
        if curve.size * rows > _FEW:
            first, number = alike(places if designs == 1 else (*places, design))
            design, places = design[first], tuple(place[first] for place in places)
        piece, angle, *widths = places
        within, step = self.middle[design, piece], max(1, AT_ONCE // max(rows, 1))
        if within.size <= step:
            there = self._places(design, angle, within, *widths)
            return series_of_curves(self.rows.packed, self.sums, curve, number, there, order)
        middle, radius = np.empty((curve.size, 1 if widths else order + 1), complex), np.empty(curve.size)
        for start in range(0, within.size, step):
            part, some = slice(start, start + step), np.flatnonzero(number // step == start // step)
            there = self._places(design[part], angle[part], within[part], *(each[part] for each in widths))
            found = series_of_curves(self.rows.packed, self.sums, curve[some], number[some] - start, there, order)
            middle[some] = found[0]
            if widths:
                radius[some] = found[1]
        return middle, radius

    def _places(self, design: Index, angle: Real, within: Real, half: Real | None = None) -> "Places":
        """What is compiled takes places (q,) as."""
        from optimizer.mechanics.kernel.rows import Places

        numbers = (angle, np.zeros(0) if half is None else half, within, *self._pressures(design, angle, within))
        return Places(_integers(design), *map(compact, numbers))

    def _pressures(self, design: Index, angle: Real, within: Real) -> tuple[Real, Real]:
        """Pressures and slopes of the traces at places, (T, q)."""
        count, size = len(self.rows.traces), angle.size
        if not count:
            return np.zeros((0, size)), np.zeros((0, size))
        pressure, slope = pressures(self.rows, design, angle[:, None], within[:, None])
        shape = (count, size, 1)
        return spread(pressure, shape).reshape(count, size), spread(slope, shape).reshape(count, size)


def alike(places: tuple[NDArray[Any], ...]) -> tuple[Index, Index]:
    """Which of places (m,) are the first of those that are alike, and which of these each is."""
    order = np.lexsort(places)
    other = np.ones(order.size, dtype=bool)
    other[1:] = np.logical_or.reduce([each[order[1:]] != each[order[:-1]] for each in places])
    number = np.empty_like(order)
    number[order] = np.cumsum(other) - 1
    return order[other], number


def _integers(values: Index) -> Index:
    """Numbers as what is compiled takes them: of any other layout it would be compiled once more."""
    flags = values.flags
    if values.dtype == np.int64 and flags.c_contiguous and flags.writeable:
        return values
    return np.require(values, np.int64, ("C", "W"))
