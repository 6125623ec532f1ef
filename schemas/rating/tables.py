"""Tables from which a rating chooses, and curves from which it reads its coefficients."""

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Annotated

from pydantic import Field, Strict

from schemas.base.model import Model
from schemas.base.rules import Rule, Ruled
from schemas.base.units import Unit

MAX_CHOICES = 100
MAX_READINGS = 100

Source = Annotated[str, Field(min_length=1, max_length=200)]
#: a share that a power law can be laid through
Reading = Annotated[float, Strict(), Field(ge=1e-6, lt=1)]


class PistonRod(Model):
    """A standard piston rod."""

    diameter_m: Annotated[float, Field(ge=1e-4, le=100), Unit("m")] = Field(
        description="diameter of the rod", examples=[0.09]
    )
    largest_force_N: Annotated[float, Field(gt=0, le=1e15), Unit("N")] = Field(
        description="gas force that it bears", examples=[160000.0]
    )


class Motor(Model):
    """A motor of a list."""

    power_W: Annotated[float, Field(gt=0, le=1e15), Unit("W")] = Field(description="rated power", examples=[1400000.0])
    speed_rpm: Annotated[float | None, Field(ge=0.1, le=1e6), Unit("rpm")] = Field(
        None, description="speed at that power; null is the speed that is asked for", examples=[496.0]
    )


class LossCurve(Ruled):
    """Relative pressure loss over pressure, for air at a mean piston speed of 3.5 m/s; a power law between readings."""

    pressure_Pa: tuple[Annotated[float, Field(ge=1, le=1e10), Unit("Pa")], ...] = Field(
        max_length=MAX_READINGS,
        description="nominal pressures of the readings, rising",
        examples=[[3e5, 7.9e5]],
    )
    relative_loss: tuple[Reading, ...] = Field(
        max_length=MAX_READINGS, description="losses at these pressures", examples=[[0.036, 0.028]]
    )
    source: Source = Field(description="where the curve is from", examples=["own measurements, 2024"])

    def rules(self) -> Iterator[Rule]:
        yield from _readings("pressure_Pa", self.pressure_Pa, "relative_loss", self.relative_loss)


class TemperatureCurve(Ruled):
    """Temperature coefficient of the delivery over pressure ratio; a power law between readings."""

    pressure_ratio: tuple[Annotated[float, Strict(), Field(ge=1, le=1e4)], ...] = Field(
        max_length=MAX_READINGS, description="pressure ratios of the readings, rising", examples=[[2.0, 4.0]]
    )
    temperature_coefficient: tuple[Annotated[float, Strict(), Field(ge=0.01, le=1)], ...] = Field(
        max_length=MAX_READINGS, description="coefficients at these ratios", examples=[[0.97, 0.94]]
    )
    source: Source = Field(description="where the curve is from", examples=["own measurements, 2024"])

    def rules(self) -> Iterator[Rule]:
        yield from _readings(
            "pressure_ratio", self.pressure_ratio, "temperature_coefficient", self.temperature_coefficient
        )


def _readings(at: str, places: Sequence[float], field: str, values: Sequence[float]) -> Iterator[Rule]:
    yield Rule(len(places) < 2, (at,), "a curve needs at least two readings")
    yield Rule(len(values) != len(places), (field,), f"must hold as many readings as {at}")
    for k, (low, high) in enumerate(pairwise(places)):
        yield Rule(high <= low, (at, k + 1), "must rise from reading to reading")


def choice_rules(rods: Sequence[PistonRod], motors: Sequence[Motor]) -> Iterator[Rule]:
    """Rules of the tables: thicker rods bear more; paths from the request."""
    for k, (thin, thick) in enumerate(pairwise(rods)):
        path = ("piston_rods", k + 1)
        yield Rule(thick.diameter_m <= thin.diameter_m, (*path, "diameter_m"), "must rise from rod to rod")
        weaker = thick.largest_force_N <= thin.largest_force_N
        yield Rule(weaker, (*path, "largest_force_N"), "a thicker rod must bear more")
    for k, (small, large) in enumerate(pairwise(motors)):
        yield Rule(large.power_W < small.power_W, ("motors", k + 1, "power_W"), "must not fall from motor to motor")
