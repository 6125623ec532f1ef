"""The answer to an optimisation as a workbook, behind the request that it answers."""

from typing import Any

from schemas.answers import OptimizeAnswer
from schemas.requests import OptimizeRequest
from service.workbook.files import workbook
from service.workbook.sheets import ANSWER, COUNTERWEIGHTS, flat, table, written


def answered(request: OptimizeRequest, answer: OptimizeAnswer) -> bytes:
    """Request, counterweights, and every figure of the answer by the path of its field; lists as JSON.

    What an answer says nothing of has no line.
    """
    asked: dict[str, Any] = request.model_dump(mode="json", exclude_unset=True)
    said = answer.model_dump(mode="json", exclude_none=True)
    fitted = said.pop("counterweights")
    fields = [[name, value] for name, value in flat(said)]
    return workbook(
        {**written(asked), COUNTERWEIGHTS: table(fitted) or [["web"]], ANSWER: [["field", "value"], *fields]}
    )
