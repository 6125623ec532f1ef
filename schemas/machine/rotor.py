"""What every machine has: a shaft, its speed, and the places for counterweights."""

from collections.abc import Iterable, Iterator, Sequence
from typing import Annotated, Literal

from pydantic import Field

from schemas.base.model import Model
from schemas.base.quantities import Count, Mass, Name, Position, Speed, Unbalance
from schemas.base.rules import Path, Rule, Ruled
from schemas.base.units import Unit
from schemas.machine.balance_quality import BalanceQuality
from schemas.machine.catalogue import Catalogue
from schemas.machine.catalogue_rules import catalogue_rules
from schemas.machine.choices import CHOICE_FIELDS, stated
from schemas.machine.webs import Web, WebGroup

MAX_WEBS = 500
MAX_UNBALANCES = 500
#: counterweights from what there is, or of any mass that is 0 or no less than a least one
Choice = Literal["discrete", "semicontinuous"]


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

    def web_lists(self) -> Iterator[tuple[Path, tuple[Web, ...]]]:
        """Webs of the crankshaft, and of every balance shaft behind them, with paths from the machine."""
        yield ("webs",), self.webs

    @property
    def every_web(self) -> tuple[Web, ...]:
        """All webs, those of balance shafts behind those of the crankshaft."""
        return self.webs

    def no_envelopes(self, message: str) -> Iterator[Rule]:
        """Rules that no web has an envelope, with paths from the machine."""
        for place, webs in self.web_lists():
            for k, web in enumerate(webs):
                yield Rule(web.envelope is not None, (*place, k, "envelope"), message)

    def _group_rules(self) -> Iterator[Rule]:
        """Every web of a group exists, is in no other, and has options."""
        yield from unique_names(("web_groups",), [group.name for group in self.web_groups])
        webs, members = {web.name: web for web in self.webs}, set[str]()
        for i, group in enumerate(self.web_groups):
            for j, name in enumerate(group.webs):
                path = ("web_groups", i, "webs", j)
                yield Rule(name not in webs, path, "the machine has no web of this name")
                yield Rule(name in members, path, "this web is in a group already")
                members.add(name)
                web = webs.get(name)
                if web is not None:
                    message = "remove this web from the group: it has a fixed counterweight"
                    yield Rule(web.fixed is not None, path, message)
                    endless = group.mirror and web.envelope is None and web.max_mass_kg is None
                    yield Rule(endless, path, "a mirrored pair needs max_mass_kg: give its webs a limit")

    def choice_fields(self) -> Iterator[Path]:
        """Fields by which the machine asks for discrete choices, with paths from the machine."""
        for name in ("catalogue", "max_counterweights"):
            if getattr(self, name) is not None:
                yield (name,)
        for place, webs in self.web_lists():
            for k, web in enumerate(webs):
                for name in stated(web):
                    yield (*place, k, name)

    def catalogue_webs(self) -> Iterator[tuple[Path, Web]]:
        """Webs that take what there is, with paths from the machine: all of the crankshaft, or none."""
        general = self.catalogue is not None or self.max_counterweights is not None
        if general or any(stated(web) for web in self.webs):
            yield from ((("webs", k), web) for k, web in enumerate(self.webs))

    @property
    def choice(self) -> Choice | None:
        """The kind of options for counterweights; None is any mass at any angle."""
        if self.catalogue is not None or self.max_counterweights is not None:
            return "discrete"
        least = False
        for web in self.every_web:
            if not CHOICE_FIELDS.isdisjoint(web.__pydantic_fields_set__):
                if stated(web):
                    return "discrete"
                least = least or web.min_fitted_mass_kg is not None
        return "semicontinuous" if least else None

    @property
    def discrete(self) -> bool:
        """Whether counterweights have finitely many options."""
        return self.choice == "discrete"

    @property
    def semicontinuous(self) -> bool:
        """Whether counterweights of any mass are at least so heavy, or not there."""
        return self.choice == "semicontinuous"

    def rules(self) -> Iterator[Rule]:
        yield from unique_names(("webs",), [web.name for web in self.webs])
        if self.unbalances:
            yield from unique_names(("unbalances",), [unbalance.name for unbalance in self.unbalances])
        if self.overspeed_rpm is not None:
            slower = self.overspeed_rpm < self.speed_rpm
            yield Rule(slower, ("overspeed_rpm",), "must be at least speed_rpm")
        if self.discrete:
            yield from catalogue_rules(self.catalogue or Catalogue(), [*self.catalogue_webs()])
            sizes, most = self.catalogue.max_part_numbers if self.catalogue else None, self.max_counterweights
            if sizes is not None and most is not None:
                message = "more sizes than counterweights: max_counterweights is smaller"
                yield Rule((most >= 1) & (sizes > most), ("catalogue", "max_part_numbers"), message)
        if self.web_groups:
            yield from self._group_rules()
        if self.max_total_mass_kg is not None:
            fixed = sum((web.fixed.mass_kg for web in self.webs if web.fixed is not None), 0.0)
            message = "the fixed counterweights are heavier than this limit"
            yield Rule(fixed > self.max_total_mass_kg, ("max_total_mass_kg",), message)


def unique_names(path: Path, names: Sequence[str | None]) -> Iterable[Rule]:
    """One rule broken for every name that already stands earlier in the list; None is no name."""
    return () if len(set(names)) == len(names) else _repetitions(path, names)


def _repetitions(path: Path, names: Sequence[str | None]) -> Iterator[Rule]:
    earlier: set[str] = set()
    for index, name in enumerate(names):
        if name is None:
            continue
        if name in earlier:
            yield Rule(True, (*path, index, "name"), "this name is taken already; names must be unique")
        earlier.add(name)


def no_catalogue(machine: Rotor, path: Path, subject: str) -> Iterator[Rule]:
    """Refuses discrete choices where counterweights have any mass and angle."""
    least = (
        (*place, k, "min_fitted_mass_kg")
        for place, webs in machine.web_lists()
        for k, web in enumerate(webs)
        if web.min_fitted_mass_kg is not None
    )
    for field in (*machine.choice_fields(), *least):
        yield Rule(True, (*path, *field), f"serves only to optimize one machine by itself, not {subject}")


def no_groups(machine: Rotor, path: Path, subject: str) -> Iterator[Rule]:
    """Refuses identical castings where counterweights are independent."""
    message = f"serves only to choose the counterweights of a machine, not {subject}"
    yield Rule(bool(machine.web_groups), (*path, "web_groups"), message)
