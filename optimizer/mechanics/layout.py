"""A machine as arrays: the only thing that the effects read.

All arrays broadcast over leading axes, so that one machine and a million designs of one shape run
the same formulas. Angles are unit vectors (complex), as drawn at shaft angle 0.
"""

from collections.abc import Iterator, Sequence
from dataclasses import fields, replace
from functools import lru_cache, reduce
from typing import Any

import numpy as np

from optimizer.mechanics.angles import direction
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.memoization import remembered
from optimizer.numerics.records import record
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.rotor import Rotor
from schemas.machine.scroll_machine import ScrollMachine

#: axes of parts of rows side by side, where no part is a column
_TABLE, _NO_TABLE = 2, np.empty(0)


@record(frozen=True)
class Rotating:
    """Masses that turn with the shaft: (..., n)."""

    mass: Real  # kg
    radius: Real  # m
    direction: Complex
    position: Real  # m


@record(frozen=True)
class Reciprocating:
    """Masses that move along an axis, driven by a crank: (..., n)."""

    mass: Real  # kg, with the rod's reciprocating share
    crank_radius: Real  # m
    crank_direction: Complex
    axis: Complex
    position: Real  # m
    rod_ratio: Real  # r/l; 0 for an infinite rod, nan without a rod
    #: r/l - rod_ratio, the rounding error of the quotient; None without one
    rod_ratio_rest: Real | None = None

    @property
    def rod_margin(self) -> Real:
        """1 - r/l (..., n). The quotient alone has lost its digits where rod and crank are nearly equal."""
        margin = 1.0 - self.rod_ratio
        return margin if self.rod_ratio_rest is None else margin - self.rod_ratio_rest


@record(frozen=True)
class Webs:
    """Places for counterweights: (..., n)."""

    position: Real  # m
    radius: Real  # m


@record(frozen=True)
class BalanceWebs:
    """Places for unbalances on balance shafts, one shaft after the other: (..., n)."""

    position: Real  # m
    radius: Real  # m
    ratio: Real  # turns for one of the crankshaft
    x: Real  # m, of the shaft's axis
    y: Real  # m


@record(frozen=True)
class Layout:
    """A machine as arrays."""

    omega: Real  # (...) rad/s
    sense: Real  # (...) +1 counter-clockwise, -1 clockwise
    centre_plane: Real  # (...) m, where couples are summed
    reference_plane: Real  # (...) m, where couples are reported
    rotating: Rotating
    reciprocating: Reciprocating
    webs: Webs
    balance: BalanceWebs | None = None  # None where there are no balance shafts
    cranks: Complex | None = None  # (..., throws) directions; None of a scroll machine

    @property
    def central(self) -> bool:
        """Whether couples are reported about the plane in which they are summed, which is the default."""
        return self.reference_plane is self.centre_plane


@remembered
def layout(machine: ReciprocatingMachine | ScrollMachine) -> Layout:
    """Arrays of one machine, or of many; rods are shared between crosshead and pin here.

    A field may hold a column (N,), one value for each of N machines that differ in nothing else. Figures that depend on
    it then have the leading axis (N,), the others none. Without columns there are no leading axes.
    Source: lecture slides on compressors and slides on balancing (share of the rod).
    """
    if isinstance(machine, ScrollMachine):
        turning, moving, planes = _scroll(machine)
        throws = None
    else:
        turning, moving, planes, throws = _reciprocating(machine)
    turning_mass, turning_radius, angle, place = _table([*turning, *_unbalances(machine)], 4)
    mass, radius, crank_angle, axis_angle, position, ratio, rest = _table(moving, 7)
    towards, crank, axis = direction(angle), direction(crank_angle), direction(axis_angle)
    centre, plane = _middle(planes), machine.reference_plane_m
    return Layout(
        omega=np.asarray(machine.speed_rpm * np.pi / 30.0),
        sense=np.asarray(1.0 if machine.rotation == "ccw" else -1.0),
        centre_plane=centre,
        reference_plane=centre if plane is None else np.asarray(plane, dtype=float),
        rotating=Rotating(turning_mass, turning_radius, towards, place),
        reciprocating=Reciprocating(mass, radius, crank, axis, position, ratio, rest),
        webs=_webs(machine),
        balance=_balance_webs(machine),
        cranks=None if throws is None else towards[..., throws],
    )


def spread(plan: Layout, leading: tuple[int, ...]) -> Layout:
    """The layout with all of the leading axes in every array; what is common to all designs is not copied."""

    def leading_axes(part: Any) -> Any:
        arrays = {field.name: getattr(part, field.name) for field in fields(part)}
        return replace(
            part, **{name: np.broadcast_to(array, (*leading, array.shape[-1])) for name, array in arrays.items()}
        )

    centre = np.broadcast_to(plan.centre_plane, leading)
    return Layout(
        omega=np.broadcast_to(plan.omega, leading),
        sense=np.broadcast_to(plan.sense, leading),
        centre_plane=centre,
        reference_plane=centre if plan.central else np.broadcast_to(plan.reference_plane, leading),
        rotating=leading_axes(plan.rotating),
        reciprocating=leading_axes(plan.reciprocating),
        webs=leading_axes(plan.webs),
        balance=None if plan.balance is None else leading_axes(plan.balance),
        cranks=None if plan.cranks is None else np.broadcast_to(plan.cranks, (*leading, plan.cranks.shape[-1])),
    )


def stacked(values: Sequence[Any]) -> Real:
    """Values side by side on a last axis, (..., len(values)); each is a number or a column (N,)."""
    if values and type(values[0]) is np.ndarray:
        return _columns(values)
    try:
        return np.array(values, dtype=float)
    except ValueError:
        # numbers beside columns make no array
        return _columns(values)


def _columns(values: Sequence[Any]) -> Real:
    columns = [np.asarray(value, dtype=float) for value in values]
    table = np.empty((*np.broadcast_shapes(*(column.shape for column in columns)), len(columns)))
    for k, column in enumerate(columns):
        table[..., k] = column
    return table


def outermost(planes: Sequence[Any]) -> tuple[Any, Any]:
    """Lowest and highest of at least one plane, each a number or a column (N,)."""
    if np.ndarray not in map(type, planes):
        return min(planes), max(planes)
    numbers = [plane for plane in planes if type(plane) is not np.ndarray]
    columns = [plane for plane in planes if type(plane) is np.ndarray]
    # numbers beside columns are compared once for all
    low, high = ([min(numbers)], [max(numbers)]) if numbers else ([], [])
    return reduce(np.minimum, [*low, *columns]), reduce(np.maximum, [*high, *columns])


def quotient(numerator: Any, denominator: Any) -> tuple[Any, Any]:
    """A quotient and what rounding took off it, so that their sum has the digits of two doubles (...)."""
    value = numerator / denominator
    # exact product (Dekker 1971), so that the remainder is exact
    product = value * denominator
    (high, low), (denominator_high, denominator_low) = _halves(value), _halves(denominator)
    error = (
        (high * denominator_high - product) + high * denominator_low + low * denominator_high
    ) + low * denominator_low
    return value, ((numerator - product) - error) / denominator


def _halves(value: Any) -> tuple[Any, Any]:
    """Two numbers of half the digits whose sum is the value (Veltkamp)."""
    scaled = 134217729.0 * value
    high = scaled - (scaled - value)
    return high, value - high


def _webs(machine: Rotor) -> Webs:
    return Webs(position=stacked([web.position_m for web in machine.webs]), radius=web_radii(machine))


@remembered
def web_radii(machine: Rotor) -> Real:
    """Radii of the centres of mass of what the webs of the crankshaft carry (..., K) m; nan where a plate decides."""
    return stacked([web.radius_m for web in machine.webs])


def _balance_webs(machine: Rotor) -> BalanceWebs | None:
    if not isinstance(machine, ReciprocatingMachine) or not machine.balance_shafts:
        return None
    webs = [(shaft, web) for shaft in machine.balance_shafts for web in shaft.webs]
    return BalanceWebs(
        position=stacked([web.position_m for _, web in webs]),
        radius=stacked([web.radius_m for _, web in webs]),
        ratio=stacked([shaft.speed_ratio for shaft, _ in webs]),
        x=stacked([shaft.x_m for shaft, _ in webs]),
        y=stacked([shaft.y_m for shaft, _ in webs]),
    )


def _unbalances(machine: Rotor) -> Iterator[Any]:
    """The shaft's own unbalances by their components, masses at a radius of 1 m: mass, radius, angle, position."""
    for unbalance in machine.unbalances:
        for component, angle in ((unbalance.x_kg_m, 0.0), (unbalance.y_kg_m, 90.0)):
            yield np.abs(component), 1.0, np.where(np.less(component, 0.0), angle + 180.0, angle), unbalance.position_m


def _reciprocating(machine: ReciprocatingMachine) -> tuple[list[Any], list[Any], list[float], list[int]]:
    """What turns with the shaft, what moves along axes, the planes of the throws, and which of the first they are."""
    turning: list[Any] = []  # mass, radius, angle, position
    throws: list[int] = []
    moving: list[Any] = []  # mass, radius, crank angle, axis, position, rod ratio and its rest
    for throw in machine.throws:
        radius, angle, plane = throw.crank_radius_m, throw.crank_angle_deg, throw.position_m
        throws.append(len(turning))
        turning.append((throw.rotating_mass_kg, radius, angle, plane))
        for row in throw.rows:
            ratio, rest = np.nan, 0.0
            if row.connecting_rod is not None:
                rod = row.connecting_rod
                ratio, rest = (0.0, 0.0) if rod.length_m is None else _rod_ratio(radius, rod.length_m)
            if row.connecting_rod is not None or row.parts:
                # the big end turns in the plane of its own row, not in that of the throw
                turning.append((row.rotating_kg, radius, angle, plane + row.offset_m))
            moving.append((row.reciprocating_kg, radius, angle, row.axis_deg, plane + row.offset_m, ratio, rest))
    return turning, moving, [throw.position_m for throw in machine.throws], throws


def _rod_ratio(radius: Any, length: Any) -> tuple[Any, Any]:
    """Crank radius over rod length, and its rest, as :func:`quotient`."""
    if type(radius) is float and type(length) is float:
        return _of_numbers(radius, length)
    return quotient(radius, length)


# most machines have one rod ratio
_of_numbers = lru_cache(maxsize=256)(quotient)


def _scroll(machine: ScrollMachine) -> tuple[list[Any], list[Any], list[float]]:
    orbit, guide = machine.orbit_radius_m, machine.anti_rotation
    turning: list[Any] = [(machine.orbiting_mass_kg, orbit, 0.0, machine.orbiting_position_m)]
    moving: list[Any] = []
    if guide.type == "oldham":
        # the ring slides along one axis with the orbit's projection: a crank with an infinite rod
        moving.append((guide.mass_kg, orbit, 0.0, guide.axis_deg, guide.position_m, 0.0, 0.0))
    else:
        turning.append((guide.count * guide.eccentric_mass_kg, orbit, 0.0, guide.position_m))
    return turning, moving, [machine.orbiting_position_m]


def _table(rows: Sequence[Any], parts: int) -> Sequence[Real]:
    """The parts of rows side by side, each (..., rows), as :func:`stacked`."""
    every = list(zip(*rows, strict=True)) if rows else [()] * parts
    try:
        table = np.array(every, dtype=float)
    except ValueError:
        # numbers beside columns make no array
        table = _NO_TABLE
    # to iterate over an array ends with an error that takes longer than the views do
    return [table[k] for k in range(parts)] if table.ndim == _TABLE else [stacked(part) for part in every]


def _middle(planes: Sequence[Any]) -> Real:
    """Middle between the outermost of planes (...) m."""
    low, high = outermost(planes)
    return np.asarray(0.5 * (low + high))
