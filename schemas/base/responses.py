"""The responses on the frame that an objective can weigh, limit and trade: what each is called wherever it is named.

One more is one more entry, with its fields in :class:`schemas.request.objective.Objective` and its shares of force and
moment in :mod:`optimizer.formulation.formulate`. All that names responses goes by this table: rules, answers, columns,
fronts, reports, forms.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Literal, NamedTuple

Axis = Literal["x", "y"]
#: how units are spelt at the end of names
_SPELT = {"N": "N", "N m": "Nm"}
_AXES: tuple[Axis, Axis] = ("x", "y")


class CeilingFields(NamedTuple):
    """What a hard limit on a peak is called."""

    response: str  # that it limits, a component of it as force:x
    unit: str
    field: str  # of the objective
    limit: str  # where it is touched
    label: str
    axis: Axis | None = None  # of the component that it limits; None is the whole vector


@dataclass(frozen=True)
class ResponseFields:
    """What a response is called.

    name : of its fields, as force of force_weight and force_ceiling_N.
    label : in tables and sentences.
    along : what its components across the shaft are called, where these have ceilings of their own.
    parameters : further fields of the objective that it depends on.
    """

    name: str
    unit: Literal["N", "N m"]
    label: str
    along: Mapping[Axis, str] = field(default_factory=dict)
    parameters: tuple[str, ...] = ()

    @cached_property
    def weight(self) -> str:
        """Field of its weight, 1/unit; null is one over the span of the machine."""
        return f"{self.name}_weight"

    @cached_property
    def peak(self) -> str:
        """Field and column of its peak."""
        return f"{self.name}_peak_{_SPELT[self.unit]}"

    @cached_property
    def ceilings(self) -> tuple[CeilingFields, ...]:
        """Its ceilings, that of the whole vector first."""
        name, unit = self.name, _SPELT[self.unit]
        whole = CeilingFields(name, self.unit, f"{name}_ceiling_{unit}", f"{name}_ceiling", self.label)
        components = (
            CeilingFields(
                f"{name}:{axis}", self.unit, f"{name}_ceiling_{axis}_{unit}", f"{name}_ceiling_{axis}", label, axis
            )
            for axis in _AXES
            if (label := self.along.get(axis)) is not None
        )
        return (whole, *components)


#: what the contract has fields of its own for: force and moment on the frame
PAIR = ("force", "moment")
#: in the order of answers
RESPONSES: dict[str, ResponseFields] = {
    fields.name: fields
    for fields in (
        ResponseFields("force", "N", "force", along={"x": "force along x", "y": "force along y"}),
        ResponseFields("moment", "N m", "moment", along={"x": "horizontal couple", "y": "vertical couple"}),
        # beside these two
    )
}


def ceilings() -> Iterator[CeilingFields]:
    """Those of all responses."""
    for response in RESPONSES.values():
        yield from response.ceilings


def limited(objective: Any) -> list[CeilingFields]:
    """Ceilings that an objective gives, as numbers or columns."""
    values = vars(objective)
    return [
        ceiling for response in RESPONSES.values() for ceiling in response.ceilings if values[ceiling.field] is not None
    ]


def active_responses(objective: Any) -> tuple[ResponseFields, ...]:
    """Force and moment, and of the others those that an objective weighs or limits, by numbers or columns."""
    if len(RESPONSES) == len(PAIR):
        return tuple(RESPONSES.values())
    return tuple(
        response
        for response in RESPONSES.values()
        if response.name in PAIR
        or _weighs(getattr(objective, response.weight))
        or any(getattr(objective, ceiling.field) is not None for ceiling in response.ceilings)
    )


def _weighs(weight: Any) -> bool:
    """Whether a weight, or one of a column, is not 0; null is one over the span."""
    return bool(weight is None or (weight.any() if hasattr(weight, "any") else weight != 0))
