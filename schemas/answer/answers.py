"""What the service answers. Every figure is recomputed by the mechanics."""

from typing import Annotated, Literal

from pydantic import Field

from schemas.answer.alternatives import Alternative
from schemas.answer.caution import Cautions, StatusReason
from schemas.answer.counterweights import Counterweight, FittedShaft, ShaftsMass, ShaftUnbalances
from schemas.answer.first_order import Floor, Residual
from schemas.answer.infeasibility import InfeasibilityProof
from schemas.answer.limits import MachineLimit, ShadowPrice
from schemas.answer.outputs import OutputFields
from schemas.answer.proof import BoundMultipliers, Multipliers
from schemas.answer.robust import PriceOfRobustness, Sensitivity, WorstCase
from schemas.base.model import Answer, Model
from schemas.base.quantities import (
    Kilograms,
    Metres,
    Milliseconds,
    Name,
)
from schemas.machine.balance_quality import GradeReached


class BalanceRate(Model):
    """How much of the rotating unbalance of a throw its own webs balance; theirs is `throw`, or else the nearest."""

    throw: int = Field(description="number of the throw in the machine, from 0", examples=[0])
    name: str | None = Field(description="name of the throw", examples=["1"])
    rate: float | None = Field(
        description="share that is opposite the crank: 1 is the customary crank, 0 a bare one; null where the throw "
        "has no rotating mass",
        examples=[0.82],
    )
    sideways: float | None = Field(
        description="share across the crank, a quarter of a revolution counter-clockwise from opposite it",
        examples=[0.0],
    )


class GoalReached(Model):
    """One of several goals that were met one after the other."""

    goal: Literal["external", "bearings", "bending", "mass", "pieces", "sizes"] = Field(
        description="the goal", examples=["external"]
    )
    value: float = Field(description="what it came to by itself; mass in kg, with those fixed", examples=[30345.0])
    lower_bound: float | None = Field(
        description="certified: under the goals before it nothing is smaller; null if nothing is proven",
        examples=[30344.97],
    )
    limit: float = Field(description="what the goals after it had to keep", examples=[30405.7])
    multipliers: BoundMultipliers | None = Field(
        None,
        description="of the bound of a goal before the last, under the limits of those before it. Null of the last,"
        " whose multipliers are the certificate's; of what castings cost; and where choices were searched",
        examples=[None],
    )


class Certificate(Model):
    """The proof: a lower bound in closed form that no counterweights within the limits can beat."""

    objective: float = Field(description="objective of the returned counterweights, recomputed", examples=[30345.0])
    lower_bound: float | None = Field(
        description="no counterweights within the limits, exceeding no ceiling by more than the returned ones do, have"
        " a smaller objective; null if nothing is proven",
        examples=[30344.97],
    )
    gap: float | None = Field(description="objective minus lower bound; null if nothing is proven", examples=[0.03])
    relative_gap: float | None = Field(description="gap over `yardstick`; null if nothing is proven", examples=[5e-7])
    yardstick: float = Field(
        description="what the relative gap is relative to: the objective without counterweights; where that is 0, what"
        " the counterweights could change of it",
        examples=[60690.0],
    )
    objective_without_counterweights: float = Field(description="objective with no counterweights", examples=[60690.0])
    mass_lower_bound_kg: Kilograms | None = Field(
        description="no optimum, ceilings kept to their tolerance, has a smaller total mass; null if minimum mass was"
        " not asked for, or if nothing is proven",
        examples=[41.2],
    )
    mass_relative_gap: float | None = Field(
        description="total mass above that bound, over `yardstick`; null likewise", examples=[2e-9]
    )
    mass_yardstick_kg: Kilograms | None = Field(
        description="what the mass gap is relative to: the total mass. Where that is less, it is 1e-5 of the minimum"
        " mass that could cancel the objective, or a response under a ceiling, at the web where a kilogram does most."
        " The gap allowed then changes neither by more than the tolerance of a ceiling. Null if minimum mass was not"
        " asked for",
        examples=[41.2],
    )
    mass_objective_limit: float | None = Field(
        description="largest objective that counts as an optimum in the bound of the mass; null if minimum mass was not"
        " asked for",
        examples=[30345.06],
    )
    implied_max_mass_kg: dict[Name, Kilograms] = Field(
        description="largest masses that the bounds count with, of webs without a limit or with one beyond any need:"
        " it is proven that some optimum, and the lightest, lies within them",
        examples=[{"1a": 412.5}],
    )
    method: str = Field(description="what found the counterweights", examples=["cone program, clarabel"])
    cuts: int | None = Field(
        None, description="angles at which responses over a revolution were held; null without any", examples=[24]
    )
    rounds: int | None = Field(None, description="programs solved to find them; null likewise", examples=[5])
    continuous_lower_bound: float | None = Field(
        None,
        description="the bound that multipliers prove: no counterweights of any mass and angle within the limits have"
        " a smaller objective. Null where nothing is chosen from a catalogue, or if nothing is proven",
        examples=[None],
    )
    nodes: int | None = Field(
        None, description="nodes of the tree behind lower_bound; null where nothing is chosen", examples=[None]
    )
    goals: tuple[GoalReached, ...] = Field(
        (),
        description="goals before the last, in their order; the certificate is that of the last one under them. Where"
        " the last of external, bearings and bending leaves an allowance to mass, pieces or sizes, or these stand"
        " elsewhere, all goals are here; the gap of the certificate then holds what was used of the allowance",
        examples=[[]],
    )
    multipliers: Multipliers = Field(
        description="the multipliers of both bounds, with which anybody can evaluate them again",
        examples=[{"objective": {"rows": [{"name": "sum", "value": 1.0}]}}],
    )


class EffectUse(Model):
    """Whether an effect was simulated, for which outputs, and how long it took."""

    simulated: bool = Field(description="whether the effect was simulated", examples=[True])
    needed_by: tuple[str, ...] = Field(
        description="outputs that asked for it; `objective` where goals go beyond the first order, `scenarios` where"
        " their machines were simulated",
        examples=[["residual"]],
    )
    time_ms: Milliseconds = Field(description="time it took; 0 where it was not simulated", examples=[0.1])


class Timing(Model):
    """Where the time went, in process."""

    total_ms: Milliseconds = Field(description="whole computation after validation", examples=[4.1])
    solve_ms: Milliseconds = Field(description="the convex program, both stages", examples=[2.9])
    mechanics_ms: Milliseconds = Field(description="machine to baseline and influence", examples=[0.3])
    certificate_ms: Milliseconds = Field(description="lower bounds", examples=[0.3])
    report_ms: Milliseconds = Field(description="residuals and other outputs", examples=[0.6])


BalanceRates = Annotated[
    tuple[BalanceRate, ...],
    Field(description="balance rate of every throw; empty if infeasible, and of a scroll", examples=[[{"rate": 0.82}]]),
]
ShaftQuality = Annotated[
    GradeReached | None,
    Field(
        description="balance quality of the shaft (ISO 21940-11); null where the machine asks for none, or no output"
        " for the first order",
        examples=[None],
    ),
]
EffectUses = Annotated[
    dict[str, EffectUse],
    Field(
        description="every effect, whether it was simulated, for which outputs, and its time",
        examples=[{"rotating_inertia": {"simulated": True, "needed_by": ["residual"], "time_ms": 0.1}}],
    ),
]


class OptimizeAnswer(OutputFields, Answer):
    """Certified counterweights."""

    status: Literal["optimal", "inaccurate", "infeasible"] = Field(
        description="optimal: certified to the asked gap; inaccurate: certified to a larger gap, which is reported; "
        "infeasible: no counterweights satisfy the ceilings",
        examples=["optimal"],
    )
    status_reason: StatusReason
    counterweights: tuple[Counterweight, ...] = Field(
        description="one for each web, in the machine's order; empty if infeasible", examples=[[]]
    )
    total_mass_kg: Kilograms | None = Field(
        description="total mass of the counterweights on the crankshaft; null if infeasible", examples=[41.2]
    )
    balance_shafts: tuple[FittedShaft, ...] = Field(
        (), description="unbalances of the balance shafts, in their order; empty if infeasible", examples=[[]]
    )
    balance_shafts_mass_kg: Kilograms | None = Field(
        None, description="total mass of these; null where there are none to show", examples=[None]
    )
    active_limits: tuple[MachineLimit, ...] = Field(
        (), description="limits of the whole machine that the answer touches", examples=[["max_total_mass"]]
    )
    shadow_prices: tuple[ShadowPrice, ...] = Field(
        (),
        description="price of every limit that the answer touches or that holds the objective up, webs in the"
        " machine's order and then the machine's limits. Empty if infeasible, and with priorities, scenarios or"
        " tolerances",
        examples=[[{"limit": "max_mass", "web": "1a", "value": 102.8, "unit": "N/kg"}]],
    )
    alternatives: tuple[Alternative, ...] = Field(
        (),
        description="cheaper choices within the allowances that the request lists; empty where nothing is cheaper",
        examples=[[{"minimised": "pieces", "allowance": 0.02, "objective": 41365.2, "total_mass_kg": 85.5}]],
    )
    worst_case: WorstCase | None = Field(
        None,
        description="peaks in the worst of all scenarios, all that may be off being so; null without scenarios and"
        " tolerances, and if infeasible",
        examples=[None],
    )
    price_of_robustness: PriceOfRobustness | None = Field(
        None, description="what suiting the worst case costs; null likewise", examples=[None]
    )
    sensitivity: Sensitivity | None = Field(
        None,
        description="what one degree and one per cent on all counterweights together may cost; null if infeasible, and"
        " where balance shafts count over all orders",
        examples=[{"objective_rise_per_deg": 105.4, "objective_rise_per_percent": 60.4}],
    )
    residual: Residual = Field(description="first order before and after", examples=[{"before": {}, "after": {}}])
    floor: Floor = Field(description="what no counterweights can remove", examples=[{"force_N": 2498.7}])
    certificate: Certificate | None = Field(
        description="the proof; null if infeasible", examples=[{"objective": 30345.0}]
    )
    infeasibility: InfeasibilityProof = None
    balance_rate: BalanceRates = ()
    balance_quality: ShaftQuality = None
    warnings: Cautions = ()
    reference_plane_m: Metres = Field(description="plane of the moments", examples=[0.0])
    effects: EffectUses
    timing: Timing = Field(description="where the time went", examples=[{"total_ms": 4.1}])


class AnalyzeAnswer(OutputFields, Answer):
    """The machine as it stands, or with given counterweights."""

    counterweights: tuple[Counterweight, ...] = Field(
        description="the counterweights on the machine, one for each web", examples=[[]]
    )
    total_mass_kg: Kilograms = Field(description="total mass of the counterweights", examples=[41.2])
    balance_shafts: ShaftUnbalances = ()
    balance_shafts_mass_kg: ShaftsMass = None
    floor: Floor | None = Field(
        None,
        description="what no counterweights can remove; null if no output asks for the first order",
        examples=[{"force_N": 2498.7}],
    )
    balance_rate: BalanceRates = ()
    balance_quality: ShaftQuality = None
    warnings: Cautions = ()
    reference_plane_m: Metres = Field(description="plane of the moments", examples=[0.0])
    residual: Residual | None = Field(None, description="first order before and after, if asked for", examples=[None])
    effects: EffectUses
    timing: Timing = Field(description="where the time went", examples=[{"total_ms": 1.2}])
