"""Places for counterweights, and what may sit there."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import ConfigDict, Field

from schemas.base.model import Model, NotEmpty
from schemas.base.presence import absent, conditions, present, when
from schemas.base.quantities import Angle, Count, Flag, Length, Mass, MaxMass, Name, Position
from schemas.base.rules import REQUIRED, Rule, Ruled
from schemas.base.units import Unit, between, positive
from schemas.machine.catalogue import Holes, Masses
from schemas.machine.choices import KINDS as CHOICES
from schemas.machine.throws import MAX_THROWS

#: largest inner radius, as a share of the outer one
_INNERMOST = 0.999
MAX_GROUPED = 500
#: fields of a web with options for its counterweight
_CHOICE_FIELDS = (
    "envelope", "sector", *CHOICES, "max_centrifugal_force_N", "min_fitted_mass_kg",
)  # fmt: skip
#: what follows from an envelope, or is limited by it
_OF_ENVELOPES = ("max_mass_kg", "max_centrifugal_force_N", "min_fitted_mass_kg")


class Sector(Model):
    """The angles that a counterweight may take: centre plus or minus half the opening."""

    centre_deg: Angle = Field(description="middle of the sector, as drawn at shaft angle 0", examples=[180.0])
    half_angle_deg: Annotated[float, positive(90.0), Unit("deg")] = Field(
        description="half the opening of the sector, above 0 and at most 90 degrees", examples=[60.0]
    )


class Envelope(Ruled):
    """The plate from which a counterweight is cut: between two radii, about the direction of its unbalance."""

    shape: Literal["sector", "segment"] = Field(
        description="sector: bounded by both radii and two edges through the shaft; segment: by a chord and the outer"
        " radius, the lightest outline that there is",
        examples=["segment"],
    )
    inner_radius_m: Annotated[float, between(0.0, 1e3), Unit("m")] = Field(
        0.0, description="radius of what is in the way, as the hub; 0 where nothing is", examples=[0.06]
    )
    outer_radius_m: Annotated[float, between(1e-4, 1e3), Unit("m")] = Field(
        description="radius that the counterweight may reach", examples=[0.25]
    )
    thickness_m: Annotated[float, between(1e-5, 1e2), Unit("m")] = Field(
        description="thickness along the shaft", examples=[0.04]
    )
    density_kg_m3: Annotated[float, between(1.0, 1e5), Unit("kg/m3")] = Field(
        7850.0, description="density; steel if not said", examples=[7850]
    )
    max_half_angle_deg: Annotated[float, between(0.1, 90.0), Unit("deg")] = Field(
        90.0, description="half of the largest opening, as seen from the shaft at the outer radius", examples=[75.0]
    )

    def rules(self) -> Iterator[Rule]:
        # what is thinner is no plate, and its figures are what rounding leaves of large ones
        thin = self.inner_radius_m > _INNERMOST * self.outer_radius_m
        yield Rule(thin, ("inner_radius_m",), f"must be smaller than {_INNERMOST:g} of the outer radius")


class FixedWeight(Model):
    """A weight that is on the crank already and stays there."""

    mass_kg: Mass = Field(description="its mass", examples=[12.5])
    angle_deg: Angle = Field(description="its angle as drawn at shaft angle 0", examples=[180.0])
    radius_m: Annotated[Length | None, Unit("m")] = Field(
        None, description="radius of its centre of mass; null is the web's counterweight_radius_m", examples=[0.2]
    )


class WebGroup(Model):
    """Webs that get identical castings: the same weight, in the same place on their own cranks or mirrored there."""

    name: Name = Field(description="name of the group, unique in the machine", examples=["cheeks"])
    webs: Annotated[tuple[Name, ...], Field(max_length=MAX_GROUPED), NotEmpty()] = Field(
        description="names of its webs, which are equal", examples=[["1a", "1b"]]
    )
    mirror: Flag = Field(
        False,
        description="every second web of the list carries the mirror image, about the plane of its own crank: the same"
        " mass, at the same angle on the other side of the crank",
        examples=[False],
    )

    def mirrors(self, place: int) -> bool:
        """Whether the web at a place of the list carries the mirror image."""
        return self.mirror and place % 2 == 1


class Web(Ruled):
    """A place where a counterweight can sit: a crank web, a shaft end or a flywheel."""

    model_config = ConfigDict(
        json_schema_extra={
            "anyOf": [
                {"required": ["counterweight_radius_m", "max_mass_kg"]},
                {"required": ["envelope"]},
                {"required": ["fixed"]},
            ],
            **conditions(
                when(present("fixed"), absent(*_CHOICE_FIELDS)),
                when(present("envelope"), absent("counterweight_radius_m", *_OF_ENVELOPES)),
                when(
                    absent("fixed", "envelope"),
                    {
                        "required": ["max_mass_kg", "counterweight_radius_m"],
                        "properties": {"counterweight_radius_m": {"not": {"type": "null"}}},
                    },
                ),
            ),
        }
    )

    name: Name = Field(description="name of the place, unique in the machine", examples=["1a"])
    position_m: Position = Field(description="plane of the counterweight along the shaft (z)", examples=[0.28])
    counterweight_radius_m: Annotated[Length | None, Unit("m")] = Field(
        None, description="radius of the counterweight's centre of mass; not with an envelope", examples=[0.25]
    )
    max_mass_kg: Annotated[MaxMass | None, Unit("kg")] = Field(
        None,
        description="largest counterweight that fits; 0 allows none, null is no limit; must be said but for an"
        " envelope",
        examples=[60.0],
    )
    envelope: Envelope | None = Field(
        None,
        description="the plate from which the counterweight is cut, in place of its radius and its largest mass",
        examples=[None],
    )
    fixed: FixedWeight | None = Field(
        None,
        description="a counterweight that is fitted already: it counts in the total mass and in the residual, and this"
        " web takes no other",
        examples=[None],
    )
    min_fitted_mass_kg: Annotated[Annotated[float, positive(1e15)] | None, Unit("kg")] = Field(
        None,
        description="a counterweight is at least so heavy, or there is none; null sets no least",
        examples=[None],
    )
    max_centrifugal_force_N: Annotated[Annotated[float, positive(1e30)] | None, Unit("N")] = Field(
        None,
        description="largest centrifugal force of the counterweight at overspeed_rpm, which its bolts bear; on a"
        " balance shaft at its own speed then; null is no limit",
        examples=[None],
    )
    sector: Sector | None = Field(
        None,
        description="angles that the counterweight may take; null allows every angle",
        examples=[{"centre_deg": 180, "half_angle_deg": 60}],
    )
    throw: Annotated[Count, Field(ge=0, lt=MAX_THROWS)] | None = Field(
        None,
        description="number from 0 of the throw whose crank the web belongs to; null is the nearest, and none where"
        " two are equally near",
        examples=[0],
    )
    catalogue_masses_kg: Masses | None = Field(
        None, description="masses that there are for this web, in place of those of the catalogue", examples=[None]
    )
    hole_angles_deg: Holes | None = Field(
        None,
        description="angles as drawn at shaft angle 0 of the bolt holes, in place of steps of the catalogue",
        examples=[None],
    )

    @property
    def radius_m(self) -> float | None:
        """Radius of the centre of mass of what it carries; None where that follows from an envelope."""
        if self.fixed is not None and self.fixed.radius_m is not None:
            return self.fixed.radius_m
        return self.counterweight_radius_m

    @property
    def reach_m(self) -> float:
        """Radius to which a counterweight reaches at most: without an envelope that of its centre of mass."""
        return self.envelope.outer_radius_m if self.envelope else self.radius_m or 0.0

    def rules(self) -> Iterator[Rule]:
        if self.min_fitted_mass_kg is not None and self.fixed is None:
            path, most = ("min_fitted_mass_kg",), self.max_mass_kg
            yield Rule(self.envelope is not None, path, "remove it: a web with an `envelope` has no minimum mass")
            if most is not None:
                yield Rule(self.min_fitted_mass_kg > most, path, "more than max_mass_kg of this web")
        if self.fixed is not None:
            yield Rule(self.radius_m is None, ("fixed", "radius_m"), REQUIRED)
            if self.max_mass_kg is not None:
                heavier = self.fixed.mass_kg > self.max_mass_kg
                yield Rule(heavier, ("fixed", "mass_kg"), "more than max_mass_kg of this web")
            for name in _CHOICE_FIELDS:
                if getattr(self, name) is not None:
                    yield Rule(True, (name,), f"remove `{name}`: this web has a fixed counterweight")
        elif self.envelope is None:
            # left out, and not null: no limit has to be meant
            if "max_mass_kg" not in self.__pydantic_fields_set__:
                yield Rule(True, ("max_mass_kg",), REQUIRED)
            if self.counterweight_radius_m is None:
                yield Rule(True, ("counterweight_radius_m",), REQUIRED)
        else:
            message = "remove it: it follows from the `envelope` of this web"
            yield Rule(self.counterweight_radius_m is not None, ("counterweight_radius_m",), message)
            yield Rule(self.max_mass_kg is not None, ("max_mass_kg",), message)
            bolted = self.max_centrifugal_force_N is not None
            message = "remove it: limit `max_half_angle_deg` of the `envelope` instead"
            yield Rule(bolted, ("max_centrifugal_force_N",), message)
