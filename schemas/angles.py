"""Where sampled outputs are sampled."""

from typing import Annotated

from pydantic import Field, model_validator

from schemas.base import FieldProblem, Model, raise_problems
from schemas.units import Unit


class Angles(Model):
    """Where sampled outputs are sampled."""

    step_deg: Annotated[float, Field(ge=0.01, le=120), Unit("deg")] = Field(
        1.0, description="step of the shaft angle; a turn must hold a whole number of them", examples=[1.0]
    )

    @model_validator(mode="after")
    def _check(self) -> "Angles":
        steps = 360 / self.step_deg
        if abs(steps - round(steps)) > 1e-9 * steps:
            raise_problems([FieldProblem(("step_deg",), "360 degrees must be a whole number of steps")])
        return self

    @property
    def count(self) -> int:
        """Number of samples in one turn, the end point not counted twice."""
        return round(360 / self.step_deg)
