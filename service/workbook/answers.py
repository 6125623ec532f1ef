"""A request as a workbook, and the answer to an optimisation behind the request that it answers."""

from typing import Any

from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import OptimizeRequest
from service.tables import as_built, foundation
from service.workbook.files import workbook
from service.workbook.sheets import ANSWER, BUILT, COUNTERWEIGHTS, FOUNDATION, Sheets, flat, request_sheets, table


def answered(request: OptimizeRequest, answer: OptimizeAnswer) -> bytes:
    """Request, counterweights, and every figure of the answer by the path of its field; lists as JSON.

    Counterweights, loads on the foundation, and what is fitted beside the optimum have a sheet each, with a number in
    every cell.

    What an answer says nothing of has no line.
    """
    content = answer.model_dump(mode="json", exclude_none=True)
    fitted = content.pop("counterweights")
    content.pop(FOUNDATION, None)
    fields = [[name, value] for name, value in flat(content)]
    sheets: Sheets = {COUNTERWEIGHTS: table(fitted) or [["web"]]}
    built = as_built.as_built(request, answer)
    if built is not None:
        sheets[BUILT] = [*as_built.lines(built), [], [*as_built.RESIDUAL_HEADS], *as_built.residual(answer, built)]
    if answer.foundation_loads:
        sheets[FOUNDATION] = foundation.lines(answer.foundation_loads)
    return workbook({**_request_sheets(request), **sheets, ANSWER: [["field", "value"], *fields]})


def requested(request: OptimizeRequest, _: object) -> bytes:
    """The request alone."""
    return workbook(_request_sheets(request))


def _request_sheets(request: OptimizeRequest) -> Sheets:
    fields: dict[str, Any] = request.model_dump(mode="json", exclude_unset=True)
    return request_sheets(fields)
