"""The same combinations by the other ways in: a row of a sweep, a front, steps of a workshop, and the ladder."""

import json
from collections.abc import Callable
from typing import Any

from optimizer.errors import NotComputable
from optimizer.studies.accuracy.measure import accuracy
from optimizer.studies.pareto.pareto import pareto
from optimizer.studies.rounding.round import round_weights
from schemas.front.pareto import ParetoRequest
from schemas.request.accuracy import AccuracyRequest
from schemas.request.rounding import RoundRequest
from schemas.sweep.request import SweepRequest
from service.common.validation import InvalidRequest, check
from service.verification import checker
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
        return (
            None if all(problem.path and problem.message for problem in refusal.problems) else "refused without a field"
        )
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
    """What is wrong with a front of three points; None where no claim of it is broken, or a field refuses it."""
    body: dict[str, Any] | None = body_of(base, features)
    if body is None:
        return None
    # of what is chosen nothing is proven that multipliers could prove
    fault = "multipliers"
    for more in ({"multipliers": True}, {}):
        request = body | {"points": 3, **more}
        text, fault = _answered(ParetoRequest, pareto, request)
        if text is not None:
            return _broken(request, text)
        if fault != "multipliers":
            break
    return fault or None


def round_fault(base: str, features: tuple[str, ...]) -> str | None:
    """What is wrong with a rounding of it; None where its bound and its steps are right, or a field refuses it."""
    body = body_of(base, features)
    if body is None:
        return None
    fields = {"request": body, "mass_step_kg": 0.3, "angle_step_deg": 7.2}
    text, fault = _answered(RoundRequest, round_weights, fields)
    if text is None:
        return fault or None
    answer = json.loads(text)
    if answer["rounding"] is None:
        return None if answer["status"] == "infeasible" else "nothing is said of the steps"
    on_shafts = [weight for shaft in answer["balance_shafts"] for weight in shaft["counterweights"]]
    free = [weight for weight in (*answer["counterweights"], *on_shafts) if not weight["fixed"]]
    off = [abs(weight["mass_kg"] / 0.3 - round(weight["mass_kg"] / 0.3)) for weight in free]
    off += [abs(weight["angle_deg"] / 7.2 - round(weight["angle_deg"] / 7.2)) for weight in on_shafts]
    if max(off, default=0.0) > 1e-9:
        return "a weight stands between two steps"
    proof, goal = answer["certificate"], body.get("objective", {})
    least = answer["rounding"]["optimum"]["objective"]
    if not goal.get("priorities") and proof["objective"] < least - 1e-5 * proof["yardstick"]:
        return f"{proof['objective']} on steps is below {least} of any masses"
    bound = proof["lower_bound"]
    return "the bound is above the value" if bound is not None and bound > proof["objective"] * (1 + 1e-9) else None


def accuracy_fault(base: str, features: tuple[str, ...]) -> str | None:
    """What is wrong with a ladder of it; None where no method is below the bound, or a field refuses it."""
    body = body_of(base, features)
    if body is None:
        return None
    text, fault = _answered(AccuracyRequest, accuracy, body | {"repeats": 1})
    if text is None:
        return fault or None
    document = json.loads(text)
    if document["status"] == "contradicted":
        return "a bound is above a value"
    rows = [row for row in (*document["ladder"], *document["choices_ladder"]) if row["relative_error"] is not None]
    lines = [row for row in rows if row.get("limits_kept", True) and (row.get("excess") or 0.0) <= 1e-9]
    below = [row["method"] for row in lines if row["relative_error"] < -1e-12]
    return f"{below} are below the bound" if below else None


def _answered(kind: type[Any], compute: Callable[[Any], Any], fields: dict[str, Any]) -> tuple[str | None, str]:
    """The answer as text; else what is wrong: nothing where a field refuses it, whose name alone is `multipliers`."""
    try:
        text: str = compute(check(kind, fields)).model_dump_json()
    except (InvalidRequest, NotComputable) as refusal:
        problems = list(refusal.problems)
        if problems and all(problem.path == ("multipliers",) for problem in problems):
            return None, "multipliers"
        return None, "" if all(problem.path and problem.message for problem in problems) else "refused without a field"
    return (None, "it holds no finite number") if "NaN" in text or "Infinity" in text else (text, "")


def _broken(fields: dict[str, Any], text: str) -> str | None:
    """The first claim that the checker finds broken."""
    module = checker()
    claims = module.verify(fields, json.loads(text), module.PLACES)["claims"]
    return next(
        (f"{claim['claim']} is broken by {claim['margin']}" for claim in claims if claim["verdict"] == "broken"), None
    )
