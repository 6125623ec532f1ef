"""The axes of a sweep: which fields vary, and over which values."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import ConfigDict, Field

from schemas.base.model import NotEmpty
from schemas.base.presence import absent, conditions, present, when
from schemas.base.quantities import Count
from schemas.base.rules import Rule, Ruled
from schemas.base.target import Value

MAX_DESIGNS = 10_000_000


class Axis(Ruled):
    """One field of the base request and the values that take its place: a list, or a range."""

    model_config = ConfigDict(
        json_schema_extra=conditions(
            when(present("values"), absent("start", "stop", "count"), present("start", "stop"))
        )
    )

    path: Annotated[str, Field(max_length=512)] = Field(
        description="JSON pointer (RFC 6901) of a numeric field of machine, objective or counterweights in the base",
        examples=["/machine/throws/0/rows/0/reciprocating_mass_kg"],
    )
    values: Annotated[tuple[Value, ...], Field(max_length=MAX_DESIGNS), NotEmpty()] | None = Field(
        None,
        description="the values, as the field itself takes them: numbers, strings with a unit, null where it may be",
        examples=[[250.0, 277.79, "310 kg"]],
    )
    start: Value = Field(None, description="first value of a range", examples=[250.0])
    stop: Value = Field(None, description="last value of a range", examples=["310 kg"])
    count: Count | None = Field(
        None,
        ge=1,
        le=MAX_DESIGNS,
        description="number of values in the range, both ends included; a Latin hypercube may leave it out and "
        "then draws from the whole range",
        examples=[21],
    )
    spacing: Literal["linear", "log"] = Field(
        "linear", description="even steps of the value, or of its logarithm", examples=["linear"]
    )

    def rules(self) -> Iterator[Rule]:
        if self.values is not None:
            for name in ("start", "stop", "count"):
                yield Rule(getattr(self, name) is not None, (name,), "give either the values or a range")
            return
        for name in ("start", "stop"):
            yield Rule(getattr(self, name) is None, (name,), "an axis needs values, or a range from start to stop")

    @property
    def levels(self) -> int | None:
        """Number of values; None for a range without a count."""
        return self.count if self.values is None else len(self.values)
