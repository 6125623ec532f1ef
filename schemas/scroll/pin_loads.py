"""Loads of the anti-rotation pins of a scroll: request and answer.

Equations (1) to (3) are those of Liu, Zhao and Li, "Anti-rotation by small crank pins in a scroll compressor" (2006).

Shaft angle 0 is where the eccentric points along angle 0 of the pin circle (pin 1 of even pins); angles grow in
the direction of rotation. A load is the force of a pin on the orbiting scroll, positive along the eccentric.
"""

from collections.abc import Iterator
from math import cos, dist, radians, sin
from typing import Annotated, Literal

from pydantic import Field

from schemas.base.angles import Angles
from schemas.base.curves import Curve
from schemas.base.model import Answer, Model, NotEmpty
from schemas.base.quantities import Angle, Count, Degrees, Joules, NewtonMetres, Newtons
from schemas.base.rules import Rule, Ruled
from schemas.base.units import Unit, between, non_negative, symmetric
from schemas.scroll.drive_bearing import DriveBearing, Stiffness
from schemas.scroll.losses import LossComparison, Losses
from schemas.scroll.over_turn import ForceOverTurn, PinRadius, TorqueOverTurn

MAX_PINS = 1000
MAX_PLACES = 200
MAX_LOADS = 1_000_000
MAX_LOADS_WITH_CLEARANCE = 50_000

Clearance = Annotated[float, non_negative(1.0), Unit("m")]
PeakBracket = Annotated[
    tuple[Newtons, Newtons] | None,
    Field(
        description="the same as a bracket, at least and at most, whatever the samples; null where dead points leave"
        " nothing that bounds the loads",
        examples=[[166.67, 166.67]],
    ),
]
EccentricityError = Annotated[float, symmetric(1.0), Unit("m")]
_TORQUE_EXAMPLE = {"angle_deg": [0, 120, 240], "torque_Nm": [12, 15, 13]}


class Pin(Model):
    """One anti-rotation pin, a small crank between frame and orbiting scroll."""

    angle_deg: Angle = Field(
        description="where the pin sits, ahead of angle 0 in the sense of rotation", examples=[120]
    )
    radius_m: PinRadius = Field(description="distance of the pin from the centre of its scroll", examples=[0.05])
    stiffness_N_per_m: Annotated[Stiffness | None, Unit("N/m")] = Field(
        None, description="stiffness of the pin with its bearings; null in every pin takes equal ones", examples=[2e7]
    )
    clearance_m: Clearance = Field(
        0.0, description="play of the pin along the eccentric before it bears, to either side", examples=[1e-5]
    )
    eccentricity_error_m: EccentricityError = Field(
        0.0, description="eccentricity of this pin less that of the shaft", examples=[5e-6]
    )


class PinLoadsRequest(Ruled):
    """What do the anti-rotation pins carry over a turn?"""

    pin_count: Annotated[Count, between(1, MAX_PINS)] | None = Field(
        None, description="number of evenly spaced pins, the first at angle 0", examples=[3]
    )
    pin_circle_radius_m: Annotated[PinRadius | None, Unit("m")] = Field(
        None, description="radius of the circle through evenly spaced pins", examples=[0.05]
    )
    pins: Annotated[tuple[Pin, ...], Field(max_length=MAX_PLACES), NotEmpty()] | None = Field(
        None,
        description="any pattern of pins, in place of evenly spaced ones",
        examples=[[{"angle_deg": angle, "radius_m": 0.05} for angle in (0, 110, 250)]],
    )
    rotation_torque_Nm: TorqueOverTurn | None = Field(
        None,
        description="torque that turns the orbiting scroll about itself, constant or over one revolution",
        examples=[12.5, _TORQUE_EXAMPLE],
    )
    tangential_gas_force_N: ForceOverTurn | None = Field(
        None,
        description="tangential gas force on the orbiting scroll, constant or over one revolution, "
        "in place of the torque that it causes",
        examples=[5000.0, {"angle_deg": [0, 120, 240], "force_N": [4000, 5000, 4300]}],
    )
    orbit_radius_m: Annotated[PinRadius | None, Unit("m")] = Field(
        None,
        description="radius of the orbit: the lever of the tangential gas force, and the way of an Oldham ring",
        examples=[0.005],
    )
    drive_bearing: DriveBearing = Field(
        DriveBearing(), description="what the drive's bearing carries beside the pins", examples=[{"type": "rigid"}]
    )
    comparison: LossComparison | None = Field(
        None, description="the losses of the pins beside those of an Oldham ring; null leaves them out", examples=[None]
    )
    angles: Angles = Field(Angles(), description="samples of the shaft angle", examples=[{"step_deg": 1}])

    @property
    def count(self) -> int:
        """Number of pins, from any of the fields."""
        return len(self.pins) if self.pins is not None else self.pin_count or 0

    @property
    def has_clearance(self) -> bool:
        """Some pin has play or an error, so that not every pin bears at every angle."""
        return any(pin.clearance_m > 0 or pin.eccentricity_error_m != 0 for pin in self.pins or ())

    def rules(self) -> Iterator[Rule]:
        yield from self._pattern_rules()
        yield from self._pin_rules()
        yield from self._cause_rules()

    def _pattern_rules(self) -> Iterator[Rule]:
        radius = ("pin_circle_radius_m",)
        if (self.pin_count is None) == (self.pins is None):
            yield Rule(True, ("pin_count",), "give either the number of evenly spaced pins or the pins")
        else:
            alone = self.pin_count is not None and self.pin_circle_radius_m is None
            yield Rule(alone, radius, "evenly spaced pins need the radius of their circle")
        is_twice = self.pins is not None and self.pin_circle_radius_m is not None
        yield Rule(is_twice, radius, "every pin has its own radius")
        most = MAX_LOADS_WITH_CLEARANCE if self.has_clearance else MAX_LOADS
        many = self.count * self.angles.count > most
        yield Rule(many, ("angles", "step_deg"), f"pins times samples must be at most {most}")

    def _pin_rules(self) -> Iterator[Rule]:
        pins = self.pins or ()
        stiffness = any(pin.stiffness_N_per_m is not None for pin in pins)
        elastic = self.drive_bearing.type == "elastic"
        needed = stiffness or self.has_clearance or elastic
        subject = "an elastic drive bearing needs" if elastic else "clearances and errors need"
        why = "every pin needs one" if stiffness else f"{subject} the stiffness of every pin"
        places = [_place(pin.radius_m, radians(pin.angle_deg % 360.0)) for pin in pins]
        for index, pin in enumerate(pins):
            yield Rule(needed and pin.stiffness_N_per_m is None, ("pins", index, "stiffness_N_per_m"), why)
            # nearer than this no arithmetic tells them apart
            is_double = any(dist(places[index], neighbour) <= 1e-9 * pin.radius_m for neighbour in places[:index])
            yield Rule(is_double, ("pins", index, "angle_deg"), "another pin is in this place")

    def _cause_rules(self) -> Iterator[Rule]:
        torque, force, lever = self.rotation_torque_Nm, self.tangential_gas_force_N, self.orbit_radius_m
        message = "give either the rotation torque or the tangential gas force"
        yield Rule((torque is None) == (force is None), ("rotation_torque_Nm",), message)
        message = "the tangential gas force needs the radius of the orbit"
        yield Rule(force is not None and lever is None, ("orbit_radius_m",), message)
        serves = force is not None or self.comparison is not None
        message = "serves only with a tangential gas force or a comparison"
        yield Rule(lever is not None and not serves, ("orbit_radius_m",), message)
        missing = self.comparison is not None and lever is None
        yield Rule(missing and force is None, ("orbit_radius_m",), "a comparison needs the radius of the orbit")


def _place(radius: float, angle: float) -> tuple[float, float]:
    return radius * cos(angle), radius * sin(angle)


class PinLoad(Model):
    """Load of one pin. Along its small crank: compression where it is positive, tension where it is negative."""

    index: int = Field(description="number of the pin, from 1", examples=[1])
    phase_deg: Degrees = Field(description="where the pin sits, in [0, 360)", examples=[0.0])
    load_N: tuple[Newtons | None, ...] = Field(
        description="force on the scroll, positive along the eccentric; null at a dead point", examples=[[0.0, 2.91]]
    )
    peak_N: Newtons | None = Field(
        description="largest magnitude over a revolution, between samples too; null where a dead point has no bound;"
        " in peak_bracket_N, or the largest that a search sees (warning peaks_not_certified)",
        examples=[166.67],
    )
    peak_bracket_N: PeakBracket
    peak_angle_deg: Degrees | None = Field(description="first shaft angle of the peak", examples=[90.0])
    compression_from_deg: Degrees | None = Field(
        description="where the pin's compression begins; null if torque or contact leave less than half a revolution",
        examples=[0.0],
    )
    compression_to_deg: Degrees | None = Field(description="where its compression ends", examples=[180.0])
    tension_from_deg: Degrees | None = Field(description="where its tension begins", examples=[180.0])
    tension_to_deg: Degrees | None = Field(description="where its tension ends", examples=[0.0])
    carries_load: tuple[bool, ...] | None = Field(
        description="whether the pin bears, at every sample; null without clearances and errors", examples=[None]
    )


class PinEquilibrium(Model):
    """Do the loads hold the scroll at every instant?"""

    holds: bool = Field(description="moment and net force are in balance at every angle", examples=[True])
    max_moment_error_Nm: NewtonMetres = Field(
        description="largest difference of the pins' moment from the torque; at a dead point the torque itself",
        examples=[0.0],
    )
    max_net_force_N: Newtons = Field(
        description="largest sum of the loads, with that of the drive's bearing", examples=[0.0]
    )
    reason: str | None = Field(description="why it does not hold", examples=[None])


class DegreesOfFreedom(Model):
    """Gruebler's count F = 3 n - (2 P_l + P_h - P') - F' of the mechanism (Liu, Zhao and Li 2006, section 1)."""

    moving_links: int = Field(description="n: shaft, orbiting scroll and the small cranks", examples=[5])
    lower_pairs: int = Field(description="P_l: turning pairs", examples=[8])
    higher_pairs: int = Field(description="P_h", examples=[0])
    virtual_constraints: int = Field(description="P': constraints that only repeat others", examples=[2])
    local_freedoms: int = Field(description="F'", examples=[0])
    degrees_of_freedom: int = Field(description="F", examples=[1])


class PinContact(Model):
    """Which pins bear, with clearances and errors of eccentricity."""

    fewest_pins: int = Field(description="fewest pins that carry load at a sample", examples=[2])
    most_pins: int = Field(description="most pins that carry load at a sample", examples=[3])
    scroll_rotation_deg: tuple[Degrees | None, ...] = Field(
        description="turn of the orbiting scroll about itself; null at a dead point", examples=[[0.002]]
    )
    load_error_bound_N: Newtons = Field(
        description="certified: no load at a sample is further than this from the exact one", examples=[1e-9]
    )
    gap_J: Joules = Field(description="largest gap between strain energy and its dual at a sample", examples=[1e-20])


class DriveBearingLoad(Model):
    """What the drive's bearing carries of the pins' net force: the force on the scroll, along the eccentric."""

    load_N: tuple[Newtons | None, ...] = Field(
        description="positive along the eccentric; null at a dead point", examples=[[-12.0, -11.5]]
    )
    peak_N: Newtons | None = Field(
        description="largest magnitude over a revolution; null where a dead point has no bound", examples=[98.0]
    )
    peak_bracket_N: PeakBracket
    peak_angle_deg: Degrees | None = Field(description="first shaft angle of the peak", examples=[20.0])


class PitchEnergy(Model):
    """Equation (2) of Liu, Zhao and Li: the work of pins and torque over one pin pitch, W_Q + W_F = 0."""

    pitch_deg: Degrees = Field(description="one pin pitch, 360 over the number of pins, from angle 0", examples=[120.0])
    pins_work_J: Joules = Field(description="W_Q, work of the pins", examples=[-26.18])
    torque_work_J: Joules = Field(description="W_F, work of the rotation torque", examples=[26.18])
    sum_J: Joules = Field(description="W_Q + W_F; 0 where the pins hold the torque on the average", examples=[0.0])


class PinWarning(Model):
    """Something to know about the answer."""

    code: Literal["too_few_pins", "uneven_load", "dead_points", "not_converged", "peaks_not_certified"] = Field(
        description="what it is about", examples=["too_few_pins"]
    )
    message: str = Field(description="the same in a sentence", examples=["at least 3 pins are needed"])


class PinLoads(Model):
    """Loads of the anti-rotation pins over one turn."""

    angle_deg: Curve[Degrees] = Field(
        description="shaft angles of the samples, the end point not repeated", examples=[[0.0, 1.0]]
    )
    rotation_torque_Nm: Curve[NewtonMetres] = Field(description="rotation torque used", examples=[[12.5, 12.5]])
    orbiting_resistance_torque_Nm: Curve[NewtonMetres] | None = Field(
        description="torque that the motor overcomes; null unless the tangential gas force is given", examples=[None]
    )
    pins: tuple[PinLoad, ...] = Field(description="the pins", examples=[[{"index": 1, "phase_deg": 0}]])
    peak_N: Newtons | None = Field(
        description="largest load of any pin; null where a dead point has no bound", examples=[166.67]
    )
    peak_bracket_N: PeakBracket
    half_turn_mechanism_peak_N: Newtons = Field(
        description="the same for a mechanism whose members bear for half a revolution only, 4 T / (n R) "
        "at the largest torque and the mean radius",
        examples=[333.33],
    )
    equilibrium: PinEquilibrium = Field(description="balance of the loads", examples=[{"holds": True}])
    dead_points_deg: tuple[Degrees, ...] = Field(
        description="shaft angles at which the pins hold no torque", examples=[[]]
    )
    mechanism: DegreesOfFreedom = Field(description="the mechanism's freedom", examples=[{"degrees_of_freedom": 1}])
    contact: PinContact | None = Field(
        description="which pins bear; null without clearances and errors", examples=[None]
    )
    drive_bearing: DriveBearingLoad | None = Field(
        description="what the drive's bearing carries; null where it is free", examples=[None]
    )
    energy: PitchEnergy = Field(description="balance of work over one pin pitch", examples=[{"pitch_deg": 120.0}])
    comparison: Losses | None = Field(
        description="losses of pins and Oldham ring; null unless asked for", examples=[None]
    )
    warnings: tuple[PinWarning, ...] = Field(description="things to know", examples=[[]])


class PinLoadsAnswer(PinLoads, Answer):
    """The same, asked for by itself."""
