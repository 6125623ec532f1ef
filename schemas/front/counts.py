"""The worth of one more counterweight, or of one more part number: request and answer."""

from typing import Literal

from pydantic import Field

from schemas.answer.counterweights import Counterweight, FittedShaft, ShaftsMass
from schemas.base.model import Displayable, Model
from schemas.base.quantities import Kilograms, NewtonMetres, Newtons

Countable = Literal["weights", "part_numbers", "pieces", "sizes"]
#: as goals of an objective name what is counted
PIECES: tuple[Countable, ...] = ("weights", "pieces")
Lessened = Literal["objective", "mass"]


class CountTrade(Model):
    """How many counterweights, or different masses, against what they come to."""

    of: Countable = Field(
        description="weights, or pieces: webs that have a counterweight; part_numbers, or sizes: different masses",
        examples=["weights"],
    )
    least: Lessened = Field(
        "objective",
        description="what is least at every number: the objective, as a single answer has it; or the total mass of all"
        " that keep the ceilings",
        examples=["objective"],
    )


class CountPoint(Model):
    """The best counterweights that are no more than a number."""

    at_most: int = Field(description="the number that they may be", examples=[2])
    status: Literal["optimal", "inaccurate", "infeasible"] = Field(
        description="optimal: certified to the asked gap; inaccurate: to a larger one; infeasible: so few keep no"
        " ceilings",
        examples=["optimal"],
    )
    status_reason: str = Field(description="why the status is what it is, in a sentence", examples=[""])
    value: float | None = Field(
        description="the objective, or the total mass [kg]; null if infeasible", examples=[7504.6]
    )
    lower_bound: float | None = Field(
        description="certified: no counterweights that are so few have a smaller one; null if nothing is proven",
        examples=[7504.5],
    )
    relative_gap: float | None = Field(
        description="value above that bound, over the objective without counterweights, or over the mass; null"
        " likewise",
        examples=[2e-4],
    )
    weights: int | None = Field(
        description="webs that have a counterweight, of those that take castings; null if infeasible", examples=[2]
    )
    part_numbers: int | None = Field(description="different masses; null if infeasible", examples=[1])
    total_mass_kg: Kilograms | None = Field(
        description="total mass on the crankshaft; null if infeasible", examples=[50.0]
    )
    force_peak_N: Newtons | None = Field(description="first-order peak force; null if infeasible", examples=[7504.6])
    moment_peak_Nm: NewtonMetres | None = Field(
        description="first-order peak moment; null if infeasible", examples=[20123.3]
    )
    counterweights: tuple[Counterweight, ...] = Field(
        description="one for each web, in the machine's order; none if infeasible", examples=[[]]
    )
    balance_shafts: tuple[FittedShaft, ...] = Field(
        (), description="unbalances of the balance shafts, in their order; none if infeasible", examples=[[]]
    )
    balance_shafts_mass_kg: ShaftsMass = None
    nodes: int = Field(description="nodes of the tree that proves it; 0 where all sets were compared", examples=[0])
    method: str = Field(description="what found it", examples=["exhaustion in halves"])


class CountFront(Displayable):
    """The same for every number, under one limit of the total mass."""

    max_total_mass_kg: Kilograms | None = Field(
        description="limit of the total mass of this front; null is none", examples=[None]
    )
    of: Countable = Field(description="what is counted", examples=["weights"])
    least: Lessened = Field(description="what is least at every number", examples=["objective"])
    status: Literal["optimal", "inaccurate", "infeasible"] = Field(
        description="optimal: every point is, or is proven infeasible; inaccurate: a point is not; infeasible: none"
        " keeps the ceilings",
        examples=["optimal"],
    )
    points: tuple[CountPoint, ...] = Field(
        description="in the order of rising numbers, up to what those use that are limited by no number: any more are"
        " of no use, within the gap of the last",
        examples=[[]],
    )
