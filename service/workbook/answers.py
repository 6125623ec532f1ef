"""A request as a workbook, and the answer to an optimisation behind the request that it answers."""

from typing import Any

from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import OptimizeRequest
from service.workbook.files import workbook
from service.workbook.sheets import ANSWER, COUNTERWEIGHTS, Sheets, flat, table, written


def answered(request: OptimizeRequest, answer: OptimizeAnswer) -> bytes:
    """Request, counterweights, and every figure of the answer by the path of its field; lists as JSON.

    What an answer says nothing of has no line.
    """
    said = answer.model_dump(mode="json", exclude_none=True)
    fitted = said.pop("counterweights")
    fields = [[name, value] for name, value in flat(said)]
    return workbook(
        {**_asked(request), COUNTERWEIGHTS: table(fitted) or [["web"]], ANSWER: [["field", "value"], *fields]}
    )


def requested(request: OptimizeRequest, _: object) -> bytes:
    """The request alone."""
    return workbook(_asked(request))


def _asked(request: OptimizeRequest) -> Sheets:
    given: dict[str, Any] = request.model_dump(mode="json", exclude_unset=True)
    return written(given)
