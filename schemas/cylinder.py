"""Gas data of a cylinder. Whether they are complete is asked by the effect that needs them."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field, Strict

from schemas.base import Model
from schemas.indicated import IndicatedPressure
from schemas.quantities import Area, Length, Pressure
from schemas.rules import Rule, Ruled
from schemas.units import Unit, between, non_negative

Exponent = Annotated[float, Strict(), Field(gt=1, le=10)]
Clearance = Annotated[float, Strict(), between(1e-6, 100.0)]
# below a pressure of 0 there is nothing, and at 0 no ratio
WorkingPressure = Annotated[float, between(1e-3, 1e12), Unit("Pa")]


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

    bore_m: Annotated[Length | None, Unit("m")] = Field(None, description="cylinder bore", examples=[0.73])
    piston_rod_diameter_m: Annotated[float | None, non_negative(1e9), Unit("m")] = Field(
        None, description="diameter of the piston rod; 0 where there is none", examples=[0.11]
    )
    head_area_m2: Annotated[Area | None, Unit("m2")] = Field(
        None, description="piston area on the head side, in place of the diameters", examples=[0.41729]
    )
    crank_area_m2: Annotated[Area | None, Unit("m2")] = Field(
        None, description="piston area on the crank side, in place of the diameters", examples=[0.41092]
    )
    acting: Literal["double", "head", "crank"] = Field(
        "double", description="which sides of the piston compress gas", examples=["double"]
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
        description="indicated pressure of an engine or of a measured compressor; a side that has one needs no other "
        "gas data than its area",
        examples=[None],
    )

    def rules(self) -> Iterator[Rule]:
        low, high = self.suction_pressure_Pa, self.discharge_pressure_Pa
        if low is not None and high is not None:
            yield Rule(high < low, ("discharge_pressure_Pa",), "must not be below the suction pressure")
        for side, state in (("head", self.head), ("crank", self.crank)):
            if state is not None:
                yield from self._side_rules(side, state)
        rod, bore = self.piston_rod_diameter_m, self.bore_m
        if bore is not None:
            if rod is not None:
                yield Rule(rod >= bore, ("piston_rod_diameter_m",), "must be smaller than the bore")
            for area in ("head_area_m2", "crank_area_m2"):
                yield Rule(getattr(self, area) is not None, (area,), "give either the bore or the piston areas")

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
