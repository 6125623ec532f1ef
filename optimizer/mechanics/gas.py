"""Gas forces: a four-process cycle in every chamber, with its switching angles and its work.

Chamber axis: index 0 the head side, 1 the crank side. A chamber's own travel is the piston's
distance from the dead centre at which that chamber is smallest. Forces are positive in rod tension:
head side -p A, crank side +p A (seed 004, 2-14 and 2-15).
"""

from dataclasses import dataclass

import numpy as np

from optimizer.mechanics.kinematics import Motion, angle_at
from optimizer.mechanics.layout import Layout
from optimizer.response import Real

#: sign of a chamber's force, head and crank side
_SIGN = np.array([-1.0, 1.0])


@dataclass(frozen=True)
class Chambers:
    """Data of the chambers, (..., rows, 2). Where ``closed`` is false the side is open to ``suction``."""

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

    pressure: Real  # (..., rows, 2, T) Pa
    force: Real  # (..., rows, 2, T) N, positive in rod tension

    @property
    def total(self) -> Real:
        """Gas force of the rows, (..., rows, T) N."""
        return np.sum(self.force, axis=-2)


def gas_forces(chambers: Chambers, motion: Motion, layout: Layout) -> GasForces:
    """Pressures and gas forces over the turn.

    Volume growing: re-expansion p_d (x_0 / (x + x_0))^m until p_s, then suction; volume shrinking:
    compression p_s ((S + x_0) / (x + x_0))^n until p_d, then discharge (seed 004, 2-10..2-13).
    """
    stroke = 2.0 * layout.reciprocating.crank_radius[..., :, None, None]
    head = motion.displacement[..., None, :]
    travel = np.concatenate([head, stroke - head], axis=-2)
    clear = chambers.clearance[..., None] * stroke
    to_shaft = np.mod(motion.crank_angle, 2.0 * np.pi) < np.pi
    growing = np.stack([to_shaft, ~to_shaft], axis=-2)
    low, high = chambers.suction[..., None], chambers.discharge[..., None]
    closed = chambers.closed[..., None]
    safe = np.where(closed, clear, 1.0)
    expansion = high * (safe / (travel + safe)) ** chambers.expansion_exponent[..., None]
    compression = low * ((stroke + safe) / (travel + safe)) ** chambers.compression_exponent[..., None]
    pressure = np.where(growing, np.maximum(expansion, low), np.minimum(compression, high))
    pressure = np.where(closed, pressure, low)
    return GasForces(pressure, _SIGN[:, None] * pressure * chambers.area[..., None])


def switching_travels(chambers: Chambers, layout: Layout) -> tuple[Real, Real]:
    """Own travel at which suction opens and at which discharge opens, (..., rows, 2) m; nan where open."""
    stroke = 2.0 * layout.reciprocating.crank_radius[..., :, None]
    clear = chambers.clearance * stroke
    # an open side may be open to a vacuum
    ratio = np.where(chambers.closed, chambers.discharge, 1.0) / np.where(chambers.closed, chambers.suction, 1.0)
    suction = clear * (ratio ** (1.0 / chambers.expansion_exponent) - 1.0)
    discharge = (stroke + clear) * ratio ** (-1.0 / chambers.compression_exponent) - clear
    opens = chambers.closed & (suction < stroke) & (discharge > 0.0)
    return np.where(opens, suction, np.nan), np.where(opens, discharge, np.nan)


def switching_angles(chambers: Chambers, layout: Layout) -> tuple[Real, Real]:
    """Own crank angles in [0, 2 pi) at which suction and discharge open, (..., rows, 2) rad; nan where never."""
    rows = layout.reciprocating
    radius, lam = rows.crank_radius[..., None], rows.rod_ratio[..., None]
    stroke = 2.0 * radius
    suction, discharge = switching_travels(chambers, layout)
    from_head = np.array([True, False])
    # the head chamber grows over 0..pi and shrinks over pi..2 pi; the crank chamber the other way round
    opens = angle_at(np.where(from_head, suction, stroke - suction), radius, lam)
    closes = angle_at(np.where(from_head, discharge, stroke - discharge), radius, lam)
    return (
        np.where(from_head, opens, 2.0 * np.pi - opens),
        np.where(from_head, 2.0 * np.pi - closes, closes),
    )


def indicated_work(chambers: Chambers, layout: Layout) -> Real:
    """Work put into the gas in one turn, in closed form, (..., rows, 2) J; 0 on open sides.

    Compression and discharge minus re-expansion and suction; nan where the chamber never delivers.
    """
    stroke = 2.0 * layout.reciprocating.crank_radius[..., :, None]
    clear = np.where(chambers.closed, chambers.clearance, 1.0) * stroke
    low, high = chambers.suction, chambers.discharge
    suction, discharge = switching_travels(chambers, layout)
    put_in = _polytropic(low, stroke + clear, discharge + clear, chambers.compression_exponent) + high * discharge
    given_back = _polytropic(high, clear, suction + clear, chambers.expansion_exponent) + low * (stroke - suction)
    return np.where(chambers.closed, chambers.area * (put_in - given_back), 0.0)


def _polytropic(pressure: Real, start: Real, end: Real, exponent: Real) -> Real:
    """|integral of p dx| along p x^n = const from start to end, per unit of area."""
    power = 1.0 - exponent
    # expm1 keeps the digits where the exponent is near 1
    log = np.log(end / start)
    quotient = np.where(power == 0.0, log, np.expm1(power * log) / np.where(power == 0.0, 1.0, power))
    return np.abs(pressure * start * quotient)
