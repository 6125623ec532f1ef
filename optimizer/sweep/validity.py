"""Which designs are valid requests: the rules of the schema, design by design at once.

Each finding is a mask of the designs (n,), or one verdict for all, with the field at fault and what is said of it.
The schema has checked the base, so only rules that a varied field can break are worth their arithmetic; a rule
between fields that hold no columns comes out as for the base.
"""

import operator
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import combinations, pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from optimizer.arrays import Real
from optimizer.effects.registry import EFFECTS, closure
from optimizer.mechanics.cylinders import chambers, gas_problems
from optimizer.mechanics.gas import switching_travels
from optimizer.mechanics.layout import layout, stacked
from optimizer.outputs import OUTPUTS
from optimizer.sweep.variation import field_at
from schemas.cylinder import Cylinder
from schemas.machine import Machine, ReciprocatingMachine, ScrollMachine
from schemas.over_turn import ForceTable, TorqueTable
from schemas.requests import AnalyzeRequest, OptimizeRequest
from schemas.sweep import Target
from schemas.sweep.target import Path

Mask = NDArray[np.bool_]
Question = OptimizeRequest | AnalyzeRequest
_COMPARE: Mapping[str, Callable[[Real, float], Mask]] = {
    ">": operator.gt,
    ">=": operator.ge,
    "<": operator.lt,
    "<=": operator.le,
}


class Finding(NamedTuple):
    """Designs that break a rule: all of them where ``broken`` is a single verdict."""

    broken: Any
    path: Path
    message: str


def range_findings(targets: Sequence[Target], values: Sequence[Real]) -> Iterator[Finding]:
    """Values outside the ranges of their fields; nan stands for null, which the field takes."""
    for target, value in zip(targets, values, strict=True):
        null = np.isnan(value)
        for symbol, bound, message in target.refusals():
            yield Finding(~(null | _COMPARE[symbol](value, bound)), target.path, message)
        if target.integer:
            yield Finding(~null & (value != np.round(value)), target.path, "must be a whole number")


def rule_findings(request: Question) -> Iterator[Finding]:
    """Rules between the fields of a request of columns."""
    for broken, path, message in _machine_findings(request.machine):
        yield Finding(broken, ("machine", *path), message)
    if isinstance(request, OptimizeRequest):
        goal, across = request.objective, request.objective.direction_weights
        at_fault = ("objective", "direction_weights", "y")
        message = "only one of the two direction weights may be 0"
        yield Finding((across.x == 0) & (across.y == 0), at_fault, message)
        if goal.moment_weight is not None:
            neither = (goal.force_weight == 0) & (goal.moment_weight == 0)
            yield Finding(neither, ("objective", "moment_weight"), "only one of the two weights may be 0")


def input_findings(request: Question, one: Question) -> Iterator[Finding]:
    """What the outputs need and the designs do not give.

    Parameters
    ----------
    one : the same request with numbers instead of columns; what is missing is missing in all.
    """
    machine = request.machine
    names = {name for output in request.outputs for name in closure(one.machine, OUTPUTS[output].needs)}
    missing = [
        Finding(True, path, f"{message}; asked for by output '{output}'")
        for path, output, message in missing_inputs(one)
    ]
    yield from missing
    if missing:
        return
    if "gas" in names and isinstance(machine, ReciprocatingMachine):
        data = chambers(machine)
        suction, _ = switching_travels(data, layout(machine))
        never = np.any(data.closed & np.isnan(suction), axis=-1)
        message = "with this clearance and pressure ratio the chamber never delivers"
        places = [(t, i) for t, throw in enumerate(machine.throws) for i in range(len(throw.rows))]
        for number, (t, i) in enumerate(places):
            path = ("machine", "throws", t, "rows", i, "cylinder", "relative_clearance")
            yield Finding(never[..., number], path, message)
    if "pin_loads" in names and isinstance(machine, ScrollMachine) and machine.tangential_gas_force_N is not None:
        # the one range of a scroll machine that is wider than that of the pins
        orbit = np.asarray(machine.orbit_radius_m)
        broken = ~((orbit >= 1e-6) & (orbit <= 1e6))
        yield Finding(broken, ("machine", "orbit_radius_m"), "must be between 1e-06 and 1e+06 for pin loads")


def missing_inputs(request: Question) -> Iterator[tuple[Path, str, str]]:
    """Fields that the outputs of one request need and that are not there: path, output, message."""
    for output in request.outputs:
        for name in closure(request.machine, OUTPUTS[output].needs):
            problems = EFFECTS[name].problems(request.machine)
            if name == "gas" and isinstance(request.machine, ReciprocatingMachine):
                # whether a chamber delivers is a matter of numbers, and so of each design
                problems = gas_problems(request.machine)
            for path, message in problems:
                # a field that holds a number is not missing: the number is wrong, in this design
                if not isinstance(field_at(request.machine, path), int | float):
                    yield ("machine", *path), output, message


def _machine_findings(machine: Machine) -> Iterator[Finding]:
    if isinstance(machine, ScrollMachine):
        yield from _scroll_findings(machine)
        return
    for t, throw in enumerate(machine.throws):
        for i, row in enumerate(throw.rows):
            path: Path = ("throws", t, "rows", i)
            rod = row.connecting_rod
            if rod is not None and rod.length_m is not None:
                too_short = ~(np.asarray(rod.length_m) > throw.crank_radius_m)
                message = "the connecting rod must be longer than the crank radius"
                yield Finding(too_short, (*path, "connecting_rod", "length_m"), message)
            if row.cylinder is not None:
                yield from _cylinder_findings((*path, "cylinder"), row.cylinder)
    yield from _drive_findings(machine)


def _cylinder_findings(path: Path, cylinder: Cylinder) -> Iterator[Finding]:
    common_low, common_high = cylinder.suction_pressure_Pa, cylinder.discharge_pressure_Pa
    if common_low is not None and common_high is not None:
        message = "must not be below the suction pressure"
        yield Finding(np.asarray(common_high) < common_low, (*path, "discharge_pressure_Pa"), message)
    for side, state in (("head", cylinder.head), ("crank", cylinder.crank)):
        if state is None or (state.suction_pressure_Pa is None and state.discharge_pressure_Pa is None):
            continue
        low = common_low if state.suction_pressure_Pa is None else state.suction_pressure_Pa
        high = common_high if state.discharge_pressure_Pa is None else state.discharge_pressure_Pa
        if low is None or high is None:
            continue
        if state.discharge_pressure_Pa is None:
            field, message = "suction_pressure_Pa", "must not be above the discharge pressure"
        else:
            field, message = "discharge_pressure_Pa", "must not be below the suction pressure"
        yield Finding(np.asarray(high) < low, (*path, side, field), message)
    rod, bore = cylinder.piston_rod_diameter_m, cylinder.bore_m
    if rod is not None and bore is not None:
        yield Finding(~(np.asarray(rod) < bore), (*path, "piston_rod_diameter_m"), "must be smaller than the bore")
    if bore is not None:
        for area in ("head_area_m2", "crank_area_m2"):
            message = "give either the bore or the piston areas"
            yield Finding(getattr(cylinder, area) is not None, (*path, area), message)


def _drive_findings(machine: ReciprocatingMachine) -> Iterator[Finding]:
    friction, flywheel = machine.friction, machine.flywheel
    if friction is not None:
        given = friction.reciprocating_force_N is not None or friction.rotating_torque_Nm is not None
        path: Path = ("friction", "mechanical_efficiency")
        if friction.mechanical_efficiency is None:
            yield Finding(not given, path, "give the efficiency, or friction forces and torque")
            useless = friction.indicated_power_W is not None
            yield Finding(useless, ("friction", "indicated_power_W"), "serves only with a mechanical efficiency")
        else:
            yield Finding(given, path, "give either the efficiency or friction forces and torque")
    if flywheel is not None:
        both = (flywheel.irregularity is None) == (flywheel.inertia_kg_m2 is None)
        yield Finding(both, ("flywheel", "irregularity"), "give either the irregularity or the inertia")
    places = [np.asarray(bearing.position_m, dtype=float) for bearing in machine.bearings]
    if places:
        all_places = stacked(places)
        extent = np.max(all_places, axis=-1) - np.min(all_places, axis=-1)
        # nearer than this no arithmetic tells them apart
        near = np.maximum(1e-8 * extent, 1e-14 * np.max(np.abs(all_places), axis=-1))
        for (_, first), (k, second) in combinations(enumerate(places), 2):
            coincide = np.abs(first - second) <= near
            yield Finding(coincide, ("bearings", k, "position_m"), "another bearing is in this plane")


def _scroll_findings(machine: ScrollMachine) -> Iterator[Finding]:
    both = machine.rotation_torque_Nm is not None and machine.tangential_gas_force_N is not None
    yield Finding(both, ("rotation_torque_Nm",), "give either the torque or the gas force")
    for name in ("rotation_torque_Nm", "tangential_gas_force_N"):
        table = getattr(machine, name)
        if isinstance(table, TorqueTable | ForceTable):
            values = table.torque_Nm if isinstance(table, TorqueTable) else table.force_N
            held = "torque_Nm" if isinstance(table, TorqueTable) else "force_N"
            yield from _table_findings((name,), table.angle_deg, values, held)


def _table_findings(path: Path, angles: Sequence[Any], values: Sequence[Any], name: str) -> Iterator[Finding]:
    for k, (left, right) in enumerate(pairwise(angles), start=1):
        yield Finding(~(np.asarray(left) < right), (*path, "angle_deg", k), "the angles must rise")
    ends_turn = np.asarray(angles[-1]) == 360.0
    late = ends_turn & (np.asarray(angles[0]) != 0.0)
    message = "360 ends the turn only if the table begins at 0"
    yield Finding(late, (*path, "angle_deg", len(angles) - 1), message)
    jumps = ends_turn & (np.asarray(values[-1]) != values[0])
    message = "the value at 360 must be that at 0: the table is one turn"
    yield Finding(jumps, (*path, name, len(values) - 1), message)
    if len(angles) < 3:
        message = "must hold at least two different angles of the turn"
        yield Finding(ends_turn, (*path, "angle_deg"), message)
