"""The thermal design of a compressor: what is asked, and what is answered. Equations (1-1) to (1-32) of seed 004."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated, Literal

from pydantic import Field, Strict, model_validator

from schemas.base import FieldProblem, Model, NotEmpty, raise_problems
from schemas.cylinder import Cylinder
from schemas.quantities import Count, Fraction, Name, Newtons
from schemas.units import Unit

MAX_STAGES = 12

#: where water has a line of saturation, from ice to the critical point
COLDEST_STEAM_K, HOTTEST_STEAM_K = 273.15, 647.096

# the ranges keep every product and power of them far inside the floating-point numbers
Kelvin = Annotated[float, Field(ge=50, le=2000), Unit("K")]
Absolute = Annotated[float, Field(ge=1, le=1e10), Unit("Pa")]
Bore = Annotated[float, Field(ge=1e-4, le=100), Unit("m")]
RodDiameter = Annotated[float, Field(ge=0, le=100), Unit("m")]
Capacity = Annotated[float, Field(ge=1e-9, le=1e6), Unit("m3/min")]
PistonSpeed = Annotated[float, Field(gt=0, le=1000), Unit("m/s")]
Power = Annotated[float, Field(gt=0, le=1e15), Unit("W")]
# table 1-3 halves what an exponent has above 1, and that too must be above 1
Exponent = Annotated[float, Strict(), Field(ge=1.0001, le=10)]
Share = Annotated[float, Strict(), Field(ge=0.01, le=1)]
Loss = Annotated[float, Strict(), Field(ge=0, lt=1)]

Kelvins = Annotated[float, Unit("K")]
Pascals = Annotated[float, Unit("Pa")]
Metres = Annotated[float, Unit("m")]
SquareMetres = Annotated[float, Unit("m2")]
CubicMetres = Annotated[float, Unit("m3")]
CubicMetresPerMinute = Annotated[float, Unit("m3/min")]
MetresPerSecond = Annotated[float, Unit("m/s")]
Watts = Annotated[float, Unit("W")]


class RelativeLeaks(Model):
    """Leaks of a stage as shares of the flow that it delivers."""

    valves: Fraction = Field(0.0, description="leak through the valves", examples=[0.04])
    piston_rings: Fraction = Field(0.0, description="leak past the piston rings", examples=[0.014])
    packing: Fraction = Field(
        0.0,
        description="leak through the packing of the piston rod; lost for good, so every stage before carries it too",
        examples=[0.0016],
    )


class CompressionStage(Model):
    """One stage: its cylinders, which are all alike, and what is known of its losses."""

    name: Name | None = Field(None, description="name of the stage, unique in the machine", examples=["I"])
    cylinders: Annotated[Count, Field(ge=1, le=100)] = Field(
        1, description="number of equal cylinders of the stage", examples=[1]
    )
    acting: Literal["double", "head", "crank"] = Field(
        "double", description="which sides of the piston compress gas", examples=["double"]
    )
    piston_rod_diameter_m: RodDiameter = Field(
        description="diameter of the piston rod, on the crank side only; 0 where there is none", examples=[0.11]
    )
    bore_m: Annotated[Bore | None, Unit("m")] = Field(
        None, description="bore as built; null is the calculated bore, rounded to the series", examples=[0.73]
    )
    suction_temperature_K: Kelvin = Field(description="gas temperature at suction", examples=[313.0])
    relative_clearance: Annotated[float, Strict(), Field(ge=1e-6, le=10)] = Field(
        description="clearance volume as a share of the swept volume", examples=[0.1]
    )
    expansion_exponent: Exponent | None = Field(
        None,
        description="polytropic exponent m of the re-expansion; null reads it off table 1-3 of seed 004",
        examples=[1.25],
    )
    compression_exponent: Exponent | None = Field(
        None, description="polytropic exponent of the compression; null is the isentropic one", examples=[1.4]
    )
    pressure_coefficient: Share | None = Field(
        None,
        description="pressure coefficient of the delivery; null is 0.97 in the first stage and 0.99 in the others",
        examples=[0.97],
    )
    temperature_coefficient: Share = Field(0.96, description="temperature coefficient of the delivery", examples=[0.96])
    leakage_coefficient: Share | None = Field(
        None, description="leakage coefficient of the delivery, in place of the leaks", examples=[0.945]
    )
    relative_leaks: RelativeLeaks | None = Field(
        None,
        description="relative leaks, in place of the leakage coefficient",
        examples=[{"valves": 0.04, "piston_rings": 0.014, "packing": 0.0016}],
    )
    side_flow_coefficient: Annotated[float, Strict(), Field(ge=0.01, le=100)] = Field(
        1.0,
        description="flow through this stage over the flow through the first; "
        "below 1 where gas was drawn off before it, above 1 where gas was added",
        examples=[1.0],
    )
    suction_pressure_loss: Loss | None = Field(
        None,
        description="relative pressure loss at suction, for air at a mean piston speed of 3.5 m/s; "
        "null is the power law through the readings of seed 004",
        examples=[0.036],
    )
    discharge_pressure_loss: Loss | None = Field(
        None, description="the same at discharge; null likewise", examples=[0.061]
    )

    @model_validator(mode="after")
    def _check(self) -> "CompressionStage":
        raise_problems(self._problems())
        return self

    def _problems(self) -> Iterator[FieldProblem]:
        if (self.leakage_coefficient is None) == (self.relative_leaks is None):
            yield FieldProblem(("leakage_coefficient",), "give either the leakage coefficient or the relative leaks")
        if self.bore_m is not None and not self.piston_rod_diameter_m < self.bore_m:
            yield FieldProblem(("piston_rod_diameter_m",), "must be smaller than the bore")


class RatingRequest(Model):
    """Size the cylinders of a compressor, and say what they deliver and need."""

    name: Name | None = Field(None, description="name of the machine", examples=["2D12-90/2-20"])
    capacity_m3_per_min: Capacity = Field(
        description="volume that the first stage is to take in; at its suction state unless another is named",
        examples=[90.0],
    )
    capacity_pressure_Pa: Annotated[Absolute | None, Unit("Pa")] = Field(
        None,
        description="absolute pressure at which the capacity is measured, as 101325 for free air; "
        "null is the suction pressure",
        examples=[101325.0],
    )
    capacity_temperature_K: Annotated[Kelvin | None, Unit("K")] = Field(
        None,
        description="temperature at which the capacity is measured; null is the first suction temperature",
        examples=[293.15],
    )
    suction_pressure_Pa: Absolute = Field(description="absolute pressure before the first stage", examples=[300000.0])
    discharge_pressure_Pa: Absolute = Field(description="absolute pressure after the last stage", examples=[2100000.0])
    interstage_pressures_Pa: tuple[Absolute, ...] | None = Field(
        None,
        max_length=MAX_STAGES - 1,
        description="absolute pressures between the stages, rising; null gives every stage the same pressure ratio",
        examples=[[790000.0]],
    )
    isentropic_exponent: Exponent = Field(description="isentropic exponent k of the gas", examples=[1.4])
    relative_density: Annotated[float, Strict(), Field(ge=0.001, le=1000)] = Field(
        1.0, description="density of the gas over that of air in the same state", examples=[1.0]
    )
    relative_humidity: Fraction = Field(
        0.0, description="water vapour in the gas before the first stage over that of saturation", examples=[1.0]
    )
    speed_rpm: Annotated[float, Field(ge=0.1, le=1e6), Unit("rpm")] = Field(
        description="speed of the shaft", examples=[500.0]
    )
    stroke_m: Annotated[float, Field(ge=1e-4, le=10), Unit("m")] = Field(
        description="stroke, twice the crank radius", examples=[0.28]
    )
    stages: Annotated[tuple[CompressionStage, ...], Field(max_length=MAX_STAGES), NotEmpty()] = Field(
        description="the stages in the order in which the gas passes them",
        examples=[
            [
                {
                    "name": "I",
                    "piston_rod_diameter_m": 0.11,
                    "suction_temperature_K": 313,
                    "relative_clearance": 0.1,
                    "leakage_coefficient": 0.945,
                }
            ]
        ],
    )
    bore_series: Literal["R20", "R40", "R80", "none"] = Field(
        "R80",
        description="preferred numbers (ISO 3) in millimetres to which calculated bores are rounded; "
        "none leaves them as they are",
        examples=["R80"],
    )
    mean_piston_speed_m_s: Annotated[PistonSpeed | None, Unit("m/s")] = Field(
        None,
        description="mean piston speed for which pressure losses are corrected; null is stroke times speed / 30",
        examples=[4.0],
    )
    ambient_pressure_Pa: Absolute = Field(
        101325.0, description="absolute pressure on the open side of a single-acting piston", examples=[101325.0]
    )
    discharge_temperature_limit_K: Kelvin = Field(
        433.15, description="discharge temperature above which the answer warns", examples=[433.15]
    )
    rated_rod_load_N: Annotated[float | None, Field(gt=0, le=1e15), Unit("N")] = Field(
        None, description="gas force that the frame is built for; above it the answer warns", examples=[120000.0]
    )
    mechanical_efficiency: Share = Field(
        0.94, description="indicated power over shaft power, at most 1", examples=[0.94]
    )
    drive_efficiency: Share = Field(
        1.0, description="efficiency between motor and shaft, at most 1; 1 is a motor on the shaft", examples=[1.0]
    )
    motor_margin: Annotated[float, Strict(), Field(ge=0, le=10)] = Field(
        0.1, description="reserve of the motor as a share of the power that it must give", examples=[0.1]
    )
    installed_motor_power_W: Annotated[Power | None, Unit("W")] = Field(
        None, description="power of the motor that is there; if it is too small the answer warns", examples=[450000.0]
    )

    @model_validator(mode="after")
    def _check(self) -> "RatingRequest":
        raise_problems(self._problems())
        return self

    def _problems(self) -> Iterator[FieldProblem]:
        if not self.discharge_pressure_Pa > self.suction_pressure_Pa:
            yield FieldProblem(("discharge_pressure_Pa",), "must be above the suction pressure")
        elif self.interstage_pressures_Pa is not None:
            yield from self._interstage_problems(self.interstage_pressures_Pa)
        if self.stages[0].side_flow_coefficient != 1.0:
            yield FieldProblem(("stages", 0, "side_flow_coefficient"), "must be 1: it counts from the first stage")
        seen: set[str] = set()
        for index, stage in enumerate(self.stages):
            if stage.name in seen:
                yield FieldProblem(("stages", index, "name"), "another stage has this name")
            if stage.name is not None:
                seen.add(stage.name)
            temperature = stage.suction_temperature_K
            if self.relative_humidity > 0 and not COLDEST_STEAM_K <= temperature <= HOTTEST_STEAM_K:
                message = f"must be from {COLDEST_STEAM_K} to {HOTTEST_STEAM_K} K where the gas is humid"
                yield FieldProblem(("stages", index, "suction_temperature_K"), message)

    def _interstage_problems(self, between: tuple[float, ...]) -> Iterator[FieldProblem]:
        if len(between) != len(self.stages) - 1:
            yield FieldProblem(("interstage_pressures_Pa",), "must hold one pressure less than there are stages")
            return
        pressures = (self.suction_pressure_Pa, *between, self.discharge_pressure_Pa)
        for index, (low, high) in enumerate(pairwise(pressures)):
            if not high > low:
                # the last pair ends at the discharge: what is wrong there is the pressure before it
                place = ("interstage_pressures_Pa", min(index, len(between) - 1))
                yield FieldProblem(place, "must rise from the suction to the discharge pressure")


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
        description="volume swept in one turn by all working sides of all cylinders of the stage", examples=[0.23172]
    )


class PressureLosses(Model):
    """Pressure losses in valves and ducts, relative to the pressure."""

    suction: float = Field(description="at suction", examples=[0.047])
    discharge: float = Field(description="at discharge", examples=[0.0797])


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
    actual_coefficients: DeliveryCoefficients = Field(
        description="delivery at the pressures in the cylinder", examples=[{"volumetric": 0.8605}]
    )
    actual_loads: GasLoads = Field(
        description="gas forces of the actual size at the pressures in the cylinder", examples=[{"largest_N": 239491}]
    )
    indicated_power_W: Watts = Field(description="indicated power of all cylinders of the stage", examples=[608300.0])
    cylinder: Cylinder = Field(
        description="gas data of one cylinder, as a row of a machine takes them", examples=[{"bore_m": 0.73}]
    )


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


class RatingAnswer(Model):
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
    largest_rod_load_N: Newtons = Field(
        description="largest gas force in a piston rod at a dead centre, with the built sizes", examples=[239937.4]
    )
    indicated_power_W: Watts = Field(description="indicated power of all stages", examples=[1191300.0])
    shaft_power_W: Watts = Field(description="indicated power over mechanical efficiency", examples=[1267340.0])
    motor_power_W: Watts = Field(description="motor needed, with its margin", examples=[1394074.0])
    warnings: tuple[RatingWarning, ...] = Field(
        description="figures that leave their customary range", examples=[[{"code": "capacity"}]]
    )
