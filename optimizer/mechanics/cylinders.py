"""Cylinders of a machine as arrays, and what is missing, impossible or too much in their data."""

from collections.abc import Iterator
from dataclasses import replace
from operator import attrgetter
from typing import NamedTuple

import numpy as np

from optimizer.mechanics.gas import Chambers, switching_travels
from optimizer.mechanics.indicated import SLIVER, TURN, Trace, entries
from optimizer.mechanics.kinematics import angle_ahead
from optimizer.mechanics.layout import Layout, stacked
from optimizer.numerics.arrays import Real, mapped, spread
from optimizer.numerics.memoization import remembered
from schemas.base.model import FieldProblem
from schemas.base.rules import Path, Rule
from schemas.machine.cylinder import Cylinder
from schemas.machine.indicated import DEAD_CENTRE_DEG, TURN_DEG, IndicatedPressure, PressureTrace
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.throws import row_cylinders

_SIDES = ("head", "crank")
_STATE = (
    "suction_pressure_Pa",
    "discharge_pressure_Pa",
    "relative_clearance",
    "expansion_exponent",
    "compression_exponent",
)
_IN_ORDER = attrgetter(*_STATE)
#: rows times entries of all traces at which the turns of a cycle are cut; so many take some ten seconds
MAX_ENTRIES = 200_000
#: a chamber that there is not
_NONE: list[float | None] = [0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 0.0]
_NEVER_DELIVERS = "with this clearance and pressure ratio the chamber never delivers"


def chambers(machine: ReciprocatingMachine, leading: tuple[int, ...] = ()) -> Chambers:
    """Chambers of all rows (..., rows, C), throw by throw; every cylinder has complete data (``gas_problems``).

    A row with fewer cylinders than another has pistons without area. Fields may hold columns, as in
    :func:`optimizer.mechanics.layout.layout`.

    Parameters
    ----------
    leading : axes that every array is to have, whatever depends on columns.
    """
    own = _chambers(machine)
    if not leading:
        return own
    axes = np.broadcast_shapes(leading, own.area.shape[:-2])
    return own if axes == own.area.shape[:-2] else mapped(own, lambda part: spread(part, (*axes, *part.shape[-2:])))


@remembered
def _chambers(machine: ReciprocatingMachine) -> Chambers:
    """The same with the axes of the columns alone."""
    cylinders = [[cylinder for _, cylinder in row_cylinders(row)] for throw in machine.throws for row in throw.rows]
    count = 2 * max((len(row) for row in cylinders), default=1) or 2
    rows = [([side for member in row for side in _row(member)] + [_NONE] * count)[:count] for row in cylinders]
    values = stacked([chamber[number] for number in range(7) for row in rows for chamber in row])
    table = values.reshape(*values.shape[:-1], 7, len(rows), count)
    area, low, high, clearance, expansion, compression, closed = [table[..., number, :, :] for number in range(7)]
    return Chambers(area, low, high, clearance, expansion, compression, closed.astype(bool))


def traces(machine: ReciprocatingMachine, layout: Layout) -> tuple[Trace, ...]:
    """Indicated pressures of the chambers that have one, with the leading axes of layout and columns together."""
    ahead = angle_ahead(layout)
    results = [
        _trace(
            place.row,
            place.chamber + side,
            record,
            getattr(record, name),
            _start_deg(machine, place.row, record),
            ahead,
        )
        for place, cylinder in _cylinders(machine)
        for record in (() if cylinder.pressure is None else (cylinder.pressure,))
        for side, name in enumerate(_SIDES)
        if getattr(record, name) is not None
    ]
    if not results:
        return ()
    leading = np.broadcast_shapes(
        layout.omega.shape, *(part.shape for result in results for part in (result.table, result.lead))
    )
    return tuple(
        replace(result, table=np.broadcast_to(result.table, leading), lead=np.broadcast_to(result.lead, leading))
        for result in results
    )


def _start_deg(machine: ReciprocatingMachine, number: int, record: IndicatedPressure) -> Real:
    """Shaft angle of the outer dead centre from which the pressure of a row counts, degrees."""
    if record.dead_centre_deg is not None:
        return np.asarray(record.dead_centre_deg, dtype=float)
    throw, row = [(throw, row) for throw in machine.throws for row in throw.rows][number]
    sense = 1.0 if machine.rotation == "ccw" else -1.0
    first = np.mod(sense * (row.axis_deg - throw.crank_angle_deg), TURN_DEG)
    # what a rounding has left short of a turn is the beginning of the first
    return np.where(first > TURN_DEG - DEAD_CENTRE_DEG, 0.0, first)


def _trace(
    row: int, chamber: int, record: IndicatedPressure, table: PressureTrace, start_deg: Real, ahead: Real
) -> Trace:
    """One trace, from an entry of the cycle before to one of the next."""
    angle, pressure = (np.atleast_2d(stacked(column)) for column in (table.angle_deg, table.pressure_Pa))
    angle, cycle = np.deg2rad(angle), TURN * record.cycle_turns
    angle = np.concatenate([angle[:, -1:] - cycle, angle, angle[:, :1] + cycle], axis=-1)
    pressure = np.concatenate([pressure[:, -1:], pressure, pressure[:, :1]], axis=-1)
    angle, pressure = np.broadcast_arrays(angle, pressure)
    return Trace(
        row=row,
        side=chamber,
        turns=record.cycle_turns,
        angle=angle,
        pressure=pressure,
        table=np.arange(len(angle)) if len(angle) > 1 else np.zeros((), dtype=np.intp),
        lead=TURN * np.round((np.deg2rad(start_deg) + ahead[..., row]) / TURN),
    )


def cycle_turns(machine: ReciprocatingMachine) -> int:
    """Turns of the shaft after which the gas of all rows repeats, 1 or 2."""
    records = [cylinder.pressure for _, cylinder in _cylinders(machine)]
    return max((record.cycle_turns for record in records if record is not None), default=1)


def entry_count(machine: ReciprocatingMachine) -> int:
    """Entries of all indicated pressures over the turns after which all repeats."""
    turns, records = cycle_turns(machine), [cylinder.pressure for _, cylinder in _cylinders(machine)]
    tables = [(record, table) for record in records if record for table in (record.head, record.crank) if table]
    return sum(len(table.angle_deg) * turns // record.cycle_turns for record, table in tables)


def without_gas(machine: ReciprocatingMachine) -> tuple[Path, ...]:
    """Where rows have no cylinder, by paths from the machine."""
    return tuple(
        ("throws", t, "rows", i, "cylinder")
        for t, throw in enumerate(machine.throws)
        for i, row in enumerate(throw.rows)
        if not any(row_cylinders(row))
    )


def gas_problems(machine: ReciprocatingMachine) -> Iterator[FieldProblem]:
    """Fields that the gas forces of cylinders need and the machine does not give, by paths from the machine."""
    for place, cylinder in _cylinders(machine):
        for field, words in _missing(cylinder):
            yield FieldProblem((*place.path, field), f"gas forces need this field{words}")


def delivery_rules(machine: ReciprocatingMachine, layout: Layout) -> Iterator[Rule]:
    """No chamber whose gas only springs back and forth: that is no cycle of four processes."""
    data = chambers(machine)
    suction, _ = switching_travels(data, layout)
    never = data.closed & np.isnan(suction)
    for place, _ in _cylinders(machine):
        broken = never[..., place.row, place.chamber] | never[..., place.row, place.chamber + 1]
        yield Rule(broken, (*place.path, "relative_clearance"), _NEVER_DELIVERS)


def trace_rules(machine: ReciprocatingMachine, layout: Layout) -> Iterator[Rule]:
    """Not more entries than can be worked on: every row is looked at between any two of them."""
    records = traces(machine, layout)
    if records:
        angles = entries(records, angle_ahead(layout))
        different = 1 + np.count_nonzero(np.diff(angles, axis=-1) > SLIVER, axis=-1)
        many = layout.reciprocating.mass.shape[-1] * different > MAX_ENTRIES
        path = next(place.path for place, cylinder in _cylinders(machine) if cylinder.pressure is not None)
        words = f"rows times the different angles of all indicated pressures must be at most {MAX_ENTRIES}"
        yield Rule(many, (*path, "pressure"), words)


class _Place(NamedTuple):
    """Where a cylinder is: its path from the machine, its row, and its first chamber."""

    path: Path
    row: int
    chamber: int


@remembered
def _cylinders(machine: ReciprocatingMachine) -> tuple[tuple[_Place, Cylinder], ...]:
    rows = [(t, i, row) for t, throw in enumerate(machine.throws) for i, row in enumerate(throw.rows)]
    return tuple(
        (_Place(("throws", t, "rows", i, *at), number, 2 * k), cylinder)
        for number, (t, i, row) in enumerate(rows)
        for k, (at, cylinder) in enumerate(row_cylinders(row))
    )


def _acts(cylinder: Cylinder, side: str) -> bool:
    """Whether a side compresses gas; one without area is none."""
    area = cylinder.head_area_m2 if side == "head" else cylinder.crank_area_m2
    if cylinder.acting is None:
        acts = _indicated(cylinder, side) is not None or cylinder.pressure is None or _has_gas(cylinder, side)
    else:
        acts = cylinder.acting in ("double", side)
    return acts and not _is_none(area)


def _has_gas(cylinder: Cylinder, side: str) -> bool:
    """Whether a side has any of the data of a cycle."""
    return any(value is not None for value in _state(cylinder, side))


def _is_none(area: float | None) -> bool:
    return area is not None and bool(np.all(np.equal(area, 0.0)))


def _indicated(cylinder: Cylinder, side: str) -> PressureTrace | None:
    trace: PressureTrace | None = None if cylinder.pressure is None else getattr(cylinder.pressure, side)
    return trace


def _state(cylinder: Cylinder, side: str) -> tuple[float | None, ...]:
    """Data of the cycle on a side, each its own or else that of both."""
    common: tuple[float | None, ...] = _IN_ORDER(cylinder)
    own = getattr(cylinder, side)
    if own is None:
        return common
    return tuple(default if alone is None else alone for alone, default in zip(_IN_ORDER(own), common, strict=True))


def _areas(cylinder: Cylinder) -> tuple[float | None, float | None]:
    if cylinder.bore_m is None:
        return cylinder.head_area_m2, cylinder.crank_area_m2
    bore, rod = cylinder.bore_m, cylinder.piston_rod_diameter_m
    if rod is None and cylinder.pressure is not None and not _acts(cylinder, "crank"):
        # a trunk piston, open to the crankcase
        rod = 0.0
    crank = None if rod is None else 0.25 * np.pi * (bore - rod) * (bore + rod)
    return 0.25 * np.pi * bore**2, crank


def _missing(cylinder: Cylinder) -> Iterator[tuple[str, str]]:
    """Fields that are missing, with the reason why a computation needs them where it is not plain."""
    head, crank = _areas(cylinder)
    if head is None:
        yield "bore_m", ""
    if crank is None:
        yield "piston_rod_diameter_m" if cylinder.bore_m is not None else "crank_area_m2", ""
    cycled = [side for side in _SIDES if _indicated(cylinder, side) is None]
    areas = dict(zip(_SIDES, (head, crank), strict=True))
    acting = [side for side in cycled if _acts(cylinder, side)]
    open_ = [side for side in cycled if side not in acting and not _is_none(areas[side])]
    if open_ and cylinder.ambient_pressure_Pa is None:
        words = "" if cylinder.pressure is None else f": the {open_[0]} side has no indicated pressure and is open"
        yield "ambient_pressure_Pa", words
    # what both sides have in common is not lacking
    for number, field in ((number, field) for number, field in enumerate(_STATE) if getattr(cylinder, field) is None):
        lacking = [side for side in acting if _state(cylinder, side)[number] is None]
        if lacking:
            words = "" if cylinder.pressure is None else f" on the {lacking[0]} side, which has no indicated pressure"
            if words and cylinder.acting == "double":
                words += "; it is open if acting is left out"
            yield field, words


def _row(cylinder: Cylinder) -> list[list[float | None]]:
    areas = _areas(cylinder)
    return [_side(cylinder, side, area) for side, area in zip(_SIDES, areas, strict=True)]


def _side(cylinder: Cylinder, side: str, area: float | None) -> list[float | None]:
    indication = _indicated(cylinder, side) is not None
    if _acts(cylinder, side) and not indication:
        return [area, *_state(cylinder, side), 1.0]
    # an open side: ambient pressure all the way round, also by default; the other numbers are not used
    ambient = 0.0 if indication or _is_none(area) else cylinder.ambient_pressure_Pa
    return [area, ambient, ambient, 1.0, 2.0, 2.0, 0.0]
