"""Losses of the anti-rotation pins of a scroll beside those of an Oldham ring: request and answer."""

from typing import Annotated

from pydantic import Field

from schemas.base.curves import Curve
from schemas.base.model import Model
from schemas.base.quantities import Angle, Mass, MetresPerSecond, Newtons, Speed, Watts
from schemas.base.units import Unit, between, non_negative
from schemas.scroll.over_turn import PinRadius

FrictionCoefficient = Annotated[float, non_negative(10.0)]
PinDiameter = Annotated[float, between(1e-6, 1e6), Unit("m")]


class OldhamRingKeys(Model):
    """An Oldham ring that would hold the same scroll: two keys slide in the frame, two in the scroll, a quarter on."""

    key_radius_m: PinRadius = Field(description="distance of the keys from the ring's centre", examples=[0.06])
    mass_kg: Mass = Field(0.0, description="mass of the ring", examples=[0.35])
    axis_deg: Angle = Field(
        0.0,
        description="direction in which the ring slides, counted like the pins' angles",
        examples=[0.0],
    )
    friction_coefficient: FrictionCoefficient = Field(description="sliding friction of the keys", examples=[0.08])


class LossComparison(Model):
    """The losses of the pins beside those of an Oldham ring in their place."""

    speed_rpm: Speed = Field(description="speed of the shaft", examples=[3000.0])
    pin_diameter_m: PinDiameter = Field(description="diameter of the pins' two journals", examples=[0.008])
    pin_friction_coefficient: FrictionCoefficient = Field(
        description="friction of the pins' bearings, referred to that diameter", examples=[0.002]
    )
    oldham_ring: OldhamRingKeys = Field(
        description="the ring", examples=[{"key_radius_m": 0.06, "friction_coefficient": 0.08}]
    )


class OldhamLoads(Model):
    """Keys of an Oldham ring over the turn, without the friction's own effect on the loads."""

    frame_key_N: Curve[Newtons] = Field(description="load of each key in the frame", examples=[[104.2]])
    scroll_keys_N: tuple[tuple[Newtons, Newtons], ...] = Field(
        description="loads of the two keys in the scroll, along the ring's axis: couple and half the ring's inertia",
        examples=[[[104.2, -104.2]]],
    )
    frame_speed_m_s: Curve[MetresPerSecond] = Field(
        description="sliding speed of the keys in the frame", examples=[[0.0]]
    )
    scroll_speed_m_s: Curve[MetresPerSecond] = Field(
        description="sliding speed of the keys in the scroll", examples=[[1.57]]
    )
    peak_key_N: Newtons = Field(
        description="largest load of a key over a revolution, between samples too", examples=[112.0]
    )
    peak_speed_m_s: MetresPerSecond = Field(
        description="largest sliding speed, orbit radius times angular speed", examples=[1.57]
    )
    loss_W: Watts = Field(
        description="mean over a revolution of friction times sliding speed, all keys", examples=[16.7]
    )


class Losses(Model):
    """What pins and ring cost."""

    pins_W: Watts | None = Field(
        description="mean friction loss of all pins over a revolution; null where a dead point leaves it without bound",
        examples=[1.33],
    )
    oldham_ring: OldhamLoads = Field(description="the ring", examples=[{"loss_W": 16.7}])
    ratio: float | None = Field(
        description="loss of the pins over that of the ring; null where the ring loses nothing", examples=[0.08]
    )
