"""Columns in detail: figures of a single answer that rows of a sweep hold only where they are asked for by name, or all
of them by ``details``. Each costs time or room that most sweeps have no use for.
"""

from collections.abc import Iterator, Sequence
from typing import Literal, NamedTuple

from schemas.answer.outputs import COLUMNS_OF_PARTS, OUTPUT_COLUMNS, Column, labels
from schemas.base.model import Model
from schemas.base.rules import Path
from schemas.base.target import pointer
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.throws import row_cylinders

Case = Literal["running", "no_load", "sudden_stop"]
#: load cases of a rod
CASES: tuple[Case, ...] = ("running", "no_load", "sudden_stop")
_SIDES = ("head", "crank")

Of = Literal["machine", "throws", "bearings", "rows", "cases", "chambers"]


class Part(NamedTuple):
    """What a column is about.

    label : follows the name of the column after a dot; empty for the machine as a whole.
    path : to the part, from the machine.
    """

    label: str
    path: Path


class Details(NamedTuple):
    """Columns for each of some parts of the machine."""

    of: Of
    columns: tuple[Column, ...]

    @property
    def keys(self) -> tuple[str, ...]:
        """Their names without the parts; with the dot before these, where there are any."""
        return tuple(column.name if self.of == "machine" else f"{column.name}." for column in self.columns)


def key(name: str) -> str:
    """The name of a column without what it is about."""
    start, dot, _ = name.partition(".")
    return start + dot


def usual_keys(output: str) -> frozenset[str]:
    """Keys of the columns that an output brings wherever it is asked for."""
    each = COLUMNS_OF_PARTS[output].columns if output in COLUMNS_OF_PARTS else ()
    of_parts = (f"{column.name}." for column in each)
    return frozenset((*(key(column.name) for column in OUTPUT_COLUMNS.get(output, ())), *of_parts))


def parts_of(machine: Machine, of: Of) -> Iterator[Part]:
    """The parts of a machine that columns are about, in its order; rows throw by throw."""
    if of == "machine":
        yield Part("", ())
    elif isinstance(machine, ReciprocatingMachine):
        if of == "throws":
            yield from _named("throws", machine.throws)
        elif of == "bearings":
            yield from _named("bearings", machine.bearings)
        else:
            for label, path in _rows(machine):
                yield from _within(machine, of, label, path)


def _named(field: str, parts: Sequence[Model]) -> Iterator[Part]:
    for k, label in enumerate(labels([getattr(part, "name", None) for part in parts])):
        yield Part(label, (field, k))


def _rows(machine: ReciprocatingMachine) -> Iterator[Part]:
    rows = [(t, i, row) for t, throw in enumerate(machine.throws) for i, row in enumerate(throw.rows)]
    names = [row.name for _, _, row in rows]
    # their names need be unique on a throw only
    apart = labels(names if len(set(names)) == len(names) else [None] * len(names))
    for (t, i, _), label in zip(rows, apart, strict=True):
        yield Part(label, ("throws", t, "rows", i))


def _within(machine: ReciprocatingMachine, of: Of, label: str, path: Path) -> Iterator[Part]:
    """A row, or what it has several of."""
    if of == "rows":
        yield Part(label, path)
    elif of == "cases":
        yield from (Part(f"{label}.{case}", path) for case in CASES)
    else:
        cylinders = [*row_cylinders(machine.throws[int(path[1])].rows[int(path[3])])]
        for within, cylinder in zip(
            labels([getattr(each, "name", None) for _, each in cylinders]), cylinders, strict=True
        ):
            place = label if len(cylinders) == 1 else f"{label}.{within}"
            yield from (Part(f"{place}.{side}", (*path, *cylinder[0])) for side in _SIDES)


def _number(name: str, unit: str | None, meaning: str) -> Column:
    return Column(name, "number", unit, meaning)


def _ellipse(quantity: str, short: str, unit: str) -> Iterator[Column]:
    of = f"first-order {quantity} with the counterweights"
    yield _number(f"{quantity}_minor_{short}", unit, f"minor semi-axis of the ellipse of the {of}")
    yield _number(f"{quantity}_peak_x_{short}", unit, f"peak along x of the {of}")
    yield _number(f"{quantity}_peak_y_{short}", unit, f"peak along y of the {of}")
    yield _number(f"{quantity}_co_rotating_{short}", unit, f"size of the co-rotating phasor of the {of}")
    yield _number(f"{quantity}_counter_rotating_{short}", unit, f"size of the counter-rotating phasor of the {of}")


#: by output
DETAILS: dict[str, tuple[Details, ...]] = {
    "residual": (Details("machine", (*_ellipse("force", "N", "N"), *_ellipse("moment", "Nm", "N m"))),),
    "gas": (
        Details("rows", (_number("indicated_power_W", "W", "power put into the gas of this row"),)),
        Details(
            "chambers",
            (
                _number("indicated_work_J", "J", "work put into the gas of this chamber in one revolution"),
                _number("suction_opens_deg", "deg", "own crank angle at which its suction opens"),
                _number("discharge_opens_deg", "deg", "own crank angle at which its discharge opens"),
            ),
        ),
    ),
    "piston_force": (
        Details(
            "rows",
            (
                _number("piston_tension_N", "N", "largest sum of the forces on this piston over the cycle"),
                _number("piston_compression_N", "N", "smallest sum of the forces on this piston over the cycle"),
            ),
        ),
    ),
    "rod_loads": (
        Details(
            "rows",
            (
                _number("rod_load_N", "N", "largest rod force of this row of all load cases, magnitude"),
                _number("peak_side_N", "N", "largest force on the guide of this row over the cycle, magnitude"),
            ),
        ),
        Details(
            "cases",
            (
                _number("rod_tension_N", "N", "largest rod force in this load case, 0 if there is no tension"),
                _number("rod_compression_N", "N", "smallest rod force in this load case, 0 if there is no compression"),
            ),
        ),
    ),
    "torque": (
        Details("rows", (_number("mean_torque_Nm", "N m", "mean torque of this row over the cycle"),)),
        Details("machine", (_number("rotating_friction_Nm", "N m", "rotating friction, constant"),)),
    ),
    "flywheel": (
        Details(
            "machine",
            (
                _number("fluctuation_energy_J", "J", "energy that a flywheel takes up and gives back"),
                _number("inertia_MD2_kg_m2", "kg m2", "the customary MD^2 = 4 J of all that turns"),
            ),
        ),
    ),
    "loads": (
        Details(
            "rows",
            (
                _number(
                    "reciprocating_mass_kg", "kg", "what moves along the axis of this row, with its share of the rod"
                ),
                _number("rod_rotating_mass_kg", "kg", "the rest of its rod, at the crank pin"),
                _number("rotating_mass_kg", "kg", "all that turns at the crank pin in the plane of this row"),
                _number("largest_gas_N", "N", "largest gas force of this row among the samples, magnitude"),
                _number("largest_inertia_N", "N", "largest inertia force among the samples, magnitude"),
                _number("largest_piston_force_N", "N", "largest sum of all of them over the cycle, magnitude"),
                _number("piston_rod_N", "N", "for piston rod and pin: the largest of the three"),
                _number("crosshead_pin_N", "N", "largest rod force of this row running, over the cycle, magnitude"),
                _number("stop_at_outer_dead_centre_N", "N", "gas force of a sudden stop at its outer dead centre"),
                _number("stop_at_inner_dead_centre_N", "N", "gas force of a sudden stop at its inner dead centre"),
                _number("stop_over_the_turn_N", "N", "largest rod force of a sudden stop anywhere, magnitude"),
                _number("frame_tension_N", "N", "largest pull of its gas at the frame among the samples"),
                _number("frame_compression_N", "N", "largest push of its gas at the frame among the samples, negative"),
                _number("frame_mean_N", "N", "midway between the largest and the smallest"),
                _number("frame_amplitude_N", "N", "half of their difference"),
                _number("guide_weight_N", "N", "weight on the guide of this row, across the axis"),
                _number("guide_largest_N", "N", "largest force towards the lower guide among the samples"),
                _number("guide_smallest_N", "N", "smallest; negative where it bears on the upper guide"),
                _number("guide_lifted_share", None, "share of the samples at which it is off the lower guide"),
            ),
        ),
        Details(
            "chambers",
            (
                _number("cover_largest_N", "N", "largest gas force on this end of the cylinder among the samples"),
                _number("cover_smallest_N", "N", "smallest gas force on it among the samples"),
            ),
        ),
        Details(
            "throws",
            (_number("throw_rotating_mass_kg", "kg", "unbalanced rotating mass at this crank, with the rods' parts"),),
        ),
        Details(
            "bearings",
            (
                _number("bearing_weight_x_N", "N", "x of the weight on this bearing, with gravity_deg"),
                _number("bearing_weight_y_N", "N", "y of the weight on this bearing, with gravity_deg"),
            ),
        ),
        Details(
            "machine",
            (
                _number("driver_Nm", "N m", "mean torque: the constant torque of the driver"),
                _number("foundation_weight_N", "N", "weight of the machine, with stationary_mass_kg"),
            ),
        ),
    ),
    "main_bearings": (
        Details(
            "bearings",
            (
                _number("specific_load_Pa", "Pa", "largest load of this bearing over diameter times length"),
                _number("bearing_rms_N", "N", "root of the mean square of the load of this bearing over the cycle"),
                _number("bearing_floor_N", "N", "what the peak comes to at least, whatever turns with the shaft"),
                _number("bearing_circle_x_N", "N", "x of the centre of the smallest circle around the load"),
                _number("bearing_circle_y_N", "N", "y of that centre, as the shaft sees it"),
            ),
        ),
        Details(
            "machine",
            (_number("bending_floor_Nm", "N m", "what the largest bending moment comes to at least, whatever turns"),),
        ),
    ),
}


def keys_of(output: str) -> tuple[str, ...]:
    """Keys of the columns in detail of one output."""
    return tuple(each for details in DETAILS[output] for each in details.keys)


def detail_columns(machine: Machine, output: str) -> Iterator[Column]:
    """Columns in detail of one output."""
    for details in DETAILS.get(output, ()):
        for label, path in parts_of(machine, details.of):
            for column in details.columns:
                if details.of == "machine":
                    yield column
                else:
                    yield column._replace(name=f"{column.name}.{label}", source=pointer(("machine", *path)))
