"""The same combinations by the other ways in: a row of a sweep, and a front."""

from typing import Any

from optimizer.errors import NotComputable
from optimizer.studies.pareto.pareto import pareto
from schemas.front.pareto import ParetoRequest
from schemas.sweep.request import SweepRequest
from service.common.validation import InvalidRequest, check
from tests.pairs.asking import ask, body_of
from tests.studies.sweep.single import assert_row_is_the_single_answer, table

#: statuses that hang on a clock are compared by what they are, not by their figures
_TIMED = "inaccurate"


def sweep_fault(base: str, features: tuple[str, ...]) -> str | None:
    """What is wrong with the row of a sweep over the speed as it is; None where it is the answer by itself."""
    body = body_of(base, features)
    if body is None:
        return None
    alone = ask(base, features)
    axis = {"path": "/machine/speed_rpm", "values": [body["machine"]["speed_rpm"]]}
    try:
        request = check(SweepRequest, {"base": body, "axes": [axis]})
    except InvalidRequest as refusal:
        return None if all(each.path and each.message for each in refusal.problems) else "refused without a field"
    (row,) = table(request).to_pylist()
    if row["status"] == "failed":
        return str(row["message"])
    if alone.status == _TIMED:
        return None if row["status"] in (_TIMED, "optimal") else f"{row['status']} is not {alone.status}"
    try:
        assert_row_is_the_single_answer(request, row, 1e-6)
    except AssertionError as unlike:
        return str(unlike)
    return None


def pareto_fault(base: str, features: tuple[str, ...]) -> str | None:
    """What is wrong with a front of three points; None where it is computed or refused by a field."""
    body: dict[str, Any] | None = body_of(base, features)
    if body is None:
        return None
    body["points"] = 3
    try:
        found = pareto(check(ParetoRequest, body))
    except (InvalidRequest, NotComputable) as refusal:
        return None if all(each.path and each.message for each in refusal.problems) else "refused without a field"
    text = found.model_dump_json()
    return "the front holds no finite number" if "NaN" in text or "Infinity" in text else None
