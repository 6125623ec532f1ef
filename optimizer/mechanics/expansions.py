"""Series of the rows about angles within pieces of the turn, each worked out once however many curves ask for it."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from optimizer.mechanics.row_data import RowData
from optimizer.mechanics.row_series import Reading, RowSeries, Taylor
from optimizer.numerics.arrays import Real
from optimizer.responses.piecewise_cubics import Index

#: design, piece, angle and perhaps half width of places, (m,) each
Places = tuple[NDArray[Any], ...]


class Expansions:
    """One force of the rows of N designs about angles within pieces."""

    def __init__(self, rows: RowData, middle: Real, reading: Reading) -> None:
        """Prepare.

        Parameters
        ----------
        middle : (N, P) rad, an angle within each piece, which says what process counts.
        """
        self._rows, self._middle, self._reading = rows, middle, reading
        self._values, self._cubics, self._fourths = _Memory(), _Memory(), _Memory()

    def values(self, design: Index, piece: Index, angle: Real) -> Real:
        """Values (m, R) at angles (m,) rad."""
        return self._values.arrays((design, piece, angle), lambda some: self._series(some, 0).middle[0])

    def cubics(self, design: Index, piece: Index, angle: Real) -> Real:
        """Coefficients (4, m, R) about angles (m,) rad."""
        return self._cubics.arrays((design, piece, angle), lambda some: self._series(some, 3).middle)

    def fourths(self, design: Index, piece: Index, angle: Real, half: Real) -> Real:
        """Middle and radius (2, m, R) of the coefficients of order 4 within half widths (m,) rad of angles."""

        def bounds(some: Places) -> Real:
            series = self._series(some, 4)
            assert series.radius is not None  # enclosures have one
            return np.stack([series.middle[0], series.radius])

        return self._fourths.arrays((design, piece, angle, half), bounds)

    def _series(self, places: Places, order: int) -> Taylor:
        """About places (m,): coefficients (order + 1, m, R), or bounds of the last (m, R)."""
        design, piece, angle, *half = places
        within = self._middle[design, piece]
        # places of one design side by side, those of many one below the other
        one = self._rows.designs == 1
        angle, within, *half = (np.expand_dims(each, 0 if one else 1) for each in (angle, within, *half))
        wide, of_design = half[0] if half else None, None if one else design
        result = RowSeries(self._rows, angle, wide, within, order, of_design).of(self._reading)

        def of_places(values: NDArray[Any]) -> NDArray[Any]:
            return np.swapaxes(values[..., 0, :, :], -1, -2) if one else values[..., 0]

        return Taylor(of_places(result.middle), None if result.radius is None else of_places(result.radius))


class _Memory:
    """Arrays (..., n, R) of n places, each place a few numbers."""

    def __init__(self) -> None:
        self._places: Places = ()
        self._arrays: NDArray[Any] = np.zeros(0)

    def arrays(self, places: Places, make: Callable[[Places], NDArray[Any]]) -> NDArray[Any]:
        """Arrays (..., m, R) of places (m,) each, made where they are not known."""
        count = len(self._places[0]) if self._places else 0
        every = tuple(map(np.concatenate, zip(self._places, places, strict=True))) if count else places
        # what is known comes first among equals
        order = np.lexsort(every)
        other = np.ones(order.size, dtype=bool)
        other[1:] = np.any([place[order[1:]] != place[order[:-1]] for place in every], axis=0)
        first = np.empty_like(order)
        first[order] = order[other][np.cumsum(other) - 1]
        kept = np.flatnonzero(first == np.arange(first.size))
        new = kept[kept >= count]
        if new.size:
            made = make(tuple(place[new] for place in every))
            self._arrays = np.concatenate([self._arrays, made], axis=-2) if count else made
            self._places = tuple(place[kept] for place in every)
        return self._arrays[..., np.searchsorted(kept, first[count:]), :]
