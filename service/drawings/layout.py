"""What is drawn of a machine with its weights: places, radii, angles, names.

Lengths are m, angles deg.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Annotated, Literal, NamedTuple

from pydantic import BaseModel, ConfigDict, Field, field_validator
from pydantic_core import PydanticCustomError

from schemas.answer.counterweights import Counterweight
from schemas.base.quantities import Angle, Count, Length, Mass, MaxMass, Name, Position
from schemas.base.units import Unit, non_negative
from schemas.machine.drive import MAX_BEARINGS
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import MAX_BALANCE_SHAFTS, MAX_ROWS_TOGETHER
from schemas.machine.rotor import MAX_WEBS
from schemas.machine.throws import MAX_ROWS, MAX_THROWS

#: of the heaviest counterweight: what rounding leaves of nothing is not drawn
_DUST = 1e-6

Radius = Annotated[Length | None, Unit("m")]


class _Part(BaseModel):
    """Reads what is drawn, of a model or of JSON, and leaves out the rest; ``None`` in a list is not known."""

    model_config = ConfigDict(frozen=True, extra="ignore", allow_inf_nan=False, from_attributes=True)


class Outline(_Part):
    """What is cut from a plate."""

    half_angle_deg: Angle
    chord_height_m: Radius = None
    outer_radius_m: Length


class Weight(_Part):
    """A counterweight on a web."""

    web: Name
    mass_kg: Mass
    angle_deg: Angle
    radius_m: Radius = None
    fixed: bool = False
    shape: Outline | None = None


class Axis(_Part):
    """The axis of a row."""

    name: Name | None = None
    axis_deg: Angle
    offset_m: Position = 0.0


class Crank(_Part):
    """A throw."""

    name: Name | None = None
    position_m: Position
    crank_radius_m: Length
    crank_angle_deg: Angle
    rows: tuple[Axis | None, ...] = Field((), max_length=MAX_ROWS)


class Opening(_Part):
    """The angles that a weight may take."""

    centre_deg: Angle
    half_angle_deg: Angle


class Plate(_Part):
    """The plate from which a weight is cut."""

    inner_radius_m: Annotated[float, non_negative(1e3), Unit("m")] = 0.0
    outer_radius_m: Length
    thickness_m: Radius = None


class Fixed(_Part):
    """Where a weight sits that stays."""

    radius_m: Radius = None


class Place(_Part):
    """A web."""

    name: Name
    position_m: Position
    counterweight_radius_m: Radius = None
    max_mass_kg: Annotated[MaxMass | None, Unit("kg")] = None
    sector: Opening | None = None
    envelope: Plate | None = None
    fixed: Fixed | None = None

    @property
    def radius_m(self) -> float | None:
        """Radius of the centre of mass of what it carries."""
        return (self.fixed.radius_m if self.fixed else None) or self.counterweight_radius_m

    @property
    def reach_m(self) -> float | None:
        """Radius to which a weight reaches: without an envelope that of its centre of mass."""
        return self.envelope.outer_radius_m if self.envelope else self.radius_m


class Fitted(NamedTuple):
    """A weight that can be seen: it has a radius."""

    web: Place
    mass_kg: float
    angle_deg: float
    radius_m: float
    fixed: bool
    shape: Outline | None


class Support(_Part):
    """A main bearing."""

    name: Name | None = None
    position_m: Position


class Ring(_Part):
    """An Oldham ring."""

    type: Literal["oldham"]
    axis_deg: Angle
    position_m: Position


class Pins(_Part):
    """Crank pins of a scroll."""

    type: Literal["crank_pins"]
    count: Annotated[Count, Field(ge=1, le=1000)]
    pin_circle_radius_m: Length
    position_m: Position


class Balancer(_Part):
    """A balance shaft; its webs stand as they do at its shaft angle 0."""

    name: Name
    speed_ratio: Literal[-2, -1, 1, 2]
    x_m: Position = 0.0
    y_m: Position = 0.0
    webs: tuple[Place | None, ...] = Field((), max_length=MAX_WEBS)

    @property
    def places(self) -> tuple[Place, ...]:
        """Webs without empty places."""
        return tuple(filter(None, self.webs))

    @property
    def axis(self) -> tuple[float, float]:
        """Distance from the crankshaft, m, and direction, deg."""
        return math.hypot(self.x_m, self.y_m), math.degrees(math.atan2(self.y_m, self.x_m))


class Balance(NamedTuple):
    """A balance shaft with what can be seen on it."""

    shaft: Balancer
    best: tuple[Fitted, ...]
    built: tuple[Fitted, ...]


class _Shaft(_Part):
    rotation: Literal["ccw", "cw"] = "ccw"
    reference_plane_m: Annotated[Position | None, Unit("m")] = None
    webs: tuple[Place | None, ...] = Field((), max_length=MAX_WEBS)

    @property
    def places(self) -> tuple[Place, ...]:
        """Webs without empty places."""
        return tuple(filter(None, self.webs))


class CrankMachine(_Shaft):
    """A reciprocating machine."""

    kind: Literal["reciprocating"]
    throws: tuple[Crank | None, ...] = Field((), max_length=MAX_THROWS)
    bearings: tuple[Support | None, ...] = Field((), max_length=MAX_BEARINGS)
    balance_shafts: tuple[Balancer | None, ...] = Field((), max_length=MAX_BALANCE_SHAFTS)

    @field_validator("throws")
    @classmethod
    def _few_rows(cls, throws: tuple[Crank | None, ...]) -> tuple[Crank | None, ...]:
        if sum(len(throw.rows) for throw in throws if throw) > MAX_ROWS_TOGETHER:
            raise PydanticCustomError("rows", f"must hold at most {MAX_ROWS_TOGETHER} rows together")
        return throws

    @property
    def cranks(self) -> tuple[tuple[str, Crank], ...]:
        """Throws without empty places, by name or by number from 1."""
        return tuple((throw.name or str(k), throw) for k, throw in enumerate(self.throws, start=1) if throw)

    @property
    def supports(self) -> tuple[tuple[str, Support], ...]:
        """Main bearings without empty places, by name or by number from 1."""
        return tuple((bearing.name or str(k), bearing) for k, bearing in enumerate(self.bearings, start=1) if bearing)


class OrbitMachine(_Shaft):
    """A scroll machine."""

    kind: Literal["scroll"]
    orbit_radius_m: Length
    orbiting_position_m: Position
    anti_rotation: Annotated[Ring | Pins | None, Field(discriminator="type")] = None


class Layout(_Part):
    """A machine with what is best on it, and with what is fitted in place of that."""

    machine: Annotated[CrankMachine | OrbitMachine, Field(discriminator="kind")]
    counterweights: tuple[Weight | None, ...] = ()
    fitted: tuple[Weight | None, ...] = ()

    @property
    def best(self) -> tuple[Fitted, ...]:
        """The counterweights on the crankshaft that can be seen."""
        return tuple(self._weights(self.counterweights, self.machine.places))

    @property
    def built(self) -> tuple[Fitted, ...]:
        """What is fitted in place of them and can be seen."""
        return tuple(self._weights(self.fitted, self.machine.places))

    @property
    def balance(self) -> tuple[Balance, ...]:
        """The balance shafts without empty places."""
        machine = self.machine
        shafts = filter(None, machine.balance_shafts) if isinstance(machine, CrankMachine) else ()
        return tuple(
            Balance(
                shaft,
                tuple(self._weights(self.counterweights, shaft.places)),
                tuple(self._weights(self.fitted, shaft.places)),
            )
            for shaft in shafts
        )

    def _weights(self, weights: Sequence[Weight | None], places: Sequence[Place]) -> Iterator[Fitted]:
        """Weights of a shaft with the radius of their own, of the web, or of the counterweight that they stand for."""
        webs = {web.name: web for web in places}
        radii = {counterweight.web: counterweight.radius_m for counterweight in self.counterweights if counterweight}
        heaviest = max((weight.mass_kg for weight in weights if weight), default=0.0)
        for weight in weights:
            if weight is None or weight.web not in webs or not weight.mass_kg > _DUST * heaviest:
                continue
            web = webs[weight.web]
            radius = weight.radius_m or web.radius_m or radii.get(weight.web)
            if radius is not None:
                yield Fitted(web, weight.mass_kg, weight.angle_deg, radius, weight.fixed, weight.shape)

    @property
    def reference_plane_m(self) -> float:
        """The plane of moments: where the machine names none, midway between what turns (mathematics, section 2)."""
        machine = self.machine
        if machine.reference_plane_m is not None:
            return machine.reference_plane_m
        if isinstance(machine, OrbitMachine):
            return machine.orbiting_position_m
        planes = [crank.position_m for _, crank in machine.cranks] or [place.position_m for place in machine.places]
        return (min(planes) + max(planes)) / 2.0


def layout_of(machine: Machine, best: Sequence[Counterweight], built: Sequence[Counterweight] = ()) -> Layout:
    """A whole machine with its counterweights, those on balance shafts among them."""
    return Layout.model_validate({"machine": machine, "counterweights": best, "fitted": built})
