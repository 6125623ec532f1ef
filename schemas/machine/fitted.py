"""Counterweights that are on a machine already."""

from collections.abc import Iterator, Sequence
from typing import Annotated

from pydantic import ConfigDict, Field

from schemas.base.model import Model
from schemas.base.presence import alternatives, conditions, present, when
from schemas.base.quantities import Angle, Length, Mass, Name, Position
from schemas.base.rules import REQUIRED, Rule, Ruled
from schemas.base.units import Unit
from schemas.machine.machine import Machine


class _Weight(Model):
    """What is fitted, wherever it is."""

    mass_kg: Mass = Field(description="mass of the counterweight", examples=[24.5])
    angle_deg: Angle = Field(description="angle of the counterweight as drawn at shaft angle 0", examples=[180.0])


class FittedCounterweight(_Weight):
    """A counterweight on a web of the machine."""

    web: Name = Field(description="name of the web that carries it", examples=["1a"])


class GivenCounterweight(_Weight, Ruled):
    """A counterweight on a web of the machine, at its radius or at one of its own, or in a plane of its own."""

    model_config = ConfigDict(
        json_schema_extra={
            "anyOf": [{"required": ["web"]}, {"required": ["position_m", "radius_m"]}],
            **conditions(alternatives("web", "position_m"), when(present("position_m"), present("radius_m"))),
        }
    )

    web: Name | None = Field(
        None, description="name of the web that carries it; must be said but for a position", examples=["1a"]
    )
    position_m: Annotated[Position | None, Unit("m")] = Field(
        None, description="plane along the shaft (z), in place of a web", examples=[None]
    )
    radius_m: Annotated[Length | None, Unit("m")] = Field(
        None,
        description="radius of its centre of mass; null is that of the web, or what is cut from the web's envelope",
        examples=[0.23],
    )

    def rules(self) -> Iterator[Rule]:
        placed = self.position_m is not None
        yield Rule(self.web is None and not placed, ("web",), REQUIRED)
        yield Rule(self.web is not None and placed, ("position_m",), "give either the web or the plane")
        yield Rule(placed and self.radius_m is None, ("radius_m",), "needed in a plane that has no web")


def fitted_rules(
    machine: Machine, counterweights: Sequence[FittedCounterweight | GivenCounterweight]
) -> Iterator[Rule]:
    """Every counterweight on a web of the machine or in a plane of its own, and every web with one at most."""
    if not counterweights:
        return
    shafts = machine.balance_shafts if machine.kind == "reciprocating" else ()
    names = {web.name for place in (machine, *shafts) for web in place.webs}
    fixed = {web.name: web.fixed for web in machine.webs if web.fixed is not None}
    earlier: set[str] = set()
    for index, counterweight in enumerate(counterweights):
        if counterweight.web is None:
            continue
        path = ("counterweights", index, "web")
        yield Rule(counterweight.web not in names, path, "the machine has no web of this name")
        twice = counterweight.web in earlier & names
        yield Rule(twice, path, "this web carries a counterweight already")
        there = fixed.get(counterweight.web)
        if there is not None:
            off = (counterweight.angle_deg - there.angle_deg) % 360.0
            differs = (counterweight.mass_kg != there.mass_kg) | (off != 0.0)
            elsewhere = isinstance(counterweight, GivenCounterweight) and counterweight.radius_m is not None
            yield Rule(differs | elsewhere, path, "the weight of this web is fixed in the machine, as another one")
        earlier.add(counterweight.web)
