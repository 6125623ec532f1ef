"""What there is to fit: masses, angles, how many counterweights and of how many part numbers."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import Field

from schemas.quantities import Angle, Count, Mass
from schemas.rules import Path, Rule, Ruled
from schemas.units import Unit, positive

if TYPE_CHECKING:
    from schemas.rotor import Rotor
    from schemas.webs import Web

MAX_MASSES, MAX_HOLES = 1_000, 720
#: masses times angles of one web, and of all webs together
MAX_OPTIONS, MAX_OPTIONS_TOGETHER = 20_000, 200_000
#: certified gap that discrete choices are asked for where nothing is said
DISCRETE_GAP = 1e-3
#: by which an angle may be outside of its sector, degrees: the rounding of angles of a turn, which bounds allow for
_ANGLE = 2e-13

Masses = Annotated[tuple[Mass, ...], Field(max_length=MAX_MASSES)]
Holes = Annotated[tuple[Angle, ...], Field(max_length=MAX_HOLES)]


class Catalogue(Ruled):
    """What counterweights are chosen from; every web may also be left without one."""

    masses_kg: Masses | None = Field(
        None, description="masses that there are, for webs without a list of their own", examples=[[5, 10, 20]]
    )
    mass_step_kg: Annotated[float, positive(1e15), Unit("kg")] | None = Field(
        None, description="in place of a list: all whole multiples of it up to max_mass_kg of the web", examples=[None]
    )
    angle_step_deg: Annotated[float, Field(gt=0, le=180), Unit("deg")] | None = Field(
        None,
        description="angles that there are, counted from the own crank, for webs without holes; a turn must hold a"
        " whole number of them",
        examples=[15.0],
    )
    max_part_numbers: Annotated[Count, Field(ge=1, le=MAX_MASSES)] | None = Field(
        None, description="most different masses that may be used; null is no limit", examples=[2]
    )

    def rules(self) -> Iterator[Rule]:
        yield from _masses_rules(("masses_kg",), self.masses_kg)
        both = self.masses_kg is not None and self.mass_step_kg is not None
        yield Rule(both, ("mass_step_kg",), "give either the masses or their step")
        if self.angle_step_deg is not None:
            steps = 360 / self.angle_step_deg
            broken = abs(steps - round(steps)) > 1e-9 * steps
            yield Rule(broken, ("angle_step_deg",), "360 degrees must be a whole number of steps")


def stated(machine: "Rotor") -> Iterator[Path]:
    """Fields by which a machine asks for discrete choices."""
    for name in ("catalogue", "max_counterweights"):
        if getattr(machine, name) is not None:
            yield (name,)
    for k, web in enumerate(machine.webs):
        for name in ("catalogue_masses_kg", "hole_angles_deg"):
            if getattr(web, name) is not None:
                yield ("webs", k, name)


def no_catalogue(machine: "Rotor", path: Path, what: str) -> Iterator[Rule]:
    """Refuses discrete choices where counterweights of any mass and angle are chosen."""
    heavy = (k for k, web in enumerate(machine.webs) if web.min_fitted_mass_kg is not None)
    least = (("webs", k, "min_fitted_mass_kg") for k in heavy)
    for field in (*stated(machine), *least):
        yield Rule(True, (*path, *field), f"serves only to optimize one machine as it is given, not {what}")


def no_groups(machine: "Rotor", path: Path, what: str) -> Iterator[Rule]:
    """Refuses identical castings where counterweights are chosen one by one."""
    message = f"serves only to choose the counterweights of a machine, not {what}"
    yield Rule(bool(machine.web_groups), (*path, "web_groups"), message)


def catalogue_rules(machine: "Rotor") -> Iterator[Rule]:
    """What the discrete choices of a machine have to hold."""
    if not any(True for _ in stated(machine)):
        return
    catalogue, together = machine.catalogue or Catalogue(), 0
    for k, web in enumerate(machine.webs):
        if web.fixed is not None:
            continue
        yield from _masses_rules(("webs", k, "catalogue_masses_kg"), web.catalogue_masses_kg)
        yield from _hole_rules(("webs", k, "hole_angles_deg"), web)
        step = catalogue.mass_step_kg if web.catalogue_masses_kg is None else None
        no_masses = web.catalogue_masses_kg is None and catalogue.masses_kg is None and step is None
        message = "chosen from a catalogue: give the masses of this web, or masses or their step for all"
        yield Rule(no_masses, ("webs", k, "catalogue_masses_kg"), message)
        no_angles = web.hole_angles_deg is None and catalogue.angle_step_deg is None
        message = "chosen from a catalogue: give the holes of this web, or a step of angles for all"
        yield Rule(no_angles, ("webs", k, "hole_angles_deg"), message)
        endless = step is not None and web.max_mass_kg is None
        yield Rule(endless, ("webs", k, "max_mass_kg"), "steps of mass need a largest mass")
        if no_masses or no_angles or endless:
            continue
        masses = len(web.catalogue_masses_kg or catalogue.masses_kg or ())
        if step is not None:
            masses = int(min((web.max_mass_kg or 0.0) / step, 1e9))
        angles = len(web.hole_angles_deg or ()) or round(360 / (catalogue.angle_step_deg or 360))
        together += masses * angles
        message = f"masses times angles of a web must be at most {MAX_OPTIONS}"
        yield Rule(masses * angles > MAX_OPTIONS, ("webs", k), message)
    message = f"masses times angles of all webs together must be at most {MAX_OPTIONS_TOGETHER}"
    yield Rule(together > MAX_OPTIONS_TOGETHER, ("webs",), message)


def in_sector(angle_deg: Any, centre_deg: float, half_angle_deg: float) -> Any:
    """Whether an angle, or each of an array, is in a sector, but for rounding."""
    off = abs((angle_deg % 360.0 - centre_deg % 360.0 + 180.0) % 360.0 - 180.0)
    return off <= half_angle_deg + _ANGLE


def _masses_rules(path: Path, masses: Sequence[float] | None) -> Iterator[Rule]:
    if masses is None:
        return
    yield Rule(not any(mass > 0 for mass in masses), path, "must hold a mass above 0")
    seen: set[float] = set()
    for n, mass in enumerate(masses):
        yield Rule(mass in seen, (*path, n), "this mass is in the list already")
        seen.add(mass)


def _hole_rules(path: Path, web: "Web") -> Iterator[Rule]:
    if web.hole_angles_deg is None:
        return
    yield Rule(not web.hole_angles_deg, path, "must hold at least one angle")
    seen: set[float] = set()
    for n, angle in enumerate(web.hole_angles_deg):
        yield Rule(angle % 360.0 in seen, (*path, n), "this hole is in the list already")
        seen.add(angle % 360.0)
        if web.sector is not None:
            inside = in_sector(angle, web.sector.centre_deg, web.sector.half_angle_deg)
            yield Rule(not inside, (*path, n), "this hole is outside the sector")
