"""What there is to fit: masses, angles, how many counterweights and of how many part numbers."""

from collections.abc import Iterator, Sequence
from math import isfinite
from typing import Annotated, Any

from pydantic import ConfigDict, Field

from schemas.base.presence import conditions, either
from schemas.base.quantities import Angle, Count, Mass
from schemas.base.rules import Path, Rule, Ruled
from schemas.base.units import Unit, positive

MAX_MASSES, MAX_HOLES = 1_000, 720
#: default of the certified gap for discrete choices
DISCRETE_GAP = 1e-3
#: by which an angle may be outside of its sector, degrees: the rounding of angles of a turn, which bounds allow for
_ANGLE = 2e-13

Masses = Annotated[tuple[Mass, ...], Field(max_length=MAX_MASSES)]
Holes = Annotated[tuple[Angle, ...], Field(max_length=MAX_HOLES)]


class Catalogue(Ruled):
    """What counterweights are chosen from; every web may also be left without one."""

    model_config = ConfigDict(json_schema_extra=conditions(either("masses_kg", "mass_step_kg")))

    masses_kg: Masses | None = Field(
        None, description="masses that there are, for webs without a list of their own", examples=[[5, 10, 20]]
    )
    mass_step_kg: Annotated[float, positive(1e15), Unit("kg")] | None = Field(
        None, description="in place of a list: all whole multiples of it up to max_mass_kg of the web", examples=[None]
    )
    angle_step_deg: Annotated[float, Field(gt=0, le=180), Unit("deg")] | None = Field(
        None,
        description="step of the angles for webs without holes, counted from the own crank; a revolution must hold a"
        " whole number of steps",
        examples=[15.0],
    )
    max_part_numbers: Annotated[Count, Field(ge=1, le=MAX_MASSES)] | None = Field(
        None, description="most different masses that may be used; null is no limit", examples=[2]
    )

    def rules(self) -> Iterator[Rule]:
        yield from masses_rules(("masses_kg",), self.masses_kg)
        is_twice = self.masses_kg is not None and self.mass_step_kg is not None
        yield Rule(is_twice, ("mass_step_kg",), "give either the masses or their step")
        if self.angle_step_deg is not None:
            yield from angle_step_rules(("angle_step_deg",), self.angle_step_deg)


def angle_step_rules(path: Path, angle_step_deg: float) -> Iterator[Rule]:
    """What a step of angles has to hold."""
    steps = 360 / angle_step_deg
    # of the smallest numbers there are infinitely many
    broken = not isfinite(steps) or abs(steps - round(steps)) > 1e-9 * steps
    yield Rule(broken, path, "360 degrees must be a whole number of steps")


def in_sector(angle_deg: Any, centre_deg: float, half_angle_deg: float) -> Any:
    """Whether an angle, or each of an array, is in a sector, but for rounding."""
    off = abs((angle_deg % 360.0 - centre_deg % 360.0 + 180.0) % 360.0 - 180.0)
    return off <= half_angle_deg + _ANGLE


def masses_rules(path: Path, masses: Sequence[float] | None) -> Iterator[Rule]:
    """What a list of masses has to hold, kg; None is no list."""
    if masses is None:
        return
    yield Rule(not any(mass > 0 for mass in masses), path, "must hold a mass above 0")
    earlier: set[float] = set()
    for n, mass in enumerate(masses):
        yield Rule(mass in earlier, (*path, n), "this mass is in the list already")
        earlier.add(mass)
