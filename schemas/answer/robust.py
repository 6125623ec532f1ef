"""What an answer is worth where things are not quite what they should be."""

from typing import Annotated

from pydantic import Field

from schemas.answer.counterweights import Counterweight, FittedShaft
from schemas.answer.first_order import ResponsePeak
from schemas.answer.proof import BoundMultipliers
from schemas.base.model import Model
from schemas.base.quantities import Kilograms, Name, NewtonMetres, Newtons
from schemas.base.units import Unit


class Sensitivity(Model):
    """What the objective may rise by where all counterweights are off together, each whichever way is worst."""

    objective_rise_per_deg: Annotated[float, Unit("1/deg")] = Field(
        ge=0,
        description="by up to one degree each; exact of one peak or the larger of several, no less than it of a sum of"
        " peaks, or of loads over a revolution",
        examples=[105.4],
    )
    objective_rise_per_percent: float = Field(
        ge=0,
        description="by up to one per cent of their mass each; exact of one peak or the largest of several, no less"
        " than it of a sum of peaks",
        examples=[60.4],
    )


class WorstPeaks(Model):
    """Peaks in the worst of all scenarios, all that may be off being so; each by itself, no less than what is true."""

    force_peak_N: Newtons = Field(
        description="largest peak force; of the first order, or of all where orders are all", examples=[5120.4]
    )
    moment_peak_Nm: NewtonMetres = Field(description="largest peak moment, likewise", examples=[20110.0])


class WorstCase(WorstPeaks):
    """The worst of all scenarios, all that may be off being so; each figure by itself, no less than what is true."""

    responses: tuple[ResponsePeak, ...] = Field(
        (), description="responses that are weighed or limited beside them, likewise", examples=[[]]
    )
    bearing_peak_N: Newtons | None = Field(
        description="largest peak load of a main bearing; null where neither bearings nor bending count",
        examples=[None],
    )
    objective: float = Field(
        description="the largest weighted objective, which is what was minimised and certified. In a sum of peaks"
        " every peak has its own worst case. So the sum is no less than the worst case of the sum",
        examples=[31730.2],
    )


class PriceOfRobustness(Model):
    """What the worst case costs: objectives of the unchanged machine, beside those of the worst case."""

    nominal: float = Field(
        description="what these counterweights come to on the unchanged machine, nothing off", examples=[30420.1]
    )
    nominal_optimum: float | None = Field(
        description="the smallest objective of that machine, nothing off; null where its ceilings are out of reach, or"
        " where accuracy.time_limit_s was over before it was found, as status_reason then says",
        examples=[30345.0],
    )
    nominal_optimum_worst_case: float | None = Field(
        description="what the counterweights of that optimum come to in the worst case, whether or not they keep the"
        " ceilings there; null likewise",
        examples=[32004.8],
    )
    nominal_lower_bound: float | None = Field(
        None,
        description="certified: nothing within the limits is smaller on that machine, nothing off; null where goals are"
        " met in their order or choices were searched, and likewise",
        examples=[30344.97],
    )
    nominal_counterweights: tuple[Counterweight, ...] = Field(
        (),
        description="those of that optimum, which other figures of the answer say nothing of; none where choices were"
        " searched, and likewise",
        examples=[[]],
    )
    nominal_balance_shafts: tuple[FittedShaft, ...] = Field(
        (), description="unbalances of the balance shafts at that optimum", examples=[[]]
    )
    nominal_multipliers: BoundMultipliers | None = Field(
        None, description="of nominal_lower_bound; null likewise", examples=[None]
    )
    nominal_implied_max_mass_kg: dict[Name, Kilograms] = Field(
        {},
        description="of webs without a limit, or with one far beyond any need: limits that change nothing on that"
        " machine, which nominal_lower_bound counts with",
        examples=[{}],
    )
