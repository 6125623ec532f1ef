"""The cylinders of a design: sizes, gas, indicated pressures."""

from collections.abc import Iterator

from schemas.machine.cylinder import Cylinder
from service.report.blocks import Block, table

_ACTING = {"double": "both sides", "head": "head side", "crank": "crank side", None: "sides with gas data"}


def cylinders(entries: list[tuple[str, Cylinder]]) -> Iterator[Block]:
    """Tables of cylinders by name."""
    yield table(
        "Cylinders",
        [
            "row", "acting", "#bore, m", "#piston rod, m", "#head area, m2", "#crank area, m2",
            "#ambient pressure, Pa",
        ],
        [
            (
                name, _ACTING[cylinder.acting], cylinder.bore_m, cylinder.piston_rod_diameter_m, cylinder.head_area_m2,
                cylinder.crank_area_m2, cylinder.ambient_pressure_Pa,
            )
            for name, cylinder in entries
        ],
    )  # fmt: skip
    states = [
        (name, side, state)
        for name, cylinder in entries
        for side, state in (("both", cylinder), ("head", cylinder.head), ("crank", cylinder.crank))
        if state is not None
    ]
    gas = [
        (
            name, side, state.suction_pressure_Pa, state.discharge_pressure_Pa, state.relative_clearance,
            state.expansion_exponent, state.compression_exponent,
        )
        for name, side, state in states
    ]  # fmt: skip
    # what is indicated needs none of it
    stated = [row for row in gas if any(value is not None for value in row[2:])]
    if stated:
        heads = [
            "row", "side", "#suction, Pa", "#discharge, Pa", "#relative clearance", "#expansion exponent",
            "#compression exponent",
        ]  # fmt: skip
        yield table("Gas", heads, stated)
    yield from _pressures(entries)


def _pressures(entries: list[tuple[str, Cylinder]]) -> Iterator[Block]:
    """Indicated pressures: how many entries, over how many turns, from where to where."""
    rows = [
        (
            name, side, indicated.cycle_turns,
            "the first" if indicated.dead_centre_deg is None else indicated.dead_centre_deg,
            len(trace.angle_deg), min(trace.pressure_Pa), max(trace.pressure_Pa),
        )
        for name, cylinder in entries
        if (indicated := cylinder.pressure) is not None
        for side, trace in (("head", indicated.head), ("crank", indicated.crank))
        if trace is not None
    ]  # fmt: skip
    if rows:
        heads = [
            "row", "side", "#turns in a cycle", "#from the dead centre at, deg", "#entries", "#lowest, Pa",
            "#highest, Pa",
        ]  # fmt: skip
        yield table("Indicated pressures, linear between their entries", heads, rows)
