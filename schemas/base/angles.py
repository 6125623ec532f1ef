"""Where sampled outputs are sampled."""

from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from schemas.base.rules import Rule, Ruled
from schemas.base.units import Unit


class Angles(Ruled):
    """Where sampled outputs are sampled."""

    step_deg: Annotated[float, Field(ge=0.01, le=120), Unit("deg")] = Field(
        1.0, description="step of the shaft angle; a revolution must hold a whole number of them", examples=[1.0]
    )

    def rules(self) -> Iterator[Rule]:
        steps = 360 / self.step_deg
        broken = abs(steps - round(steps)) > 1e-9 * steps
        yield Rule(broken, ("step_deg",), "360 degrees must be a whole number of steps")

    @property
    def count(self) -> int:
        """Number of samples in one turn, the end point not counted twice."""
        return round(360 / self.step_deg)
