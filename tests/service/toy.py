"""A computation that is none of the service: what it takes to add one."""

from collections.abc import Iterator

from pydantic import Field

from schemas.base.model import Model
from service.computations.computation import Computation
from service.report.blocks import Chapter, facts


class ToyRequest(Model):
    """Two numbers."""

    one: float = Field(description="a number", examples=[1.0])
    other: float = Field(1.0, description="another", examples=[2.0])


class ToyAnswer(Model):
    """Their sum."""

    total: float = Field(description="the sum", examples=[3.0])


def add(request: ToyRequest) -> ToyAnswer:
    return ToyAnswer(total=request.one + request.other)


def added(_: ToyRequest, answer: ToyAnswer) -> Iterator[Chapter]:
    yield Chapter("Toy", (facts("", [("the sum", answer.total)]),))


TOY = Computation(
    name="toy_sum",
    path="/v1/toy-sum",
    request=f"{__name__}:ToyRequest",
    answer=f"{__name__}:ToyAnswer",
    compute=f"{__name__}:add",
    summary="A sum",
    remark="Nothing else.",
    help="Add two numbers.",
    chapters=f"{__name__}:added",
    scope="sweeps",
    later=True,
)
