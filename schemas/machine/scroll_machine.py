"""The scroll machine: an orbiting scroll and what keeps it from turning."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import ConfigDict, Field

from schemas.base.model import Model
from schemas.base.presence import conditions, either
from schemas.base.quantities import Angle, Count, Length, Mass, Position
from schemas.base.rules import Rule
from schemas.machine.drive import Bearing
from schemas.machine.rotor import Rotor
from schemas.machine.throws import Throw
from schemas.scroll.drive_bearing import DriveBearing
from schemas.scroll.over_turn import ForceOverTurn, PinRadius, TorqueOverTurn


class OldhamRing(Model):
    """A ring that reciprocates along its axis with the amplitude of the orbit."""

    type: Literal["oldham"] = Field(description="an Oldham ring", examples=["oldham"])
    mass_kg: Mass = Field(description="mass of the ring", examples=[0.35])
    axis_deg: Angle = Field(description="direction in which the ring slides", examples=[90.0])
    position_m: Position = Field(description="plane of the ring along the shaft", examples=[0.03])


class CrankPins(Model):
    """Small crank pins in frame and orbiting scroll that keep the scroll from turning."""

    type: Literal["crank_pins"] = Field(description="crank pins", examples=["crank_pins"])
    count: Count = Field(ge=1, le=1000, description="number of evenly spaced pins", examples=[3])
    pin_circle_radius_m: PinRadius = Field(description="radius of the circle through the pins", examples=[0.05])
    eccentric_mass_kg: Mass = Field(
        0.0, description="rotating unbalanced mass of one pin, referred to the orbit radius", examples=[0.02]
    )
    position_m: Position = Field(description="plane of the pins' unbalance along the shaft", examples=[0.03])


class ScrollMachine(Rotor):
    """A scroll compressor or expander; the eccentric points along +x at shaft angle 0."""

    model_config = ConfigDict(json_schema_extra=conditions(either("rotation_torque_Nm", "tangential_gas_force_N")))

    kind: Literal["scroll"] = Field(description="kind of machine", examples=["scroll"])
    orbit_radius_m: Length = Field(description="radius of the orbit", examples=[0.005])
    orbiting_mass_kg: Mass = Field(description="orbiting scroll with its bearing", examples=[1.2])
    orbiting_position_m: Position = Field(description="plane of the orbiting scroll's centre of mass", examples=[0.05])
    anti_rotation: Annotated[OldhamRing | CrankPins, Field(discriminator="type")] = Field(
        description="what keeps the scroll from turning",
        examples=[{"type": "crank_pins", "count": 3, "pin_circle_radius_m": 0.05, "position_m": 0.03}],
    )
    drive_bearing: DriveBearing = Field(
        DriveBearing(),
        description="what the drive's bearing carries beside crank pins; serves pin_loads alone",
        examples=[{"type": "rigid"}],
    )

    rotation_torque_Nm: TorqueOverTurn | None = Field(
        None,
        description="torque that turns the scroll about itself, constant or over one revolution; needed by pin_loads",
        examples=[12.5],
    )
    tangential_gas_force_N: ForceOverTurn | None = Field(
        None,
        description="tangential gas force on the scroll, in place of the torque that it causes",
        examples=[5000.0],
    )

    @property
    def throws(self) -> tuple[Throw, ...]:
        """None: it has no cranks."""
        return ()

    @property
    def bearings(self) -> tuple[Bearing, ...]:
        """None: main bearings are those of a crankshaft."""
        return ()

    def rules(self) -> Iterator[Rule]:
        yield from super().rules()
        for k, web in enumerate(self.webs):
            yield Rule(web.throw is not None, ("webs", k, "throw"), "a scroll has no throws")
        is_twice = self.rotation_torque_Nm is not None and self.tangential_gas_force_N is not None
        yield Rule(is_twice, ("rotation_torque_Nm",), "give either the torque or the gas force")
