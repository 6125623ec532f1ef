"""Effects over the turn: motion, gas, forces in the mechanism, torque, flywheel, main bearings."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from operator import itemgetter
from typing import Any, TypeVar

from schemas.answer.dynamics import (
    BearingLoad,
    Flywheel,
    Gas,
    Kinematics,
    MainBearings,
    Overturning,
    PistonForce,
    RodLoads,
    RowPistonForce,
    RowSeries,
    Torque,
)
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import ReciprocatingMachine
from service.report.blocks import Block, Chapter, Equation, Figure, Paragraph, Samples, angle, extremes, facts, table
from service.report.chapters.bearing_loci import bearing_loci
from service.report.chapters.inputs import row_name
from service.report.charts import MAX_LINES, Line, chart, over_turn
from service.report.formula import formula
from service.report.indicator import MAX_ROWS, chamber_name, indicators

Row = TypeVar("Row", bound=RowSeries)

_CASES = {"running": "running", "no_load": "no load", "sudden_stop": "sudden stop"}
_INERTIA_ALONE = "inertia only"
_DRY = (
    "Rows without a cylinder have no gas force: their rod loads are of inertia only, and friction where it is given. "
    "They are no rating of rods and bolts."
)
#: rows whose piston forces are drawn part by part
_MAX_APART = 4
_EXTREMES = "Extremes among the samples"
_SIGNS = "Forces are positive in rod tension, torques against rotation."


def figure(
    title: str, unit: str, angle_deg: Sequence[float], lines: Sequence[Line], caption: str, *, tabled: bool = False
) -> Figure:
    """Lines over the turn; of too many, those with the largest values.

    Parameters
    ----------
    tabled : whether the samples are worth reading where there are no drawings.
    """
    samples = Samples(title, unit, angle_deg, lines) if tabled else None
    if len(lines) > MAX_LINES:
        largest = sorted(lines, key=lambda line: -max(abs(value or 0.0) for value in line.values))[:MAX_LINES]
        caption += f" Drawn are the {MAX_LINES} of {len(lines)} with the largest values."
        lines = [line for line in lines if line in largest]
    return Figure((over_turn(title, unit, angle_deg, lines),), caption, samples)


def _lines(machine: Machine, rows: Sequence[Row], values: Callable[[Row], Sequence[float]]) -> list[Line]:
    return [Line(row_name(machine, row.throw, row.row), values(row)) for row in rows]


def _kinematics(machine: Machine, motion: Kinematics) -> Chapter:
    parts = [
        (f"{row_name(machine, row.throw, row.row)}: {quantity}", values)
        for row in motion.rows
        for quantity, values in (
            ("displacement, m", row.displacement_m),
            ("velocity, m/s", row.velocity_m_s),
            ("acceleration, m/s2", row.acceleration_m_s2),
        )
    ]
    series: tuple[tuple[str, str, list[Line]], ...] = (
        ("displacement from outer dead centre", "m", _lines(machine, motion.rows, lambda row: row.displacement_m)),
        ("velocity towards the shaft", "m/s", _lines(machine, motion.rows, lambda row: row.velocity_m_s)),
        ("acceleration towards the shaft", "m/s²", _lines(machine, motion.rows, lambda row: row.acceleration_m_s2)),
    )
    figures = [figure(title, unit, motion.angle_deg, lines, f"{title.capitalize()}.") for title, unit, lines in series]
    return Chapter("Motion", (extremes(_EXTREMES, motion.angle_deg, parts), *figures))


def _gas(machine: Machine, gas: Gas) -> Chapter:
    chambers = [
        (
            row_name(machine, row.throw, row.row),
            chamber_name(row, chamber),
            min(chamber.pressure_Pa),
            max(chamber.pressure_Pa),
            chamber.suction_opens_deg,
            chamber.discharge_opens_deg,
            chamber.indicated_work_J,
        )
        for row in gas.rows
        for chamber in row.chambers
    ]
    pressures = [
        Line(f"{row_name(machine, row.throw, row.row)} {chamber_name(row, chamber)}", chamber.pressure_Pa)
        for row in gas.rows
        for chamber in row.chambers
    ]
    powers = [(row_name(machine, row.throw, row.row), row.indicated_power_W) for row in gas.rows]
    forces = _lines(machine, gas.rows, lambda row: row.force_N)
    heads = [
        "row", "side", "#lowest, Pa", "#highest, Pa", "#suction opens, deg", "#discharge opens, deg",
        "#indicated work per revolution, J",
    ]  # fmt: skip
    words = "Indicator diagrams: absolute pressure over the travel of the piston."
    if len(gas.rows) > MAX_ROWS:
        words += f" Drawn are the first {MAX_ROWS} of {len(gas.rows)} rows."
    return Chapter(
        "Gas",
        (
            table("Chambers: pressures, work, and angles from the row's own outer dead centre", heads, chambers),
            table(
                "Indicated power",
                ["row", "#indicated power, W"],
                [*powers, ("machine", gas.indicated_power_W)],
            ),
            extremes("Gas force on the piston, N", gas.angle_deg, forces),
            *(Figure((drawing,), words if k == 0 else "") for k, drawing in enumerate(indicators(machine, gas))),
            figure("pressure", "Pa", gas.angle_deg, pressures, "Absolute pressure in the chambers."),
            figure("gas force", "N", gas.angle_deg, forces, f"Gas force on the pistons. {_SIGNS}", tabled=True),
        ),
    )


def _piston_force(machine: Machine, forces: PistonForce) -> Chapter:
    parts_by_row = [(row_name(machine, row.throw, row.row), _parts(row)) for row in forces.rows]
    series = [(f"{name}: {part.name}", part.values) for name, parts in parts_by_row for part in parts]
    total = _lines(machine, forces.rows, lambda row: row.total_N)
    words = f"Sum of gas, inertia and friction. {_SIGNS}"
    figures = [figure("piston force", "N", forces.angle_deg, total, words, tabled=True)]
    for name, parts in parts_by_row if len(parts_by_row) <= _MAX_APART else ():
        figures.append(figure(f"row {name}", "N", forces.angle_deg, parts, f"Forces on the piston of row {name}."))
    return Chapter("Piston forces", (extremes(f"{_EXTREMES}, N", forces.angle_deg, series), *figures))


def _parts(row: RowPistonForce) -> list[Line]:
    return [
        Line("gas", row.gas_N),
        Line("inertia", row.inertia_N),
        Line("friction", row.friction_N),
        Line("sum", row.total_N),
    ]


def _rod_loads(machine: Machine, loads: RodLoads) -> Chapter:
    dry = {(row.throw, row.row) for row in loads.rows if not _has_gas(machine, row.throw, row.row)}
    cases = [
        (
            row_name(machine, row.throw, row.row),
            _INERTIA_ALONE
            if (row.throw, row.row) in dry
            else _CASES[case.case] + (" (governs)" if case.case == row.governing_case else ""),
            case.tension_N,
            case.tension_deg,
            case.compression_N,
            case.compression_deg,
        )
        for row in loads.rows
        for case in row.cases
        # without gas there is one case: what turns and moves to and fro
        if (row.throw, row.row) not in dry or case.case == "running"
    ]
    # of inertia alone the largest forces tell all: the curves are cosines and their products
    inertia = len(dry) == len(loads.rows)
    guide_and_pin = [
        (f"{row_name(machine, row.throw, row.row)}: {quantity}", values)
        for row in loads.rows
        for quantity, values in (("side", row.side_N), ("tangential", row.tangential_N), ("radial", row.radial_N))
        if quantity == "side" or not inertia
    ]
    heads = ["row", "load case", "#tension, N", "#at, deg", "#compression, N", "#at, deg"]
    series: tuple[tuple[str, str, list[Line]], ...] = (
        ("rod force", "Force in the connecting rods.", _lines(machine, loads.rows, lambda row: row.rod_N)),
        ("side force", "Force on the crosshead guides.", _lines(machine, loads.rows, lambda row: row.side_N)),
        ("tangential force", "Tangential force on the crank pins.",
         _lines(machine, loads.rows, lambda row: row.tangential_N)),
        ("radial force", "Radial force on the crank pins.", _lines(machine, loads.rows, lambda row: row.radial_N)),
    )  # fmt: skip
    return Chapter(
        "Rod loads",
        (
            *((Paragraph(_DRY, "warning"),) if dry else ()),
            facts("", [("largest rod force of the machine, N", loads.governing_load_N)]),
            table("Rod force by load case", heads, cases),
            extremes(f"Forces on guide{'' if inertia else ' and crank pin'}, N", loads.angle_deg, guide_and_pin),
            *(
                figure(title, "N", loads.angle_deg, lines, f"{caption} {_SIGNS}")
                for title, caption, lines in (() if inertia else series)
            ),
        ),
    )


def _has_gas(machine: Machine, throw: int, row: int) -> bool:
    """Whether a row has a cylinder whose gas acts on its rod."""
    place = machine.throws[throw].rows[row] if isinstance(machine, ReciprocatingMachine) else None
    return place is not None and (place.cylinder is not None or bool(place.cylinders))


def _torque(machine: Machine, torque: Torque) -> Chapter:
    rows = [(row_name(machine, row.throw, row.row), row.mean_torque_Nm) for row in torque.rows]
    by_row = _lines(machine, torque.rows, lambda row: row.torque_Nm)
    total = Line("machine", torque.torque_Nm)
    mean = Line("mean", [torque.mean_torque_Nm] * len(torque.angle_deg))
    tangential = [] if torque.tangential_N is None else [Line("tangential force, N", torque.tangential_N)]
    # inertia alone gives and takes: without gas and friction there is no mean, and no power
    driven = any(mean for _, mean in rows) or bool(torque.rotating_friction_Nm or torque.friction_power_W)
    means = [
        ("mean torque, N m", torque.mean_torque_Nm),
        ("estimate of its error, N m", torque.mean_torque_error_Nm),
        ("rotating friction, N m", torque.rotating_friction_Nm),
        ("indicated power, W", torque.indicated_power_W),
        ("friction power, W", torque.friction_power_W),
        ("shaft power, W", torque.shaft_power_W),
    ]
    lines = [total, mean, *(by_row if len(by_row) <= MAX_LINES - 2 else ())]
    curve = figure("torque", "N m", torque.angle_deg, lines, f"Torque of the shaft. {_SIGNS}")
    return Chapter(
        "Torque",
        (
            Equation(formula("T_m = 1/(2π) ∫ T dθ,   P = T_m omega,   ΔE = range of ∫ (T - T_m) dθ over the cycle")),
            facts(
                "",
                [
                    *(means if driven else ()),
                    ("largest torque over the cycle, N m", torque.peak_Nm),
                    ("fluctuation energy ΔE, J", torque.fluctuation_energy_J),
                    *([("estimate of its error, J", torque.fluctuation_energy_error_J)] if driven else ()),
                ],
            ),
            *((table("Mean torque of the rows", ["row", "#mean torque, N m"], rows),) if driven else ()),
            extremes(f"{_EXTREMES}: torque of rows and machine, N m", torque.angle_deg, [*by_row, total, *tangential]),
            replace(curve, samples=Samples("torque", "N m", torque.angle_deg, [*by_row, total, *tangential])),
        ),
    )


def _flywheel(_machine: Machine, flywheel: Flywheel) -> Chapter:
    rows: list[tuple[str, float | str]] = [
        ("fluctuation energy ΔE, J", flywheel.fluctuation_energy_J),
        ("irregularity δ", flywheel.irregularity),
        ("polar moment of inertia J of all that turns, kg m2", flywheel.inertia_J_kg_m2),
        ("MD2 = 4 J, kg m2", flywheel.inertia_MD2_kg_m2),
    ]
    return Chapter("Flywheel", (Equation(formula("J = ΔE/(omega^2 delta)")), facts("", rows)))


def _overturning(machine: Machine, couple: Overturning) -> Chapter:
    rows = _lines(machine, couple.rows, lambda row: row.couple_Nm)
    lines = [Line("machine", couple.couple_Nm), *(rows if 1 < len(rows) < MAX_LINES else ())]
    words = "Side forces of the crossheads turn the frame with the rotation; the couple equals the torque of the rows."
    return Chapter(
        "Overturning couple",
        (
            Paragraph(words),
            facts("", [("largest couple over the cycle, N m", couple.peak_Nm)]),
            extremes(f"{_EXTREMES}, N m", couple.angle_deg, [*rows, Line("machine", couple.couple_Nm)]),
            figure("overturning couple", "N m", couple.angle_deg, lines, "Overturning couple on the frame."),
        ),
    )


def _main_bearings(machine: Machine, loads: MainBearings) -> Chapter:
    rows = [
        (
            bearing.name,
            bearing.position_m,
            bearing.before.peak_N,
            angle(bearing.before.peak_angle_deg),
            bearing.after.peak_N if bearing.after else None,
            angle(bearing.after.peak_angle_deg if bearing.after else None),
        )
        for bearing in loads.bearings
    ]
    heads = [
        "bearing", "#plane z, m", "#peak without counterweights, N", "#at, deg", "#peak with counterweights, N",
        "#at, deg",
    ]  # fmt: skip
    smooth = [
        (bearing.name, bearing.before.rms_N, bearing.after.rms_N if bearing.after else None, bearing.before.floor_N)
        for bearing in loads.bearings
    ]
    smooth_heads = ["bearing", "#rms without, N", "#rms with, N", "#floor of the peak, N"]
    shaft = {"simple_spans": "every span simply supported", "continuous": "a continuous shaft on rigid bearings"}
    lines = [Line(f"{bearing.name}", _magnitude(bearing.after or bearing.before)) for bearing in loads.bearings]
    state = "with counterweights" if any(bearing.after for bearing in loads.bearings) else "without counterweights"
    bending = [Line("without counterweights", loads.bending.before_Nm)]
    if loads.bending.after_Nm is not None:
        bending.append(Line("with counterweights", loads.bending.after_Nm))
    planes = loads.bending.position_m
    largest = [(line.name, *max(zip(line.values, planes, strict=True), key=itemgetter(0))) for line in bending]
    curve = chart("bending moment", "N m", "plane along the shaft z, m", loads.bending.position_m, bending)
    blocks: list[Block] = [
        Paragraph(f"Taken as {shaft[loads.shaft]}; loads from rows, rotating masses and counterweights."),
        table("Peaks over the cycle", heads, rows),
        table("Root mean square, and what counterweights cannot go below", smooth_heads, smooth),
        table("Largest bending moment", ["", "#moment, N m", "#in the plane z, m"], largest),
        figure("bearing load", "N", loads.angle_deg, lines, f"Magnitude of the load of the main bearings, {state}."),
        Figure((curve,), "Largest bending moment inside the shaft over the cycle, plane by plane."),
    ]
    blocks += bearing_loci(machine, loads)
    return Chapter("Main bearings", tuple(blocks))


def _magnitude(load: BearingLoad) -> list[float]:
    return list(map(math.hypot, load.force_x_N, load.force_y_N))


#: chapters of the outputs over the turn
OVER_THE_TURN: Mapping[str, Callable[[Machine, Any], Chapter]] = {
    "kinematics": _kinematics,
    "gas": _gas,
    "piston_force": _piston_force,
    "rod_loads": _rod_loads,
    "torque": _torque,
    "flywheel": _flywheel,
    "overturning": _overturning,
    "main_bearings": _main_bearings,
}
