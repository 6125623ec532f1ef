"""The bearing between the eccentric of the shaft and an orbiting scroll: what it carries beside the pins."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from schemas.base.rules import Rule, Ruled
from schemas.base.units import Unit, between

# the ranges keep every product and quotient of them far inside the floating-point numbers
Stiffness = Annotated[float, between(1e-6, 1e18), Unit("N/m")]


class DriveBearing(Ruled):
    """Where the loads of the pins do not sum to 0, the drive's bearing carries the rest, along the eccentric."""

    type: Literal["free", "rigid", "elastic"] = Field(
        "free",
        description="free: it gives way along the eccentric and carries nothing; rigid: it holds the scroll's centre; "
        "elastic: it gives way by its stiffness",
        examples=["rigid"],
    )
    stiffness_N_per_m: Annotated[Stiffness | None, Unit("N/m")] = Field(
        None, description="stiffness of an elastic bearing", examples=[5e7]
    )

    @property
    def carries(self) -> bool:
        """Whether it carries what the pins do not."""
        return self.type != "free"

    def rules(self) -> Iterator[Rule]:
        path, elastic = ("stiffness_N_per_m",), self.type == "elastic"
        yield Rule(elastic and self.stiffness_N_per_m is None, path, "an elastic bearing needs its stiffness")
        yield Rule(not elastic and self.stiffness_N_per_m is not None, path, "only an elastic bearing has one")
