"""What a client asks: optimise or analyse a machine."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field, Strict

from schemas.angles import Angles
from schemas.base import Model
from schemas.machine import MAX_WEBS, Machine
from schemas.outputs import OutputNames
from schemas.quantities import Angle, Flag, Force, Mass, Moment, Name, Weight
from schemas.rules import Rule, Ruled
from schemas.units import Unit


class DirectionWeights(Ruled):
    """Weights of the force and moment components across the shaft."""

    x: Weight = Field(1.0, description="weight of the x components", examples=[1.0])
    y: Weight = Field(1.0, description="weight of the y components", examples=[1.0])

    def rules(self) -> Iterator[Rule]:
        yield Rule((self.x == 0) & (self.y == 0), ("y",), "only one of the two direction weights may be 0")


class Objective(Ruled):
    """What is to be small: w_F peak force and w_M peak moment."""

    combine: Literal["sum", "max"] = Field(
        "sum", description="minimise the sum of the two weighted peaks, or the larger of them", examples=["sum"]
    )
    force_weight: Weight = Field(1.0, description="weight of the peak force w_F [1/N]", examples=[1.0])
    moment_weight: Weight | None = Field(
        None,
        description="weight of the peak moment w_M [1/(N m)]; null is 1/L, L the axial span of throws and webs",
        examples=[2.5],
    )
    direction_weights: DirectionWeights = Field(
        DirectionWeights(),
        description="weights of the components across the shaft; 0 is allowed for one of them",
        examples=[{"x": 1, "y": 1}],
    )
    force_ceiling_N: Annotated[Force | None, Unit("N")] = Field(
        None, description="hard limit on the first-order peak force", examples=[5000.0]
    )
    moment_ceiling_Nm: Annotated[Moment | None, Unit("N m")] = Field(
        None, description="hard limit on the first-order peak moment", examples=[20000.0]
    )
    least_mass: Flag = Field(
        True, description="among all optima take the one with the least total mass", examples=[True]
    )

    def rules(self) -> Iterator[Rule]:
        neither = (self.force_weight == 0) & (self.moment_weight == 0)
        yield Rule(neither, ("moment_weight",), "only one of the two weights may be 0")


class Accuracy(Model):
    """How close to the optimum the answer has to be."""

    relative_gap: Annotated[float, Strict()] = Field(
        1e-6,
        ge=1e-12,
        le=1,
        description="certified gap asked for, relative to the objective without counterweights",
        examples=[1e-6],
    )


class Fidelity(Model):
    """How closely effects are simulated."""

    kinematics: Literal["exact", "order_2"] = Field(
        "exact",
        description="exact slider-crank kinematics, or its series cut off after the second order",
        examples=["exact"],
    )
    shaft: Literal["simple_spans", "continuous"] = Field(
        "simple_spans",
        description="main bearings: every span simply supported, or a continuous shaft on rigid bearings",
        examples=["simple_spans"],
    )


class Scene(Model):
    """A machine and what is asked about it; decides which effects are simulated."""

    machine: Machine = Field(
        description="the machine",
        examples=[
            {
                "kind": "reciprocating",
                "speed_rpm": 500,
                "throws": [
                    {
                        "position_m": 0.0,
                        "crank_radius_m": 0.14,
                        "crank_angle_deg": 0,
                        "rows": [{"axis_deg": 0, "reciprocating_mass_kg": 100}],
                    }
                ],
            }
        ],
    )
    outputs: OutputNames = Field(("residual",), description="what the answer shall hold", examples=[["residual"]])
    angles: Angles = Field(Angles(), description="samples of the shaft angle", examples=[{"step_deg": 1}])
    fidelity: Fidelity = Field(Fidelity(), description="how closely to simulate", examples=[{"kinematics": "exact"}])


class OptimizeRequest(Scene):
    """Choose the counterweights of a machine."""

    objective: Objective = Field(Objective(), description="what is to be small", examples=[{"combine": "sum"}])
    accuracy: Accuracy = Field(Accuracy(), description="how close to the optimum", examples=[{"relative_gap": 1e-6}])


class FittedCounterweight(Model):
    """A counterweight that is on the machine."""

    web: Name = Field(description="name of the web that carries it", examples=["1a"])
    mass_kg: Mass = Field(description="mass of the counterweight", examples=[24.5])
    angle_deg: Angle = Field(description="angle of the counterweight as drawn at shaft angle 0", examples=[180.0])


class AnalyzeRequest(Scene, Ruled):
    """The machine as it stands, or with given counterweights."""

    counterweights: tuple[FittedCounterweight, ...] = Field(
        (),
        max_length=MAX_WEBS,
        description="counterweights on the machine, at most one for each web",
        examples=[[{"web": "1a", "mass_kg": 24.5, "angle_deg": 180}]],
    )

    def rules(self) -> Iterator[Rule]:
        names = {web.name for web in self.machine.webs}
        seen: set[str] = set()
        for index, counterweight in enumerate(self.counterweights):
            path = ("counterweights", index, "web")
            yield Rule(counterweight.web not in names, path, "the machine has no web of this name")
            twice = counterweight.web in seen & names
            yield Rule(twice, path, "this web carries a counterweight already")
            seen.add(counterweight.web)
