"""Errors as RFC 9457 problem details."""

from pydantic import Field

from schemas.base.model import Model


class FieldError(Model):
    """What is wrong with one field."""

    pointer: str = Field(
        description="JSON pointer to the field in the request body; of a parameter, below /query or /path",
        examples=["/machine/throws/0/crank_radius_m"],
    )
    message: str = Field(description="what is wrong", examples=["must be at least 1e-12"])


class Problem(Model):
    """Problem details for HTTP APIs."""

    type: str = Field(description="kind of problem, a URI reference", examples=["/problems/invalid-request"])
    title: str = Field(description="short name of the kind of problem", examples=["Invalid request"])
    status: int = Field(description="HTTP status code", examples=[422])
    detail: str = Field(description="what happened", examples=["1 field is invalid."])
    instance: str = Field(description="path of the request", examples=["/v1/optimize"])
    errors: tuple[FieldError, ...] = Field(
        (),
        description="the fields that are wrong, the first 50 of them",
        examples=[[{"pointer": "/machine/throws/0/crank_radius_m", "message": "must be at least 1e-12"}]],
    )
