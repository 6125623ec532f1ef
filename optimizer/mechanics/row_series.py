"""Forces of the rows as Taylor series in the shaft angle, at points or bounded over pieces of the turn.

What they are made of, once however many forces are read from it, is compiled: :mod:`optimizer.mechanics.kernel.rows`.

Shapes: N designs or places, R rows, P angles.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from optimizer.mechanics.row_data import RowData, compact
from optimizer.numerics.arrays import Complex, Real, in_order, spread
from optimizer.responses.piecewise_cubics import Index

if TYPE_CHECKING:
    from optimizer.mechanics.kernel.rows import Functions

#: rows times places of which it is kept what forces are made of, which bounds the memory
AT_ONCE = 50_000

#: a force of the rows
Reading = Literal[
    "piston", "rod", "rod_without_gas", "rod_at_rest", "side", "tangential", "radial", "on_shaft", "on_frame", "gas"
]


class Taylor(NamedTuple):
    """Coefficients f^(k)/k! of functions of an angle.

    middle : (order + 1, ...) at points; of enclosures the middles of the last alone, (1, ...). Complex for vectors
        across the shaft.
    radius : (N, R, P) of the enclosures; (0, R, P) at points.
    """

    middle: Real | Complex
    radius: Real


@dataclass(frozen=True)
class RowSeries:
    """Series of the rows about shaft angles, each (order + 1, N, R, P); worked out when asked for.

    centre, half : (N, P) rad; half None for series at points.
    within : (N, P) rad, angles that say which process counts.
    of_design : (N,) which design each row of angles is of; by default each of its own.
    """

    data: RowData
    centre: Real
    half: Real | None
    within: Real
    order: int
    of_design: Index | None = None

    @cached_property
    def design(self) -> Index:
        """The design of each row of angles, (N,)."""
        given = np.arange(self.data.designs) if self.of_design is None else self.of_design
        return in_order(np.asarray(given, np.int64))

    def of(self, reading: Reading) -> Taylor:
        """Series of a force, N.

        What shaft or frame bears is over the direction of the crank, as the shaft sees it: along - j s across.
        """
        parts, radius = self.parts(reading)
        middle = parts[0] if len(parts) == 1 else parts[0] + 1j * parts[1]
        return Taylor(middle, radius)

    def parts(self, reading: Reading) -> tuple[Real, Real]:
        """The same, of vectors real and imaginary parts (1 or 2, ...), and the radii."""
        if reading not in self._readings:
            self._readings[reading] = self._made(reading)
        return self._readings[reading]

    @cached_property
    def _readings(self) -> dict[Reading, tuple[Real, Real]]:
        return {}

    def _made(self, reading: Reading) -> tuple[Real, Real]:
        from optimizer.mechanics.kernel.readings import READINGS, WITHOUT_GAS, row_series

        rows, number, pressed = self.data.packed, READINGS.index(reading), reading not in WITHOUT_GAS
        if known := self._memo(pressed):
            return row_series(rows, known, self.design, self.centre.shape[1], number)
        found = [row_series(rows, made, self.design, angles, number) for made, angles in self._functions(pressed)]
        if len(found) == 1:
            return found[0]
        parts, radius = (np.concatenate(each, axis=-1) for each in zip(*found, strict=True))
        return parts, radius

    def _memo(self, pressed: bool) -> "Functions | None":
        """What forces are made of, where that is kept: with gas it serves both."""
        return self._functions_by_pressure.get(True) or self._functions_by_pressure.get(pressed)

    def _functions(self, pressed: bool) -> "Iterator[tuple[Functions, int]]":
        """What forces are made of, with gas where it is pressed, and of how many angles of a design: part by part, and
        kept where one part is all."""
        from optimizer.mechanics.kernel.rows import Places, row_functions

        rows, angles = self.data.packed, self.centre.shape[1]
        # the pressures may differ between designs that have all else in common
        once = len(rows.motion) == len(self.centre) == 1 and rows.traces.table.shape[1] == 1
        design = self.design[:1] if once else self.design
        shape = (design.size, angles)
        centre, within = (spread(each, shape) for each in (self.centre, self.within))
        half = None if self.half is None else spread(self.half, shape)
        parts = max(1, min(-(-design.size * rows.motion.shape[1] * angles // AT_ONCE), angles))
        ends = [angles * part // parts for part in range(parts + 1)]
        for first, last in pairwise(ends):
            place = slice(first, last)
            places = Places(
                np.repeat(design, last - first),
                _flat(centre[:, place]),
                np.zeros(0) if half is None else _flat(half[:, place]),
                _flat(within[:, place]),
            )
            functions = row_functions(rows, places, self.order, pressed)
            if parts == 1:
                self._functions_by_pressure[pressed] = functions
            yield functions, last - first

    @cached_property
    def _functions_by_pressure(self) -> "dict[bool, Functions]":
        return {}


def _flat(values: Real) -> Real:
    """Values (N, P) as what is compiled takes them, design by design."""
    return compact(values).reshape(-1)
