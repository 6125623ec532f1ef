"""Gas forces: a four-process cycle in every chamber, with its switching angles and its work; or a table of pressures.

Chamber axis: head and crank side of the first cylinder of the row, then of the next on the same rod (tandem or
stepped). Even chambers are head sides. Rows with fewer cylinders have chambers without area. A chamber's own travel is
the piston's distance from the dead centre at which that chamber is smallest. Forces are positive in rod tension: head
side -p A, crank side +p A (design calculation of the 2D12, 2-14 and 2-15).
"""

import math
from collections.abc import Sequence
from functools import cache
from types import ModuleType

import numpy as np

from optimizer.mechanics.indicated import Trace
from optimizer.mechanics.kinematics import Motion, motion_kernel, row_table
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.layout import spread as spread_layout
from optimizer.numerics.arrays import Real, in_order, mapped, spread
from optimizer.numerics.memoization import cached_property, remembered, remembered_of_pair
from optimizer.numerics.records import record

#: own crank angles of the outer and the inner dead centre, rad
_DEAD_CENTRES = np.array([0.0, np.pi])


@record(frozen=True)
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


@record(frozen=True)
class GasForces:
    """Gas over shaft angles."""

    pressure: Real  # (..., rows, C, T) Pa
    area: Real  # (..., rows, C) m^2

    @cached_property
    def force(self) -> Real:
        """(..., rows, C, T) N, positive in rod tension."""
        return self.pressure * np.where(head_sides(self.area), -self.area, self.area)[..., None]

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
    chambers, layout = _common_axes(chambers, layout, motion.crank_angle.shape[:-2])
    rows, table = row_table(layout), chamber_table(chambers)
    *leading, count, sides = table.shape[1:]
    angles = motion.crank_angle.shape[-1]
    places, number = (*leading, count, angles), math.prod(leading) * count
    series = (motion.crank_angle, motion.displacement, motion.remaining)
    pressure = np.empty((*leading, count, sides, angles))
    motion_kernel().cycle_pressures(
        *(in_order(spread(values, places)).reshape(number, angles) for values in series),
        *(rows.reshape(len(rows), number), table.reshape(len(table), number, sides)),
        pressure.reshape(number, sides, angles),
    )
    for trace in traces:
        pressure[..., trace.row, trace.side, :], _ = trace.at(motion.crank_angle[..., trace.row, :])
    return GasForces(pressure, chambers.area)


def forces_at_dead_centres(chambers: Chambers, traces: Sequence[Trace] = ()) -> Real:
    """Gas forces of the rows at their own outer and inner dead centres, (..., rows, 2) N.

    There a chamber is at its smallest and ends its discharge, or at its largest and ends its suction (design
    calculation of the 2D12, 2-10..2-13).

    Parameters
    ----------
    traces : pressures of chambers, in place of these.
    """
    low, high = chambers.suction, np.where(chambers.closed, chambers.discharge, chambers.suction)
    heads = head_sides(chambers.area)
    pressure = np.stack([np.where(heads, high, low), np.where(heads, low, high)], axis=-1)
    for trace in traces:
        pressure[..., trace.row, trace.side, :], _ = trace.at(_DEAD_CENTRES)
    return GasForces(pressure, chambers.area).total


def pressure_range(chambers: Chambers, traces: Sequence[Trace] = ()) -> tuple[Real, Real]:
    """Smallest and largest pressures of the chambers over the cycle, (..., rows, C) Pa.

    They are those of suction and discharge, for what lies between rises and falls from one to the other; and those of
    entries of a table, between which it is linear.

    Parameters
    ----------
    traces : pressures of chambers, in place of these.
    """
    low, high = chambers.suction, np.where(chambers.closed, chambers.discharge, chambers.suction)
    if traces:
        low, high = low.copy(), high.copy()
    for trace in traces:
        for ends, extreme in ((low, np.minimum.reduce), (high, np.maximum.reduce)):
            ends[..., trace.row, trace.side] = extreme(trace.pressure, axis=-1)[trace.table]
    return low, high


@cache
def _head_sides(count: int) -> np.ndarray:
    return np.arange(count) % 2 == 0


def head_sides(chambers: Real) -> np.ndarray:
    """Which of the chambers (..., C) are head sides, (C,)."""
    return _head_sides(chambers.shape[-1])


@remembered
def chamber_table(chambers: Chambers) -> Real:
    """The chambers as what is compiled takes them, (7, ..., rows, C)."""
    return np.array(list(vars(chambers).values()), float)


def _common_axes(chambers: Chambers, layout: Layout, leading: tuple[int, ...] = ()) -> tuple[Chambers, Layout]:
    """Both with the leading axes of both; the very same where they have these."""
    own = row_table(layout).shape[1:-1]
    if chambers.area.shape[:-2] == own and leading in ((), own):
        return chambers, layout
    axes = np.broadcast_shapes(leading, chambers.area.shape[:-2], own)
    if axes != own:
        layout = spread_layout(layout, axes)
    if axes != chambers.area.shape[:-2]:
        chambers = mapped(chambers, lambda part: spread(part, (*axes, *part.shape[-2:])))
    return chambers, layout


# it loads the compiler, and so at the first call; an import at each takes as long as a small array
@cache
def _kernel() -> ModuleType:
    from optimizer.mechanics.kernel import chamber_values

    return chamber_values


def switching_travels(chambers: Chambers, layout: Layout) -> tuple[Real, Real]:
    """Own travel at which suction opens and at which discharge opens, (..., rows, C) m; nan where open.

    By what re-expansion adds to the clearance, V_0 ((p_d / p_s)^(1/m) - 1), and compression takes off the full volume.
    """
    values, kernel = cycle_values(chambers, layout), _kernel()
    return values[kernel.SUCTION], values[kernel.DISCHARGE]


@remembered_of_pair
def cycle_values(chambers: Chambers, layout: Layout) -> Real:
    """What the chambers come to whatever the samples, as :func:`chamber_values` has it, (7, ..., rows, C)."""
    kernel = _kernel()
    chambers, layout = _common_axes(chambers, layout)
    rows, table = row_table(layout), chamber_table(chambers)
    *leading, count, sides = table.shape[1:]
    number = math.prod(leading) * count
    values = np.empty((kernel.VALUES, *leading, count, sides))
    kernel.chamber_values(
        *(rows.reshape(len(rows), number), table.reshape(len(table), number, sides)),
        values.reshape(kernel.VALUES, number, sides),
    )
    return values


def switching_angles(chambers: Chambers, layout: Layout, exact: bool = True) -> tuple[Real, Real]:
    """Own crank angles in [0, 2 pi) at which suction and discharge open, (..., rows, C) rad; nan where never.

    Parameters
    ----------
    exact : kinematics, or cut off after the second order.
    """
    values, kernel = cycle_values(chambers, layout), _kernel()
    if not exact:
        return values[kernel.SUCTION_CUT_OFF], values[kernel.DISCHARGE_CUT_OFF]
    return values[kernel.SUCTION_ANGLE], values[kernel.DISCHARGE_ANGLE]


def indicated_work(chambers: Chambers, layout: Layout) -> Real:
    """Work put into the gas in one turn, in closed form, (..., rows, C) J; 0 on open sides.

    The work above the suction pressure, which would do none by itself: with the volumes V and their polytropes,
    p_s V_full g(l_n, n) + (p_d - p_s) V_delivered - p_s V_opens g(l_m, m), where l_n = ln(p_d / p_s) / n and
    g(l, n) = integral from 0 to l of (e^{nu} - 1) e^{-u} du. So pressures that hardly differ keep their digits.
    nan where the chamber never delivers.
    """
    # who has other pressures in some of the chambers writes their work to it
    work: Real = cycle_values(chambers, layout)[_kernel().WORK].copy()
    return work
