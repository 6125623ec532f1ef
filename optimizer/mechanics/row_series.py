"""Forces of the rows as Taylor series in the shaft angle, at points or bounded over pieces of the turn.

What they are made of is compiled: :mod:`optimizer.mechanics.kernel.rows`.

Shapes: N designs or places, R rows, P angles.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.mechanics.row_data import RowData, compact

#: a force of the rows
Reading = Literal[
    "piston", "rod", "rod_without_gas", "rod_at_rest", "side", "tangential", "radial", "on_shaft", "on_frame", "gas"
]


class Taylor(NamedTuple):
    """Coefficients f^(k)/k! of functions of an angle, (order + 1, ...).

    middle : the coefficients, or the middles of their enclosures; complex for vectors across the shaft.
    radius : of their enclosures; None at points.
    """

    middle: Real | Complex
    radius: Real | None


@dataclass(frozen=True)
class RowSeries:
    """Series of the rows about shaft angles, each (order + 1, N, R, P); worked out when asked for.

    centre, half : (N, P) rad; half None for series at points.
    within : (N, P) rad, angles that say which process counts.
    """

    data: RowData
    centre: Real
    half: Real | None
    within: Real
    order: int

    def of(self, reading: Reading) -> Taylor:
        """Series of a force, N.

        What shaft or frame bears is over the direction of the crank, as the shaft sees it: along - j s across.
        """
        if reading not in self._known:
            self._known[reading] = self._made(reading)
        return self._known[reading]

    @cached_property
    def _known(self) -> dict[Reading, Taylor]:
        return {}

    def _made(self, reading: Reading) -> Taylor:
        from optimizer.mechanics.kernel.rows import READINGS, Places, row_series

        none = np.zeros((0, 0))
        half = none if self.half is None else self.half
        places = Places(*map(compact, (self.centre, half, self.within, *self._given)))
        parts, radius = row_series(self.data.packed, places, READINGS.index(reading), self.order)
        middle = parts[0] if len(parts) == 1 else parts[0] + 1j * parts[1]
        return Taylor(middle, None if self.half is None else radius)

    @property
    def _given(self) -> tuple[Real, Real]:
        """Pressures [Pa] and their slopes [Pa/rad] of the traces (T, N or 1, P)."""
        found = []
        for trace in self.data.traces:
            ahead = self.data.ahead[:, trace.row, None]
            found.append(trace.at(self.centre + ahead, self.within + ahead))
        if not found:
            return np.zeros((0, 1, 1)), np.zeros((0, 1, 1))
        pressure, slope = (np.stack(np.broadcast_arrays(*each)) for each in zip(*found, strict=True))
        return pressure, np.broadcast_to(slope, pressure.shape)
