"""Forces of the rows of many designs over the pieces of their turns, those of several readings made together.

The expansions of the rows are large, and are let go a few designs later: so all readings that anybody needs sooner
or later are made at once.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from optimizer.mechanics.reading import READINGS, WITHOUT_GAS, Reading
from optimizer.mechanics.row_data import RowData, compact
from optimizer.numerics.arrays import Real
from optimizer.numerics.memoization import cached_property

if TYPE_CHECKING:
    from optimizer.mechanics.kernel.rows import Functions

#: up to which forces are bounded over pieces
ORDER = 4


@dataclass(frozen=True)
class DesignForces:
    """Forces of the rows of N designs over P pieces.

    centre, half : (N, P) rad.
    readings : of the forces, which are made together.
    """

    rows: RowData
    centre: Real
    half: Real
    readings: tuple[Reading, ...]

    def of(self, reading: Reading) -> "Functions":
        """Of one reading, as :func:`optimizer.mechanics.kernel.curves.sums_of_rows` takes them."""
        if reading not in self._memo:
            self._make({reading, *self.readings}.difference(self._memo))
        return self._memo[reading]

    def _make(self, readings: set[Reading]) -> None:
        from optimizer.mechanics.kernel.entry import FORCES, NO_QUERY, NO_READING, over_turn
        from optimizer.mechanics.kernel.readings import ON_FRAME, ON_SHAFT
        from optimizer.mechanics.kernel.rows import Functions

        mask, half = np.array([name in readings for name in READINGS], np.int64), compact(self.half)
        outcome = over_turn(
            FORCES,
            self.rows.kernel_rows,
            order=ORDER,
            with_gas=not readings.issubset(WITHOUT_GAS),
            reading=NO_READING._replace(curve=mask, half=half),
            query=NO_QUERY._replace(middle=compact(self.centre)),
        )[0]
        points, bounds, radius = outcome
        part = 0
        for k, number in enumerate(np.flatnonzero(mask).tolist()):
            own = slice(part, part + (2 if number in (ON_SHAFT, ON_FRAME) else 1))
            of_rows = slice(k * len(radius) // len(readings), (k + 1) * len(radius) // len(readings))
            self._memo[READINGS[number]] = Functions(points[own], bounds[own], radius[of_rows])
            part = own.stop

    @cached_property
    def _memo(self) -> "dict[str, Functions]":
        return {}
