"""Answers on their way to a test, each through the independent checker."""

import json
from typing import Any

from optimizer.optimize import optimize
from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import OptimizeRequest
from service.verification import checker


def optimized(body: dict[str, Any]) -> OptimizeAnswer:
    """The answer to a request; no claim of it is broken."""
    answer = optimize(OptimizeRequest.model_validate(body))
    # tests may put arrays where JSON has lists
    sent = json.loads(json.dumps(body, default=lambda array: array.tolist()))
    found = broken(sent, json.loads(answer.model_dump_json()))
    assert not found, "\n".join([*found, json.dumps(sent)])
    return answer


def broken(request: Any, answer: Any) -> list[str]:
    """The claims of an answer, or of rows, that do not hold."""
    claims = checker().verify(request, answer)["claims"]
    return [f"{one['claim']} {one['margin']} {one['where']}" for one in claims if one["verdict"] == "broken"]


def verdict(request: Any, answer: Any) -> str:
    """The verdict on an answer, or on rows."""
    found: str = checker().verify(request, answer)["verdict"]
    return found
