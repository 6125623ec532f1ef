"""The trade-off of any two or three responses: what is answered about each point of it."""

from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from schemas.answer.caution import StatusReason
from schemas.answer.counterweights import ShaftsMass, ShaftUnbalances, WebCounterweights
from schemas.answer.infeasibility import InfeasibilityProof
from schemas.base.model import Displayable, Model
from schemas.base.quantities import Kilograms, NewtonMetres, Newtons
from schemas.base.responses import RESPONSES

if TYPE_CHECKING:
    Traded = str
else:
    #: of the responses on the frame, inside the shaft, the mass, and beside the mass all that is weighed
    Traded = Literal[*RESPONSES, "bearings", "bending", "roll", "mass", "objective"]
TradedNames = Annotated[tuple[Traded, ...], Field(min_length=2, max_length=3)]
#: points of all fronts of one request
MAX_TRADED_POINTS = 100


class TradedResponse(Model):
    """One of the responses that are traded."""

    response: Traded = Field(
        description="force, moment: their peaks as weighed across the shaft, of the first order or of all as `orders`"
        " says; bearings: the largest load as `bearing_measure` says; bending: the largest moment; roll: the peak of"
        " the moment about the crankshaft, of all orders; mass: the total, of balance shafts too;"
        " objective: force and moment of the first order, as they are weighed and combined",
        examples=["bearings"],
    )
    unit: str = Field(description="unit of its values", examples=["N"])
    without_counterweights: float = Field(description="its value without counterweights", examples=[103000.0])
    smallest: float = Field(description="its value where it alone counts", examples=[98000.0])
    lower_bound: float = Field(
        description="certified: no counterweights within the limits and ceilings have a smaller one", examples=[97999.9]
    )
    yardstick: float = Field(
        description="what gaps are relative to: its value without counterweights, or where there is none what the"
        " counterweights at the ends do one by one",
        examples=[103000.0],
    )


class TradedCertificate(Model):
    """The proof of a point: no counterweights within limits and ceilings are below this corner in every response."""

    corner: tuple[float | None, ...] = Field(
        description="one value for each response, in their order; null if nothing is proven", examples=[[98000.0, 41.2]]
    )
    relative_gap: float | None = Field(
        description="how far the point is above the corner: the largest difference over `yardstick`; null likewise",
        examples=[3e-7],
    )
    mass_lower_bound_kg: Kilograms | None = Field(
        description="no counterweights that are as good in every response, to within that gap, have a smaller total"
        " mass. Null if minimum mass was not asked for, or the mass is traded",
        examples=[41.2],
    )
    mass_relative_gap: float | None = Field(
        description="total mass above that bound, over the mass; null likewise", examples=[2e-6]
    )
    cuts: int = Field(description="cuts of what is known over a revolution", examples=[12])
    rounds: int = Field(description="programs that were solved", examples=[4])
    method: str = Field(description="what found the counterweights", examples=["cuts, clarabel"])


class TradedPoint(Model):
    """Counterweights of the trade-off."""

    status: Literal["optimal", "inaccurate"] = Field(
        description="optimal: certified to the asked gap; inaccurate: certified to a larger gap, which is reported",
        examples=["optimal"],
    )
    status_reason: StatusReason
    values: tuple[float, ...] = Field(
        description="one for each response, in their order, in the worst case, with the weights of scenarios; of what"
        " is known by a bracket its upper end",
        examples=[[99000.0, 41.2]],
    )
    nominal_values: tuple[float, ...] | None = Field(
        None,
        description="the same of the unchanged machine, nothing off; null without scenarios and tolerances",
        examples=[None],
    )
    beaten_by: int | None = Field(
        None,
        description="index of a point that is as small in every response and smaller in one; null if there is none."
        " Points nearer to each other than their gaps may beat one another, and where three are traded the edge of"
        " the triangle may lie behind the front",
        examples=[None],
    )
    force_peak_N: Newtons = Field(
        description="first-order peak force of the unchanged machine, nothing off", examples=[7504.6]
    )
    moment_peak_Nm: NewtonMetres = Field(description="first-order peak moment, likewise", examples=[20123.28])
    total_mass_kg: Kilograms = Field(description="total mass of the counterweights on the crankshaft", examples=[41.2])
    counterweights: WebCounterweights
    balance_shafts: ShaftUnbalances = ()
    balance_shafts_mass_kg: ShaftsMass = None
    certificate: TradedCertificate = Field(description="the proof", examples=[{"relative_gap": 3e-7}])


class TradedFront(Displayable):
    """The trade-off under one limit of the total mass."""

    max_total_mass_kg: Kilograms | None = Field(
        description="limit of the total mass of this front; null is none", examples=[None]
    )
    status: Literal["optimal", "inaccurate", "infeasible"] = Field(
        description="optimal: every point is; inaccurate: a point is not; infeasible: no counterweights satisfy the"
        " ceilings",
        examples=["optimal"],
    )
    reason: Literal["reached_together"] | None = Field(
        None,
        description="why there is a single point: all responses are smallest at the same counterweights, within the"
        " asked gap",
        examples=[None],
    )
    responses: tuple[TradedResponse, ...] = Field(
        description="what is traded, in the order asked; none if infeasible", examples=[[{"response": "bearings"}]]
    )
    points: tuple[TradedPoint, ...] = Field(
        description="of two responses in the order of the rising first; none if infeasible", examples=[[]]
    )
    infeasibility: InfeasibilityProof = None
