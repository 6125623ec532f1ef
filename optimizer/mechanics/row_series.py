"""What forces of the rows are made of, as Taylor series in the shaft angle, at points or bounded over pieces of it.

It is compiled (:mod:`optimizer.mechanics.kernel.rows`), and made once however many curves are read from it.

Shapes: N designs or places, R rows, P angles.
"""

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from itertools import pairwise
from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np

from optimizer.mechanics.row_data import RowData, compact
from optimizer.mechanics.row_kinds import RowKinds
from optimizer.numerics.arrays import Real, spread
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.responses.piecewise_cubics import Index

if TYPE_CHECKING:
    from optimizer.mechanics.kernel.rows import Functions, Rows

#: rows times places of which it is kept what forces are made of, which bounds the memory
AT_ONCE = 50_000
#: of what is expanded at points
NO_WIDTHS = np.zeros(0)


@record(frozen=True)
class RowSeries:
    """Functions of the rows about shaft angles of N designs, to an order.

    centre, half : (N, P) rad; half None for series at points.
    within : (N, P) rad, angles that say which process counts.
    higher : the same to a higher order, of which these are the first coefficients.
    kinds : of the rows of one machine, of which only the first of each kind has functions then.
    """

    data: RowData
    centre: Real
    half: Real | None
    within: Real
    order: int
    higher: "RowSeries | None" = None
    kinds: RowKinds | None = None

    @property
    def rows(self) -> "Rows":
        """The rows that have functions, as what is compiled takes them."""
        return self.data.kernel_rows if self.kinds is None else self.kinds.rows.kernel_rows

    def of_order(self, order: int) -> "RowSeries":
        """The same to a lower order."""
        return replace(self, order=order, higher=self)

    @cached_property
    def design(self) -> Index:
        """The design of each row of angles, (N,)."""
        return np.arange(self.data.designs)

    def functions(self, with_gas: bool) -> "Iterator[tuple[Functions, slice]]":
        """What forces are made of, with gas where it is pressed, of some angles after the other, to the order or a
        higher one; kept where these are all."""
        if self.higher is not None:
            yield from self.higher.functions(with_gas)
            return
        # with gas they serve both
        memo, every = self._memo.get(True) or self._memo.get(with_gas), slice(0, self.centre.shape[1])
        if memo is not None:
            yield memo, every
            return
        for functions, place in self._functions(with_gas):
            if place == every:
                self._memo[with_gas] = functions
            yield functions, place

    def _functions(self, with_gas: bool) -> "Iterator[tuple[Functions, slice]]":
        entry = turn_kernel()
        rows, angles = self.rows, self.centre.shape[1]
        # the pressures may differ between designs that have all else in common
        once = len(rows.motion) == len(self.centre) == 1 and rows.traces.table.shape[1] == 1
        design = self.design[:1] if once else self.design
        shape = (design.size, angles)
        centre = spread(self.centre, shape)
        within = centre if self.within is self.centre else spread(self.within, shape)
        half = None if self.half is None else spread(self.half, shape)
        parts = max(1, min(-(-design.size * rows.motion.shape[1] * angles // AT_ONCE), angles))
        ends = [angles * part // parts for part in range(parts + 1)]
        for first, last in pairwise(ends):
            place = slice(first, last)
            about = _flat(centre[:, place])
            places = entry.Places(
                design.repeat(last - first),
                about,
                NO_WIDTHS if half is None else _flat(half[:, place]),
                about if within is centre else _flat(within[:, place]),
            )
            outcome = entry.over_turn(entry.FUNCTIONS, rows, places=places, order=self.order, with_gas=with_gas)[0]
            yield entry.Functions(*outcome), place

    @cached_property
    def _memo(self) -> "dict[bool, Functions]":
        return {}


# it loads the compiler, and so at the first call; an import at each takes as long as a small array
@cache
def turn_kernel() -> ModuleType:
    """The entry to what is compiled of the whole turn."""
    from optimizer.mechanics.kernel import entry

    return entry


def _flat(values: Real) -> Real:
    """Values (N, P) as what is compiled takes them, design by design."""
    return compact(values).reshape(-1)
