"""Assignments of weighed parts: each part is on one row, and rows weigh what is on them."""

import copy
from collections.abc import Callable
from typing import Any

import pytest

from schemas.match.request import MatchRequest
from service.verification import checker
from tests.studies.matching.cases import machine, matched, parts

Answer = dict[str, Any]


@pytest.fixture(scope="module")
def files() -> tuple[Answer, Answer]:
    """A request as it is read, and its answer."""
    body = {"machine": machine([0.0, 180.0, 90.0, 270.0], [0.0] * 4), "parts": parts(1, 4, 4)}
    request = MatchRequest.model_validate(body).model_dump(mode="json", by_alias=True)
    return request, matched(body).model_dump(mode="json", by_alias=True)


def test_a_genuine_assignment_is_not_broken(files: tuple[Answer, Answer]) -> None:
    found = checker().verify(*files)
    assert found["verdict"] == "not covered"
    assert {each["claim"]: each["verdict"] for each in found["claims"]} == {
        "assignments": "held", "spares": "held", "rows": "held", "total_mass": "held", "request": "not covered",
    }  # fmt: skip
    assert any("residual" in name for name in found["not_covered"])


def swap_names(answer: Answer) -> None:
    first, second = answer["assignments"][:2]
    first["part"], second["part"] = second["part"], first["part"]


def double(answer: Answer) -> None:
    answer["assignments"][1]["part"] = answer["assignments"][0]["part"]


def drop(answer: Answer) -> None:
    del answer["assignments"][0]


def elsewhere(answer: Answer) -> None:
    answer["assignments"][0]["throw"] = 9


def lighter(answer: Answer) -> None:
    answer["rows"][0]["reciprocating_mass_kg"] -= 0.01


def fewer_rows(answer: Answer) -> None:
    answer["rows"].pop()


@pytest.mark.parametrize("tampered", [swap_names, double, drop, elsewhere, lighter, fewer_rows])
def test_what_is_wrong_with_it_is_broken(files: tuple[Answer, Answer], tampered: Callable[[Answer], None]) -> None:
    request, answer = copy.deepcopy(files)
    tampered(answer)
    assert checker().verify(request, answer)["verdict"] == "broken"


def test_nuts_are_not_covered(files: tuple[Answer, Answer]) -> None:
    request, answer = copy.deepcopy(files)
    request["balance_nuts_kg"] = [0.5]
    found = checker().verify(request, answer)
    assert found["verdict"] == "not covered"
    assert [each["claim"] for each in found["claims"]] == ["total_mass", "request"]
