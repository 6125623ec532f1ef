"""Quantities over one turn of the shaft: a constant, or a table with periodic linear interpolation."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated, Any

from pydantic import Discriminator, Field, Tag, model_validator

from schemas.base import FieldProblem, Model, raise_problems
from schemas.units import Unit, between, symmetric

MAX_TABLE = 3601

# the ranges keep every product and quotient of them far inside the floating-point numbers
PinRadius = Annotated[float, between(1e-6, 1e6), Unit("m")]
Torque = Annotated[float, symmetric(1e18), Unit("N m")]
GasForce = Annotated[float, symmetric(1e18), Unit("N")]
TableAngles = Annotated[
    tuple[Annotated[float, between(0.0, 360.0), Unit("deg")], ...],
    Field(
        min_length=2,
        max_length=MAX_TABLE,
        description="shaft angles, rising, within one turn from 0; a last one at 360 repeats the first value",
        examples=[[0.0, 120.0, 240.0]],
    ),
]


class TorqueTable(Model):
    """A torque over one turn; linear between the entries, and from the last one on to the first."""

    angle_deg: TableAngles
    torque_Nm: tuple[Torque, ...] = Field(description="torque at these angles", examples=[[12.0, 15.0, 13.0]])

    @model_validator(mode="after")
    def _check(self) -> "TorqueTable":
        raise_problems(_table_problems(self.angle_deg, self.torque_Nm, "torque_Nm"))
        return self


class ForceTable(Model):
    """A force over one turn; linear between the entries, and from the last one on to the first."""

    angle_deg: TableAngles
    force_N: tuple[GasForce, ...] = Field(description="force at these angles", examples=[[4000.0, 5000.0, 4300.0]])

    @model_validator(mode="after")
    def _check(self) -> "ForceTable":
        raise_problems(_table_problems(self.angle_deg, self.force_N, "force_N"))
        return self


def _table_problems(angles: tuple[float, ...], values: tuple[float, ...], name: str) -> Iterator[FieldProblem]:
    if len(values) != len(angles):
        yield FieldProblem((name,), f"must hold one value for each of the {len(angles)} angles")
    falling = [index for index, (left, right) in enumerate(pairwise(angles), start=1) if not left < right]
    for index in falling[:1]:
        yield FieldProblem(("angle_deg", index), "the angles must rise")
    if falling or len(values) != len(angles) or angles[-1] != 360.0:
        return
    if angles[0] != 0.0:
        yield FieldProblem(("angle_deg", len(angles) - 1), "360 ends the turn only if the table begins at 0")
    elif values[-1] != values[0]:
        yield FieldProblem((name, len(values) - 1), "the value at 360 must be that at 0: the table is one turn")
    elif len(angles) < 3:
        yield FieldProblem(("angle_deg",), "must hold at least two different angles of the turn")


def _form(value: Any) -> str:
    return "table" if isinstance(value, dict | Model) else "number"


TorqueOverTurn = Annotated[
    Annotated[Torque, Tag("number")] | Annotated[TorqueTable, Tag("table")], Discriminator(_form)
]
ForceOverTurn = Annotated[
    Annotated[GasForce, Tag("number")] | Annotated[ForceTable, Tag("table")], Discriminator(_form)
]
