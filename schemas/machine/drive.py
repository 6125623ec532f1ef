"""Friction, flywheel and main bearings of a machine; each is an input of some outputs only."""

from collections.abc import Iterator
from typing import Annotated

from pydantic import ConfigDict, Field, Strict

from schemas.base.model import Model
from schemas.base.presence import absent, alternatives, conditions, present, when
from schemas.base.quantities import Force, Fraction, Length, Moment, Name, Position
from schemas.base.rules import Rule, Ruled
from schemas.base.units import Unit, between, non_negative

Power = Annotated[float, non_negative(1e18), Unit("W")]
MAX_BEARINGS = 500


class Friction(Ruled):
    """Mechanical losses: from the efficiency, or given as forces."""

    model_config = ConfigDict(
        json_schema_extra=conditions(
            when(
                present("mechanical_efficiency"),
                absent("reciprocating_force_N", "rotating_torque_Nm"),
                {
                    **absent("indicated_power_W"),
                    "anyOf": [present("reciprocating_force_N"), present("rotating_torque_Nm")],
                },
            )
        )
    )

    mechanical_efficiency: Annotated[float, Strict(), between(0.01, 1.0)] | None = Field(
        None, description="indicated power over shaft power; the losses follow from it", examples=[0.94]
    )
    reciprocating_share: Fraction = Field(
        0.7, description="share of the losses in the rows; the rest is friction of the turning shaft", examples=[0.7]
    )
    indicated_power_W: tuple[Power, ...] | None = Field(
        None, description="indicated power of every row, in order; null takes it from the gas", examples=[[608300.0]]
    )
    reciprocating_force_N: tuple[Force, ...] | None = Field(
        None, description="friction force of every row, in order, in place of the efficiency", examples=[[5824.1]]
    )
    rotating_torque_Nm: Annotated[Moment | None, Unit("N m")] = Field(
        None, description="friction torque of the shaft, in place of the efficiency", examples=[435.9]
    )

    def rules(self) -> Iterator[Rule]:
        path = ("mechanical_efficiency",)
        forces = self.reciprocating_force_N is not None or self.rotating_torque_Nm is not None
        if self.mechanical_efficiency is None:
            yield Rule(not forces, path, "give the efficiency, or friction forces and torque")
            useless = self.indicated_power_W is not None
            yield Rule(useless, ("indicated_power_W",), "serves only with a mechanical efficiency")
        else:
            yield Rule(forces, path, "give either the efficiency or friction forces and torque")

    def row_rules(self, rows: int) -> Iterator[Rule]:
        """Lists have one entry for each row; paths from the machine."""
        for field in ("indicated_power_W", "reciprocating_force_N"):
            values = getattr(self, field)
            if values is not None and len(values) != rows:
                yield Rule(True, ("friction", field), f"must hold one value for each of the {rows} row(s)")


class FlywheelData(Ruled):
    """What is known of the turning inertia: the irregularity to be held, or the inertia."""

    model_config = ConfigDict(json_schema_extra=conditions(alternatives("irregularity", "inertia_kg_m2")))

    irregularity: Annotated[float, Strict(), between(1e-6, 2.0)] | None = Field(
        None, description="range of the speed over its mean that is allowed", examples=[0.01]
    )
    inertia_kg_m2: Annotated[float | None, between(1e-12, 1e18), Unit("kg m2")] = Field(
        None, description="polar moment of inertia of all that turns", examples=[1048.0]
    )

    def rules(self) -> Iterator[Rule]:
        broken = (self.irregularity is None) == (self.inertia_kg_m2 is None)
        yield Rule(broken, ("irregularity",), "give either the irregularity or the inertia")


class Bearing(Model):
    """A main bearing of the crankshaft."""

    name: Name = Field(description="name of the bearing, unique in the machine", examples=["A"])
    position_m: Position = Field(description="plane of the bearing along the shaft", examples=[-0.4])
    diameter_m: Length | None = Field(
        None, description="diameter of the journal; needed only by specific loads", examples=[0.12]
    )
    length_m: Length | None = Field(
        None, description="length of the bearing; needed only by specific loads", examples=[0.05]
    )
