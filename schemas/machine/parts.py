"""Parts that masses are made of: of a row, and of the shaft."""

from typing import Literal

from pydantic import Field

from schemas.base.model import Model
from schemas.base.quantities import Mass, Name, Position

MAX_PARTS = 50


class Part(Model):
    """A part of a row: piston, rings, piston rod, crosshead, pins, shells of the big end."""

    name: Name = Field(description="name of the part, unique in its row", examples=["piston"])
    mass_kg: Mass = Field(description="its mass", examples=[96.5])
    motion: Literal["reciprocating", "rotating"] = Field(
        "reciprocating",
        description="whether it moves along the axis, or turns with the crank pin",
        examples=["reciprocating"],
    )


class ShaftPart(Model):
    """What turns about its own centre of mass, and so has weight alone: the shaft itself, a flywheel, a rotor."""

    name: Name = Field(description="name of the part, unique in the machine", examples=["flywheel"])
    mass_kg: Mass = Field(description="its mass", examples=[420.0])
    position_m: Position = Field(description="plane of its centre of mass along the shaft (z)", examples=[0.5])
