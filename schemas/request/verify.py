"""An answer to be checked against its request, and what became of its claims."""

from typing import Any, Literal

from pydantic import Field

from schemas.base.model import Answer, Model

Verdict = Literal["held", "broken", "not covered"]


class VerifyRequest(Model):
    """A request with the answer that it got; the checker reads both as they are (docs/verify.md)."""

    request: dict[str, Any] = Field(
        description="body of /v1/optimize, /v1/pareto, /v1/sweeps or /v1/scroll/pin-loads",
        examples=[{"machine": {"kind": "reciprocating"}}],
    )
    answer: dict[str, Any] | list[Any] = Field(
        description="the answer; of a sweep, a list of its rows as in NDJSON", examples=[{"status": "optimal"}]
    )


class Claim(Model):
    """What became of the claims of one kind; of several, such as those of many webs, the worst."""

    claim: str = Field(description="kind of claim, docs/verify.md lists them", examples=["lower_bound"])
    verdict: Verdict = Field(
        description="held and broken are proven; not covered: not claimed, or not known to the checker",
        examples=["held"],
    )
    margin: float | None = Field(
        description="room that is left until the claim is broken, as a share of what it is measured by. It is below 0"
        " where the claim is broken, null where there is no number to it",
        examples=[1e-13],
    )
    where: str = Field(description="JSON pointer (RFC 6901) of the field", examples=["/answer/certificate/lower_bound"])


class VerifyAnswer(Answer):
    """The claims of an answer."""

    claims: tuple[Claim, ...] = Field(description="the claims", examples=[[{"claim": "lower_bound"}]])
    leaves: int = Field(
        description="numbers and texts of the answer that claim something, without those that state how it was found",
        examples=[212],
    )
    checked: int = Field(description="those of them that were looked at", examples=[212])
    not_covered: tuple[str, ...] = Field(
        description="JSON pointers (RFC 6901) of the others, * for all of a list, a part of which nothing was looked at"
        " as one; the first 200",
        examples=[["/answer/main_bearings"]],
    )
    verdict: Verdict = Field(
        description="broken: a claim is; held: every claim was looked at and holds; not covered: nothing is broken, but"
        " there are claims that were not looked at",
        examples=["held"],
    )
