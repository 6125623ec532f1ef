"""Which weighed part goes on which row: what is answered."""

from typing import Literal

from pydantic import ConfigDict, Field

from schemas.answer.answers import Timing
from schemas.answer.caution import StatusReason
from schemas.answer.counterweights import Counterweight, FittedShaft
from schemas.answer.dynamics import RowSeries
from schemas.answer.first_order import FirstOrder
from schemas.base.model import Answer, Model
from schemas.base.quantities import Kilograms, Name


class Spare(Model):
    """A part that goes on no row."""

    model_config = ConfigDict(validate_by_name=True, serialize_by_alias=True)

    kind: Name = Field(alias="class", description="what it is; balance_nut for a nut", examples=["balance_nut"])
    part: Name = Field(description="its name; of a nut its number in the list, from 1", examples=["2"])
    mass_kg: Kilograms = Field(description="what it weighs", examples=[2.0])


class Assignment(Spare):
    """A part and the row that it goes on."""

    throw: int = Field(description="number of the throw in the machine, from 0", examples=[0])
    row: int = Field(description="number of the row on its throw, from 0", examples=[0])


class MatchedRow(RowSeries):
    """What a row weighs with its parts."""

    reciprocating_mass_kg: Kilograms = Field(
        description="reciprocating mass with the parts, without the rod", examples=[277.79]
    )


class Matched(Model):
    """First order with the parts as they are listed, and as they are matched."""

    before: FirstOrder = Field(
        description="the k-th part of a class on the k-th of its rows, without nuts; with chosen counterweights, those"
        " that are best for it",
        examples=[{"force": {"peak_N": 383.8}}],
    )
    after: FirstOrder = Field(description="as matched", examples=[{"force": {"peak_N": 30.7}}])


class MatchCertificate(Model):
    """How close to the best assignment the answer is proven to be."""

    objective: float = Field(description="weighted peaks as matched", examples=[30.7])
    objective_as_listed: float = Field(description="the same with the parts as they are listed", examples=[383.8])
    lower_bound: float | None = Field(
        description="certified: no assignment has a smaller objective; null if nothing is proven", examples=[30.7]
    )
    gap: float | None = Field(description="objective minus lower bound", examples=[0.0])
    relative_gap: float | None = Field(description="gap over yardstick", examples=[0.0])
    yardstick: float = Field(
        description="what the gap is relative to: the objective with the parts as they are listed, and without the"
        " counterweights that are to be chosen",
        examples=[383.8],
    )
    method: Literal["exhaustion", "sorting"] = Field(
        description="exhaustion: every assignment counts, those that a bound excludes are left out. sorting: the best"
        " of a search, beside the bound that sorting the masses proves, of all or set by set of the parts",
        examples=["exhaustion"],
    )


class MatchAnswer(Answer):
    """Which weighed part goes on which row."""

    status: Literal["optimal", "inaccurate"] = Field(
        description="optimal: certified to the asked gap; inaccurate: to a larger one, which is reported",
        examples=["optimal"],
    )
    status_reason: StatusReason
    assignments: tuple[Assignment, ...] = Field(
        description="parts on rows, class by class, the nuts last", examples=[[{"throw": 0, "row": 0}]]
    )
    spares: tuple[Spare, ...] = Field(description="nuts that are not used", examples=[[]])
    rows: tuple[MatchedRow, ...] = Field(
        description="every row with its parts", examples=[[{"throw": 0, "row": 0, "reciprocating_mass_kg": 277.79}]]
    )
    counterweights: tuple[Counterweight, ...] = Field(
        description="counterweights as given or as chosen, one for each web", examples=[[]]
    )
    total_mass_kg: Kilograms = Field(description="total mass of the counterweights", examples=[41.2])
    balance_shafts: tuple[FittedShaft, ...] = Field(
        (), description="what the balance shafts carry, in their order", examples=[[]]
    )
    balance_shafts_mass_kg: Kilograms | None = Field(
        None, description="total mass of that; null where there are none", examples=[None]
    )
    residual: Matched = Field(description="first order before and after", examples=[{"before": {}, "after": {}}])
    certificate: MatchCertificate = Field(description="the proof", examples=[{"objective": 30.7}])
    timing: Timing = Field(description="where the time went", examples=[{"total_ms": 4.1}])
