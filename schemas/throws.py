"""Throws of a crankshaft, with the rows on their pins."""

from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from schemas.base import Model
from schemas.cylinder import Cylinder, RowCylinder
from schemas.quantities import Angle, Fraction, Length, Mass, Name, Position
from schemas.units import Unit

MAX_THROWS = 500
MAX_ROWS = 60
MAX_CYLINDERS = 8


class ConnectingRod(Model):
    """The connecting rod of a row; its mass is shared between crosshead and crank pin."""

    length_m: Annotated[Length | None, Unit("m")] = Field(
        description="length between centres; null is an infinite rod (scotch yoke, Oldham ring)", examples=[0.7]
    )
    mass_kg: Mass = Field(0.0, description="mass of the whole rod", examples=[86.025])
    reciprocating_share: Fraction = Field(
        1 / 3,
        description="share of the rod's mass that reciprocates; the rest turns with the crank pin",
        examples=[0.3],
    )


class Row(Model):
    """One cylinder axis and the masses that reciprocate along it."""

    name: Name | None = Field(None, description="name of the row, unique on its throw", examples=["I"])
    axis_deg: Angle = Field(
        description="direction of the cylinder axis towards outer dead centre, counter-clockwise from +x",
        examples=[0.0],
    )
    offset_m: Position = Field(
        0.0, description="axial distance of the row's plane from its throw's plane", examples=[0.0]
    )
    reciprocating_mass_kg: Mass = Field(
        description="piston, piston rod and crosshead, without the connecting rod", examples=[277.79]
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


def row_cylinders(row: Row) -> Iterator[tuple[tuple[str | int, ...], Cylinder]]:
    """The cylinders of a row with their paths from it."""
    if row.cylinder is not None:
        yield ("cylinder",), row.cylinder
    for k, one in enumerate(row.cylinders):
        yield ("cylinders", k), one


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
