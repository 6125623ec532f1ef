"""Indicated pressures: a table over a cycle of one or two turns in place of the cycle of four processes.

A table counts from an outer dead centre of its row, so that its angle differs from the row's own crank angle by whole
turns. Between its entries the pressure is linear, and also from the last entry to the first of the next cycle. Kinks
are only at the entries, which are breaks of the turn (:mod:`whole_turn`).
"""

from collections.abc import Sequence

import numpy as np

from optimizer.mechanics.kinematics import steep_angles
from optimizer.mechanics.turn import mean, panels
from optimizer.numerics.arrays import Real
from optimizer.numerics.records import record
from optimizer.responses.piecewise_cubics import Index

TURN = 2.0 * np.pi
#: rad; breaks of the turn nearer to each other are one
SLIVER = 1e-12
_WIDEST_PANEL = np.deg2rad(10.0)


@record(frozen=True)
class Trace:
    """Indicated pressure of one chamber of each design (...): one of D tables of K entries.

    row, side : which chamber; even ones are head sides.
    turns : of the shaft in a cycle, 1 or 2.
    """

    row: int
    side: int
    turns: int
    angle: Real  # (D, K) rad, rising from at most 0 to at least the end of the cycle
    pressure: Real  # (D, K) Pa
    table: Index  # (...) which of the tables a design has
    lead: Real  # (...) rad, own crank angle of the row at which its table begins: 0 or a turn

    @property
    def cycle(self) -> float:
        """Length of a cycle, rad."""
        return TURN * self.turns

    def at(self, own: Real, within: Real | None = None) -> tuple[Real, Real]:
        """Pressure [Pa] and its slope [Pa/rad] at own crank angles (..., T) of the row.

        Parameters
        ----------
        within : (..., T) rad, angles that say which part of the table counts; by default the same.
        """
        inside = own if within is None else within
        place = np.mod(inside - self.lead[..., None], self.cycle)
        place = np.broadcast_to(place, (*np.broadcast_shapes(place.shape[:-1], self.table.shape), place.shape[-1]))
        angle, pressure, slope = self._part(place)
        return pressure + slope * (place - angle + (own - inside)), slope

    def breaks(self, ahead: Real) -> Real:
        """Shaft angles of the entries (..., K) rad.

        Parameters
        ----------
        ahead : (...) rad, own crank angle of the row at shaft angle 0.
        """
        return self.angle[self.table] + (self.lead - ahead)[..., None]

    def work(self, area: Real, radius: Real, rod_ratio: Real, rod_margin: Real) -> Real:
        """Work put into the gas in one turn, in the mean of a cycle, (...) J: -integral of p dV.

        By Gauss-Legendre quadrature between the entries, the dead centres and where the rod makes the motion steep.
        """
        dead = np.broadcast_to([0.0, 0.5 * TURN], (*self.lead.shape, 2))
        once = np.concatenate([dead, steep_angles(rod_ratio)], axis=-1)
        again = [once + TURN * turn for turn in range(self.turns)]
        turn = panels(np.concatenate([self.angle[self.table], *again], axis=-1), _WIDEST_PANEL, turns=self.turns)
        phi, lam = turn.angle, rod_ratio[..., None]
        cosine, sine = np.cos(phi), np.sin(phi)
        upright = np.sqrt(rod_margin[..., None] * (1.0 + lam) + (lam * cosine) ** 2)
        # the head side grows while the row moves to the shaft
        outward = 1.0 if self.side % 2 == 0 else -1.0
        growth = outward * (area * radius)[..., None] * sine * (1.0 + lam * cosine / upright)
        pressure, _ = self.at(phi + self.lead[..., None])
        return -TURN * mean(turn, pressure * growth)

    def _part(self, place: Real) -> tuple[Real, Real, Real]:
        """Entry before places (..., T) of the cycle: its angle, its pressure, and the slope from there on."""
        step = np.diff(self.angle, axis=-1)
        slopes = np.diff(self.pressure, axis=-1) / np.where(step > 0.0, step, np.inf)
        result = np.empty((3, *place.shape))
        for table in range(len(self.angle)):
            mine = np.broadcast_to(self.table == table, place.shape[:-1])
            entry = np.searchsorted(self.angle[table], place[mine], side="right") - 1
            entry = np.minimum(entry, slopes.shape[-1] - 1)
            for part, values in enumerate((self.angle, self.pressure, slopes)):
                result[part][mine] = values[table][entry]
        return result[0], result[1], result[2]


def entries(traces: Sequence[Trace], ahead: Real) -> Real:
    """Shaft angles (..., B) rad at which traces have entries, over all turns after which they repeat; rising.

    Parameters
    ----------
    ahead : (..., rows) rad, own crank angles of the rows at shaft angle 0.
    """
    turns = turns_of(traces)
    # a trace of one turn begins anew where another takes two
    results = [trace.breaks(ahead[..., trace.row]) + TURN * k for trace in traces for k in range(0, turns, trace.turns)]
    return np.sort(np.mod(np.concatenate(results, axis=-1), TURN * turns), axis=-1)


def turns_of(traces: Sequence[Trace]) -> int:
    """Turns of the shaft after which all repeats: 2 where any cycle takes two."""
    return max((trace.turns for trace in traces), default=1)
