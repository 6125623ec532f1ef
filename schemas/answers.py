"""What the service answers. Every figure is recomputed by the mechanics."""

from typing import Literal

from pydantic import Field

from schemas.balance_quality import GradeReached
from schemas.base import Answer, Model
from schemas.caution import Caution
from schemas.outputs import Order, OutputFields
from schemas.proof import BoundMultipliers, InfeasibilityMultipliers, Multipliers, ResponseName
from schemas.quantities import (
    Degrees,
    KilogramMetres,
    Kilograms,
    KilogramSquareMetres,
    Metres,
    Milliseconds,
    Name,
    NewtonMetres,
    Newtons,
)
from schemas.robust import PriceOfRobustness, Sensitivity, WorstCase

WebLimit = Literal[
    "max_mass",
    "envelope",
    "sector",
]
CeilingField = Literal[
    "force_ceiling_N", "force_ceiling_x_N", "force_ceiling_y_N",
    "moment_ceiling_Nm", "moment_ceiling_x_Nm", "moment_ceiling_y_Nm",
    "bearing_ceiling_N", "specific_load_ceiling_Pa", "bending_ceiling_Nm",
]  # fmt: skip
MachineLimit = Literal[
    "max_total_mass", "force_ceiling", "force_ceiling_x", "force_ceiling_y",
    "moment_ceiling", "moment_ceiling_x", "moment_ceiling_y",
    "bearing_ceiling", "specific_load_ceiling", "bending_ceiling",
]  # fmt: skip
PriceUnit = Literal[
    "N/kg", "N/(kg m)", "N/deg", "N/N", "N/(N m)", "N m/kg", "N m/(kg m)", "N m/deg", "N m/N", "N m/(N m)"
]  # fmt: skip


class Shape(Model):
    """What is cut from the plate of a web, symmetric about the direction of its unbalance."""

    half_angle_deg: Degrees = Field(description="half the opening, as seen from the shaft", examples=[52.3])
    chord_height_m: Metres | None = Field(
        description="distance of the chord from the shaft; null for a sector", examples=[0.153]
    )
    outer_radius_m: Metres = Field(description="radius that it reaches: its clearance circle", examples=[0.25])
    inertia_kg_m2: KilogramSquareMetres = Field(description="moment of inertia about the shaft", examples=[0.61])


class Counterweight(Model):
    """One counterweight on one web."""

    web: Name = Field(description="name of the web", examples=["1a"])
    mass_kg: Kilograms = Field(description="mass", examples=[24.5])
    angle_deg: Degrees = Field(
        description="angle as drawn at shaft angle 0, from 0 up to 360; 0 where the mass is 0", examples=[180.0]
    )
    position_m: Metres = Field(description="plane of the counterweight along the shaft", examples=[0.28])
    radius_m: Metres = Field(description="radius of its centre of mass", examples=[0.25])
    throw: int | None = Field(
        description="number from 0 of the throw whose crank it belongs to; null where two are equally near",
        examples=[0],
    )
    angle_from_crank_deg: Degrees | None = Field(
        description="angle from that crank, from 0 up to 360: 180 is opposite it; null without crank or without mass",
        examples=[180.0],
    )
    mass_radius_kg_m: KilogramMetres = Field(description="mass times radius", examples=[6.125])
    x_kg_m: KilogramMetres = Field(description="x component of mass times radius", examples=[-6.125])
    y_kg_m: KilogramMetres = Field(description="y component of mass times radius", examples=[0.0])
    centrifugal_force_N: Newtons = Field(
        description="what has to hold it, at overspeed_rpm of the machine", examples=[16792.0]
    )
    active_limits: tuple[WebLimit, ...] = Field(
        description="limits of this web that the counterweight touches", examples=[["max_mass"]]
    )
    shape: Shape | None = Field(None, description="its outline; null where the web has no envelope", examples=[None])


class ShaftUnbalance(Model):
    """The unbalances of one balance shaft."""

    name: Name = Field(description="name of the shaft", examples=["upper"])
    speed_ratio: int = Field(description="turns of it for one of the crankshaft", examples=[-1])
    gearing: str = Field(
        description="which way it turns, how fast, and how its unbalances stand at shaft angle 0, in a sentence",
        examples=["Turns against the crankshaft at its speed."],
    )
    total_mass_kg: Kilograms = Field(description="total mass of its unbalances", examples=[3.2])
    counterweights: tuple[Counterweight, ...] = Field(
        description="one for each of its webs; angles as drawn at shaft angle 0, forces at its own speed", examples=[[]]
    )


class ForceEllipse(Model):
    """The first-order force over a turn: an ellipse, exact."""

    peak_N: Newtons = Field(description="largest force over a turn, the major semi-axis", examples=[4997.4])
    minor_N: Newtons = Field(description="smallest force over a turn, the minor semi-axis", examples=[0.0])
    major_axis_deg: Degrees = Field(description="direction of the major axis, 0 to 180", examples=[0.0])
    peak_x_N: Newtons = Field(description="largest x component over a turn", examples=[4997.4])
    peak_y_N: Newtons = Field(description="largest y component over a turn", examples=[0.0])
    co_rotating_N: Newtons = Field(description="magnitude of the phasor that turns with the shaft", examples=[2498.7])
    counter_rotating_N: Newtons = Field(
        description="magnitude of the phasor that turns against the shaft", examples=[2498.7]
    )


class MomentEllipse(Model):
    """The first-order moment over a turn: the couple in the plane of the forces, an ellipse, exact."""

    peak_Nm: NewtonMetres = Field(description="largest moment over a turn, the major semi-axis", examples=[19494.0])
    minor_Nm: NewtonMetres = Field(description="smallest moment over a turn, the minor semi-axis", examples=[0.0])
    major_axis_deg: Degrees = Field(description="direction of the major axis, 0 to 180", examples=[0.0])
    peak_x_Nm: NewtonMetres = Field(description="largest x component over a turn", examples=[19494.0])
    peak_y_Nm: NewtonMetres = Field(description="largest y component over a turn", examples=[0.0])
    co_rotating_Nm: NewtonMetres = Field(
        description="magnitude of the phasor that turns with the shaft", examples=[9747.0]
    )
    counter_rotating_Nm: NewtonMetres = Field(
        description="magnitude of the phasor that turns against the shaft", examples=[9747.0]
    )


class FirstOrder(Model):
    """First-order force and moment on the frame."""

    force: ForceEllipse = Field(description="force on the frame", examples=[{"peak_N": 4997.4}])
    moment: MomentEllipse = Field(
        description="moment about the reference plane, as a couple in the plane of the forces",
        examples=[{"peak_Nm": 19494.0}],
    )


class ResidualOrders(Model):
    """Orders 1 and 2 without and with counterweights, which change the first alone; closed forms."""

    before: tuple[Order, Order | None] = Field(
        description="without counterweights; the second is null where a row has no rod", examples=[[{"order": 1}, None]]
    )
    after: tuple[Order, Order | None] | None = Field(
        description="with the counterweights; null where there are none to show (infeasible)",
        examples=[[{"order": 1}, None]],
    )


class Residual(Model):
    """First order without and with counterweights, and the second that they cannot change."""

    before: FirstOrder = Field(description="without counterweights", examples=[{"force": {"peak_N": 9994.7}}])
    after: FirstOrder | None = Field(
        description="with the counterweights; null where there are none to show (infeasible)",
        examples=[{"force": {"peak_N": 4997.4}}],
    )
    orders: ResidualOrders = Field(description="orders 1 and 2 as phasors", examples=[{"before": [{"order": 1}, None]}])


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
        description="share across the crank, a quarter of a turn counter-clockwise from opposite it", examples=[0.0]
    )


class Floor(Model):
    """What remains however large the counterweights: the counter-rotating phasors, as far as no shaft turns so."""

    force_N: Newtons = Field(description="smallest peak force that counterweights could reach", examples=[2498.7])
    moment_Nm: NewtonMetres = Field(
        description="smallest peak moment that counterweights could reach", examples=[9747.0]
    )


class GoalReached(Model):
    """One of several goals that were met one after the other."""

    goal: Literal["external", "bearings", "bending"] = Field(description="the goal", examples=["external"])
    value: float = Field(description="what it came to by itself", examples=[30345.0])
    lower_bound: float | None = Field(
        description="certified: under the goals before it nothing is smaller; null if nothing is proven",
        examples=[30344.97],
    )
    limit: float = Field(description="what the goals after it had to keep", examples=[30405.7])


class Certificate(Model):
    """The proof: a lower bound in closed form that no counterweights within the limits can beat."""

    objective: float = Field(description="objective of the returned counterweights, recomputed", examples=[30345.0])
    lower_bound: float | None = Field(
        description="no counterweights within the limits, exceeding no ceiling by more than the returned ones do, have"
        " a smaller objective; null if nothing is proven",
        examples=[30344.97],
    )
    gap: float | None = Field(description="objective minus lower bound; null if nothing is proven", examples=[0.03])
    relative_gap: float | None = Field(description="gap over the yardstick; null if nothing is proven", examples=[5e-7])
    yardstick: float = Field(
        description="what the relative gap is relative to: the objective without counterweights; where that is 0, what"
        " the counterweights could change of it",
        examples=[60690.0],
    )
    objective_without_counterweights: float = Field(description="objective with no counterweights", examples=[60690.0])
    mass_lower_bound_kg: Kilograms | None = Field(
        description="no optimum, ceilings kept to their tolerance, has a smaller total mass; null if least mass was not"
        " asked for, or if nothing is proven",
        examples=[41.2],
    )
    mass_relative_gap: float | None = Field(
        description="total mass above that bound, over its yardstick; null likewise", examples=[2e-9]
    )
    mass_yardstick_kg: Kilograms | None = Field(
        description="what the mass gap is relative to: the total mass; where that is less, 1e-5 of the least mass that"
        " could cancel the objective, or a response under a ceiling, at the web where a kilogram does most, so that the"
        " gap allowed changes neither by more than ceilings may be exceeded by. Null if least mass was not asked for",
        examples=[41.2],
    )
    mass_objective_limit: float | None = Field(
        description="largest objective that counts as an optimum in the bound of the mass; null if least mass was not"
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
        None, description="angles at which responses over the whole turn were held; null without any", examples=[24]
    )
    rounds: int | None = Field(None, description="programs solved to find them; null likewise", examples=[5])
    continuous_lower_bound: float | None = Field(
        None,
        description="the bound that multipliers prove: no counterweights of any mass and angle within the limits have a"
        " smaller objective; null where nothing is chosen from a catalogue, or if nothing is proven",
        examples=[None],
    )
    nodes: int | None = Field(
        None, description="nodes of the tree behind lower_bound; null where nothing is chosen", examples=[None]
    )
    goals: tuple[GoalReached, ...] = Field(
        (),
        description="goals before the last, in their order; the certificate is that of the last one under them",
        examples=[[]],
    )
    multipliers: Multipliers = Field(
        description="the multipliers of both bounds, with which anybody can evaluate them again",
        examples=[{"objective": {"rows": [{"name": "sum", "value": 1.0}]}}],
    )


class ShadowPrice(Model):
    """What a limit costs: how much the smallest objective falls per unit by which the limit is raised."""

    limit: WebLimit | MachineLimit = Field(description="the limit", examples=["max_mass"])
    web: Name | None = Field(description="web whose limit it is; null for a limit of the machine", examples=["1a"])
    value: float = Field(
        ge=0,
        description="fall of the objective per unit of the limit, the objective taken as a force (over the force "
        "weight) or, where the force has no weight, as a moment; 0 if it cannot be told from 0 by the certificate",
        examples=[102.8],
    )
    unit: PriceUnit = Field(description="unit of the value; sectors are opened to both sides", examples=["N/kg"])


class EffectUse(Model):
    """Whether an effect was simulated, for which outputs, and how long it took."""

    simulated: bool = Field(description="whether the effect was simulated", examples=[True])
    needed_by: tuple[str, ...] = Field(description="outputs that asked for it", examples=[["residual"]])
    time_ms: Milliseconds = Field(description="time it took; 0 where it was not simulated", examples=[0.1])


class Timing(Model):
    """Where the time went, in process."""

    total_ms: Milliseconds = Field(description="whole computation after validation", examples=[4.1])
    solve_ms: Milliseconds = Field(description="the convex program, both stages", examples=[2.9])
    mechanics_ms: Milliseconds = Field(description="machine to baseline and influence", examples=[0.3])
    certificate_ms: Milliseconds = Field(description="lower bounds", examples=[0.3])
    report_ms: Milliseconds = Field(description="residuals and other outputs", examples=[0.6])


class Closest(Model):
    """The counterweights whose largest excess over the ceilings is smallest."""

    counterweights: tuple[Counterweight, ...] = Field(description="the counterweights", examples=[[]])
    balance_shafts: tuple[ShaftUnbalance, ...] = Field(
        (), description="unbalances of the balance shafts with them", examples=[[]]
    )
    first_order: FirstOrder = Field(description="what they leave", examples=[{"force": {"peak_N": 4997.4}}])


class SmallestPeak(Model):
    """The smallest peak of a response over the whole turn beside its ceiling."""

    response: ResponseName = Field(description="the response", examples=["bearing:A"])
    ceiling_field: CeilingField = Field(description="its ceiling in the request", examples=["bearing_ceiling_N"])
    ceiling: float = Field(description="largest peak allowed, N or N m", examples=[9000.0])
    smallest: float = Field(description="smallest peak within the limits, all else left free", examples=[9120.4])
    lower_bound: float = Field(description="certified: no counterweights have a smaller one", examples=[9120.3])
    multipliers: BoundMultipliers | None = Field(
        None, description="the multipliers that prove the bound", examples=[{"rows": [{"name": "force:x", "value": 1}]}]
    )


class Infeasibility(Model):
    """Why no counterweights satisfy the ceilings, and what can be reached."""

    conflict: tuple[CeilingField, ...] = Field(
        description="the ceilings that cannot be met, alone or together", examples=[["force_ceiling_N"]]
    )
    smallest_force_N: Newtons = Field(
        description="smallest peak force within the limits, the moment left free", examples=[2498.7]
    )
    smallest_moment_Nm: NewtonMetres = Field(
        description="smallest peak moment within the limits, the force left free", examples=[9747.0]
    )
    smallest_force_lower_bound_N: Newtons = Field(
        description="certified: no counterweights within the limits have a smaller peak force", examples=[2498.7]
    )
    smallest_moment_lower_bound_Nm: NewtonMetres = Field(
        description="certified: no counterweights within the limits have a smaller peak moment", examples=[9747.0]
    )
    scenarios: tuple[Name, ...] = Field(
        (), description="scenarios whose ceilings conflict, one by itself or several with one another", examples=[[]]
    )
    smallest: tuple[SmallestPeak, ...] = Field(
        (), description="the same of every component, bearing load and bending moment that has a ceiling", examples=[[]]
    )
    implied_max_mass_kg: dict[Name, Kilograms] = Field(
        description="largest masses that the bounds count with, of webs without a limit or with one beyond any need:"
        " it is proven that the smallest that can be reached lies within them",
        examples=[{"1a": 412.5}],
    )
    closest: Closest = Field(description="the best compromise with the ceilings", examples=[{"counterweights": []}])
    multipliers: InfeasibilityMultipliers = Field(
        description="the multipliers that prove the conflict and both bounds",
        examples=[{"conflict": {"rows": [{"name": "force", "value": 0.01}]}}],
    )


class OptimizeAnswer(OutputFields, Answer):
    """Certified counterweights."""

    status: Literal["optimal", "inaccurate", "infeasible"] = Field(
        description="optimal: certified to the asked gap; inaccurate: certified to a larger gap, which is reported; "
        "infeasible: no counterweights satisfy the ceilings",
        examples=["optimal"],
    )
    status_reason: str = Field(
        description="why the status is what it is, in a sentence",
        examples=["The gap to the proven lower bound is within the asked one, and every limit is kept."],
    )
    counterweights: tuple[Counterweight, ...] = Field(
        description="one for each web, in the machine's order; empty if infeasible", examples=[[]]
    )
    total_mass_kg: Kilograms | None = Field(
        description="total mass of the counterweights on the crankshaft; null if infeasible", examples=[41.2]
    )
    balance_shafts: tuple[ShaftUnbalance, ...] = Field(
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
        description="price of every limit that the answer touches or that holds the objective up, webs in the "
        "machine's order and then the machine's limits; empty if infeasible, where the objective looks at the "
        "whole turn, and with scenarios or tolerances",
        examples=[[{"limit": "max_mass", "web": "1a", "value": 102.8, "unit": "N/kg"}]],
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
    infeasibility: Infeasibility | None = Field(
        None, description="which ceilings conflict; only if infeasible", examples=[None]
    )
    balance_rate: tuple[BalanceRate, ...] = Field(
        (), description="balance rate of every throw; empty if infeasible, and of a scroll", examples=[[{"rate": 0.82}]]
    )
    balance_quality: GradeReached | None = Field(
        None,
        description="balance quality of the shaft (ISO 21940-11); null where the machine asks for none, or no output"
        " for the first order",
        examples=[None],
    )
    warnings: tuple[Caution, ...] = Field(
        (),
        description="what one should know about an answer that is right as it stands",
        examples=[[{"code": "bare_crank", "message": "", "pointer": "/objective"}]],
    )
    reference_plane_m: Metres = Field(description="plane of the moments", examples=[0.0])
    effects: dict[str, EffectUse] = Field(
        description="every effect, whether it was simulated, for which outputs, and its time",
        examples=[{"rotating_inertia": {"simulated": True, "needed_by": ["residual"], "time_ms": 0.1}}],
    )
    timing: Timing = Field(description="where the time went", examples=[{"total_ms": 4.1}])


class AnalyzeAnswer(OutputFields, Answer):
    """The machine as it stands, or with given counterweights."""

    counterweights: tuple[Counterweight, ...] = Field(
        description="the counterweights on the machine, one for each web", examples=[[]]
    )
    total_mass_kg: Kilograms = Field(description="total mass of the counterweights", examples=[41.2])
    balance_shafts: tuple[ShaftUnbalance, ...] = Field(
        (), description="unbalances of the balance shafts, in their order", examples=[[]]
    )
    balance_shafts_mass_kg: Kilograms | None = Field(
        None, description="total mass of these; null where there are none", examples=[None]
    )
    floor: Floor | None = Field(
        None,
        description="what no counterweights can remove; null if no output asks for the first order",
        examples=[{"force_N": 2498.7}],
    )
    balance_rate: tuple[BalanceRate, ...] = Field(
        (), description="balance rate of every throw; empty if infeasible, and of a scroll", examples=[[{"rate": 0.82}]]
    )
    balance_quality: GradeReached | None = Field(
        None,
        description="balance quality of the shaft (ISO 21940-11); null where the machine asks for none, or no output"
        " for the first order",
        examples=[None],
    )
    warnings: tuple[Caution, ...] = Field(
        (),
        description="what one should know about an answer that is right as it stands",
        examples=[[{"code": "bare_crank", "message": "", "pointer": "/objective"}]],
    )
    reference_plane_m: Metres = Field(description="plane of the moments", examples=[0.0])
    residual: Residual | None = Field(None, description="first order before and after, if asked for", examples=[None])
    effects: dict[str, EffectUse] = Field(
        description="every effect, whether it was simulated, for which outputs, and its time",
        examples=[{"rotating_inertia": {"simulated": True, "needed_by": ["residual"], "time_ms": 0.1}}],
    )
    timing: Timing = Field(description="where the time went", examples=[{"total_ms": 1.2}])
