"""Cylinders of a machine as arrays, and what is missing or impossible in their data."""

from collections.abc import Iterator

import numpy as np

from optimizer.mechanics.gas import Chambers, switching_travels
from optimizer.mechanics.layout import Layout, stacked
from schemas.base import FieldProblem
from schemas.cylinder import Cylinder
from schemas.machine import ReciprocatingMachine
from schemas.rules import Path, Rule

_SIDES = ("head", "crank")
_STATE = (
    "suction_pressure_Pa",
    "discharge_pressure_Pa",
    "relative_clearance",
    "expansion_exponent",
    "compression_exponent",
)
_NEVER_DELIVERS = "with this clearance and pressure ratio the chamber never delivers"


def chambers(machine: ReciprocatingMachine, leading: tuple[int, ...] = ()) -> Chambers:
    """Chambers of all rows (..., rows, 2), throw by throw; every cylinder has complete data (``gas_problems``).

    A row without a cylinder has pistons without area. Fields may hold columns, as in
    :func:`optimizer.mechanics.layout.layout`.

    Parameters
    ----------
    leading : axes that every array is to have, whatever depends on columns.
    """
    rows = [_row(row.cylinder) for throw in machine.throws for row in throw.rows]

    values = stacked([row[side][number] for number in range(7) for row in rows for side in (0, 1)])
    axes = np.broadcast_shapes(leading, values.shape[:-1])
    table = np.broadcast_to(values, (*axes, values.shape[-1])).reshape(*axes, 7, len(rows), 2)
    area, low, high, clearance, expansion, compression, closed = np.moveaxis(table, -3, 0)
    return Chambers(area, low, high, clearance, expansion, compression, closed.astype(bool))


def without_gas(machine: ReciprocatingMachine) -> tuple[Path, ...]:
    """Where rows have no cylinder, by paths from the machine."""
    return tuple(path for path, cylinder in _cylinders(machine) if cylinder is None)


def gas_problems(machine: ReciprocatingMachine) -> Iterator[FieldProblem]:
    """Fields that the gas forces of cylinders need and the machine does not give, by paths from the machine."""
    for path, cylinder in _cylinders(machine):
        if cylinder is not None:
            for field in _missing(cylinder):
                yield FieldProblem((*path, field), "gas forces need this field")


def delivery_rules(machine: ReciprocatingMachine, layout: Layout) -> Iterator[Rule]:
    """No chamber whose gas only springs back and forth: that is no cycle of four processes."""
    data = chambers(machine)
    suction, _ = switching_travels(data, layout)
    never = np.any(data.closed & np.isnan(suction), axis=-1)
    for number, (path, _) in enumerate(_cylinders(machine)):
        yield Rule(never[..., number], (*path, "relative_clearance"), _NEVER_DELIVERS)


def _cylinders(machine: ReciprocatingMachine) -> Iterator[tuple[Path, Cylinder | None]]:
    for t, throw in enumerate(machine.throws):
        for i, row in enumerate(throw.rows):
            yield ("throws", t, "rows", i, "cylinder"), row.cylinder


def _acts(cylinder: Cylinder, side: str) -> bool:
    return cylinder.acting in ("double", side)


def _value(cylinder: Cylinder, side: str, field: str) -> float | None:
    own = getattr(cylinder, side)
    value: float | None = None if own is None else getattr(own, field)
    return getattr(cylinder, field) if value is None else value


def _areas(cylinder: Cylinder) -> tuple[float | None, float | None]:
    if cylinder.bore_m is None:
        return cylinder.head_area_m2, cylinder.crank_area_m2
    bore, rod = cylinder.bore_m, cylinder.piston_rod_diameter_m
    crank = None if rod is None else 0.25 * np.pi * (bore - rod) * (bore + rod)
    return 0.25 * np.pi * bore**2, crank


def _missing(cylinder: Cylinder) -> Iterator[str]:
    head, crank = _areas(cylinder)
    if head is None:
        yield "bore_m"
    if crank is None:
        yield "piston_rod_diameter_m" if cylinder.bore_m is not None else "crank_area_m2"
    if cylinder.acting != "double" and cylinder.ambient_pressure_Pa is None:
        yield "ambient_pressure_Pa"
    for field in _STATE:
        if any(_acts(cylinder, side) and _value(cylinder, side, field) is None for side in _SIDES):
            yield field


def _row(cylinder: Cylinder | None) -> list[list[float | None]]:
    if cylinder is None:
        return [[0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 0.0]] * 2
    areas = _areas(cylinder)
    ambient = cylinder.ambient_pressure_Pa
    return [
        [area, *(_value(cylinder, side, field) for field in _STATE), 1.0]
        if _acts(cylinder, side)
        # an open side: ambient pressure all the way round; the other numbers are not used
        else [area, ambient, ambient, 1.0, 2.0, 2.0, 0.0]
        for side, area in zip(_SIDES, areas, strict=True)
    ]
