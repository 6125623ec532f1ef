"""Counterweights as they are fitted."""

from itertools import chain
from typing import Annotated, Protocol

from pydantic import Field

from schemas.answer.limits import WebLimit
from schemas.base.model import Model
from schemas.base.quantities import (
    Degrees,
    KilogramMetres,
    Kilograms,
    KilogramSquareMetres,
    Metres,
    Name,
    Newtons,
)


class Shape(Model):
    """What is cut from the plate of a web, symmetric about the direction of its unbalance."""

    half_angle_deg: Degrees = Field(description="half the opening, as seen from the shaft", examples=[52.3])
    chord_height_m: Metres | None = Field(
        description="distance of the chord from the shaft; null for a sector", examples=[0.153]
    )
    outer_radius_m: Metres = Field(description="radius that it reaches: its clearance circle", examples=[0.25])
    inertia_kg_m2: KilogramSquareMetres = Field(description="moment of inertia about the shaft", examples=[0.61])


class Counterweight(Model):
    """One counterweight on one web."""

    web: Name = Field(description="name of the web", examples=["1a"])
    mass_kg: Kilograms = Field(description="mass", examples=[24.5])
    angle_deg: Degrees = Field(
        description="angle as drawn at shaft angle 0, from 0 up to 360; 0 where the mass is 0", examples=[180.0]
    )
    position_m: Metres = Field(description="plane of the counterweight along the shaft", examples=[0.28])
    radius_m: Metres = Field(description="radius of its centre of mass", examples=[0.25])
    throw: int | None = Field(
        description="number from 0 of the throw whose crank it belongs to; null where two are equally near",
        examples=[0],
    )
    angle_from_crank_deg: Degrees | None = Field(
        description="angle from that crank, from 0 up to 360: 180 is opposite it; null without crank or without mass",
        examples=[180.0],
    )
    mass_radius_kg_m: KilogramMetres = Field(description="mass times radius", examples=[6.125])
    x_kg_m: KilogramMetres = Field(description="x component of mass times radius", examples=[-6.125])
    y_kg_m: KilogramMetres = Field(description="y component of mass times radius", examples=[0.0])
    centrifugal_force_N: Newtons = Field(
        description="what has to hold it, at overspeed_rpm of the machine", examples=[16792.0]
    )
    active_limits: tuple[WebLimit, ...] = Field(
        description="limits of this web that the counterweight touches", examples=[["max_mass"]]
    )
    fixed: bool = Field(False, description="whether it was there already, and was not chosen", examples=[False])
    shape: Shape | None = Field(None, description="its outline; null where the web has no envelope", examples=[None])


class FittedShaft(Model):
    """The unbalances of one balance shaft."""

    name: Name = Field(description="name of the shaft", examples=["upper"])
    speed_ratio: int = Field(description="turns of it for one of the crankshaft", examples=[-1])
    gearing: str = Field(
        description="sense of rotation, speed, and its unbalances at shaft angle 0, in a sentence",
        examples=["Turns against the crankshaft at its speed."],
    )
    total_mass_kg: Kilograms = Field(description="total mass of its unbalances", examples=[3.2])
    counterweights: tuple[Counterweight, ...] = Field(
        description="one for each of its webs; angles as drawn at shaft angle 0, forces at its own speed", examples=[[]]
    )


class OnAllShafts(Protocol):
    """What holds counterweights of the crankshaft and of balance shafts: answers, points of fronts, choices."""

    @property
    def counterweights(self) -> tuple[Counterweight, ...]: ...

    @property
    def balance_shafts(self) -> tuple[FittedShaft, ...]: ...


def every_counterweight(holder: OnAllShafts) -> tuple[Counterweight, ...]:
    """Those on balance shafts behind those of the crankshaft."""
    return (*holder.counterweights, *chain.from_iterable(shaft.counterweights for shaft in holder.balance_shafts))


#: fields of points, sets and answers that state what is on all webs and on all balance shafts
WebCounterweights = Annotated[
    tuple[Counterweight, ...], Field(description="one for each web, in the machine's order", examples=[[]])
]
ShaftUnbalances = Annotated[
    tuple[FittedShaft, ...], Field(description="unbalances of the balance shafts, in their order", examples=[[]])
]
ShaftsMass = Annotated[
    Kilograms | None, Field(description="total mass of these; null where there are none", examples=[None])
]
