"""Series of curves about angles within pieces of the turn: all rows are expanded about an angle once, whatever curves
ask for it."""

from abc import ABC, abstractmethod
from itertools import repeat
from typing import TYPE_CHECKING

import numpy as np

from optimizer.mechanics.reading import READINGS, WITHOUT_GAS, Reading
from optimizer.mechanics.row_data import RowData, compact
from optimizer.mechanics.row_series import AT_ONCE, NO_WIDTHS, RowSeries, turn_kernel
from optimizer.numerics.arrays import Complex, Real, in_order, spread
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.responses.floors import Floors
from optimizer.responses.piecewise_cubics import Index

if TYPE_CHECKING:
    from optimizer.mechanics.kernel.curves import Sums
    from optimizer.mechanics.kernel.rows import Functions
    from optimizer.responses.kernel.motion import Motion
    from optimizer.responses.kernel.parts import Best, Cubics, Members

_POWERS = np.arange(4)


@record(frozen=True)
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
        return self._about(*self._places(curve, piece), angle, 0)[:, 0]

    def cubics(self, curve: Index, piece: Index, centre: Real, half: Real) -> Complex:
        """Taylor polynomials (m, 4) about centres (m,) rad within pieces, in units of half widths (m,)."""
        return self._about(*self._places(curve, piece), centre, 3) * half[:, None] ** _POWERS

    def over(self, points: RowSeries | None, bounds: RowSeries | None, half: Real) -> tuple[Complex, Real, Real]:
        """Coefficients (J, P, order + 1) over the angles of series, in units of half widths (N, P). Bounds have what
        they leave out (J, P). Both have the size (J,) of what is added up. Empty for a series that is None."""
        entry = turn_kernel()
        series, nothing = points or bounds, repeat((entry.NOTHING, None))
        assert series is not None  # at least one is there
        rows, kinds = series.rows, entry.NO_KINDS if series.kinds is None else series.kinds.places
        functions = (nothing if series is None else series.functions(self._has_gas) for series in (points, bounds))
        results, order = [], -1 if bounds is None else bounds.order
        for (at, place), (over, there) in zip(*functions, strict=False):
            wide = compact(half[:, place or there])
            reading = entry.Reading(self._every, np.arange(len(wide)), wide, order, wide.shape[1], kinds)
            outcome = entry.over_turn(entry.SUMS, rows, self.sums, reading=reading, points=at, bounds=over)
            results.append(outcome[1:])
        if len(results) == 1:
            return results[0]
        cubic, rest, size = zip(*results, strict=True)
        return np.concatenate(cubic, axis=1), np.concatenate(rest, axis=1), np.max(size, axis=0)

    def of_forces(self, forces: "Functions", order: int, half: Real) -> tuple[Complex, Real, Real]:
        """The same of curves of one reading, of the forces of the rows that are made already, bounded to an order."""
        entry = turn_kernel()
        reading = entry.Reading(self._every, np.arange(len(half)), compact(half), order, half.shape[1])
        outcome = entry.over_turn(entry.FORCE_SUMS, self.rows.kernel_rows, self.sums, reading=reading, points=forces)
        cubic, rest, size = outcome[1:]
        return cubic, rest, size

    @cached_property
    def sums(self) -> "Sums":
        """What is compiled takes them as."""
        number = np.empty(len(self.weights), np.int64)
        number[:] = [READINGS.index(reading) for reading in self.readings]
        vectors = [in_order(np.asarray(array, complex)) for array in (self.weights, self.constant)]
        sums: Sums = turn_kernel().Sums(number, *vectors)
        return sums

    def search(self, cubics: "Cubics", members: "Members", best: "Best", motion: "Motion | None") -> Complex:
        """Peaks of the curves, or of one of them in motion, from their pieces, and the curves there, at rest."""
        entry = turn_kernel()
        moving = entry.STILL if motion is None else motion
        query = entry.Query(cubics, members, best, entry.NO_LEVELS, self._within, moving)
        _, values, _, _ = entry.over_turn(entry.PEAKS, self.rows.kernel_rows, self.sums, query=query)
        there: Complex = values[:, 0, 0]
        return there

    def circles(self, cubics: "Cubics", members: "Members", motion: "Motion | None") -> Floors:
        """The smallest circles around the curves, or around one of them in motion."""
        from optimizer.mechanics.kernel.circles import ANGLES, COUNT, RADIUS, UPPER, WEIGHTS

        entry = turn_kernel()
        moving = entry.STILL if motion is None else motion
        query = entry.Query(cubics, members, entry.NO_BEST, entry.NO_LEVELS, self._within, moving)
        _, vectors, numbers, _ = entry.over_turn(entry.CIRCLES, self.rows.kernel_rows, self.sums, query=query)
        return Floors(
            vectors[:, 0, 0],
            numbers[:, RADIUS],
            numbers[:, UPPER],
            numbers[:, ANGLES:WEIGHTS],
            vectors[:, 1:, 0],
            numbers[:, WEIGHTS:],
            numbers[:, COUNT].astype(np.intp),
        )

    def crossings(self, cubics: "Cubics", level: Real) -> tuple[Real, Real]:
        """Angles at which the curves cross levels (J,), and what their integrals may be off by, from their pieces."""
        entry = turn_kernel()
        query = entry.Query(cubics, entry.NO_MEMBERS, entry.NO_BEST, level, self._within, entry.STILL)
        _, _, angle, error = entry.over_turn(entry.CROSSINGS, self.rows.kernel_rows, self.sums, query=query)
        return angle, error

    def _places(self, curve: Index, piece: Index) -> tuple[Index, Index, Real]:
        """Curves (m,), their designs, and angles rad that say which process counts, as what is compiled takes them."""
        number = _integers(curve)
        design = number // max(len(self.weights) // len(self.middle), 1)
        return number, design, self._within[design, piece]

    def _about(self, curve: Index, design: Index, within: Real, angle: Real, order: int) -> Complex:
        """Coefficients (m, order + 1) at angles (m,) rad; so many at once as rows are expanded at."""
        step, places = max(1, AT_ONCE // max(self.weights.shape[1], 1)), compact(angle)
        if curve.size <= step:
            return self._at(curve, design, places, within, order)
        parts = [slice(first, first + step) for first in range(0, curve.size, step)]
        return np.concatenate(
            [self._at(curve[part], design[part], places[part], within[part], order) for part in parts]
        )

    def _at(self, curve: Index, design: Index, angle: Real, within: Real, order: int) -> Complex:
        entry = turn_kernel()
        places = entry.Places(design, angle, NO_WIDTHS, within)
        wide = np.empty((curve.size, 1))
        wide.fill(1.0)
        reading = entry.Reading(curve, design, wide, -1, 1)
        _, vectors, *_ = entry.over_turn(
            entry.BOTH, self.rows.kernel_rows, self.sums, places, order, self._has_gas, reading
        )
        coefficients: Complex = vectors[:, 0]
        return coefficients

    @cached_property
    def _has_gas(self) -> bool:
        """Whether gas is a part of any."""
        return any(reading not in WITHOUT_GAS for reading in self.readings)

    @cached_property
    def _every(self) -> Index:
        return np.arange(len(self.weights))

    @cached_property
    def _within(self) -> Real:
        return compact(self.middle)


def _integers(values: Index) -> Index:
    """Numbers as what is compiled takes them: of any other layout it would be compiled once more."""
    return in_order(np.asarray(values, np.int64))


def forces(series: RowSeries, reading: Reading, bounded: bool = False) -> Complex | Real:
    """A force of every row of N designs about the angles of series, N: coefficients (N, R, P, order + 1).

    What shaft or frame bears is over the direction of the crank, as the shaft sees it: along - j s across.

    Parameters
    ----------
    bounded : of series over pieces: what the last coefficient is at most (N, R, P).
    """
    designs, rows = series.data.designs, series.data.crank_radius.shape[-1]
    every = spread(np.eye(rows), (designs, rows, rows)).reshape(-1, rows)
    curves = CurveSeries(series.data, series.centre, (reading,), every, np.zeros(len(every)))
    points, bounds = (None, series) if bounded else (series, None)
    middle, most, _ = curves.over(points, bounds, np.ones((designs, series.centre.shape[1])))
    coefficients = most if bounded else middle
    return coefficients.reshape(designs, rows, *coefficients.shape[1:])


class SeriesCurves(ABC):
    """Curves that are read from a series: the source of a search for peaks or circles."""

    @property
    @abstractmethod
    def _series(self) -> CurveSeries: ...

    def cubics(self, curve: Index, piece: Index, centre: Real, half: Real) -> Complex:
        """Taylor polynomials (m, 4) about centres (m,) rad within pieces; the process that counts is that of the
        piece."""
        return self._series.cubics(curve, piece, centre, half)

    def values(self, curve: Index, piece: Index, angle: Real) -> Complex:
        """The curves at angles (m,) rad within pieces, ends included."""
        return self._series.values(curve, piece, angle)

    def search(self, cubics: "Cubics", members: "Members", best: "Best", motion: "Motion | None" = None) -> Complex:
        """Peaks of the curves, or of one of them in motion."""
        return self._series.search(cubics, members, best, motion)

    def circles(self, cubics: "Cubics", members: "Members", motion: "Motion | None" = None) -> Floors:
        """The smallest circles around the curves, or around one of them in motion."""
        return self._series.circles(cubics, members, motion)
