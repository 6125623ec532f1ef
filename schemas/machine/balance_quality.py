"""Balance quality of a shaft after ISO 21940-11: the grade of a request, and the grade of an answer."""

from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from schemas.base.model import Model
from schemas.base.quantities import Degrees, KilogramMetres, Metres, Position
from schemas.base.rules import Rule, Ruled
from schemas.base.units import Unit, between

Grade = Annotated[float, between(1e-3, 1e6), Unit("mm/s")]


class BalanceQuality(Ruled):
    """The grade that is asked for, and the rotor and the planes that it is of."""

    grade_mm_s: Grade = Field(description="balance quality grade G", examples=[6.3])
    mass_kg: Annotated[float, between(1e-9, 1e15), Unit("kg")] = Field(
        description="mass of the rotor: the shaft with all that turns on it", examples=[420.0]
    )
    centre_of_mass_m: Position = Field(description="plane of the rotor's centre of mass", examples=[0.0])
    plane_a_m: Position = Field(description="tolerance plane on one side of it, such as a bearing", examples=[-0.4])
    plane_b_m: Position = Field(description="tolerance plane on its other side", examples=[0.4])

    def rules(self) -> Iterator[Rule]:
        arm_a, arm_b = self.centre_of_mass_m - self.plane_a_m, self.plane_b_m - self.centre_of_mass_m
        apart = (arm_a > 0) & (arm_b > 0) | (arm_a < 0) & (arm_b < 0)
        yield Rule(apart == 0, ("centre_of_mass_m",), "must lie between plane_a_m and plane_b_m")


class PlaneUnbalance(Model):
    """Unbalance in one tolerance plane."""

    position_m: Metres = Field(description="the plane", examples=[-0.4])
    permissible_kg_m: KilogramMetres = Field(description="permissible residual unbalance in it", examples=[0.0253])
    unbalance_kg_m: KilogramMetres = Field(description="deviation from the design unbalance in it", examples=[0.012])
    angle_deg: Degrees = Field(
        description="direction of the deviation as drawn at shaft angle 0; 0 where there is none", examples=[90.0]
    )


class Grading(Model):
    """How far the shaft deviates from its design unbalance."""

    grade_mm_s: Annotated[float, Unit("mm/s")] = Field(
        description="grade reached: the larger of what both planes come to", examples=[2.98]
    )
    plane_a: PlaneUnbalance = Field(description="first plane", examples=[{"unbalance_kg_m": 0.012}])
    plane_b: PlaneUnbalance = Field(description="second plane", examples=[{"unbalance_kg_m": 0.003}])


class GradeReached(Model):
    """Balance quality with and without counterweights.

    By its design a shaft has the unbalance that turns against half of every reciprocating mass. What deviates from that
    is the first-order force and moment that turn with the shaft.
    """

    permissible_kg_m: KilogramMetres = Field(
        description="permissible residual unbalance of the rotor, grade times mass over angular speed",
        examples=[0.0505],
    )
    before: Grading = Field(description="without counterweights", examples=[{"grade_mm_s": 812.0}])
    after: Grading | None = Field(description="with them; null if infeasible", examples=[{"grade_mm_s": 2.98}])
