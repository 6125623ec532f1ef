"""Throws of a crankshaft, with the rows on their pins."""

from collections.abc import Iterator
from typing import Annotated, Any

from pydantic import ConfigDict, Field

from schemas.base.model import Model
from schemas.base.presence import conditions, present, when
from schemas.base.quantities import Angle, Fraction, Length, Mass, Name, Position
from schemas.base.rules import REQUIRED, Rule, Ruled
from schemas.base.units import Unit
from schemas.machine.cylinder import Cylinder, RowCylinder
from schemas.machine.parts import MAX_PARTS, Part

MAX_THROWS = 500
MAX_ROWS = 60
MAX_CYLINDERS = 8

#: default share of a rod that moves with the crosshead
_CUSTOMARY_SHARE = 1 / 3


class ConnectingRod(Ruled):
    """The connecting rod of a row; its mass is shared between crosshead and crank pin."""

    model_config = ConfigDict(
        json_schema_extra=conditions(
            when(
                present("centre_of_mass_m"),
                {
                    "properties": {
                        "length_m": {"not": {"type": "null"}},
                        "reciprocating_share": {"const": _CUSTOMARY_SHARE},
                    }
                },
            )
        )
    )

    length_m: Annotated[Length | None, Unit("m")] = Field(
        description="length between centres; null is an infinite rod (scotch yoke, Oldham ring)", examples=[0.7]
    )
    mass_kg: Mass = Field(0.0, description="mass of the whole rod", examples=[86.025])
    reciprocating_share: Fraction = Field(
        _CUSTOMARY_SHARE,
        description="share of the rod's mass that reciprocates; the rest turns with the crank pin",
        examples=[0.3],
    )
    centre_of_mass_m: Annotated[Length | None, Unit("m")] = Field(
        None,
        description="distance of its centre of mass from the crank pin, which shares its mass in place of "
        "reciprocating_share",
        examples=[None],
    )

    @property
    def reciprocating_kg(self) -> Any:
        """What of it moves along the axis."""
        return self.share * self.mass_kg

    @property
    def rotating_kg(self) -> Any:
        """What of it turns with the crank pin."""
        return (1.0 - self.share) * self.mass_kg

    @property
    def share(self) -> Any:
        """What reciprocates of a kilogram of it."""
        centre = self.centre_of_mass_m
        if centre is None or self.length_m is None:
            return self.reciprocating_share
        # two masses with the rod's own centre of mass
        return centre / self.length_m

    def rules(self) -> Iterator[Rule]:
        if self.centre_of_mass_m is None:
            return
        path = ("centre_of_mass_m",)
        if self.length_m is None:
            yield Rule(True, path, "an infinite rod has no such distance: give reciprocating_share")
            return
        yield Rule(self.centre_of_mass_m > self.length_m, path, "must be between crank pin and crosshead pin")
        is_twice = self.reciprocating_share != _CUSTOMARY_SHARE
        yield Rule(is_twice, path, "give either the centre of mass or reciprocating_share")


class Row(Ruled):
    """One cylinder axis and the masses that reciprocate along it."""

    model_config = ConfigDict(
        json_schema_extra={"anyOf": [{"required": ["reciprocating_mass_kg"]}, {"required": ["parts"]}]}
    )

    name: Name | None = Field(None, description="name of the row, unique on its throw", examples=["I"])
    axis_deg: Angle = Field(
        description="direction of the cylinder axis towards outer dead centre, counter-clockwise from +x",
        examples=[0.0],
    )
    offset_m: Position = Field(
        0.0, description="axial distance of the row's plane from its throw's plane", examples=[0.0]
    )
    reciprocating_mass_kg: Mass = Field(
        0.0,
        description="piston, piston rod and crosshead, without the connecting rod; may be left out beside parts",
        examples=[277.79],
    )
    parts: tuple[Part, ...] = Field(
        (),
        max_length=MAX_PARTS,
        description="parts of the row but for the rod; their masses are added to reciprocating_mass_kg, or turn "
        "with the crank pin",
        examples=[[]],
    )
    connecting_rod: ConnectingRod | None = Field(
        None,
        description="the connecting rod; needed only when an output asks for more than the first order",
        examples=[{"length_m": 0.7, "mass_kg": 86.025, "reciprocating_share": 0.3}],
    )
    cylinder: Cylinder | None = Field(
        None, description="gas data; a row without it carries no gas, and the output gas needs it", examples=[None]
    )
    cylinders: tuple[RowCylinder, ...] = Field(
        (),
        max_length=MAX_CYLINDERS,
        description="several cylinders on the row's piston rod, in tandem or stepped, in place of cylinder",
        examples=[[]],
    )

    @property
    def reciprocating_kg(self) -> Any:
        """All that moves along the axis, with the rod's share."""
        own, rod, parts = self.reciprocating_mass_kg, self.connecting_rod, self.parts
        if parts:
            own = sum((part.mass_kg for part in parts if part.motion == "reciprocating"), own)
        return own if rod is None else own + rod.reciprocating_kg

    @property
    def rotating_kg(self) -> Any:
        """All that turns with the crank pin in the plane of the row."""
        rod, parts = self.connecting_rod, self.parts
        own = 0.0 if rod is None else rod.rotating_kg
        return sum((part.mass_kg for part in parts if part.motion == "rotating"), own) if parts else own

    def rules(self) -> Iterator[Rule]:
        if not self.parts and "reciprocating_mass_kg" not in self.__pydantic_fields_set__:
            yield Rule(True, ("reciprocating_mass_kg",), REQUIRED)
        earlier: set[str] = set()
        for k, part in enumerate(self.parts):
            if part.name in earlier:
                yield Rule(True, ("parts", k, "name"), "another part of the row has this name")
            earlier.add(part.name)


def row_cylinders(row: Row) -> Iterator[tuple[tuple[str | int, ...], Cylinder]]:
    """The cylinders of a row with their paths from it."""
    if row.cylinder is not None:
        yield ("cylinder",), row.cylinder
    for k, cylinder in enumerate(row.cylinders):
        yield ("cylinders", k), cylinder


class Throw(Model):
    """One crank throw with the rows that share its pin."""

    name: Name | None = Field(None, description="name of the throw, unique in the machine", examples=["1"])
    position_m: Position = Field(description="plane of the throw along the shaft (z)", examples=[0.175])
    crank_radius_m: Length = Field(description="crank radius, half the stroke", examples=[0.14])
    crank_angle_deg: Angle = Field(
        description="direction of the crank as drawn at shaft angle 0, counter-clockwise from +x", examples=[0.0]
    )
    rotating_mass_kg: Mass = Field(
        0.0,
        description="unbalanced rotating mass referred to the crank radius, without rods and counterweights",
        examples=[12.0],
    )
    rows: tuple[Row, ...] = Field(
        (),
        max_length=MAX_ROWS,
        description="rows on this throw; none makes a purely rotating unbalance",
        examples=[[{"name": "I", "axis_deg": 0, "reciprocating_mass_kg": 277.79}]],
    )
