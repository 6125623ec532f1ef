"""Gas forces: a four-process cycle in every chamber, with its switching angles and its work; or a pressure as given.

Chamber axis: head and crank side of the first cylinder of the row, then of the next on the same rod (tandem or
stepped), so that even ones are head sides; rows with fewer cylinders have chambers without area. A chamber's own
travel is the piston's distance from the dead centre at which that chamber is smallest. Forces are positive in rod
tension:
head side -p A, crank side +p A (design calculation of the 2D12, 2-14 and 2-15).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import leggauss

from optimizer.mechanics.indicated import Trace
from optimizer.mechanics.kinematics import Motion, angle_at
from optimizer.mechanics.layout import Layout
from optimizer.numerics.arrays import Real
from optimizer.numerics.memoization import cached_property, remembered, remembered_of_both

#: Gauss-Legendre quadrature on [0, 1]
_INSIDE, _SHARES = (np.array(values) for values in (0.5 * (1.0 + leggauss(10)[0]), 0.5 * leggauss(10)[1]))


@dataclass(frozen=True)
class Chambers:
    """Data of the chambers, (..., rows, C), C twice the most cylinders of a row.

    Where ``closed`` is false the side is open to ``suction``.
    """

    area: Real  # m^2
    suction: Real  # Pa
    discharge: Real  # Pa
    clearance: Real  # relative to the stroke
    expansion_exponent: Real
    compression_exponent: Real
    closed: np.ndarray  # bool


@dataclass(frozen=True)
class GasForces:
    """Gas over shaft angles."""

    pressure: Real  # (..., rows, C, T) Pa
    area: Real  # (..., rows, C) m^2

    @property
    def force(self) -> Real:
        """(..., rows, C, T) N, positive in rod tension."""
        return np.where(head_sides(self.area), -1.0, 1.0)[:, None] * self.pressure * self.area[..., None]

    @cached_property
    def total(self) -> Real:
        """Gas force of the rows, (..., rows, T) N."""
        return np.add.reduce(self.force, axis=-2)


def gas_forces(chambers: Chambers, motion: Motion, layout: Layout, traces: Sequence[Trace] = ()) -> GasForces:
    """Pressures and gas forces over the turn.

    Volume growing: re-expansion p_d (x_0 / (x + x_0))^m until p_s, then suction; volume shrinking:
    compression p_s ((S + x_0) / (x + x_0))^n until p_d, then discharge (design calculation of the 2D12, 2-10..2-13).

    Parameters
    ----------
    traces : pressures of chambers, in place of these.
    """
    stroke = 2.0 * layout.reciprocating.crank_radius[..., :, None, None]
    head = motion.displacement[..., None, :]
    # the crank side empties where the difference from the stroke has no digits left
    crank = motion.remaining[..., None, :]
    heads = head_sides(chambers.area)[:, None]
    travel = np.where(heads, head, crank)
    clear = chambers.clearance[..., None] * stroke
    to_shaft = np.mod(motion.crank_angle, 2.0 * np.pi) < np.pi
    growing = heads == to_shaft[..., None, :]
    low, high = chambers.suction[..., None], chambers.discharge[..., None]
    closed = chambers.closed[..., None]
    safe = np.where(closed, clear, 1.0)
    expansion = high * (safe / (travel + safe)) ** chambers.expansion_exponent[..., None]
    compression = low * ((stroke + safe) / (travel + safe)) ** chambers.compression_exponent[..., None]
    pressure = np.where(growing, np.maximum(expansion, low), np.minimum(compression, high))
    pressure = np.where(closed, pressure, low)
    for trace in traces:
        pressure[..., trace.row, trace.side, :], _ = trace.at(motion.crank_angle[..., trace.row, :])
    return GasForces(pressure, chambers.area)


def head_sides(chambers: Real) -> np.ndarray:
    """Which of the chambers (..., C) are head sides, (C,)."""
    return np.arange(chambers.shape[-1]) % 2 == 0


def switching_travels(chambers: Chambers, layout: Layout) -> tuple[Real, Real]:
    """Own travel at which suction opens and at which discharge opens, (..., rows, C) m; nan where open."""
    suction, discharge, _ = _switching(chambers, layout)
    return suction, discharge


@remembered_of_both
def _switching(chambers: Chambers, layout: Layout) -> tuple[Real, Real, Real]:
    """Switching travels, and how far before full volume discharge opens: each by itself, without cancellation."""
    stroke = 2.0 * layout.reciprocating.crank_radius[..., :, None]
    clear = chambers.clearance * stroke
    log = log_ratio(chambers)
    suction = clear * np.expm1(log / chambers.expansion_exponent)
    # share of the full volume that compression takes away
    taken = -np.expm1(-log / chambers.compression_exponent)
    discharge, before = stroke * (1.0 - taken) - clear * taken, (stroke + clear) * taken
    opens = chambers.closed & (suction < stroke) & (discharge > 0.0)
    return np.where(opens, suction, np.nan), np.where(opens, discharge, np.nan), np.where(opens, before, np.nan)


@remembered
def log_ratio(chambers: Chambers) -> Real:
    """ln(p_d / p_s), 0 on open sides; good for pressures that hardly differ."""
    # an open side may be open to a vacuum
    low = np.where(chambers.closed, chambers.suction, 1.0)
    return np.log1p(np.where(chambers.closed, chambers.discharge - chambers.suction, 0.0) / low)


def switching_angles(chambers: Chambers, layout: Layout, exact: bool = True) -> tuple[Real, Real]:
    """Own crank angles in [0, 2 pi) at which suction and discharge open, (..., rows, C) rad; nan where never.

    Parameters
    ----------
    exact : kinematics, or cut off after the second order.
    """
    rows = layout.reciprocating
    radius, lam, margin = rows.crank_radius[..., None], rows.rod_ratio[..., None], rows.rod_margin[..., None]
    stroke = 2.0 * radius
    suction, discharge, before = _switching(chambers, layout)
    from_head = head_sides(chambers.area)
    # the head chamber grows over 0..pi and shrinks over pi..2 pi; the crank chamber the other way round

    def own_angle(travel: Real, left: Real) -> Real:
        moved, rest = np.where(from_head, travel, left), np.where(from_head, left, travel)
        return angle_at(moved, radius, lam, rest, margin, exact)

    opens, closes = own_angle(suction, stroke - suction), own_angle(discharge, before)
    return (
        np.where(from_head, opens, 2.0 * np.pi - opens),
        np.where(from_head, 2.0 * np.pi - closes, closes),
    )


def indicated_work(chambers: Chambers, layout: Layout) -> Real:
    """Work put into the gas in one turn, in closed form, (..., rows, C) J; 0 on open sides.

    The work above the suction pressure, which would do none by itself: with the volumes V and their polytropes,
    p_s V_full g(l_n, n) + (p_d - p_s) V_delivered - p_s V_opens g(l_m, m), where l_n = ln(p_d / p_s) / n and
    g(l, n) = integral from 0 to l of (e^{nu} - 1) e^{-u} du. So pressures that hardly differ keep their digits.
    nan where the chamber never delivers.
    """
    stroke = 2.0 * layout.reciprocating.crank_radius[..., :, None]
    clear = np.where(chambers.closed, chambers.clearance, 1.0) * stroke
    low, rise, log = chambers.suction, chambers.discharge - chambers.suction, log_ratio(chambers)
    suction, discharge = switching_travels(chambers, layout)
    compression, expansion = (
        _above_start(log, n) for n in (chambers.compression_exponent, chambers.expansion_exponent)
    )
    put_in = low * (stroke + clear) * compression + rise * discharge
    recovery = low * (clear + suction) * expansion
    return np.where(chambers.closed, chambers.area * (put_in - recovery), 0.0)


def _above_start(log: Real, exponent: Real) -> Real:
    """g(log / n, n), work of a compression above its first pressure over first pressure times first volume."""
    length, power = log / exponent, exponent - 1.0
    safe = np.where(power == 0.0, 1.0, power)
    direct = np.where(power == 0.0, length, np.expm1(power * length) / safe) + np.expm1(-length)
    # the two terms cancel for small pressure ratios, and the integrand is smooth
    u = length[..., None] * _INSIDE
    near = length * (np.expm1(np.minimum(exponent[..., None] * u, 1.0)) * np.exp(-u) @ _SHARES)
    return np.where(log < 1.0, near, direct)
