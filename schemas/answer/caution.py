"""What one should know about an answer that is right as it stands."""

from typing import Annotated, Literal

from pydantic import Field

from schemas.base.model import Model

CautionCode = Literal[
    "no_gas",
    "second_order_remains",
    "bare_crank",
    "component_grows",
    "span_of_a_far_web",
    "bearing_load_grows",
    "bending_moment_grows",
    "peak_not_closed",
    "fragile_optimum",
    "crosshead_lifts",
]


class Caution(Model):
    """One thing to know: the answer holds, but not for what one might take it for."""

    code: CautionCode = Field(description="what it is about", examples=["no_gas"])
    message: str = Field(
        description="the same in a sentence, with its numbers",
        examples=["1 row has no cylinder: its loads are those of inertia and friction alone."],
    )
    pointer: str = Field(
        description="JSON pointer into the request: the field that it is about",
        examples=["/machine/throws/0/rows/0/cylinder"],
    )


Cautions = Annotated[
    tuple[Caution, ...],
    Field(
        description="what one should know about an answer that is right as it stands",
        examples=[[{"code": "bare_crank", "message": "", "pointer": "/objective"}]],
    ),
]
StatusReason = Annotated[
    str,
    Field(
        description="why the status is what it is, in a sentence",
        examples=["The gap to the proven lower bound is within the asked one, and every limit is kept."],
    ),
]
