"""Work of the rows on the shaft from one angle to another, in closed form, and what a flywheel takes up of it.

With the exact motion the lever of a row is dx/dphi, so that its torque does the work of the piston force: of m a that
is m c^2 / 2, of the friction the force times the way, of the gas -integral of p dV over the processes of a chamber.
A motion cut off after the second order has levers that are not its own, and tables of pressures have no such form: for
those there is the quadrature of :mod:`optimizer.mechanics.turn`.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from optimizer.mechanics.gas import Chambers, head_sides, indicated_work, log_ratio, switching_travels
from optimizer.mechanics.indicated import TURN
from optimizer.mechanics.kinematics import motion
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.whole_turn import TurnCurves
from optimizer.numerics.arrays import Real
from optimizer.numerics.memoization import cached_property
from optimizer.responses.piecewise_cubics import ROUNDING


class Range(NamedTuple):
    """Range over the turn of what a flywheel takes up and gives back (...) J, and what it may be short by."""

    value: Real
    error: Real


@dataclass(frozen=True)
class RowWork:
    """Work that the rows take from the shaft, with the leading axes (...) of the layout.

    friction : (..., rows) N; None where there is none.
    chambers : of the rows, none of them with a table of pressures; None where there is no gas.
    indicated : work put into the gas of every chamber in one turn (..., rows, C) J, where it is known already.
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
        rows, moving = self.layout.reciprocating, motion(self.layout, angle)
        own = np.mod(moving.crank_angle, TURN)
        stroke = 2.0 * rows.crank_radius[..., None]
        # both ways count from the outer dead centre
        way = np.where(own < 0.5 * TURN, moving.displacement, stroke + moving.remaining)
        work = 0.5 * rows.mass[..., None] * moving.velocity**2
        work += self._rubbed[..., None] * (0.5 * way / stroke - own / TURN)
        if self.chambers is not None and self._indicated is not None:
            heads = head_sides(self.chambers.area)[:, None]
            moved, left = moving.displacement[..., None, :], moving.remaining[..., None, :]
            # a chamber counts from the dead centre at which it is smallest
            since = np.mod(own[..., None, :] + np.where(heads, 0.0, 0.5 * TURN), TURN)
            travel, rest = np.where(heads, moved, left), np.where(heads, left, moved)
            switching = switching_travels(self.chambers, self.layout)
            gas = _gas_work(self.chambers, stroke[..., None], travel, rest, since < 0.5 * TURN, switching)
            work += np.add.reduce(gas - self._indicated[..., None] * (since / TURN), axis=-2)
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


def _gas_work(
    chambers: Chambers, stroke: Real, travel: Real, rest: Real, growing: np.ndarray, switching: tuple[Real, Real]
) -> Real:
    """Work put into the gas of every chamber since it was smallest, (..., rows, C, n) J.

    With l = ln(V / V_end) a polytropic of exponent n takes p V l phi((n - 1) l) from p and V, phi(z) = (e^z - 1) / z.

    Parameters
    ----------
    stroke : (..., rows, 1, 1) m.
    travel, rest : (..., rows, C, n) m, of the stroke, from where the chamber is smallest.
    growing : (..., rows, C, n).
    switching : (..., rows, C) m, travels at which suction and discharge open; nan on open sides.
    """
    closed, low, high = (side[..., None] for side in (chambers.closed, chambers.suction, chambers.discharge))
    opens, delivers = (np.where(closed, side[..., None], 0.0) for side in switching)
    expansion, compression = chambers.expansion_exponent[..., None], chambers.compression_exponent[..., None]
    clear = np.where(closed, chambers.clearance[..., None], 1.0) * stroke
    log, full = log_ratio(chambers)[..., None], stroke + clear

    def expansion_work(travel: Real) -> Real:
        length = np.minimum(np.log1p(travel / clear), log / expansion)
        return high * clear * length * _growth((1.0 - expansion) * length) + low * np.maximum(travel - opens, 0.0)

    length = np.minimum(-np.log1p(-rest / full), log / compression)
    put_in = low * full * length * _growth((compression - 1.0) * length) + high * np.maximum(delivers - travel, 0.0)
    of_cycle = np.where(growing, -expansion_work(travel), put_in - expansion_work(stroke))
    # what is open takes the one pressure both ways
    work: Real = chambers.area[..., None] * np.where(closed, of_cycle, -low * travel)
    return work


def _growth(power: Real) -> Real:
    """(e^z - 1) / z, 1 at 0."""
    safe = np.where(power == 0.0, 1.0, power)
    return np.where(power == 0.0, 1.0, np.expm1(safe) / safe)
