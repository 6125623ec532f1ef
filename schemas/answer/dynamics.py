"""Outputs of the dynamics: motion, gas, forces in the mechanism, torque, flywheel, main bearings.

Sampled values stand over ``angle_deg``, shaft angles with the end point not repeated. Rows come in the
machine's order, throw by throw. Scalar forces are positive in rod tension; tangential forces and torques
are positive against rotation.
"""

from typing import Annotated, Literal

from pydantic import Field

from schemas.base.curves import Curve
from schemas.base.model import Model
from schemas.base.quantities import (
    Degrees,
    Joules,
    KilogramSquareMetres,
    Metres,
    MetresPerSecond,
    MetresPerSquareSecond,
    NewtonMetres,
    Newtons,
    Pascals,
    Watts,
)

ShaftAngles = Annotated[
    Curve[Degrees],
    Field(description="shaft angles of the samples, the end point not repeated", examples=[[0.0, 1.0]]),
]


ForceBracket = Annotated[
    tuple[Newtons, Newtons],
    Field(
        description="the same as a bracket, at least and at most, whatever the samples", examples=[[1e5, 1.0000001e5]]
    ),
]
MomentBracket = Annotated[
    tuple[NewtonMetres, NewtonMetres],
    Field(
        description="the same as a bracket, at least and at most, whatever the samples", examples=[[1e5, 1.0000001e5]]
    ),
]


class RowSeries(Model):
    """Which row a series belongs to."""

    throw: int = Field(description="number of the throw in the machine, from 0", examples=[0])
    row: int = Field(description="number of the row on its throw, from 0", examples=[0])
    name: str | None = Field(description="name of the row", examples=["I"])


class RowMotion(RowSeries):
    """Motion of one row."""

    crank_angle_deg: Curve[Degrees] = Field(
        description="own crank angle from the outer dead centre, 0 up to 360", examples=[[0.0]]
    )
    displacement_m: Curve[Metres] = Field(description="from the outer dead centre", examples=[[0.0]])
    velocity_m_s: Curve[MetresPerSecond] = Field(description="towards the shaft", examples=[[0.0]])
    acceleration_m_s2: Curve[MetresPerSquareSecond] = Field(description="towards the shaft", examples=[[460.6]])


class Kinematics(Model):
    """Motion of every row."""

    angle_deg: ShaftAngles
    rows: tuple[RowMotion, ...] = Field(description="the rows", examples=[[{"throw": 0, "row": 0}]])


class Chamber(Model):
    """One side of a piston."""

    side: Literal["head", "crank"] = Field(description="which side", examples=["head"])
    cylinder: int = Field(description="number of the cylinder on its row, from 0", examples=[0])
    name: str | None = Field(description="name of that cylinder; null where it has none", examples=[None])
    pressure_Pa: Curve[Pascals] = Field(description="absolute pressure", examples=[[852000.0]])
    force_N: Curve[Newtons] = Field(description="force on the piston", examples=[[-355531.1]])
    suction_opens_deg: Degrees | None = Field(
        description="own crank angle at which suction opens; null on an open side", examples=[36.873]
    )
    discharge_opens_deg: Degrees | None = Field(
        description="own crank angle at which discharge opens; null on an open side", examples=[286.5]
    )
    indicated_work_J: Joules = Field(
        description="work put into the gas in one revolution, closed form", examples=[37000.0]
    )


class RowGas(RowSeries):
    """Gas in the cylinders of one row."""

    chambers: tuple[Chamber, ...] = Field(
        description="head and crank side of every cylinder", examples=[[{"side": "head"}]]
    )
    displacement_m: Curve[Metres] = Field(
        description="travel from the outer dead centre, over which an indicator draws the pressures", examples=[[0.0]]
    )
    force_N: Curve[Newtons] = Field(description="gas force on the row's pistons, all sides", examples=[[-238008.0]])
    indicated_power_W: Watts = Field(description="indicated power of the row", examples=[624389.3])


class Gas(Model):
    """Gas forces of every row."""

    angle_deg: ShaftAngles
    rows: tuple[RowGas, ...] = Field(description="the rows", examples=[[{"throw": 0, "row": 0}]])
    indicated_power_W: Watts = Field(description="indicated power of the machine", examples=[1216873.9])


class RowPistonForce(RowSeries):
    """What pulls and pushes on one piston."""

    gas_N: Curve[Newtons] = Field(description="gas force", examples=[[-238008.0]])
    inertia_N: Curve[Newtons] = Field(description="inertia force of the row", examples=[[139833.0]])
    friction_N: Curve[Newtons] = Field(description="friction of the row", examples=[[0.0]])
    total_N: Curve[Newtons] = Field(description="their sum", examples=[[-98175.0]])
    peak_tension_N: Newtons = Field(description="largest sum over the cycle", examples=[180000.0])
    peak_tension_bracket_N: ForceBracket
    peak_compression_N: Newtons = Field(description="smallest sum over the cycle", examples=[-200000.0])
    peak_compression_bracket_N: ForceBracket


class PistonForce(Model):
    """Piston forces of every row."""

    angle_deg: ShaftAngles
    rows: tuple[RowPistonForce, ...] = Field(description="the rows", examples=[[{"throw": 0, "row": 0}]])


class LoadCase(Model):
    """Extremes of the rod force of one row in one load case, over the whole turn."""

    case: Literal["running", "no_load", "sudden_stop"] = Field(
        description="running; no_load: no gas; sudden_stop: gas alone, the machine standing still", examples=["running"]
    )
    tension_N: Newtons = Field(description="largest rod force, 0 if there is no tension", examples=[250000.0])
    tension_bracket_N: ForceBracket
    tension_deg: Degrees = Field(description="shaft angle at which it occurs", examples=[180.0])
    compression_N: Newtons = Field(description="smallest rod force, 0 if there is no compression", examples=[-240000.0])
    compression_bracket_N: ForceBracket
    compression_deg: Degrees = Field(description="shaft angle at which it occurs", examples=[0.0])


class RowRodLoads(RowSeries):
    """Forces in the mechanism of one row."""

    rod_N: Curve[Newtons] = Field(description="force in the connecting rod", examples=[[-98175.0]])
    side_N: Curve[Newtons] = Field(description="force on the crosshead guide", examples=[[0.0]])
    tangential_N: Curve[Newtons] = Field(description="tangential force on the crank pin", examples=[[0.0]])
    radial_N: Curve[Newtons] = Field(description="radial force on the crank pin, outward", examples=[[-98175.0]])
    peak_side_N: Newtons = Field(
        description="largest force on the crosshead guide over the cycle, magnitude", examples=[41000.0]
    )
    peak_side_bracket_N: ForceBracket
    cases: tuple[LoadCase, ...] = Field(description="load cases", examples=[[{"case": "running"}]])
    governing_case: Literal["running", "no_load", "sudden_stop"] = Field(
        description="load case with the largest rod force", examples=["sudden_stop"]
    )
    governing_load_N: Newtons = Field(description="largest rod force of all load cases, magnitude", examples=[239491.5])


class RodLoads(Model):
    """Forces in the mechanism of every row."""

    angle_deg: ShaftAngles
    rows: tuple[RowRodLoads, ...] = Field(description="the rows", examples=[[{"throw": 0, "row": 0}]])
    governing_load_N: Newtons = Field(description="largest rod force of the machine", examples=[239937.4])


class RowTorque(RowSeries):
    """Torque of one row."""

    torque_Nm: Curve[NewtonMetres] = Field(description="torque about the shaft", examples=[[0.0]])
    mean_torque_Nm: NewtonMetres = Field(description="mean over the cycle", examples=[12000.0])


class Torque(Model):
    """Torque of the machine against its rotation, and what it means for the drive."""

    angle_deg: ShaftAngles
    rows: tuple[RowTorque, ...] = Field(description="the rows", examples=[[{"throw": 0, "row": 0}]])
    rotating_friction_Nm: NewtonMetres = Field(description="rotating friction, constant", examples=[435.7])
    torque_Nm: Curve[NewtonMetres] = Field(description="all rows and rotating friction", examples=[[435.7]])
    tangential_N: Curve[Newtons] | None = Field(
        description="the same as tangential force at the crank radius; null if the radii differ", examples=[[3112.0]]
    )
    peak_Nm: NewtonMetres = Field(description="largest over the cycle, magnitude", examples=[62000.0])
    peak_bracket_Nm: MomentBracket
    peak_angle_deg: Degrees = Field(description="shaft angle at which it occurs", examples=[38.2])
    mean_torque_Nm: NewtonMetres = Field(description="mean over the cycle, whatever the samples", examples=[24692.8])
    mean_torque_error_Nm: NewtonMetres = Field(description="estimate of its error", examples=[1e-9])
    indicated_power_W: Watts = Field(description="power put into the gas", examples=[1216873.9])
    friction_power_W: Watts = Field(description="power lost to friction", examples=[76040.4])
    shaft_power_W: Watts = Field(description="mean torque times angular speed", examples=[1292914.4])
    fluctuation_energy_J: Joules = Field(
        description="range of the running integral of torque minus mean over the cycle", examples=[28733.2]
    )
    fluctuation_energy_error_J: Joules = Field(description="estimate of its error", examples=[0.01])


class Flywheel(Model):
    """Speed fluctuation and the inertia that holds it."""

    fluctuation_energy_J: Joules = Field(description="energy to take up and give back", examples=[28733.2])
    irregularity: float = Field(
        description="speed fluctuation delta: range of the speed over its mean", examples=[0.01]
    )
    inertia_J_kg_m2: KilogramSquareMetres = Field(
        description="polar moment of inertia J of all that turns", examples=[1048.1]
    )
    inertia_MD2_kg_m2: KilogramSquareMetres = Field(description="the customary MD^2 = 4 J", examples=[4192.2])


class RowOverturning(RowSeries):
    """Overturning couple of one row."""

    couple_Nm: Curve[NewtonMetres] = Field(description="side force times its distance from the shaft", examples=[[0.0]])


class Overturning(Model):
    """Overturning couple on the frame, with the rotation; it equals the torque of the rows."""

    angle_deg: ShaftAngles
    rows: tuple[RowOverturning, ...] = Field(description="the rows", examples=[[{"throw": 0, "row": 0}]])
    couple_Nm: Curve[NewtonMetres] = Field(description="all rows", examples=[[0.0]])
    peak_Nm: NewtonMetres = Field(description="largest over the cycle, magnitude", examples=[62000.0])
    peak_bracket_Nm: MomentBracket
    peak_angle_deg: Degrees = Field(description="shaft angle at which it occurs", examples=[38.2])


class BearingLoad(Model):
    """Load of one main bearing over the turn: the force that the shaft puts on it."""

    force_x_N: Curve[Newtons] = Field(description="x component", examples=[[120000.0]])
    force_y_N: Curve[Newtons] = Field(description="y component", examples=[[0.0]])
    peak_N: Newtons = Field(description="largest magnitude over the cycle", examples=[120000.0])
    peak_bracket_N: ForceBracket
    peak_angle_deg: Degrees = Field(
        description="shaft angle at which it occurs; at a jump the load is that on its larger side", examples=[0.0]
    )
    specific_load_Pa: Pascals | None = Field(
        None, description="peak over diameter times length; null where the bearing has none", examples=[2.0e7]
    )
    rms_N: Newtons = Field(description="root of the mean square over the cycle", examples=[61000.0])
    floor_N: Newtons = Field(
        description="what the peak comes to at least, whatever counterweights turn with the shaft: the radius of the "
        "smallest circle around the load as the shaft sees it",
        examples=[38000.0],
    )
    circle_x_N: Newtons = Field(
        description="x of the centre of that circle, as drawn at shaft angle 0; counterweights move nothing else",
        examples=[52000.0],
    )
    circle_y_N: Newtons = Field(description="y of its centre", examples=[0.0])


class MainBearing(Model):
    """One main bearing without and with counterweights."""

    name: str = Field(description="name of the bearing", examples=["A"])
    position_m: Metres = Field(description="plane of the bearing", examples=[-0.4])
    before: BearingLoad = Field(description="without counterweights", examples=[{"peak_N": 120000.0}])
    after: BearingLoad | None = Field(
        description="with the counterweights; null if infeasible", examples=[{"peak_N": 118000.0}]
    )


class BendingMoment(Model):
    """Largest bending moment inside the shaft over the turn, plane by plane."""

    position_m: tuple[Metres, ...] = Field(description="planes along the shaft", examples=[[-0.4, 0.0, 0.4]])
    before_Nm: tuple[NewtonMetres, ...] = Field(description="without counterweights", examples=[[0.0, 9000.0, 0.0]])
    after_Nm: tuple[NewtonMetres, ...] | None = Field(
        description="with the counterweights; null if infeasible", examples=[[0.0, 8800.0, 0.0]]
    )
    peak_Nm: NewtonMetres = Field(
        description="largest of all planes, with the counterweights where there are any", examples=[8800.0]
    )
    peak_bracket_Nm: MomentBracket
    peak_position_m: Metres = Field(description="plane in which it occurs", examples=[0.0])
    floor_Nm: NewtonMetres = Field(
        description="what it comes to at least, whatever counterweights turn with the shaft", examples=[2100.0]
    )


class MainBearings(Model):
    """Loads of the main bearings from all rows, rotating masses and counterweights."""

    angle_deg: ShaftAngles
    shaft: Literal["simple_spans", "continuous"] = Field(
        description="how the shaft was taken to lie on its bearings", examples=["simple_spans"]
    )
    bearings: tuple[MainBearing, ...] = Field(description="the bearings", examples=[[{"name": "A"}]])
    bending: BendingMoment = Field(description="bending moment inside the shaft", examples=[{"position_m": [0.0]}])
