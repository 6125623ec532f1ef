"""The thermal design of a compressor: the request. After the design calculation of the 2D12, (1-1) to (1-32)."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated, Literal

from pydantic import ConfigDict, Field, Strict

from schemas.base.model import Model, NotEmpty
from schemas.base.presence import absent, alternatives, conditions, filled, when
from schemas.base.quantities import Count, Fraction, Name
from schemas.base.rules import Rule, Ruled
from schemas.base.units import Unit
from schemas.rating.tables import MAX_CHOICES, LossCurve, Motor, PistonRod, TemperatureCurve, choice_rules

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


class RelativeLeaks(Model):
    """Leaks of a stage as shares of the flow that it delivers."""

    valves: Fraction = Field(0.0, description="leak through the valves", examples=[0.04])
    piston_rings: Fraction = Field(0.0, description="leak past the piston rings", examples=[0.014])
    packing: Fraction = Field(
        0.0,
        description="leak through the packing of the piston rod; lost for good, so every stage before carries it too",
        examples=[0.0016],
    )


StageNumber = Annotated[int, Strict(), Field(ge=1, le=MAX_STAGES)]


class CompressionStage(Ruled):
    """One stage: its cylinders, which are all alike, and what is known of its losses."""

    model_config = ConfigDict(json_schema_extra=conditions(alternatives("leakage_coefficient", "relative_leaks")))

    name: Name | None = Field(None, description="name of the stage, unique in the machine", examples=["I"])
    cylinders: Annotated[Count, Field(ge=1, le=100)] = Field(
        1, description="number of equal cylinders of the stage", examples=[1]
    )
    acting: Literal["double", "head", "crank"] = Field(
        "double", description="which sides of the piston compress gas", examples=["double"]
    )
    piston_rod_diameter_m: Annotated[RodDiameter | None, Unit("m")] = Field(
        description="diameter of the piston rod, on the crank side only; 0 where there is none, null chooses from "
        "piston_rods",
        examples=[0.11],
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
        description="polytropic exponent m of the re-expansion; null reads it off table 1-3 of the design calculation "
        "of the 2D12-90/2-20 compressor",
        examples=[1.25],
    )
    compression_exponent: Exponent | None = Field(
        None, description="polytropic exponent of the compression; null is the isentropic one", examples=[1.4]
    )
    polytropic_exponent: Exponent | None = Field(
        None,
        description="polytropic exponent of a compression that is cooled on its way, for a discharge temperature "
        "of its own beside that of compression_exponent; null answers none",
        examples=[1.25],
    )
    pressure_coefficient: Share | None = Field(
        None,
        description="pressure coefficient of the delivery; null is 0.97 in the first stage and 0.99 in the others",
        examples=[0.97],
    )
    temperature_coefficient: Share | None = Field(
        None,
        description="temperature coefficient of the delivery; null reads it off temperature_curve, without which it is "
        "0.96",
        examples=[0.96],
    )
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
        description="relative pressure loss at suction, for air at a mean piston speed of 3.5 m/s. Null reads it off"
        " suction_loss_curve. Without that curve it is the power law through the readings in the design calculation of"
        " the 2D12-90/2-20 compressor",
        examples=[0.036],
    )
    discharge_pressure_loss: Loss | None = Field(
        None, description="the same at discharge; null likewise, off discharge_loss_curve", examples=[0.061]
    )

    def rules(self) -> Iterator[Rule]:
        unclear = (self.leakage_coefficient is None) == (self.relative_leaks is None)
        yield Rule(unclear, ("leakage_coefficient",), "give either the leakage coefficient or the relative leaks")
        rod, bore = self.piston_rod_diameter_m, self.bore_m
        thick = rod is not None and bore is not None and rod >= bore
        yield Rule(thick, ("piston_rod_diameter_m",), "must be smaller than the bore")


class RatingRequest(Ruled):
    """Size the cylinders of a compressor, and say what they deliver and need."""

    model_config = ConfigDict(json_schema_extra=conditions(when(filled("motors"), absent("installed_motor_power_W"))))

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
    tandems: tuple[tuple[StageNumber, ...], ...] = Field(
        (),
        max_length=MAX_STAGES,
        description="numbers of stages, from 1, whose pistons share a rod, in tandem or as steps of one piston: their "
        "gas forces add. The crank side of a step has the smaller step for its piston rod",
        examples=[[[1, 2]]],
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

    piston_rods: tuple[PistonRod, ...] = Field(
        (),
        max_length=MAX_CHOICES,
        description="standard piston rods, the thinnest first; a stage whose diameter is null gets the thinnest that "
        "bears its gas force, which is found by doing the design over",
        examples=[[{"diameter_m": 0.09, "largest_force_N": 160000}, {"diameter_m": 0.11, "largest_force_N": 250000}]],
    )
    motors: tuple[Motor, ...] = Field(
        (),
        max_length=MAX_CHOICES,
        description="motors, the weakest first; of those within 5 percent of speed_rpm the weakest that suffices is "
        "chosen, and the machine runs at its speed",
        examples=[[{"power_W": 1400000, "speed_rpm": 496}]],
    )
    suction_loss_curve: LossCurve | None = Field(
        None, description="pressure losses at suction of stages that do not say theirs", examples=[None]
    )
    discharge_loss_curve: LossCurve | None = Field(
        None, description="pressure losses at discharge of stages that do not say theirs", examples=[None]
    )
    temperature_curve: TemperatureCurve | None = Field(
        None, description="temperature coefficients of stages that do not say theirs", examples=[None]
    )

    def rules(self) -> Iterator[Rule]:
        yield from choice_rules(self.piston_rods, self.motors)
        is_twice = bool(self.motors) and self.installed_motor_power_W is not None
        yield Rule(
            is_twice, ("installed_motor_power_W",), "give either the motor that is there or motors to choose from"
        )
        for index, stage in enumerate(self.stages):
            unsaid = stage.piston_rod_diameter_m is None and not self.piston_rods
            path = ("stages", index, "piston_rod_diameter_m")
            yield Rule(unsaid, path, "give it, or piston_rods to choose from")
        yield from self._tandem_rules()
        falls = self.discharge_pressure_Pa <= self.suction_pressure_Pa
        yield Rule(falls, ("discharge_pressure_Pa",), "must be above the suction pressure")
        if self.interstage_pressures_Pa is not None and not falls:
            yield from self._interstage_rules(self.interstage_pressures_Pa)
        is_unequal = self.stages[0].side_flow_coefficient != 1.0
        yield Rule(is_unequal, ("stages", 0, "side_flow_coefficient"), "must be 1: it counts from the first stage")
        earlier: set[str] = set()
        for index, stage in enumerate(self.stages):
            yield Rule(stage.name in earlier, ("stages", index, "name"), "another stage has this name")
            if stage.name is not None:
                earlier.add(stage.name)
            temperature = stage.suction_temperature_K
            outside = self.relative_humidity > 0 and not COLDEST_STEAM_K <= temperature <= HOTTEST_STEAM_K
            message = f"must be from {COLDEST_STEAM_K} to {HOTTEST_STEAM_K} K where the gas is humid"
            yield Rule(outside, ("stages", index, "suction_temperature_K"), message)

    def _tandem_rules(self) -> Iterator[Rule]:
        earlier: set[int] = set()
        for index, tandem in enumerate(self.tandems):
            yield Rule(len(tandem) < 2, ("tandems", index), "takes at least two stages")
            for place, number in enumerate(tandem):
                path = ("tandems", index, place)
                yield Rule(number > len(self.stages), path, "there is no stage of this number")
                yield Rule(number in earlier, path, "this stage is on a rod already")
                earlier.add(number)
            counts = {self.stages[number - 1].cylinders for number in tandem if number <= len(self.stages)}
            yield Rule(len(counts) > 1, ("tandems", index), "stages that share rods have as many cylinders each")

    def _interstage_rules(self, between: tuple[float, ...]) -> Iterator[Rule]:
        if len(between) != len(self.stages) - 1:
            yield Rule(True, ("interstage_pressures_Pa",), "must hold one pressure less than there are stages")
            return
        pressures = (self.suction_pressure_Pa, *between, self.discharge_pressure_Pa)
        for index, (low, high) in enumerate(pairwise(pressures)):
            # the last pair ends at the discharge: what is wrong there is the pressure before it
            place = ("interstage_pressures_Pa", min(index, len(between) - 1))
            yield Rule(high <= low, place, "must rise from the suction to the discharge pressure")
