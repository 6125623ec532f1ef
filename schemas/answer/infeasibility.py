"""Ceilings that cannot be kept, and how far each peak comes down."""

from typing import Annotated

from pydantic import Field

from schemas.answer.counterweights import Counterweight, FittedShaft
from schemas.answer.first_order import FirstOrder, ResponsePeak
from schemas.answer.limits import CeilingField
from schemas.answer.proof import BoundMultipliers, InfeasibilityMultipliers, ResponseName
from schemas.base.model import Model
from schemas.base.quantities import (
    Kilograms,
    Name,
    NewtonMetres,
    Newtons,
)


class Closest(Model):
    """The counterweights whose largest excess over the ceilings is smallest."""

    counterweights: tuple[Counterweight, ...] = Field(description="the counterweights", examples=[[]])
    balance_shafts: tuple[FittedShaft, ...] = Field(
        (), description="unbalances of the balance shafts with them", examples=[[]]
    )
    first_order: FirstOrder = Field(description="what they leave", examples=[{"force": {"peak_N": 4997.4}}])
    responses: tuple[ResponsePeak, ...] = Field(
        (), description="the same of responses that are weighed or limited beside force and moment", examples=[[]]
    )


class SmallestPeak(Model):
    """The smallest peak of a response over the whole turn beside its ceiling."""

    response: ResponseName = Field(description="the response", examples=["bearing:A"])
    ceiling_field: CeilingField = Field(description="its ceiling in the request", examples=["bearing_ceiling_N"])
    ceiling: float = Field(
        description="largest peak allowed, N or N m; of specific_load_ceiling_Pa"
        " times the area of the bearing, diameter times length",
        examples=[9000.0],
    )
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
        " it is proven that what comes closest lies within them",
        examples=[{"1a": 412.5}],
    )
    smallest_implied_max_mass_kg: dict[ResponseName, dict[Name, Kilograms]] = Field(
        {},
        description="the same of the smallest peak of a response by itself where its bound counts with other masses,"
        " by response",
        examples=[{}],
    )
    closest: Closest = Field(description="the best compromise with the ceilings", examples=[{"counterweights": []}])
    multipliers: InfeasibilityMultipliers = Field(
        description="the multipliers that prove the conflict and both bounds",
        examples=[{"conflict": {"rows": [{"name": "force", "value": 0.01}]}}],
    )


InfeasibilityProof = Annotated[
    Infeasibility | None, Field(description="which ceilings conflict; only if infeasible", examples=[None])
]
