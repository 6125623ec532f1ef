"""Rows of one machine that differ by their phase alone, as those of equal throws do. One of them repeats what another
does over the revolution some pieces later.

Shapes: R rows of K kinds, P pieces.
"""

import math
from dataclasses import replace

import numpy as np

from optimizer.mechanics.row_data import RowData
from optimizer.numerics.arrays import Real
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.responses.piecewise_cubics import ANGLE_ROUNDING, Index

_TURN = 2.0 * np.pi


@record(frozen=True)
class RowKinds:
    """The kinds of R rows, of which the first row of each stands for all.

    every : of all rows.
    first : (K,) rows.
    kind : (R,) the kind of each row.
    ahead : (R,) rad, by how much the crank of a row is ahead of the first of its kind.
    later : (R,) over piece p a row does what the first of its kind does over piece p + later.
    """

    every: RowData
    first: Index
    kind: Index
    ahead: Real
    later: Index

    @cached_property
    def rows(self) -> RowData:
        """The first row of each kind."""
        return self.every.of_rows(self.first)

    @cached_property
    def places(self) -> Index:
        """Kinds and pieces, as what is compiled takes them, (2, R)."""
        return np.array([self.kind, self.later])

    @cached_property
    def ahead_deg(self) -> list[float]:
        """The same in degrees."""
        degrees: list[float] = np.rad2deg(self.ahead).tolist()
        return degrees

    def of_parts(self, later: Index) -> "RowKinds":
        """The same over parts of pieces, of which equal pieces have equally many: how many parts later (R,)."""
        return replace(self, later=later)


def row_kinds(rows: RowData, centre: Real, half: Real) -> RowKinds | None:
    """The kinds of the rows of one machine over pieces about centres (P,) rad, of half widths (P,); None where no two
    rows are of one kind.

    Pieces have to repeat where a kind does. They begin where something jumps or has a kink, so those of a machine
    with equal throws at even angles repeat. Angles are equal that differ by their rounding.
    """
    if rows.designs != 1 or rows.traces:
        return None
    data = rows.kernel_rows
    count = data.motion.shape[1]
    if len({*map(tuple, data.scale[0].tolist())}) == count:
        return None
    of_gas = (entry[0].reshape(count, math.prod(entry.shape[2:])) for entry in (data.area, data.gas))
    numbers = np.concatenate([data.motion[0, :, 1:], data.scale[0], *of_gas], 1)
    first_rows: dict[bytes, int] = {}
    base = np.array([first_rows.setdefault(row.tobytes(), number) for number, row in enumerate(numbers)])
    if len(first_rows) == count:
        return None
    # of all rows over all pieces
    ahead = np.mod(data.motion[0, :, 0] - data.motion[0, base, 0] + ANGLE_ROUNDING, _TURN) - ANGLE_ROUNDING
    pieces = np.arange(centre.size)
    later = np.searchsorted(centre, centre[0] + ahead - ANGLE_ROUNDING) % centre.size
    place = (pieces + later[:, None]) % centre.size
    apart = np.mod(centre[place] - centre - ahead[:, None] + ANGLE_ROUNDING, _TURN)
    equal = (apart <= 2.0 * ANGLE_ROUNDING) & (np.abs(half[place] - half) <= ANGLE_ROUNDING)
    alone = np.count_nonzero(equal, axis=1) < centre.size
    number = np.arange(count)
    base, ahead, later = np.where(alone, number, base), np.where(alone, 0.0, ahead), np.where(alone, 0, later)
    first = number[base == number]
    if first.size == count:
        return None
    return RowKinds(rows, first, np.searchsorted(first, base), ahead, later)
