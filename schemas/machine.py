"""The machine: throws, rows, webs. Frame and signs: docs/mathematics.md section 1."""

from collections.abc import Iterator, Sequence
from functools import reduce
from operator import or_
from typing import Annotated, Literal

from pydantic import Field

from schemas.balance_quality import BalanceQuality
from schemas.base import Model, NotEmpty
from schemas.catalogue import Catalogue, catalogue_rules, stated
from schemas.drive import MAX_BEARINGS, Bearing, FlywheelData, Friction
from schemas.drive_bearing import DriveBearing
from schemas.over_turn import ForceOverTurn, PinRadius, TorqueOverTurn
from schemas.parts import MAX_PARTS, ShaftPart
from schemas.quantities import Angle, Count, Length, Mass, Name, Position, Speed, Unbalance
from schemas.rules import Path, Rule, Ruled, larger
from schemas.throws import MAX_THROWS, Row, Throw, row_cylinders
from schemas.units import Unit
from schemas.webs import Web, WebGroup

MAX_ROWS_TOGETHER = 500
MAX_WEBS = 500
MAX_BALANCE_SHAFTS = 20
MAX_UNBALANCES = 500


class ShaftUnbalance(Model):
    """An unbalance that the shaft has already: a flywheel with a pocket, a weight that stays where it is."""

    name: Name = Field(description="name of the unbalance, unique in the machine", examples=["flywheel"])
    position_m: Position = Field(description="plane of the unbalance along the shaft (z)", examples=[0.5])
    x_kg_m: Unbalance = Field(
        0.0, description="x component of mass times radius, as drawn at shaft angle 0", examples=[0.05]
    )
    y_kg_m: Unbalance = Field(
        0.0, description="y component of mass times radius, as drawn at shaft angle 0", examples=[-0.02]
    )


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


class Rotor(Ruled):
    """What every machine has: a shaft, its speed, and the places for counterweights."""

    name: Name | None = Field(None, description="name of the machine", examples=["2D12-90/2-20"])
    description: str | None = Field(
        None, max_length=2000, description="free text, such as which data are assumed", examples=["row spacing assumed"]
    )
    speed_rpm: Speed = Field(description="speed of the shaft", examples=[500.0])
    overspeed_rpm: Annotated[Speed | None, Unit("rpm")] = Field(
        None, description="highest speed that counterweights have to bear; null is speed_rpm", examples=[None]
    )
    rotation: Literal["ccw", "cw"] = Field(
        "ccw", description="sense of rotation seen from +z looking at the origin", examples=["ccw"]
    )
    reference_plane_m: Annotated[Position | None, Unit("m")] = Field(
        None, description="plane of moments; null is midway between the outermost throws", examples=[None]
    )
    webs: tuple[Web, ...] = Field(
        (),
        max_length=MAX_WEBS,
        description="places where counterweights can sit",
        examples=[[{"name": "1a", "position_m": 0.28, "counterweight_radius_m": 0.25, "max_mass_kg": 60}]],
    )
    max_total_mass_kg: Annotated[Mass | None, Unit("kg")] = Field(
        None, description="largest total mass of all counterweights; null is no limit", examples=[None]
    )
    catalogue: Catalogue | None = Field(
        None, description="what counterweights are chosen from; null is any mass at any angle", examples=[None]
    )
    max_counterweights: Annotated[Count, Field(ge=0, le=MAX_WEBS)] | None = Field(
        None,
        description="most webs that may have a counterweight, where they are chosen from a catalogue; null is no limit",
        examples=[None],
    )
    web_groups: tuple[WebGroup, ...] = Field(
        (),
        max_length=MAX_WEBS,
        description="webs that get identical castings, each in the same place on its own crank",
        examples=[[]],
    )
    unbalances: tuple[ShaftUnbalance, ...] = Field(
        (),
        max_length=MAX_UNBALANCES,
        description="unbalances of the shaft itself; they move neither the default reference plane nor the default"
        " weight of the moment",
        examples=[[]],
    )

    balance_quality: BalanceQuality | None = Field(
        None,
        description="balance quality that is asked of the shaft; null asks for none",
        examples=[{"grade_mm_s": 6.3, "mass_kg": 420, "centre_of_mass_m": 0.0, "plane_a_m": -0.4, "plane_b_m": 0.4}],
    )

    def no_envelopes(self, message: str) -> Iterator[Rule]:
        """Rules that no web has an envelope, with paths from the machine."""
        for k, web in enumerate(self.webs):
            yield Rule(web.envelope is not None, ("webs", k, "envelope"), message)

    def _group_rules(self) -> Iterator[Rule]:
        """Every web of a group is there, in no other, and chosen."""
        yield from _unique_names(("web_groups",), [group.name for group in self.web_groups])
        webs, taken = {web.name: web for web in self.webs}, set[str]()
        for i, group in enumerate(self.web_groups):
            for j, name in enumerate(group.webs):
                path = ("web_groups", i, "webs", j)
                yield Rule(name not in webs, path, "the machine has no web of this name")
                yield Rule(name in taken, path, "this web is in a group already")
                taken.add(name)
                web = webs.get(name)
                if web is not None:
                    yield Rule(web.fixed is not None, path, "the weight of this web is fixed: nothing is chosen")
                    yield Rule(web.envelope is not None, path, "only webs with a counterweight_radius_m, no envelope")

    @property
    def discrete(self) -> bool:
        """Whether counterweights are chosen from what there is."""
        return any(True for _ in stated(self))

    @property
    def semicontinuous(self) -> bool:
        """Whether counterweights of any mass are at least so heavy, or not there."""
        return not self.discrete and any(web.min_fitted_mass_kg is not None for web in self.webs)

    def rules(self) -> Iterator[Rule]:
        yield from _unique_names(("webs",), [web.name for web in self.webs])
        yield from _unique_names(("unbalances",), [each.name for each in self.unbalances])
        if self.overspeed_rpm is not None:
            slower = self.overspeed_rpm < self.speed_rpm
            yield Rule(slower, ("overspeed_rpm",), "must be at least speed_rpm")
        yield from catalogue_rules(self)
        yield from self._group_rules()
        fixed = sum((web.fixed.mass_kg for web in self.webs if web.fixed is not None), 0.0)
        if self.max_total_mass_kg is not None:
            message = "the weights that are fixed are heavier"
            yield Rule(fixed > self.max_total_mass_kg, ("max_total_mass_kg",), message)


#: fields of webs that those of balance shafts do not have
_OF_THE_CRANKSHAFT = (
    "catalogue_masses_kg", "hole_angles_deg", "fixed", "max_centrifugal_force_N", "min_fitted_mass_kg",
)  # fmt: skip


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

    def rules(self) -> Iterator[Rule]:
        yield from super().rules()
        rows = sum(len(throw.rows) for throw in self.throws)
        message = f"all throws together must hold at most {MAX_ROWS_TOGETHER} rows"
        yield Rule(rows > MAX_ROWS_TOGETHER, ("throws",), message)
        yield from _unique_names(("throws",), [throw.name for throw in self.throws])
        for t, throw in enumerate(self.throws):
            yield from _throw_rules(("throws", t), throw, 1.0 if self.rotation == "ccw" else -1.0)
        for k, web in enumerate(self.webs):
            if web.throw is not None:
                beyond = web.throw >= len(self.throws)
                yield Rule(beyond, ("webs", k, "throw"), f"the machine has {len(self.throws)} throw(s), counted from 0")
        if self.friction is not None:
            yield from self.friction.row_rules(rows)
        if self.balance_shafts:
            yield from self.no_envelopes("not beside balance shafts")
        for n, shaft in enumerate(self.balance_shafts):
            for k, web in enumerate(shaft.webs):
                path = ("balance_shafts", n, "webs", k, "envelope")
                yield Rule(web.envelope is not None, path, "a balance shaft's weights have a known radius")
        yield from _bearing_rules(self.bearings)
        yield from _unique_names(("shaft_parts",), [part.name for part in self.shaft_parts])
        if self.balance_shafts:
            yield from self._shaft_rules()

    def _shaft_rules(self) -> Iterator[Rule]:
        """Rules of the balance shafts."""
        yield from _unique_names(("balance_shafts",), [shaft.name for shaft in self.balance_shafts])
        places = sum((len(shaft.webs) for shaft in self.balance_shafts), len(self.webs))
        yield Rule(places > MAX_WEBS, ("balance_shafts",), f"all shafts together must hold at most {MAX_WEBS} webs")
        taken = {web.name for web in self.webs}
        for i, shaft in enumerate(self.balance_shafts):
            for k, web in enumerate(shaft.webs):
                path = ("balance_shafts", i, "webs", k)
                message = "this name is taken already; names of webs must be unique on all shafts"
                yield Rule(web.name in taken, (*path, "name"), message)
                yield Rule(web.throw is not None, (*path, "throw"), "a balance shaft has no throws")
                for name in _OF_THE_CRANKSHAFT:
                    yield Rule(getattr(web, name) is not None, (*path, name), "of the crankshaft's webs only")
                taken.add(web.name)
        message = "with balance shafts the total mass has no limit: limit the masses of the webs"
        yield Rule(self.max_total_mass_kg is not None, ("max_total_mass_kg",), message)


class OldhamRing(Model):
    """A ring that reciprocates along its axis with the amplitude of the orbit."""

    type: Literal["oldham"] = Field(description="an Oldham ring", examples=["oldham"])
    mass_kg: Mass = Field(description="mass of the ring", examples=[0.35])
    axis_deg: Angle = Field(description="direction in which the ring slides", examples=[90.0])
    position_m: Position = Field(description="plane of the ring along the shaft", examples=[0.03])


class CrankPins(Model):
    """Small crank pins in frame and orbiting scroll that keep the scroll from turning."""

    type: Literal["crank_pins"] = Field(description="crank pins", examples=["crank_pins"])
    count: Count = Field(ge=1, le=1000, description="number of evenly spaced pins", examples=[3])
    pin_circle_radius_m: PinRadius = Field(description="radius of the circle through the pins", examples=[0.05])
    eccentric_mass_kg: Mass = Field(
        0.0, description="rotating unbalanced mass of one pin, referred to the orbit radius", examples=[0.02]
    )
    position_m: Position = Field(description="plane of the pins' unbalance along the shaft", examples=[0.03])


class ScrollMachine(Rotor):
    """A scroll compressor or expander; the eccentric points along +x at shaft angle 0."""

    kind: Literal["scroll"] = Field(description="kind of machine", examples=["scroll"])
    orbit_radius_m: Length = Field(description="radius of the orbit", examples=[0.005])
    orbiting_mass_kg: Mass = Field(description="orbiting scroll with its bearing", examples=[1.2])
    orbiting_position_m: Position = Field(description="plane of the orbiting scroll's centre of mass", examples=[0.05])
    anti_rotation: Annotated[OldhamRing | CrankPins, Field(discriminator="type")] = Field(
        description="what keeps the scroll from turning",
        examples=[{"type": "crank_pins", "count": 3, "pin_circle_radius_m": 0.05, "position_m": 0.03}],
    )
    drive_bearing: DriveBearing = Field(
        DriveBearing(),
        description="what the drive's bearing carries beside crank pins; serves pin_loads alone",
        examples=[{"type": "rigid"}],
    )

    rotation_torque_Nm: TorqueOverTurn | None = Field(
        None,
        description="torque that turns the scroll about itself, constant or over one turn; needed by pin_loads",
        examples=[12.5],
    )
    tangential_gas_force_N: ForceOverTurn | None = Field(
        None,
        description="tangential gas force on the scroll, in place of the torque that it causes",
        examples=[5000.0],
    )

    def rules(self) -> Iterator[Rule]:
        yield from super().rules()
        for k, web in enumerate(self.webs):
            yield Rule(web.throw is not None, ("webs", k, "throw"), "a scroll has no throws")
        both = self.rotation_torque_Nm is not None and self.tangential_gas_force_N is not None
        yield Rule(both, ("rotation_torque_Nm",), "give either the torque or the gas force")


Machine = Annotated[ReciprocatingMachine | ScrollMachine, Field(discriminator="kind")]


def no_balance_shafts(machine: Rotor, path: Path, what: str) -> Iterator[Rule]:
    """Refuses balance shafts, where something is of the crankshaft alone."""
    if isinstance(machine, ReciprocatingMachine):
        message = f"{what} has no balance shafts: it is of the crankshaft alone"
        yield Rule(bool(machine.balance_shafts), (*path, "balance_shafts"), message)


def _throw_rules(path: Path, throw: Throw, sense: float) -> Iterator[Rule]:
    yield from _unique_names((*path, "rows"), [row.name for row in throw.rows])
    for i, row in enumerate(throw.rows):
        if row.connecting_rod is not None and row.connecting_rod.length_m is not None:
            short = row.connecting_rod.length_m <= throw.crank_radius_m
            message = "the connecting rod must be longer than the crank radius"
            yield Rule(short, (*path, "rows", i, "connecting_rod", "length_m"), message)
        yield from _cylinder_rules((*path, "rows", i), throw, row, sense)


def _cylinder_rules(path: Path, throw: Throw, row: Row, sense: float) -> Iterator[Rule]:
    both = row.cylinder is not None and bool(row.cylinders)
    yield Rule(both, (*path, "cylinders"), "give either one cylinder or several")
    yield from _unique_names((*path, "cylinders"), [one.name for one in row.cylinders])
    for k, one in enumerate(row.cylinders):
        overlaps = reduce(or_, (one.overlaps(other) for other in row.cylinders[:k]), False)
        yield Rule(overlaps, (*path, "cylinders", k, "from_m"), "overlaps another cylinder of the row")
    for at, cylinder in row_cylinders(row):
        if cylinder.pressure is not None:
            for broken, rest, words in cylinder.pressure.row_rules(sense, throw.crank_angle_deg, row.axis_deg):
                yield Rule(broken, (*path, *at, "pressure", *rest), words)


def _bearing_rules(bearings: Sequence[Bearing]) -> Iterator[Rule]:
    yield from _unique_names(("bearings",), [bearing.name for bearing in bearings])
    if not bearings:
        return
    places = [bearing.position_m for bearing in bearings]
    extent = reduce(larger, places) + reduce(larger, [-place for place in places])
    # nearer than this no arithmetic tells them apart
    near = larger(1e-8 * extent, 1e-14 * reduce(larger, map(abs, places)))
    for k, place in enumerate(places):
        coincides = reduce(or_, (abs(place - other) <= near for other in places[:k]), False)
        yield Rule(coincides, ("bearings", k, "position_m"), "another bearing is in this plane")
    yield Rule(len(places) == 1, ("bearings",), "a shaft needs at least two bearings")


def _unique_names(path: Path, names: Sequence[str | None]) -> Iterator[Rule]:
    """One rule broken for every name that already stands earlier in the list; None is no name."""
    seen: set[str] = set()
    for index, name in enumerate(names):
        if name is None:
            continue
        if name in seen:
            yield Rule(True, (*path, index, "name"), "this name is taken already; names must be unique")
        seen.add(name)
