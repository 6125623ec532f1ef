"""The reciprocating machine: throws, rows, bearings, balance shafts."""

from collections.abc import Iterator, Sequence
from functools import reduce
from itertools import pairwise
from operator import or_
from typing import Annotated, Literal

from pydantic import Field

from schemas.base.model import Model, NotEmpty
from schemas.base.quantities import Angle, Mass, Name, Position
from schemas.base.rules import Path, Rule, largest
from schemas.base.units import Unit
from schemas.machine.choices import stated
from schemas.machine.drive import MAX_BEARINGS, Bearing, FlywheelData, Friction
from schemas.machine.parts import MAX_PARTS, ShaftPart
from schemas.machine.rotor import MAX_WEBS, Rotor, unique_names
from schemas.machine.throws import MAX_THROWS, Row, Throw, row_cylinders
from schemas.machine.webs import Web

MAX_ROWS_TOGETHER = 500
MAX_BALANCE_SHAFTS = 20


class BalanceShaft(Model):
    """A shaft beside the crankshaft, geared to it, whose unbalance is chosen as well."""

    name: Name = Field(description="name of the shaft, unique in the machine", examples=["upper"])
    speed_ratio: Literal[-2, -1, 1, 2] = Field(
        description="turns of it for one of the crankshaft; negative against its sense of rotation", examples=[-1]
    )
    x_m: Position = Field(0.0, description="place of its axis across the crankshaft", examples=[0.05])
    y_m: Position = Field(0.0, description="place of its axis across the crankshaft", examples=[0.2])
    webs: Annotated[tuple[Web, ...], NotEmpty()] = Field(
        max_length=MAX_WEBS,
        description="places where its unbalances can sit; angles as drawn at shaft angle 0",
        examples=[[{"name": "upper", "position_m": 0.0, "counterweight_radius_m": 0.03, "max_mass_kg": 4}]],
    )


class ReciprocatingMachine(Rotor):
    """A reciprocating compressor or engine of any layout."""

    kind: Literal["reciprocating"] = Field(description="kind of machine", examples=["reciprocating"])
    throws: Annotated[tuple[Throw, ...], NotEmpty()] = Field(
        max_length=MAX_THROWS,
        description="the throws of the crankshaft",
        examples=[[{"name": "1", "position_m": 0.175, "crank_radius_m": 0.14, "crank_angle_deg": 0}]],
    )

    friction: Friction | None = Field(
        None, description="mechanical losses; null takes none into account", examples=[{"mechanical_efficiency": 0.94}]
    )
    flywheel: FlywheelData | None = Field(
        None, description="turning inertia; needed only by the output flywheel", examples=[{"irregularity": 0.01}]
    )
    gravity_deg: Annotated[Angle | None, Unit("deg")] = Field(
        None,
        description="direction in which weight acts across the shaft, as drawn; needed only by the guides and "
        "weights of loads",
        examples=[270.0],
    )
    shaft_parts: tuple[ShaftPart, ...] = Field(
        (),
        max_length=MAX_PARTS,
        description="parts of the shaft that are balanced in themselves; needed only by the weights of loads",
        examples=[[]],
    )
    stationary_mass_kg: Annotated[Mass | None, Unit("kg")] = Field(
        None,
        description="what stands still: frame, cylinders, covers; needed only by the weight on the foundation of loads",
        examples=[None],
    )
    bearings: tuple[Bearing, ...] = Field(
        (),
        max_length=MAX_BEARINGS,
        description="main bearings; needed only by the output main_bearings",
        examples=[[{"name": "A", "position_m": -0.4}, {"name": "B", "position_m": 0.4}]],
    )

    balance_shafts: tuple[BalanceShaft, ...] = Field(
        (),
        max_length=MAX_BALANCE_SHAFTS,
        description="shafts geared to the crankshaft, whose unbalances are chosen together with the counterweights",
        examples=[[]],
    )

    def web_lists(self) -> Iterator[tuple[Path, tuple[Web, ...]]]:
        yield from super().web_lists()
        for i, shaft in enumerate(self.balance_shafts):
            yield ("balance_shafts", i, "webs"), shaft.webs

    def catalogue_webs(self) -> Iterator[tuple[Path, Web]]:
        yield from super().catalogue_webs()
        for i, shaft in enumerate(self.balance_shafts):
            for k, web in enumerate(shaft.webs):
                # of a balance shaft those that say so themselves
                if stated(web):
                    yield ("balance_shafts", i, "webs", k), web

    @property
    def every_web(self) -> tuple[Web, ...]:
        shafts = self.balance_shafts
        return (*self.webs, *(web for shaft in shafts for web in shaft.webs)) if shafts else self.webs

    def rules(self) -> Iterator[Rule]:
        yield from super().rules()
        rows = sum(len(throw.rows) for throw in self.throws)
        if rows > MAX_ROWS_TOGETHER:
            yield Rule(True, ("throws",), f"all throws together must hold at most {MAX_ROWS_TOGETHER} rows")
        yield from unique_names(("throws",), [throw.name for throw in self.throws])
        for t, throw in enumerate(self.throws):
            if throw.rows:
                yield from _throw_rules(("throws", t), throw, 1.0 if self.rotation == "ccw" else -1.0)
        for k, web in enumerate(self.webs):
            beyond = web.throw is not None and web.throw >= len(self.throws)
            if beyond is not False:
                yield Rule(beyond, ("webs", k, "throw"), f"the machine has {len(self.throws)} throw(s), counted from 0")
        if self.friction is not None:
            yield from self.friction.row_rules(rows)
        if self.bearings:
            yield from _bearing_rules(self.bearings)
        if self.shaft_parts:
            yield from unique_names(("shaft_parts",), [part.name for part in self.shaft_parts])
        if self.balance_shafts:
            yield from self._shaft_rules()

    def _shaft_rules(self) -> Iterator[Rule]:
        """Rules of the balance shafts."""
        yield from unique_names(("balance_shafts",), [shaft.name for shaft in self.balance_shafts])
        places = sum((len(shaft.webs) for shaft in self.balance_shafts), len(self.webs))
        yield Rule(places > MAX_WEBS, ("balance_shafts",), f"all shafts together must hold at most {MAX_WEBS} webs")
        names = {web.name for web in self.webs}
        for i, shaft in enumerate(self.balance_shafts):
            for k, web in enumerate(shaft.webs):
                path = ("balance_shafts", i, "webs", k)
                message = "this name is taken already; names of webs must be unique on all shafts"
                yield Rule(web.name in names, (*path, "name"), message)
                yield Rule(web.throw is not None, (*path, "throw"), "a balance shaft has no throws")
                yield Rule(web.fixed is not None, (*path, "fixed"), "of the crankshaft's webs only")
                names.add(web.name)
        places_of_castings = {path[0] for path, _ in self.catalogue_webs()}
        message = "with castings on balance shafts the crankshaft's are of the catalogue too: give one"
        yield Rule(bool(self.web_groups) and places_of_castings == {"balance_shafts"}, ("web_groups",), message)
        message = "with balance shafts the total mass has no limit: limit the masses of the webs"
        yield Rule(self.max_total_mass_kg is not None, ("max_total_mass_kg",), message)


def balance_shafts(machine: Rotor) -> tuple[BalanceShaft, ...]:
    """Those of a machine, of whichever kind."""
    return machine.balance_shafts if isinstance(machine, ReciprocatingMachine) else ()


def _throw_rules(path: Path, throw: Throw, sense: float) -> Iterator[Rule]:
    if len(throw.rows) > 1:
        yield from unique_names((*path, "rows"), [row.name for row in throw.rows])
    for i, row in enumerate(throw.rows):
        rod, cylinder = row.connecting_rod, row.cylinder
        if rod is not None and rod.length_m is not None:
            short = rod.length_m <= throw.crank_radius_m
            if short is not False:
                message = "the connecting rod must be longer than the crank radius"
                yield Rule(short, (*path, "rows", i, "connecting_rod", "length_m"), message)
        if row.cylinders or (cylinder is not None and cylinder.pressure is not None):
            yield from _cylinder_rules((*path, "rows", i), throw, row, sense)


def _cylinder_rules(path: Path, throw: Throw, row: Row, sense: float) -> Iterator[Rule]:
    if row.cylinder is not None and row.cylinders:
        yield Rule(True, (*path, "cylinders"), "give either one cylinder or several")
    yield from unique_names((*path, "cylinders"), [member.name for member in row.cylinders])
    for k, member in enumerate(row.cylinders):
        overlaps = reduce(or_, (member.overlaps(other) for other in row.cylinders[:k]), False)
        yield Rule(overlaps, (*path, "cylinders", k, "from_m"), "overlaps another cylinder of the row")
    for at, cylinder in row_cylinders(row):
        if cylinder.pressure is not None:
            for broken, rest, words in cylinder.pressure.row_rules(sense, throw.crank_angle_deg, row.axis_deg):
                yield Rule(broken, (*path, *at, "pressure", *rest), words)


def _bearing_rules(bearings: Sequence[Bearing]) -> Iterator[Rule]:
    yield from unique_names(("bearings",), [bearing.name for bearing in bearings])
    places = [bearing.position_m for bearing in bearings]
    highest, lowest = largest(places), -largest([-place for place in places])
    # nearer than this no arithmetic tells them apart
    near = largest([1e-8 * (highest - lowest), 1e-14 * largest([abs(highest), abs(lowest)])])
    # of numbers neighbours tell whether any two coincide
    order = sorted(places) if type(near) is float else places
    if order is places or any(other - place <= near for place, other in pairwise(order)):
        for k, place in enumerate(places):
            coincides = reduce(or_, [abs(place - other) <= near for other in places[:k]], False)
            if coincides is not False:
                yield Rule(coincides, ("bearings", k, "position_m"), "another bearing is in this plane")
    if len(places) == 1:
        yield Rule(True, ("bearings",), "a shaft needs at least two bearings")
