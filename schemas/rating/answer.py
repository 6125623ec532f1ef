"""The thermal design of a compressor as it is answered. After the design calculation of the 2D12, (1-1) to (1-32)."""

from typing import Annotated, Literal

from pydantic import Field

from schemas.base.model import Answer, Model
from schemas.base.quantities import Newtons
from schemas.base.units import AnswerUnit
from schemas.machine.cylinder import Cylinder

Kelvins = Annotated[float, AnswerUnit("K")]
Pascals = Annotated[float, AnswerUnit("Pa")]
Metres = Annotated[float, AnswerUnit("m")]
SquareMetres = Annotated[float, AnswerUnit("m2")]
CubicMetres = Annotated[float, AnswerUnit("m3")]
CubicMetresPerMinute = Annotated[float, AnswerUnit("m3/min")]
MetresPerSecond = Annotated[float, AnswerUnit("m/s")]
Watts = Annotated[float, AnswerUnit("W")]
RevolutionsPerMinute = Annotated[float, AnswerUnit("rpm")]


class StageState(Model):
    """What a stage does to the gas, at one level of detail."""

    suction_pressure_Pa: Pascals = Field(description="absolute pressure at suction", examples=[300000.0])
    discharge_pressure_Pa: Pascals = Field(description="absolute pressure at discharge", examples=[793725.4])
    pressure_ratio: float = Field(description="discharge over suction pressure", examples=[2.6458])
    discharge_temperature_K: Kelvins = Field(description="temperature after the compression", examples=[413.3])


class DeadCentre(Model):
    """The gas on both sides of a piston at a dead centre."""

    head_pressure_Pa: Pascals = Field(description="absolute pressure on the head side", examples=[852000.0])
    crank_pressure_Pa: Pascals = Field(description="absolute pressure on the crank side", examples=[286000.0])
    gas_force_N: Newtons = Field(
        description="gas force on the piston of one cylinder, positive in rod tension", examples=[-239491.5]
    )


class GasLoads(Model):
    """Gas forces in the piston rod of one cylinder at its dead centres."""

    outer: DeadCentre = Field(description="outer dead centre, piston at the head", examples=[{"gas_force_N": -239491}])
    inner: DeadCentre = Field(description="inner dead centre, piston at the crank", examples=[{"gas_force_N": 228682}])
    largest_N: Newtons = Field(description="the larger of the two, as a magnitude", examples=[239491.5])


class DeliveryCoefficients(Model):
    """What share of its swept volume a stage takes in, and why not all of it."""

    volumetric: float = Field(description="left by the re-expansion of the clearance volume", examples=[0.8822])
    pressure: float = Field(description="left by the pressure drop at suction", examples=[0.97])
    temperature: float = Field(description="left by the warming of the gas at suction", examples=[0.96])
    leakage: float = Field(description="left by the leaks", examples=[0.945])
    delivery: float = Field(description="product of the four", examples=[0.7763])


class CylinderSize(Model):
    """The size of the cylinders of a stage."""

    bore_m: Metres = Field(description="bore", examples=[0.73])
    head_area_m2: SquareMetres = Field(description="piston area of one cylinder on the head side", examples=[0.41854])
    crank_area_m2: SquareMetres = Field(
        description="piston area of one cylinder on the crank side, without the rod", examples=[0.40904]
    )
    swept_volume_m3: CubicMetres = Field(
        description="volume swept in one revolution by all working sides of all cylinders of the stage",
        examples=[0.23172],
    )


class PressureLosses(Model):
    """Pressure losses in valves and ducts, relative to the pressure."""

    suction: float = Field(description="at suction", examples=[0.047])
    discharge: float = Field(description="at discharge", examples=[0.0797])


class CoefficientSources(Model):
    """Where coefficients are from: the request, or what the curve that was read says of itself."""

    suction_pressure_loss: str = Field(description="of the pressure loss at suction", examples=["request"])
    discharge_pressure_loss: str = Field(description="of the pressure loss at discharge", examples=["request"])
    temperature_coefficient: str = Field(description="of the temperature coefficient", examples=["request"])


class StageRating(Model):
    """One stage, from the nominal pressures to the power."""

    name: str | None = Field(description="name of the stage", examples=["I"])
    cylinders: int = Field(description="number of equal cylinders of the stage", examples=[1])
    nominal: StageState = Field(description="between the nominal pressures", examples=[{"pressure_ratio": 2.6458}])
    expansion_exponent: float = Field(description="exponent m of the re-expansion", examples=[1.25])
    design_coefficients: DeliveryCoefficients = Field(
        description="delivery at the nominal pressures", examples=[{"delivery": 0.7763}]
    )
    saturation_pressure_Pa: Pascals | None = Field(
        description="pressure of saturated steam at the suction temperature; null where the gas is dry",
        examples=[7375.0],
    )
    condensate_coefficient: float = Field(
        description="what the condensation of water vapour before this stage leaves of the flow", examples=[0.9846]
    )
    calculated: CylinderSize = Field(description="the size that the capacity asks for", examples=[{"bore_m": 0.7301}])
    nominal_loads: GasLoads = Field(
        description="gas forces of the calculated size at the nominal pressures", examples=[{"largest_N": 206383}]
    )
    actual: CylinderSize = Field(description="the size with the bore as built", examples=[{"bore_m": 0.73}])
    suction_pressure_correction: float = Field(
        description="what the rounding of the bores makes of the suction pressure", examples=[1.0]
    )
    discharge_pressure_correction: float = Field(
        description="what the rounding of the bores makes of the discharge pressure", examples=[0.9987]
    )
    corrected: StageState = Field(description="between the corrected pressures", examples=[{"pressure_ratio": 2.63}])
    reference_losses: PressureLosses = Field(
        description="pressure losses of air at 3.5 m/s", examples=[{"suction": 0.036}]
    )
    losses: PressureLosses = Field(
        description="pressure losses of this gas at the mean piston speed", examples=[{"suction": 0.047}]
    )
    in_cylinder: StageState = Field(
        description="between the pressures in the cylinder", examples=[{"suction_pressure_Pa": 286000}]
    )
    polytropic_temperature_K: Kelvins | None = Field(
        description="discharge temperature in the cylinder by the polytropic exponent; null where none is given",
        examples=[389.0],
    )
    actual_coefficients: DeliveryCoefficients = Field(
        description="delivery at the pressures in the cylinder", examples=[{"volumetric": 0.8605}]
    )
    actual_loads: GasLoads = Field(
        description="gas forces of the actual size at the pressures in the cylinder", examples=[{"largest_N": 239491}]
    )
    sources: CoefficientSources = Field(
        description="where coefficients of the stage are from", examples=[{"temperature_coefficient": "request"}]
    )
    indicated_power_W: Watts = Field(description="indicated power of all cylinders of the stage", examples=[608300.0])
    cylinder: Cylinder = Field(
        description="gas data of one cylinder, as a row of a machine takes them", examples=[{"bore_m": 0.73}]
    )


class ChoiceStep(Model):
    """One design on the way to rods and motor that suffice."""

    speed_rpm: RevolutionsPerMinute = Field(description="speed of the shaft", examples=[496.0])
    piston_rod_diameters_m: tuple[Metres, ...] = Field(description="rods of the stages", examples=[[0.09, 0.09]])
    rod_loads_N: tuple[Newtons, ...] = Field(
        description="largest gas forces of the stages with them", examples=[[236000.0, 234000.0]]
    )
    motor_power_W: Watts = Field(description="motor needed, with its margin", examples=[1394074.0])


class TandemLoads(Model):
    """Gas forces in a rod that several pistons share, with the built sizes; positive in rod tension."""

    stages: tuple[int, ...] = Field(description="numbers of the stages, from 1", examples=[[1, 2]])
    outer_N: Newtons = Field(description="at the outer dead centre", examples=[-181000.0])
    inner_N: Newtons = Field(description="at the inner dead centre", examples=[152000.0])
    largest_N: Newtons = Field(description="the larger of the two in size", examples=[181000.0])


class Choice(Model):
    """What was chosen from the tables of the request."""

    speed_rpm: RevolutionsPerMinute = Field(description="speed of the shaft: that of the motor", examples=[496.0])
    piston_rod_diameters_m: tuple[Metres, ...] = Field(
        description="rods of the stages, chosen or given", examples=[[0.11, 0.11]]
    )
    motor_power_W: Watts | None = Field(
        description="power of the motor; null where there were none to choose from", examples=[1400000.0]
    )
    steps: tuple[ChoiceStep, ...] = Field(description="designs on the way, the last with these", examples=[[]])


class RatingWarning(Model):
    """A figure that leaves its customary range; the answer stands nevertheless."""

    code: Literal[
        "discharge_temperature",
        "pressure_coefficient",
        "temperature_coefficient",
        "leakage_coefficient",
        "pressure_losses",
        "capacity",
        "mean_piston_speed",
        "rod_load",
        "motor_power",
    ] = Field(description="what is out of range", examples=["discharge_temperature"])
    message: str = Field(description="the figure and its range", examples=["discharge at 437 K, above 433.15 K"])
    stage: int | None = Field(description="number of the stage from 1; null is the whole machine", examples=[1])


class RatingAnswer(Answer):
    """The thermal design of a compressor."""

    total_pressure_ratio: float = Field(description="discharge over suction pressure of the machine", examples=[7.0])
    mean_piston_speed_m_s: MetresPerSecond = Field(
        description="mean piston speed for which the pressure losses were corrected", examples=[4.6667]
    )
    capacity_m3_per_min: CubicMetresPerMinute = Field(
        description="what the built machine delivers, in the state in which the asked capacity is measured",
        examples=[87.67],
    )
    capacity_share: float = Field(description="that over the asked capacity", examples=[0.974])
    stages: tuple[StageRating, ...] = Field(description="the stages in the order of the request", examples=[[]])
    tandem_loads: tuple[TandemLoads, ...] = Field(
        (), description="gas forces of stages that share rods, one for each of `tandems`", examples=[[]]
    )
    largest_rod_load_N: Newtons = Field(
        description="largest gas force in a piston rod at a dead centre, with the built sizes", examples=[239937.4]
    )
    indicated_power_W: Watts = Field(description="indicated power of all stages", examples=[1191300.0])
    shaft_power_W: Watts = Field(description="indicated power over mechanical efficiency", examples=[1267340.0])
    motor_power_W: Watts = Field(description="motor needed, with its margin", examples=[1394074.0])
    choice: Choice | None = Field(
        None, description="rods and motor from the tables of the request; null without such", examples=[None]
    )
    warnings: tuple[RatingWarning, ...] = Field(
        description="figures that leave their customary range", examples=[[{"code": "capacity"}]]
    )
