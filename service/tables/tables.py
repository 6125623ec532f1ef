"""Tables that are there one at a time: each is called with a request and optimises for it."""

from collections.abc import Callable
from dataclasses import dataclass

from optimizer.errors import OutOfRange
from optimizer.optimize import optimize
from schemas.answer.answers import OptimizeAnswer
from schemas.answer.outputs import OutputName
from schemas.base.model import FieldProblem
from schemas.request.requests import OptimizeRequest
from service.tables import as_built, foundation, pins
from service.tables import order as workshop
from service.tables.lines import Lines


@dataclass(frozen=True)
class Table:
    """A table of the answer to an optimisation.

    outputs : what the answer must hold.
    lines : request, answer -> headings and lines.

    Raises
    ------
    MissingInput
        if the machine lacks what the table, or the objective, needs.
    OutOfRange
        if there is nothing to list.
    """

    outputs: tuple[OutputName, ...]
    lines: Callable[[OptimizeRequest, OptimizeAnswer], Lines]

    def __call__(self, request: OptimizeRequest) -> Lines:
        return self.lines(request, optimize(request, outputs=self.outputs))


def _pin_loads(_request: OptimizeRequest, answer: OptimizeAnswer) -> Lines:
    if answer.pin_loads is None:
        raise OutOfRange([FieldProblem(("machine",), "there are no pins: only a scroll has them")])
    return pins.lines(answer.pin_loads)


order = Table((), lambda _request, answer: workshop.required(answer))
built = Table(("residual",), lambda request, answer: as_built.lines(as_built.required(request, answer)))
foundation_loads = Table(
    ("foundation_loads",), lambda _request, answer: foundation.lines(answer.foundation_loads or ())
)
pin_loads = Table(("pin_loads",), _pin_loads)
