"""Loads as a designer of parts asks for them: piston rod, pin, covers, frame bolts, guides, base, bearings."""

from typing import Annotated, Literal

from pydantic import Field

from schemas.answer.dynamics import RowSeries, ShaftAngles
from schemas.base.curves import Curve
from schemas.base.model import Model
from schemas.base.quantities import Degrees, Kilograms, NewtonMetres, Newtons
from schemas.base.units import Unit


class CoverLoad(Model):
    """Gas force on one end of a cylinder, outward: cover or crank-end head, and the bolts that hold it."""

    cylinder: int = Field(description="number of the cylinder on its row, from 0", examples=[0])
    side: Literal["head", "crank"] = Field(description="which end", examples=["head"])
    largest_N: Newtons = Field(
        description="absolute pressure times piston area, largest over the cycle", examples=[355531.1]
    )
    smallest_N: Newtons = Field(description="smallest over the cycle", examples=[119344.9])


class FrameLoad(Model):
    """What the gas of a row does to the frame between its cylinders and the main bearings, alternating."""

    tension_N: Newtons = Field(description="largest pull over the cycle, 0 if there is none", examples=[239491.5])
    compression_N: Newtons = Field(description="largest push, negative, 0 if there is none", examples=[-228681.6])
    mean_N: Newtons = Field(description="midway between largest and smallest", examples=[5404.9])
    amplitude_N: Newtons = Field(description="half of their difference", examples=[234086.6])


class GuideLoad(Model):
    """Crosshead on its guide, with its weight; towards the lower guide."""

    weight_N: Newtons = Field(description="weight of the reciprocating masses across the axis", examples=[2977.0])
    largest_N: Newtons = Field(description="largest over the cycle", examples=[24000.0])
    smallest_N: Newtons = Field(
        description="smallest over the cycle; negative: it bears on the upper guide", examples=[-18000.0]
    )
    lifts: bool | None = Field(
        description="whether it leaves the lower guide; null where the axis is upright", examples=[True]
    )
    lifted_share: float = Field(description="share of the cycle over which it is off it", examples=[0.49])


class RowLoad(RowSeries):
    """Loads of one row."""

    reciprocating_mass_kg: Kilograms = Field(
        description="what moves along the axis, with its share of the rod", examples=[303.6]
    )
    rod_rotating_mass_kg: Kilograms = Field(description="the rest of the rod, at the crank pin", examples=[60.2])
    rotating_mass_kg: Kilograms = Field(
        description="all that turns at the crank pin in the plane of the row: that, and its turning parts",
        examples=[60.2],
    )
    largest_gas_N: Newtons = Field(description="largest gas force over the cycle, magnitude", examples=[239491.5])
    largest_inertia_N: Newtons = Field(
        description="largest inertia force over the cycle, magnitude", examples=[139833.0]
    )
    largest_piston_force_N: Newtons = Field(
        description="largest sum of gas, inertia and friction over the cycle, magnitude", examples=[180000.0]
    )
    piston_rod_N: Newtons = Field(description="for piston rod and pin: the largest of the three", examples=[239491.5])
    piston_rod_governed_by: Literal["gas", "inertia", "running"] = Field(
        description="which of the three", examples=["gas"]
    )
    crosshead_pin_N: Newtons = Field(
        description="largest rod force over the cycle while running, magnitude", examples=[182000.0]
    )
    stop_at_outer_dead_centre_N: Newtons = Field(
        description="sudden stop at the outer dead centre: gas force alone", examples=[-239491.5]
    )
    stop_at_inner_dead_centre_N: Newtons = Field(description="at the inner dead centre", examples=[228681.6])
    stop_over_the_turn_N: Newtons = Field(
        description="sudden stop anywhere: largest rod force of gas alone over the cycle, magnitude",
        examples=[239937.4],
    )
    covers: tuple[CoverLoad, ...] = Field(description="ends of the cylinders", examples=[[{"side": "head"}]])
    frame: FrameLoad = Field(description="frame and frame bolts", examples=[{"amplitude_N": 234086.6}])
    guide: GuideLoad | None = Field(
        description="crosshead and guide; null without the direction of gravity", examples=[None]
    )


class ThrowMass(Model):
    """What turns with one throw."""

    throw: int = Field(description="number of the throw in the machine, from 0", examples=[0])
    rotating_mass_kg: Kilograms = Field(
        description="unbalanced rotating mass at the crank radius, with the rods' parts", examples=[72.2]
    )


class BearingWeight(Model):
    """Weight on a main bearing: its static share."""

    name: str = Field(description="name of the bearing", examples=["A"])
    weight_N: Newtons = Field(
        description="of what turns: masses at the cranks, shaft_parts, counterweights. With gravity_deg also of what"
        " reciprocates, by the part of its weight along the axis; the rest lies on the guide",
        examples=[410.0],
    )
    x_N: Newtons | None = Field(
        description="along x; the same as x and y of the bearings' loads, and null without gravity_deg",
        examples=[0.0],
    )
    y_N: Newtons | None = Field(description="along y", examples=[-410.0])


class Loads(Model):
    """Loads of all rows, and what of the torque reaches the base."""

    angle_deg: ShaftAngles
    rows: tuple[RowLoad, ...] = Field(description="the rows", examples=[[{"throw": 0, "row": 0}]])
    throws: tuple[ThrowMass, ...] = Field(description="rotating masses", examples=[[{"throw": 0}]])
    driver_Nm: NewtonMetres = Field(
        description="mean torque: the constant torque of the driver, whose reaction acts on its own base",
        examples=[24692.8],
    )
    shared_base_Nm: Curve[NewtonMetres] = Field(
        description="torque less its mean: what leaves a base that machine and driver share, and by Newton the torque "
        "-J eps of the turning masses",
        examples=[[-24000.0]],
    )
    own_base_peak_Nm: NewtonMetres = Field(
        description="largest torque on a base of the machine's own, over the cycle, magnitude", examples=[62000.0]
    )
    shared_base_peak_Nm: NewtonMetres = Field(
        description="largest of shared_base_Nm, over the cycle, magnitude", examples=[41000.0]
    )
    angular_acceleration_rad_s2: Annotated[Curve[float] | None, Unit("rad/s2")] = Field(
        description="eps of the shaft for its inertia; null without flywheel", examples=[None]
    )
    bearing_weights: tuple[BearingWeight, ...] = Field(
        description="weights on the main bearings", examples=[[{"name": "A"}]]
    )
    foundation_weight_N: Newtons | None = Field(
        description="weight of the machine: all of that, what reciprocates, and stationary_mass_kg; null without the "
        "latter",
        examples=[None],
    )
    gravity_deg: Degrees | None = Field(description="direction of gravity used", examples=[None])
