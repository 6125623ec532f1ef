"""The dynamics as readable tables: the figures that matter, and a coarse look at what is sampled over the turn."""

from collections.abc import Iterable, Iterator, Sequence
from typing import TypeVar

from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from schemas.answers import Outputs
from schemas.dynamics import (
    Flywheel,
    Gas,
    Kinematics,
    MainBearings,
    Overturning,
    PistonForce,
    RodLoads,
    RowSeries,
    Torque,
)
from service.cells import Cell, add, number, table

Row = TypeVar("Row", bound=RowSeries)
Series = tuple[str, Sequence[float]]

_COARSE_STEPS = 12
_SERIES_SIDE_BY_SIDE = 6


def dynamics(answer: Outputs) -> Iterator[RenderableType]:
    """Tables of the outputs over the turn that an answer holds."""
    if answer.kinematics is not None:
        yield from _kinematics(answer.kinematics)
    if answer.gas is not None:
        yield from _gas(answer.gas)
    if answer.piston_force is not None:
        yield from _piston_force(answer.piston_force)
    if answer.rod_loads is not None:
        yield from _rod_loads(answer.rod_loads)
    if answer.torque is not None:
        yield from _torque(answer.torque)
    if answer.flywheel is not None:
        yield _flywheel(answer.flywheel)
    if answer.overturning is not None:
        yield from _overturning(answer.overturning)
    if answer.main_bearings is not None:
        yield from _main_bearings(answer.main_bearings)


def _kinematics(found: Kinematics) -> Iterator[Table]:
    parts: list[Series] = []
    for label, row in _labelled(found.rows):
        parts += [(f"{label}: displacement, m", row.displacement_m), (f"{label}: velocity, m/s", row.velocity_m_s)]
        parts += [(f"{label}: acceleration, m/s2", row.acceleration_m_s2)]
    yield _extremes("motion", found.angle_deg, parts)


def _gas(found: Gas) -> Iterator[RenderableType]:
    columns = ("row", "side", "lowest, Pa", "highest, Pa", "suction opens, deg", "discharge opens, deg", "work, J")
    sides = table("gas: pressures, opening of the valves by own crank angle, indicated work of a turn", *columns)
    for label, row in _labelled(found.rows):
        for side in row.chambers:
            opens = (side.suction_opens_deg, side.discharge_opens_deg)
            add(sides, label, side.side, min(side.pressure_Pa), max(side.pressure_Pa), *opens, side.indicated_work_J)
    yield sides
    powers = [(label, row.indicated_power_W) for label, row in _labelled(found.rows)]
    yield _figures("indicated power, W", *powers, ("all rows", found.indicated_power_W))
    forces = [(label, row.force_N) for label, row in _labelled(found.rows)]
    yield _extremes("gas force on the piston, N", found.angle_deg, forces)
    yield from _over_the_turn("gas force", "N", found.angle_deg, forces)


def _piston_force(found: PistonForce) -> Iterator[Table]:
    parts: list[Series] = []
    for label, row in _labelled(found.rows):
        parts += [(f"{label}: gas", row.gas_N), (f"{label}: inertia", row.inertia_N)]
        parts += [(f"{label}: friction", row.friction_N), (f"{label}: sum", row.total_N)]
    yield _extremes("piston force, N", found.angle_deg, parts)
    sums = [(label, row.total_N) for label, row in _labelled(found.rows)]
    yield from _over_the_turn("piston force", "N", found.angle_deg, sums)


def _rod_loads(found: RodLoads) -> Iterator[RenderableType]:
    cases = table("rod loads", "row", "case", "tension, N", "at, deg", "compression, N", "at, deg", "")
    for label, row in _labelled(found.rows):
        for one in row.cases:
            governs = f"governs: {number(row.governing_load_N)} N" if one.case == row.governing_case else ""
            extremes = (one.tension_N, one.tension_deg, one.compression_N, one.compression_deg)
            add(cases, label, one.case.replace("_", " "), *extremes, governs)
    yield cases
    parts: list[Series] = []
    for label, row in _labelled(found.rows):
        parts += [(f"{label}: side", row.side_N), (f"{label}: tangential", row.tangential_N)]
        parts += [(f"{label}: radial", row.radial_N)]
    yield _extremes("forces on guide and crank pin, N", found.angle_deg, parts)
    yield Text(f"largest rod force of the machine {number(found.governing_load_N)} N")


def _torque(found: Torque) -> Iterator[RenderableType]:
    rows: list[Series] = [(label, row.torque_Nm) for label, row in _labelled(found.rows)]
    total: Series = ("all, with friction", found.torque_Nm)
    tangential: list[Series] = [] if found.tangential_N is None else [("tangential force, N", found.tangential_N)]
    yield _extremes("torque against rotation, N m", found.angle_deg, [*rows, total, *tangential])
    means = [(f"mean of {label}, N m", row.mean_torque_Nm) for label, row in _labelled(found.rows)]
    yield _figures(
        "torque and powers",
        *means,
        ("rotating friction, N m", found.rotating_friction_Nm),
        ("mean, N m", _with_error(found.mean_torque_Nm, found.mean_torque_error_Nm)),
        ("indicated power, W", found.indicated_power_W),
        ("friction power, W", found.friction_power_W),
        ("shaft power, W", found.shaft_power_W),
        ("fluctuation energy, J", _with_error(found.fluctuation_energy_J, found.fluctuation_energy_error_J)),
    )
    yield from _over_the_turn("torque", "N m", found.angle_deg, [*rows, total, *tangential])


def _flywheel(found: Flywheel) -> Table:
    return _figures(
        "flywheel",
        ("fluctuation energy, J", found.fluctuation_energy_J),
        ("irregularity", found.irregularity),
        ("inertia J, kg m2", found.inertia_J_kg_m2),
        ("inertia MD^2, kg m2", found.inertia_MD2_kg_m2),
    )


def _overturning(found: Overturning) -> Iterator[RenderableType]:
    rows: list[Series] = [(label, row.couple_Nm) for label, row in _labelled(found.rows)]
    yield _extremes("overturning couple, N m", found.angle_deg, [*rows, ("all rows", found.couple_Nm)])
    yield Text(f"largest overturning couple {number(found.peak_Nm)} N m")


def _main_bearings(found: MainBearings) -> Iterator[Table]:
    shaft = found.shaft.replace("_", " ")
    columns = ("bearing", "position, m", "peak before, N", "at, deg", "peak after, N", "at, deg")
    loads = table(f"main bearings ({shaft})", *columns)
    for one in found.bearings:
        after = (None, None) if one.after is None else (one.after.peak_N, one.after.peak_angle_deg)
        add(loads, one.name, one.position_m, one.before.peak_N, one.before.peak_angle_deg, *after)
    yield loads
    bending = table("largest bending moment of the shaft", "", "moment, N m", "in the plane, m")
    moments = {"before": found.bending.before_Nm, "after": found.bending.after_Nm}
    for name, values in moments.items():
        if values:
            largest = max(range(len(values)), key=values.__getitem__)
            add(bending, name, values[largest], found.bending.position_m[largest])
    yield bending


def _labelled(rows: Sequence[Row]) -> Iterator[tuple[str, Row]]:
    """Rows with their names; with their places where the names do not tell them apart."""
    names = [row.name for row in rows]
    distinct = None not in names and len(set(names)) == len(names)
    for row in rows:
        place = f"throw {row.throw + 1} row {row.row + 1}"
        yield (row.name or "") if distinct else " ".join(filter(None, (place, row.name))), row


def _figures(title: str, *figures: tuple[str, Cell]) -> Table:
    found = table(title, "", "value")
    for name, value in figures:
        add(found, name, value)
    return found


def _with_error(value: float, error: float) -> str:
    return f"{number(value)} ± {error:.1e}"


def _extremes(title: str, angle_deg: Sequence[float], series: Iterable[Series]) -> Table:
    """Largest and smallest sample of every series, and where."""
    found = table(title, "", "largest", "at, deg", "smallest", "at, deg")
    for name, values in series:
        samples = range(len(values))
        high, low = max(samples, key=values.__getitem__), min(samples, key=values.__getitem__)
        add(found, name, values[high], angle_deg[high], values[low], angle_deg[low])
    return found


def _over_the_turn(title: str, unit: str, angle_deg: Sequence[float], series: Sequence[Series]) -> Iterator[Table]:
    """Every 30 degrees, as nearly as the samples allow."""
    stride = max(1, round(len(angle_deg) / _COARSE_STEPS))
    for first in range(0, len(series), _SERIES_SIDE_BY_SIDE):
        some = series[first : first + _SERIES_SIDE_BY_SIDE]
        found = table(f"{title} over the turn, {unit}", "angle, deg", *(name for name, _ in some))
        for k in range(0, len(angle_deg), stride):
            add(found, angle_deg[k], *(values[k] for _, values in some))
        yield found
