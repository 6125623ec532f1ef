"""Work of the rows on the shaft from one angle to another, in closed form, and what a flywheel takes up of it.

With the exact motion the lever of a row is dx/dphi, so that its torque does the work of the piston force. The work of
m a is m c^2 / 2, of the friction force times way, of the gas -integral of p dV over the processes of a chamber.
A motion cut off after the second order has levers that are not its own, and tables of pressures have no such form. For
those there is the quadrature of :mod:`optimizer.mechanics.turn`.
"""

import math
from typing import NamedTuple

import numpy as np

from optimizer.mechanics.gas import Chambers, chamber_table, cycle_values, indicated_work
from optimizer.mechanics.indicated import TURN
from optimizer.mechanics.kinematics import motion, row_table
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.whole_turn import TurnCurves
from optimizer.numerics.arrays import Real, in_order, spread
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.responses.piecewise_cubics import ROUNDING


class Range(NamedTuple):
    """Range over the turn of what a flywheel takes up and gives back (...) J, and what it may be short by."""

    value: Real
    error: Real


@record(frozen=True)
class RowWork:
    """Work that the rows take from the shaft, with the leading axes (...) of the layout.

    friction : (..., rows) N; None where there is none.
    chambers : of the rows, none of them with a table of pressures; None where there is no gas.
    indicated : work put into the gas of every chamber in one turn (..., rows, C) J, if at hand.
    """

    layout: Layout
    friction: Real | None
    chambers: Chambers | None = None
    indicated: Real | None = None

    @cached_property
    def of_a_turn(self) -> Real:
        """Work of every row in one turn (..., rows) J."""
        gas = 0.0 if self._indicated is None else np.add.reduce(self._indicated, axis=-1)
        work: Real = gas + self._rubbed
        return work

    def beside_mean(self, angle: Real) -> Real:
        """Running integral of torque - mean, of all rows, but for a constant, at shaft angles (..., n) rad: (..., n) J.

        It repeats with every turn.
        """
        # the compiler is loaded at its first use
        from optimizer.mechanics.kernel.chamber_values import work_values

        moving, rows = motion(self.layout, angle), row_table(self.layout)
        shape = moving.crank_angle.shape
        number, angles = math.prod(shape[:-1]), shape[-1]
        series = (moving.crank_angle, moving.displacement, moving.velocity, moving.remaining)
        own, work = np.array([spread(self.layout.reciprocating.mass, shape[:-1]), self._rubbed]), np.empty(shape)
        table, travels, indicated = self._gas
        sides = table.shape[-1]
        work_values(
            *(in_order(values).reshape(number, angles) for values in series),
            *(rows.reshape(len(rows), number), own.reshape(2, number), table.reshape(len(table), number, sides)),
            *(travels.reshape(2, number, sides), indicated.reshape(number, sides), work.reshape(number, angles)),
        )
        total: Real = np.add.reduce(work, axis=-2)
        return total

    def fluctuation(self, torque: TurnCurves) -> Range:
        """Range of the running integral of torque - mean, of the torque of all rows: it turns where they are equal."""
        leading, mean = self.layout.omega.shape, np.add.reduce(self.of_a_turn, axis=-1) / TURN
        angle, error = torque.crossings(np.reshape(mean, -1))
        work = self.beside_mean(angle.reshape(*leading, -1))
        rounding = ROUNDING * np.maximum.reduce(np.abs(work), axis=-1)
        return Range(
            np.maximum.reduce(work, axis=-1) - np.minimum.reduce(work, axis=-1), error.reshape(leading) + rounding
        )

    @cached_property
    def _rubbed(self) -> Real:
        """Work of the friction in one turn (..., rows) J."""
        rows = self.layout.reciprocating
        if self.friction is None:
            return np.zeros(rows.mass.shape)
        work: Real = 4.0 * rows.crank_radius * self.friction
        return work

    @cached_property
    def _indicated(self) -> Real | None:
        """Work put into the gas of every chamber in one turn (..., rows, C) J."""
        if self.chambers is None or self.indicated is not None:
            return self.indicated
        return indicated_work(self.chambers, self.layout)

    @cached_property
    def _gas(self) -> tuple[Real, Real, Real]:
        """Chambers (7, ..., rows, C), the travels at which they switch (2, ..., rows, C), and the work of a turn: of no
        chamber where there is no gas."""
        if self.chambers is None or self._indicated is None:
            none = np.zeros((7, *row_table(self.layout).shape[1:], 0))
            return none, none[:2], none[0]
        return chamber_table(self.chambers), cycle_values(self.chambers, self.layout)[:2], in_order(self._indicated)
