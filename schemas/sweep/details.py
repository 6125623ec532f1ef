"""Columns in detail: figures of a single answer that rows of a sweep hold only if the request names them, or all
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
#: name, unit and meaning of a column
Figure = tuple[str, str | None, str]


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
    """Keys of the columns in detail of an output."""
    columns = COLUMNS_OF_PARTS[output].columns if output in COLUMNS_OF_PARTS else ()
    of_parts = (f"{column.name}." for column in columns)
    return frozenset((*(key(column.name) for column in OUTPUT_COLUMNS.get(output, ())), *of_parts))


def parts_of(machine: Machine, of: Of) -> Iterator[Part]:
    """The parts of a machine that columns are about, in its order; rows throw by throw."""
    if of == "machine":
        yield Part("", ())
    elif isinstance(machine, ReciprocatingMachine):
        if of == "throws":
            yield from _parts_of("throws", machine.throws)
        elif of == "bearings":
            yield from _parts_of("bearings", machine.bearings)
        else:
            for label, path in _rows(machine):
                yield from _within(machine, of, label, path)


def _parts_of(field: str, parts: Sequence[Model]) -> Iterator[Part]:
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
            labels([getattr(member, "name", None) for _, member in cylinders]), cylinders, strict=True
        ):
            place = label if len(cylinders) == 1 else f"{label}.{within}"
            yield from (Part(f"{place}.{side}", (*path, *cylinder[0])) for side in _SIDES)


def _ellipse(quantity: str, short: str, unit: str) -> Iterator[Figure]:
    of = f"first-order {quantity} with the counterweights"
    yield f"{quantity}_minor_{short}", unit, f"minor semi-axis of the ellipse of the {of}"
    yield f"{quantity}_peak_x_{short}", unit, f"peak along x of the {of}"
    yield f"{quantity}_peak_y_{short}", unit, f"peak along y of the {of}"
    yield f"{quantity}_co_rotating_{short}", unit, f"size of the co-rotating phasor of the {of}"
    yield f"{quantity}_counter_rotating_{short}", unit, f"size of the counter-rotating phasor of the {of}"


#: by output and what they are about
_FIGURES: dict[tuple[str, Of], tuple[Figure, ...]] = {
    ("residual", "machine"): (
        *_ellipse("force", "N", "N"),
        *_ellipse("moment", "Nm", "N m"),
    ),
    ("gas", "rows"): (("indicated_power_W", "W", "power put into the gas of this row"),),
    ("gas", "chambers"): (
        ("indicated_work_J", "J", "work put into the gas of this chamber in one revolution"),
        ("suction_opens_deg", "deg", "own crank angle at which its suction opens"),
        ("discharge_opens_deg", "deg", "own crank angle at which its discharge opens"),
    ),
    ("piston_force", "rows"): (
        ("piston_tension_N", "N", "largest sum of the forces on this piston over the cycle"),
        ("piston_compression_N", "N", "smallest sum of the forces on this piston over the cycle"),
    ),
    ("rod_loads", "rows"): (
        ("rod_load_N", "N", "largest rod force of this row of all load cases, magnitude"),
        ("peak_side_N", "N", "largest force on the guide of this row over the cycle, magnitude"),
    ),
    ("rod_loads", "cases"): (
        ("rod_tension_N", "N", "largest rod force in this load case, 0 if there is no tension"),
        ("rod_compression_N", "N", "smallest rod force in this load case, 0 if there is no compression"),
    ),
    ("torque", "rows"): (("mean_torque_Nm", "N m", "mean torque of this row over the cycle"),),
    ("torque", "machine"): (("rotating_friction_Nm", "N m", "rotating friction, constant"),),
    ("flywheel", "machine"): (
        ("fluctuation_energy_J", "J", "energy that a flywheel takes up and gives back"),
        ("inertia_MD2_kg_m2", "kg m2", "the customary MD^2 = 4 J of all that turns"),
    ),
    ("loads", "rows"): (
        ("reciprocating_mass_kg", "kg", "what moves along the axis of this row, with its share of the rod"),
        ("rod_rotating_mass_kg", "kg", "the rest of its rod, at the crank pin"),
        ("rotating_mass_kg", "kg", "all that turns at the crank pin in the plane of this row"),
        ("largest_gas_N", "N", "largest gas force of this row over the cycle, magnitude"),
        ("largest_inertia_N", "N", "largest inertia force over the cycle, magnitude"),
        ("largest_piston_force_N", "N", "largest sum of all of them over the cycle, magnitude"),
        ("piston_rod_N", "N", "for piston rod and pin: the largest of the three"),
        ("crosshead_pin_N", "N", "largest rod force of this row running, over the cycle, magnitude"),
        ("stop_at_outer_dead_centre_N", "N", "gas force of a sudden stop at its outer dead centre"),
        ("stop_at_inner_dead_centre_N", "N", "gas force of a sudden stop at its inner dead centre"),
        ("stop_over_the_turn_N", "N", "largest rod force of a sudden stop anywhere, magnitude"),
        ("frame_tension_N", "N", "largest pull of its gas at the frame over the cycle"),
        ("frame_compression_N", "N", "largest push of its gas at the frame over the cycle, negative"),
        ("frame_mean_N", "N", "midway between the largest and the smallest"),
        ("frame_amplitude_N", "N", "half of their difference"),
        ("guide_weight_N", "N", "weight on the guide of this row, across the axis"),
        ("guide_largest_N", "N", "largest force towards the lower guide over the cycle"),
        ("guide_smallest_N", "N", "smallest; negative where it bears on the upper guide"),
        ("guide_lifted_share", None, "share of the cycle over which it is off the lower guide"),
    ),
    ("loads", "chambers"): (
        ("cover_largest_N", "N", "largest gas force on this end of the cylinder over the cycle"),
        ("cover_smallest_N", "N", "smallest gas force on it over the cycle"),
    ),
    ("loads", "throws"): (
        ("throw_rotating_mass_kg", "kg", "unbalanced rotating mass at this crank, with the rods' parts"),
    ),
    ("loads", "bearings"): (
        ("bearing_weight_x_N", "N", "x of the weight on this bearing, with gravity_deg"),
        ("bearing_weight_y_N", "N", "y of the weight on this bearing, with gravity_deg"),
    ),
    ("loads", "machine"): (
        ("driver_Nm", "N m", "mean torque: the constant torque of the driver"),
        ("foundation_weight_N", "N", "weight of the machine, with stationary_mass_kg"),
    ),
    ("main_bearings", "bearings"): (
        ("specific_load_Pa", "Pa", "largest load of this bearing over diameter times length"),
        ("bearing_rms_N", "N", "root of the mean square of the load of this bearing over the cycle"),
        ("bearing_floor_N", "N", "what the peak comes to at least, whatever turns with the shaft"),
        ("bearing_circle_x_N", "N", "x of the centre of the smallest circle around the load"),
        ("bearing_circle_y_N", "N", "y of that centre, as the shaft sees it"),
    ),
    ("main_bearings", "machine"): (
        ("bending_floor_Nm", "N m", "what the largest bending moment comes to at least, whatever turns"),
    ),
}


def _details(output: str) -> Iterator[Details]:
    for (name, of), figures in _FIGURES.items():
        if name == output:
            yield Details(of, tuple(Column(figure, "number", unit, meaning) for figure, unit, meaning in figures))


#: by output
DETAILS: dict[str, tuple[Details, ...]] = {output: tuple(_details(output)) for output, _ in _FIGURES}


def keys_of(output: str) -> tuple[str, ...]:
    """Keys of the columns in detail of one output."""
    return tuple(name for details in DETAILS[output] for name in details.keys)


def detail_columns(machine: Machine, output: str) -> Iterator[Column]:
    """Columns in detail of one output."""
    for details in DETAILS.get(output, ()):
        for label, path in parts_of(machine, details.of):
            for column in details.columns:
                if details.of == "machine":
                    yield column
                else:
                    yield column._replace(name=f"{column.name}.{label}", source=pointer(("machine", *path)))
