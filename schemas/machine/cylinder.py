"""Gas data of a cylinder. The effect that needs them checks whether they are complete."""

from collections.abc import Iterator
from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field, Strict

from schemas.base.model import Model
from schemas.base.presence import conditions, either, together
from schemas.base.quantities import Area, Length, Name, Pressure
from schemas.base.rules import Rule, Ruled
from schemas.base.units import Unit, between, non_negative
from schemas.machine.indicated import IndicatedPressure

Exponent = Annotated[float, Strict(), Field(gt=1, le=10)]
Clearance = Annotated[float, Strict(), between(1e-6, 100.0)]
# below a pressure of 0 there is nothing, and at 0 no ratio
WorkingPressure = Annotated[float, between(1e-3, 1e12), Unit("Pa")]

PistonArea = Annotated[float, non_negative(1e12), Unit("m2")]


class GasState(Model):
    """Pressures, clearance and exponents of a chamber."""

    suction_pressure_Pa: Annotated[WorkingPressure | None, Unit("Pa")] = Field(
        None, description="absolute pressure in the cylinder during suction", examples=[286000.0]
    )
    discharge_pressure_Pa: Annotated[WorkingPressure | None, Unit("Pa")] = Field(
        None, description="absolute pressure in the cylinder during discharge", examples=[852000.0]
    )
    relative_clearance: Clearance | None = Field(
        None, description="clearance volume as a share of the swept volume", examples=[0.1]
    )
    expansion_exponent: Exponent | None = Field(
        None, description="polytropic exponent of the re-expansion", examples=[1.4]
    )
    compression_exponent: Exponent | None = Field(
        None, description="polytropic exponent of the compression", examples=[1.4]
    )


class Cylinder(GasState, Ruled):
    """One cylinder; ``head`` and ``crank`` replace the common data for one side."""

    model_config = ConfigDict(json_schema_extra=conditions(either("bore_m", "head_area_m2", "crank_area_m2")))

    bore_m: Annotated[Length | None, Unit("m")] = Field(None, description="cylinder bore", examples=[0.73])
    piston_rod_diameter_m: Annotated[float | None, non_negative(1e9), Unit("m")] = Field(
        None,
        description="diameter of the piston rod; 0 where there is none; null is 0 where the head side has an indicated "
        "pressure and the crank side is open: a trunk piston",
        examples=[0.11],
    )
    head_area_m2: Annotated[Area | None, Unit("m2")] = Field(
        None, description="piston area on the head side, in place of the diameters", examples=[0.41729]
    )
    crank_area_m2: Annotated[Area | None, Unit("m2")] = Field(
        None, description="piston area on the crank side, in place of the diameters", examples=[0.41092]
    )
    acting: Literal["double", "head", "crank"] | None = Field(
        None,
        description="which sides of the piston compress gas; null is the sides with an indicated pressure or gas data, "
        "and both where no pressure is indicated",
        examples=["double"],
    )
    ambient_pressure_Pa: Annotated[Pressure | None, Unit("Pa")] = Field(
        None, description="absolute pressure on the open side of a single-acting piston", examples=[101325.0]
    )
    head: GasState | None = Field(
        None, description="data of the head side where they differ", examples=[{"relative_clearance": 0.1}]
    )
    crank: GasState | None = Field(
        None, description="data of the crank side where they differ", examples=[{"relative_clearance": 0.12}]
    )
    pressure: IndicatedPressure | None = Field(
        None,
        description="indicated pressure of an engine or of a measured compressor. A side that has one needs no other"
        " gas data than its area. The open side of a trunk piston needs ambient_pressure_Pa only",
        examples=[None],
    )

    def rules(self) -> Iterator[Rule]:
        low, high = self.suction_pressure_Pa, self.discharge_pressure_Pa
        below = low is not None and high is not None and high < low
        if below is not False:
            yield Rule(below, ("discharge_pressure_Pa",), "must not be below the suction pressure")
        if self.head is not None:
            yield from self._side_rules("head", self.head)
        if self.crank is not None:
            yield from self._side_rules("crank", self.crank)
        rod, bore = self.piston_rod_diameter_m, self.bore_m
        if bore is not None:
            thick = rod is not None and rod >= bore
            if thick is not False:
                yield Rule(thick, ("piston_rod_diameter_m",), "must be smaller than the bore")
            for area, size in (("head_area_m2", self.head_area_m2), ("crank_area_m2", self.crank_area_m2)):
                if size is not None:
                    yield Rule(True, (area,), "give either the bore or the piston areas")

    def _side_rules(self, side: str, state: GasState) -> Iterator[Rule]:
        """Pressures of one side, each its own or else the common one, where it has one of its own."""
        own_low, own_high = state.suction_pressure_Pa, state.discharge_pressure_Pa
        if own_low is None and own_high is None:
            return
        low = self.suction_pressure_Pa if own_low is None else own_low
        high = self.discharge_pressure_Pa if own_high is None else own_high
        if low is None or high is None:
            return
        if own_high is None:
            yield Rule(high < low, (side, "suction_pressure_Pa"), "must not be above the discharge pressure")
        else:
            yield Rule(high < low, (side, "discharge_pressure_Pa"), "must not be below the suction pressure")


class RowCylinder(Cylinder):
    """One of several cylinders on a piston rod. The chamber of a step is a side with its ring as area, the other 0."""

    model_config = ConfigDict(
        json_schema_extra=conditions(either("bore_m", "head_area_m2", "crank_area_m2"), together("from_m", "to_m"))
    )

    name: Name | None = Field(None, description="name of the cylinder, unique on its row", examples=["I"])
    head_area_m2: Annotated[PistonArea | None, Unit("m2")] = Field(
        None,
        description="piston area on the head side, in place of the diameters; 0 where the piston has no such side",
        examples=[0.12],
    )
    crank_area_m2: Annotated[PistonArea | None, Unit("m2")] = Field(
        None,
        description="piston area on the crank side, in place of the diameters; 0 where the piston has no such side",
        examples=[0.0],
    )
    from_m: Annotated[Length | None, Unit("m")] = Field(
        None, description="where the bore begins along the axis, from the shaft; with to_m", examples=[1.2]
    )
    to_m: Annotated[Length | None, Unit("m")] = Field(
        None, description="where it ends; no two of a row may overlap", examples=[1.8]
    )

    def rules(self) -> Iterator[Rule]:
        yield from super().rules()
        alone = (self.from_m is None) != (self.to_m is None)
        yield Rule(alone, ("to_m" if self.to_m is None else "from_m",), "a bore has a beginning and an end")
        if self.from_m is not None and self.to_m is not None:
            yield Rule(self.to_m <= self.from_m, ("to_m",), "must be beyond from_m")

    def overlaps(self, other: "RowCylinder") -> Any:
        """Whether the bores of two cylinders of a row share a part of the axis; of each of many."""
        if self.from_m is None or self.to_m is None or other.from_m is None or other.to_m is None:
            return False
        return (self.from_m < other.to_m) & (other.from_m < self.to_m)
