"""Counterweights on the steps of a workshop: the request, and what the steps cost."""

from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from schemas.answer.answers import OptimizeAnswer
from schemas.answer.counterweights import ShaftsMass, ShaftUnbalances, WebCounterweights
from schemas.base.model import Model
from schemas.base.quantities import Kilograms, Name
from schemas.base.rules import Rule, Ruled
from schemas.base.units import Unit, positive
from schemas.machine.catalogue import angle_step_rules
from schemas.request.requests import OptimizeRequest

_BY_ITSELF = "what is fitted has a radius: optimise first, then give radius and mass of the plate"


class RoundRequest(Ruled):
    """Round the optimum of a machine to masses and angles that can be made."""

    request: OptimizeRequest = Field(description="body of /v1/optimize", examples=[{"machine": {}}])
    mass_step_kg: Annotated[float, positive(1e15), Unit("kg")] = Field(
        description="masses are whole multiples of it", examples=[0.5]
    )
    angle_step_deg: Annotated[float, Field(gt=0, le=180), Unit("deg")] = Field(
        description="angles are whole multiples of it, counted from the own crank, on balance shafts from 0; a"
        " revolution must hold a whole number of steps",
        examples=[5.0],
    )

    def rules(self) -> Iterator[Rule]:
        yield from angle_step_rules(("angle_step_deg",), self.angle_step_deg)
        request, machine = self.request, self.request.machine
        limits = [web.max_mass_kg for web in machine.every_web if web.fixed is None and web.envelope is None]
        finite = [limit for limit in limits if limit is not None]
        if finite and len(finite) == len(limits):
            most = max(finite)
            message = f"larger than the largest mass of every web, {most:g} kg: nothing could be fitted"
            yield Rule(0.0 < most < self.mass_step_kg, ("mass_step_kg",), message)
        for field in machine.choice_fields():
            message = "remove it: what is chosen from a catalogue is on its steps already"
            yield Rule(True, ("request", "machine", *field), message)
        message = "not with steps, which are judged as they are: round without, then send the masses as `fixed`"
        yield Rule(request.tolerances is not None, ("request", "tolerances"), message)
        for broken, path, text in request.envelope_rules(_BY_ITSELF):
            yield Rule(broken, ("request", *path), text)


class Weights(Model):
    """Counterweights, and what they come to."""

    objective: float = Field(description="objective, recomputed", examples=[40549.4])
    limits_kept: bool = Field(description="whether ceilings and the total mass keep their limits", examples=[True])
    total_mass_kg: Kilograms = Field(
        description="total mass on the crankshaft, fixed counterweights included", examples=[85.75]
    )
    counterweights: WebCounterweights
    balance_shafts: ShaftUnbalances = ()
    balance_shafts_mass_kg: ShaftsMass = None


class StepRise(Model):
    """What the objective rises by where one counterweight of the answer alone is a step off; below 0 where it falls."""

    web: Name = Field(description="name of its web", examples=["1a"])
    lighter: float = Field(description="a step of the mass lighter", examples=[210.0])
    heavier: float = Field(description="a step of the mass heavier", examples=[180.0])
    backward: float = Field(description="a step of the angle back, against the sense of angles", examples=[950.0])
    forward: float = Field(description="a step of the angle on", examples=[990.0])


class Rounding(Model):
    """What steps of mass and angle cost."""

    optimum: Weights = Field(description="any masses at any angles", examples=[{"objective": 40549.4}])
    nearest: Weights = Field(
        description="every mass and every angle of these on the nearest step within the limits of its web",
        examples=[{"objective": 42252.0}],
    )
    objective_rise: float = Field(description="objective of the answer above that of the optimum", examples=[1650.0])
    relative_rise: float | None = Field(
        description="the same as a share of the optimum's objective; null where that is 0, or no more than its gap",
        examples=[0.041],
    )
    mass_rise_kg: Kilograms = Field(
        description="total mass of the answer above that of the optimum, of all shafts", examples=[-0.25]
    )
    masses_alone_rise: float = Field(
        description="what the objective rises by with the masses of the answer at the angles of the optimum",
        examples=[70.0],
    )
    angles_alone_rise: float = Field(
        description="what it rises by with the masses of the optimum at the angles of the answer", examples=[1590.0]
    )
    steps: tuple[StepRise, ...] = Field(
        description="what one step more or less costs, of every counterweight that is fitted and not fixed",
        examples=[[{"web": "1a", "lighter": 210.0}]],
    )


class RoundAnswer(OptimizeAnswer):
    """The best of all roundings, certified, and what rounding costs.

    Of every counterweight of the optimum mass and angle are the steps on either side, or it is left out.
    """

    rounding: Rounding | None = Field(
        None, description="what rounding costs; null if infeasible", examples=[{"objective_rise": 1650.0}]
    )
