"""Multipliers of a certificate: with them anybody can evaluate the bound again, without a solver."""

from typing import Annotated, Literal

from pydantic import Field, StringConstraints

from schemas.answer.counterweights import Counterweight, FittedShaft
from schemas.base.model import Model
from schemas.base.quantities import Degrees, Kilograms, Name
from schemas.base.responses import RESPONSES

_ON_FRAME = "|".join(RESPONSES)
#: a response on the frame, a component of it as force:x, roll, bearing:name, bending:plane
ResponseName = Annotated[
    str,
    StringConstraints(
        max_length=80,
        pattern=rf"^(({_ON_FRAME})(:[xy])?|roll|bearing:[^\x00-\x1f\x7f]+|bending:[-+.e0-9]+)$",
    ),
]
#: a row of the objective: of a cut the response and the angle
RowName = Annotated[str, StringConstraints(min_length=1, max_length=192)]
Part = Literal["co", "counter"]

_PART = (
    "co: the weighted vector that turns with the shaft; counter: the one that turns against it, which counterweights"
    " change only where the direction weights differ"
)
_ANGLE = "shaft angle at which a response over a revolution is cut; null where the peak has a closed form"
_SCENARIO = "scenario whose response it is; null for the unchanged machine"


class TermMultiplier(Model):
    """Multiplier of one norm of the objective, a vector across the shaft."""

    response: ResponseName = Field(description="response whose peak the norm belongs to", examples=["force"])
    part: Part = Field(description=_PART, examples=["co"])
    row: RowName = Field(description="row of the objective that the norm belongs to", examples=["sum"])
    angle_deg: Degrees | None = Field(None, description=_ANGLE, examples=[None])
    scenario: Name | None = Field(None, description=_SCENARIO, examples=[None])
    x: float = Field(
        description="x component, no longer together with y than the row's multiplier; in the row's unit; of"
        " a root mean square that of the part that counterweights move",
        examples=[0.6],
    )
    y: float = Field(description="y component", examples=[-0.8])
    share: float | None = Field(
        None,
        ge=0,
        le=1,
        description="of a root mean square: share of the row's multiplier that belongs to the part that counterweights"
        " move, with which masses that scatter count; null elsewhere",
        examples=[None],
    )


class RowMultiplier(Model):
    """Multiplier of one row of the objective."""

    name: RowName = Field(
        description="sum, or the response whose weighted peak is the row, with the angle of a cut", examples=["sum"]
    )
    value: float = Field(
        ge=0,
        description="multiplier; those of a bound on the objective sum to 1, those of a bound on the mass are in kg per"
        " unit of the objective",
        examples=[1.0],
    )


class CeilingMultiplier(Model):
    """Multiplier of one ceiling, a vector across the shaft; its length is the price of the ceiling."""

    response: ResponseName = Field(description="response that the ceiling limits", examples=["force"])
    part: Part = Field(description="co: the vector that turns with the shaft", examples=["co"])
    angle_deg: Degrees | None = Field(None, description=_ANGLE, examples=[None])
    scenario: Name | None = Field(None, description=_SCENARIO, examples=[None])
    x: float = Field(description="x component, in what is bounded per N or per N m", examples=[0.0])
    y: float = Field(description="y component", examples=[0.0])


class BoundMultipliers(Model):
    """Multipliers of one bound (docs/mathematics.md section 5 evaluates it by hand)."""

    terms: tuple[TermMultiplier, ...] = Field(
        description="of the norms of the objective; empty where only ceilings count",
        examples=[[{"response": "force", "part": "co", "row": "sum", "x": 0.6, "y": -0.8}]],
    )
    rows: tuple[RowMultiplier, ...] = Field(
        description="of the rows of the objective; where only ceilings count, of the ceilings by the name of their"
        " response, in 1/N or 1/(N m)",
        examples=[[{"name": "sum", "value": 1.0}]],
    )
    budget: float = Field(
        ge=0,
        description="price of the limit of the total mass, in what is bounded per kg; 0 where there is none or where it"
        " does not bind",
        examples=[0.0],
    )
    ceilings: tuple[CeilingMultiplier, ...] = Field(description="of the ceilings, force first", examples=[[]])


class Multipliers(Model):
    """Multipliers of both stages."""

    objective: BoundMultipliers = Field(
        description="of the lower bound of the objective", examples=[{"rows": [{"name": "sum", "value": 1.0}]}]
    )
    mass: BoundMultipliers | None = Field(
        description="of the lower bound of the total mass; null if minimum mass was not asked for; all 0 where no more"
        " than 0 is proven",
        examples=[{"rows": [{"name": "sum", "value": 0.02}]}],
    )


class NominalProof(Model):
    """The best of an unchanged design, nothing off, and what proves it; fields as in the price of robustness."""

    lower_bound: float | None = Field(
        description="certified: nothing within the limits is smaller on that machine, nothing off; null where goals are"
        " met in their order",
        examples=[30344.97],
    )
    counterweights: tuple[Counterweight, ...] = Field(description="those of that optimum", examples=[[]])
    balance_shafts: tuple[FittedShaft, ...] = Field(
        description="unbalances of the balance shafts at that optimum", examples=[[]]
    )
    multipliers: BoundMultipliers | None = Field(description="of its lower bound; null likewise", examples=[None])
    implied_max_mass_kg: dict[Name, Kilograms] = Field(
        description="limits that change nothing on that machine, which its bound counts with", examples=[{}]
    )


class DesignMultipliers(Model):
    """What a sweep holds of the proof of one design, as JSON text."""

    objective: BoundMultipliers | None = Field(
        description="of the lower bound of the objective; null if infeasible",
        examples=[{"rows": [{"name": "sum", "value": 1.0}]}],
    )
    mass: BoundMultipliers | None = Field(
        description="of the lower bound of the total mass; null if infeasible or not asked for",
        examples=[{"rows": [{"name": "sum", "value": 0.02}]}],
    )
    mass_objective_limit: float | None = Field(
        description="largest objective that counts as an optimum in the bound of the mass", examples=[30345.06]
    )
    conflict: BoundMultipliers | None = Field(
        description="that the ceilings cannot be kept; only if infeasible", examples=[None]
    )
    implied_max_mass_kg: dict[Name, Kilograms] = Field(
        description="of webs without a limit, or with one far beyond any need: limits that change nothing, which the"
        " bounds count with",
        examples=[{"far": 41.2}],
    )
    nominal: NominalProof | None = Field(
        None,
        description="of nominal_optimum, with scenarios or tolerances; null where choices were searched",
        examples=[None],
    )


class EndMultipliers(Model):
    """Multipliers of the smallest peaks of a front."""

    smallest_force: BoundMultipliers = Field(
        description="of smallest_force_lower_bound_N", examples=[{"rows": [{"name": "force", "value": 1.0}]}]
    )
    smallest_moment: BoundMultipliers = Field(
        description="of smallest_moment_lower_bound_Nm", examples=[{"rows": [{"name": "moment", "value": 1.0}]}]
    )


class ScenarioConflict(Model):
    """Multipliers that prove that the ceilings of one scenario conflict by themselves."""

    scenario: Name = Field(description="the scenario", examples=["heavy"])
    conflict: BoundMultipliers = Field(
        description="with them its ceilings are exceeded by any counterweights within the limits",
        examples=[{"rows": [{"name": "force", "value": 0.01}]}],
    )


class InfeasibilityMultipliers(Model):
    """Multipliers that prove what an infeasible answer says."""

    conflict: BoundMultipliers | None = Field(
        description="with them the ceilings are exceeded by any counterweights within the limits; null where they are"
        " only by those that can be chosen",
        examples=[{"rows": [{"name": "force", "value": 0.01}]}],
    )
    smallest_force: BoundMultipliers = Field(
        description="of smallest_force_lower_bound_N", examples=[{"rows": [{"name": "force", "value": 1.0}]}]
    )
    smallest_moment: BoundMultipliers = Field(
        description="of smallest_moment_lower_bound_Nm", examples=[{"rows": [{"name": "moment", "value": 1.0}]}]
    )
    scenarios: tuple[ScenarioConflict, ...] = Field(
        (),
        description="of each of `scenarios`, where the ceilings of several conflict by themselves; else empty, and"
        " `conflict` prices no ceilings but theirs",
        examples=[[]],
    )
