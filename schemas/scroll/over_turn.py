"""Quantities over one turn of the shaft: a constant, or a table with periodic linear interpolation."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated, Any

from pydantic import Discriminator, Field, Tag

from schemas.base.model import Model
from schemas.base.rules import Rule, Ruled, first_of
from schemas.base.units import Unit, between, symmetric

MAX_TABLE = 3601
#: degrees between entries; a table may be steep, but it does not jump
LEAST_STEP_DEG = 1e-9

# the ranges keep every product and quotient of them far inside the floating-point numbers
LEAST_PIN_RADIUS_M, LARGEST_PIN_RADIUS_M = 1e-6, 1e6
PinRadius = Annotated[float, between(LEAST_PIN_RADIUS_M, LARGEST_PIN_RADIUS_M), Unit("m")]
Torque = Annotated[float, symmetric(1e18), Unit("N m")]
GasForce = Annotated[float, symmetric(1e18), Unit("N")]
TableAngles = Annotated[
    tuple[Annotated[float, between(0.0, 360.0), Unit("deg")], ...],
    Field(
        min_length=2,
        max_length=MAX_TABLE,
        description="shaft angles, rising, within one revolution from 0; a last one at 360 repeats the first value",
        examples=[[0.0, 120.0, 240.0]],
    ),
]


class TorqueTable(Ruled):
    """A torque over one turn; linear between the entries, and from the last one on to the first."""

    angle_deg: TableAngles
    torque_Nm: tuple[Torque, ...] = Field(description="torque at these angles", examples=[[12.0, 15.0, 13.0]])

    def rules(self) -> Iterator[Rule]:
        return _table_rules(self.angle_deg, self.torque_Nm, "torque_Nm")


class ForceTable(Ruled):
    """A force over one turn; linear between the entries, and from the last one on to the first."""

    angle_deg: TableAngles
    force_N: tuple[GasForce, ...] = Field(description="force at these angles", examples=[[4000.0, 5000.0, 4300.0]])

    def rules(self) -> Iterator[Rule]:
        return _table_rules(self.angle_deg, self.force_N, "force_N")


def _table_rules(angles: tuple[float, ...], values: tuple[float, ...], name: str) -> Iterator[Rule]:
    rising = [
        Rule(right - left < LEAST_STEP_DEG, ("angle_deg", k), f"the angles must rise, by {LEAST_STEP_DEG:g} at least")
        for k, (left, right) in enumerate(pairwise(angles), start=1)
    ]
    if len(values) != len(angles):
        yield Rule(True, (name,), f"must hold one value for each of the {len(angles)} angles")
        yield from first_of(rising)
        return
    whole, last = angles[-1] == 360.0, len(angles) - 1
    late, jumps, short = whole & (angles[0] != 0.0), whole & (values[-1] != values[0]), whole & (len(angles) < 3)
    yield from first_of(
        [
            *rising,
            Rule(late, ("angle_deg", last), "360 ends the revolution only if the table begins at 0"),
            Rule(jumps, (name, last), "the value at 360 must be that at 0: the table is one revolution"),
            Rule(short, ("angle_deg",), "must hold at least two different angles of the revolution"),
        ]
    )


def _form(value: Any) -> str:
    return "table" if isinstance(value, dict | Model) else "number"


TorqueOverTurn = Annotated[
    Annotated[Torque, Tag("number")] | Annotated[TorqueTable, Tag("table")], Discriminator(_form)
]
ForceOverTurn = Annotated[
    Annotated[GasForce, Tag("number")] | Annotated[ForceTable, Tag("table")], Discriminator(_form)
]
