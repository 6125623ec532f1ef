"""Answers on their way to a test, through the independent checker.

Of every file of tests the first is, and every twentieth. The checker takes four times as long as an ordinary answer,
and a hundred times where its cylinders have a measured pressure. Where the variable CHECKED_ANSWERS is `every`, as at
night and under mutants, all of them are.
"""

import json
import os
import sys
from collections import Counter
from typing import Any

import pytest

from optimizer.optimize import optimize
from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import OptimizeRequest
from service.verification import checker
from tests.night import ALL

#: of a file, so many answers are checked whatever there are, then one of so many
_FIRST, _STEP = 1, 20


class Spread:
    """Which answers of a file of tests are checked: by their number, so that a run that failed fails again."""

    def __init__(self, every: bool) -> None:
        self._every = every
        self._counts = Counter[str]()

    def __call__(self, test: str) -> bool:
        """Whether the next answer of a test is checked; it is named as pytest names it, its file before two colons."""
        file = test.partition("::")[0]
        self._counts[file] += 1
        count = self._counts[file]
        return self._every or count <= _FIRST or count % _STEP == 0


_spread = Spread(ALL)


def optimized(body: dict[str, Any]) -> OptimizeAnswer:
    """The answer to a request; no claim of it is broken, where it is checked."""
    answer = optimize(OptimizeRequest.model_validate(body))
    require(body, answer)
    return answer


def sound_answer(body: dict[str, Any]) -> OptimizeAnswer:
    """The answer to a request, which is always checked: every claim of it holds."""
    answer = optimize(OptimizeRequest.model_validate(body))
    assert not broken(body, answer.model_dump(mode="json"))
    return answer


def require(request: Any, answer: Any, spread: Spread = _spread) -> None:
    """
    Raises
    ------
    AssertionError
        if the answer is one of those that are checked, and a claim of it is broken.
    """
    if is_checked(spread):
        # a dictionary is what a request was made of; tests may put arrays where JSON has lists
        text = (
            json.dumps(request, default=lambda array: array.tolist())
            if isinstance(request, dict)
            else request.model_dump_json()
        )
        document = json.loads(text)
        claims = broken(document, json.loads(answer.model_dump_json()))
        assert not claims, "\n".join([*claims, text])


def is_checked(spread: Spread = _spread) -> bool:
    """Whether the next answer is one of those; outside of tests each is."""
    test = os.environ.get("PYTEST_CURRENT_TEST")
    return test is None or spread(test)


def broken(request: Any, answer: Any) -> list[str]:
    """The claims of an answer, or of rows, that do not hold."""
    claims = checker().verify(request, answer)["claims"]
    return [f"{claim['claim']} {claim['margin']} {claim['where']}" for claim in claims if claim["verdict"] == "broken"]


def is_broken(request: Any, answer: Any) -> bool:
    """Whether a claim does not hold: the first that does not is the last that is looked at."""
    tools = checker()
    is_contradiction = sys.modules["verify_claims"].is_contradiction

    def judged(claims: Any, _answer: Any) -> bool:
        return any(room is not None and is_contradiction(room) for _, _, room, _ in claims)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(tools, "judged", judged)
        judgement: bool = tools.verify(request, answer)
    return judgement


def verdict(request: Any, answer: Any) -> str:
    """The verdict on an answer, or on rows."""
    judgement: str = checker().verify(request, answer)["verdict"]
    return judgement
