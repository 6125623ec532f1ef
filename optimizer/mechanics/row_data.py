"""What the forces of the rows depend on, of one design or many."""

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from optimizer.mechanics.gas import Chambers
from optimizer.mechanics.indicated import Trace
from optimizer.mechanics.kinematics import angle_ahead
from optimizer.mechanics.layout import Layout
from optimizer.numerics.arrays import Real, in_order, spread
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record

if TYPE_CHECKING:
    from optimizer.mechanics.kernel.rows import Rows, Tables


@record(frozen=True)
class RowData:
    """What the forces of the rows depend on; what is the same in all N designs stands there once, (1, R)."""

    designs: int  # N
    ahead: Real  # (N, R) rad, own crank angle at shaft angle 0
    crank_radius: Real  # (N, R) m
    rod_ratio: Real  # (N, R)
    rod_margin: Real  # (N, R) 1 - rod ratio
    inertia: Real  # (N, R) m r omega^2, N
    sense: Real  # (N, 1)
    friction: Real  # (N, R) N
    exact: bool  # or cut off after the second order
    area: Real | None  # (N, R, C) m^2, chambers as in :class:`Chambers`; None without gas
    suction: Real | None = None
    discharge: Real | None = None
    clearance: Real | None = None
    expansion_exponent: Real | None = None
    compression_exponent: Real | None = None
    closed: Real | None = None
    traces: tuple[Trace, ...] = ()  # of chambers with a table of pressures

    def of_designs(self, designs: slice) -> "RowData":
        """Data of some of the designs alone."""

        def part(value: Any) -> Any:
            return shared(value[designs]) if len(value) > 1 else value

        arrays = {name: part(value) for name, value in vars(self).items() if isinstance(value, np.ndarray)}
        traces = tuple(replace(trace, table=part(trace.table), lead=part(trace.lead)) for trace in self.traces)
        return replace(self, designs=len(range(self.designs)[designs]), traces=traces, **arrays)

    def of_rows(self, rows: NDArray[np.intp]) -> "RowData":
        """Data of some of the rows alone, of which none has a trace."""
        parts: dict[str, Any] = {
            name: value[:, rows]
            for name, value in vars(self).items()
            if isinstance(value, np.ndarray) and name != "sense"
        }
        return replace(self, **parts)

    @cached_property
    def kernel_rows(self) -> "Rows":
        """What is compiled takes it as."""
        from optimizer.mechanics.kernel.rows import Rows

        count = self.crank_radius.shape[-1]
        motion = _together([self.ahead, self.rod_ratio, self.rod_margin, self.sense], (count,))
        scale = _together([self.inertia, self.friction], (count,))
        chambers = 0 if self.area is None else self.area.shape[-1]
        area, gas, numbers = np.zeros((1, count, 0)), np.zeros((1, count, 0, 8)), np.full((count, chambers), -1)
        if self.area is not None and self.closed is not None:
            # crank sides pull, head sides push
            area = np.where(np.arange(chambers) % 2 == 0, -self.area, self.area)
            gas = _together([*self._state, *_opened(self._state, self.closed), self.closed], (count, chambers))
        for number, trace in enumerate(self.traces):
            numbers[trace.row, trace.side] = number
        designs = max(len(motion), len(gas))
        motion, gas = (compact(spread(array, (designs, *array.shape[1:]))) for array in (motion, gas))
        return Rows(motion, scale, compact(area), gas, numbers, self.exact, _tables(self.traces))

    @property
    def _state(self) -> list[Real]:
        """Pressures, clearance and exponents of the chambers."""
        names = ("suction", "discharge", "clearance", "expansion_exponent", "compression_exponent")
        return [getattr(self, name) for name in names]


def row_data(
    layout: Layout, exact: bool, friction: Real | None, chambers: Chambers | None, traces: Sequence[Trace] = ()
) -> RowData:
    """Data of designs whose leading axes become one, N.

    Parameters
    ----------
    friction : (..., R) N, of the rows; None where there is none.
    chambers : of the rows; None where there is no gas.
    traces : of chambers with a table of pressures.
    """
    rows = layout.reciprocating
    leading = layout.omega.shape
    designs, count = math.prod(leading), rows.mass.shape[-1]

    def flat(value: Any, *own: int) -> Any:
        return shared(spread(value, (*leading, *own)).reshape(designs, *own))

    gas: dict[str, Any] = {"area": None}
    if chambers is not None:
        gas = {name: flat(value, count, value.shape[-1]) for name, value in vars(chambers).items()}
    return RowData(
        designs=designs,
        ahead=flat(angle_ahead(layout), count),
        crank_radius=flat(rows.crank_radius, count),
        rod_ratio=flat(rows.rod_ratio, count),
        rod_margin=flat(rows.rod_margin, count),
        inertia=flat(rows.mass * rows.crank_radius * layout.omega[..., None] ** 2, count),
        sense=flat(layout.sense[..., None], 1),
        friction=flat(np.zeros(()) if friction is None else friction, count),
        exact=exact,
        traces=tuple(replace(trace, table=flat(trace.table), lead=flat(trace.lead)) for trace in traces),
        **gas,
    )


def _opened(state: Sequence[Real], closed: Real) -> tuple[Real, Real]:
    """Volumes over crank radius times area at which suction and discharge open."""
    suction, discharge, clearance, expansion, compression = state
    # an open side may be open to a vacuum
    log = np.log(np.where(closed, discharge, 1.0) / np.where(closed, suction, 1.0))
    return 2.0 * clearance * np.exp(log / expansion), 2.0 * (1.0 + clearance) * np.exp(-log / compression)


@cache
def _no_tables() -> "Tables":
    return _tables_of(())


def _tables(traces: Sequence[Trace]) -> "Tables":
    """The pressures that traces give, as what is compiled takes them."""
    return _tables_of(traces) if traces else _no_tables()


def _tables_of(traces: Sequence[Trace]) -> "Tables":
    from optimizer.mechanics.kernel.rows import Tables

    number, designs = (
        len(traces),
        max((len(entry) for trace in traces for entry in (trace.table, trace.lead)), default=1),
    )
    sizes = [trace.angle.shape for trace in traces]
    shape = (number, *(max(entry) for entry in zip(*sizes, strict=True))) if sizes else (0, 1, 1)
    parts, lead, table = np.zeros((3, *shape)), np.empty((number, designs)), np.empty((number, designs), np.int64)
    for k, (trace, (tables, count)) in enumerate(zip(traces, sizes, strict=True)):
        step = np.diff(trace.angle, axis=-1)
        parts[0, k, :tables, :count], parts[1, k, :tables, :count] = trace.angle, trace.pressure
        parts[2, k, :tables, : count - 1] = np.diff(trace.pressure, axis=-1) / np.where(step > 0.0, step, np.inf)
        table[k], lead[k] = trace.table, trace.lead
    counts, cycles = np.array([count for _, count in sizes], np.int64), np.array([trace.cycle for trace in traces])
    angle, pressure, slope = parts
    return Tables(angle, pressure, slope, counts, cycles, table, lead)


def compact(values: Real) -> Real:
    """Values as what is compiled takes them: of any other layout it would be compiled once more."""
    return in_order(values if values.dtype == np.float64 else values.astype(float))


def _together(values: Sequence[Real], shape: tuple[int, ...]) -> Real:
    """Values (D, *shape) on a last axis; D is 1 where all designs have the same."""
    result = np.empty((max(len(value) for value in values), *shape, len(values)))
    for k, value in enumerate(values):
        result[..., k] = value
    return result


def shared(values: Real) -> Real:
    """Values (N, ...) once, (1, ...), where they are the same in all designs: what is made of them is made once too."""
    return (
        values[:1] if len(values) > 1 and np.array_equal(values, np.broadcast_to(values[:1], values.shape)) else values
    )
