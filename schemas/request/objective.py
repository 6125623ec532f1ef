"""What is to be small, and what is limited."""

from collections.abc import Collection, Iterable, Iterator
from typing import Annotated, Any, Literal, get_args

from pydantic import Field

from schemas.base.model import Model
from schemas.base.quantities import (
    Flag,
    Force,
    Fraction,
    Moment,
    Pressure,
    Weight,
)
from schemas.base.responses import RESPONSES
from schemas.base.rules import Rule, Ruled
from schemas.base.units import Unit


class DirectionWeights(Ruled):
    """Weights of the force and moment components across the shaft."""

    x: Weight = Field(1.0, description="weight of the x components", examples=[1.0])
    y: Weight = Field(1.0, description="weight of the y components", examples=[1.0])

    def rules(self) -> Iterator[Rule]:
        yield Rule((self.x == 0) & (self.y == 0), ("y",), "only one of the two direction weights may be 0")


#: goals that count what counterweights cost, and not what they do
Cost = Literal["mass", "pieces", "sizes"]
COSTS: tuple[Cost, ...] = get_args(Cost)


class Priority(Model):
    """One of several goals that are met one after the other."""

    goal: Literal["external", "bearings", "bending", "mass", "pieces", "sizes"] = Field(
        description="external: force, moment and roll as they are weighed and combined; bearings, bending: the largest"
        " of their kind; mass: the minimum total mass; pieces: the fewest counterweights; sizes: the fewest different"
        " masses. Pieces and sizes need a catalogue; without one the mass is the last",
        examples=["external"],
    )
    allowance: Fraction = Field(
        0.0,
        description="what the goals after it may use of it, as a share of its value without counterweights, at least"
        " 1e-6. Of mass, pieces and sizes it is a share of what they come to",
        examples=[0.001],
    )


#: weights of which a goal needs one
_WEIGHTS = {
    "external": "force_weight, moment_weight or roll_weight",
    "bearings": "bearing_weight",
    "bending": "bending_weight",
}
#: fields of the objective that look at the whole turn, with what asks for nothing
OVER_THE_TURN: dict[str, Any] = {
    "bearing_weight": 0.0,
    "bearing_ceiling_N": None,
    "specific_load_ceiling_Pa": None,
    "bending_weight": 0.0,
    "bending_ceiling_Nm": None,
    "roll_weight": 0.0,
    "orders": "first",
    "priorities": (),
}


def of_the_shaft(names: Iterable[str]) -> bool:
    """Whether one of these fields is about bearing loads or bending moments."""
    return any(name.startswith(("bearing", "specific", "bending")) for name in names)


def outputs_about(names: Collection[str]) -> tuple[str, ...]:
    """Outputs that show what these fields are about: an answer always holds them."""
    loads, roll = of_the_shaft(names), "roll_weight" in names
    return (*(("main_bearings",) if loads else ()), *(("roll",) if roll else ()))


class Objective(Ruled):
    """What is to be small: w_F peak force and w_M peak moment, w_B bearing load and w_D bending moment."""

    combine: Literal["sum", "max"] = Field(
        "sum", description="minimise the sum of the weighted peaks, or the largest of them", examples=["sum"]
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
        None, description="hard limit on the peak force, of the orders that count", examples=[5000.0]
    )
    moment_ceiling_Nm: Annotated[Moment | None, Unit("N m")] = Field(
        None, description="hard limit on the peak moment, of the orders that count", examples=[20000.0]
    )
    force_ceiling_x_N: Annotated[Force | None, Unit("N")] = Field(
        None, description="hard limit on the peak of the force along x, likewise", examples=[4000.0]
    )
    force_ceiling_y_N: Annotated[Force | None, Unit("N")] = Field(
        None, description="hard limit on the peak of the force along y, likewise", examples=[2500.0]
    )
    moment_ceiling_x_Nm: Annotated[Moment | None, Unit("N m")] = Field(
        None,
        description="hard limit on the peak of the horizontal couple, of the x forces, likewise",
        examples=[15000.0],
    )
    moment_ceiling_y_Nm: Annotated[Moment | None, Unit("N m")] = Field(
        None,
        description="hard limit on the peak of the vertical couple, of the y forces, likewise",
        examples=[9000.0],
    )
    orders: Literal["first", "all"] = Field(
        "first",
        description="force and moment of the first order, or of all orders together; bearing loads and bending always"
        " count with all of them",
        examples=["first"],
    )
    bearing_weight: Weight = Field(
        0.0,
        description="weight of the largest main-bearing load [1/N], under specific [1/Pa]; gas and friction count",
        examples=[1.0],
    )
    bearing_measure: Literal["peak", "rms", "specific"] = Field(
        "peak",
        description="of every bearing the peak over the cycle, the root mean square, or the peak over diameter times"
        " length",
        examples=["peak"],
    )
    bearing_ceiling_N: Annotated[Force | None, Unit("N")] = Field(
        None, description="hard limit on the peak load of every main bearing", examples=[120000.0]
    )
    specific_load_ceiling_Pa: Annotated[Pressure | None, Unit("Pa")] = Field(
        None,
        description="hard limit on the peak load of every main bearing over its diameter times length",
        examples=[2.5e7],
    )
    bending_weight: Weight = Field(
        0.0, description="weight of the largest bending moment inside the shaft [1/(N m)]", examples=[1.0]
    )
    bending_ceiling_Nm: Annotated[Moment | None, Unit("N m")] = Field(
        None, description="hard limit on the bending moment everywhere inside the shaft", examples=[9000.0]
    )
    roll_weight: Weight = Field(
        0.0,
        description="weight of the peak of the roll moment about the crankshaft, its mean apart [1/(N m)]; all orders,"
        " gas and friction count, and balance shafts alone change it",
        examples=[1.0],
    )
    priorities: tuple[Priority, ...] = Field(
        (),
        max_length=6,
        description="goals to meet one after the other, in place of their sum or the largest; each keeps what was"
        " reached before it but for the allowance",
        examples=[[{"goal": "external", "allowance": 0.001}, {"goal": "bearings"}, {"goal": "mass"}]],
    )
    least_mass: Flag = Field(
        True, description="among all optima take the one with the minimum total mass", examples=[True]
    )
    symmetric: Flag = Field(
        True,
        description="of equally good and equally light counterweights take the most symmetric: equal webs in equal"
        " places get equal ones",
        examples=[True],
    )

    @property
    def of_the_shaft(self) -> bool:
        """Whether bearing loads or bending moments count."""
        names = self.over_the_turn
        return bool(names) and of_the_shaft(names)

    @property
    def over_the_turn(self) -> tuple[str, ...]:
        """Fields of goals beyond one of the first order on the frame."""
        if OVER_THE_TURN.keys().isdisjoint(self.__pydantic_fields_set__):
            return ()
        own = vars(self)
        return tuple([name for name, nothing in OVER_THE_TURN.items() if own[name] != nothing])

    @property
    def of_the_revolution(self) -> tuple[str, ...]:
        """Those of them that need the motion of the rods: goals of the first order in their order need none."""
        names = self.over_the_turn
        return tuple(name for name in names if name != "priorities") if names else names

    def rules(self) -> Iterator[Rule]:
        external = self.roll_weight != 0
        for response in RESPONSES.values():
            external = external | (getattr(self, response.weight) != 0)
        has_weight = external | (self.bearing_weight != 0) | (self.bending_weight != 0)
        none = has_weight == 0
        if none is not False:
            yield Rule(none, ("moment_weight",), "one of the weights must be above 0")
        across = self.direction_weights
        unequal = self.orders == "all" and across.x != across.y
        if unequal is not False:
            message = "with all orders both directions count equally: give equal weights"
            yield Rule(unequal, ("direction_weights",), message)
        if self.priorities:
            yield from self._priority_rules(external)

    def _priority_rules(self, external: Any) -> Iterator[Rule]:
        """What does not go with goals in their order; ``external``: whether what acts on the frame has a weight."""
        weighed = {"external": external, "bearings": self.bearing_weight != 0, "bending": self.bending_weight != 0}
        goals = [priority.goal for priority in self.priorities]
        for i, goal in enumerate(goals):
            path = ("priorities", i, "goal")
            yield Rule(goal in goals[:i], path, "this goal is named already")
            message = f"give a goal beside {goal}: external, bearings or bending"
            yield Rule(goal in COSTS and not set(goals) - set(COSTS), path, message)
            yield Rule(weighed.get(goal, True) == 0, path, f"this goal has no weight: give {_WEIGHTS.get(goal)}")
        for name, has in weighed.items():
            yield Rule((name not in goals) & has, ("priorities",), f"the goal {name} has a weight and no place")
        yield Rule(
            "mass" in goals and not self.least_mass, ("least_mass",), "the mass has a place among the priorities"
        )
