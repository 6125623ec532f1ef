"""Reports of objectives over the whole turn, feasible and not; the checker says that it does not cover them."""

import json
from typing import Any

import pytest

from optimizer.optimize import optimize
from service.report.document import report
from service.report.html import html
from service.verification import checker
from tests.optimize.whole_turn import asked, inline_six


@pytest.mark.parametrize(
    ("objective", "words"),
    [
        ({"bearing_weight": 1, "priorities": [{"goal": "external"}, {"goal": "bearings"}]}, "external, bearings"),
        ({"bearing_ceiling_N": 1e3}, "the ceiling of the bearing loads"),
    ],
)
def test_the_report_names_goals_and_ceilings(objective: dict[str, Any], words: str) -> None:
    request = asked(inline_six(), **objective)
    assert words in html(report(request)).decode()


@pytest.mark.parametrize("objective", [{"orders": "all"}, {"bearing_weight": 1}, {"bearing_ceiling_N": 1e3}])
def test_the_checker_does_not_cover_the_whole_turn(objective: dict[str, Any]) -> None:
    body = {"machine": inline_six(), "objective": objective}
    answer = json.loads(optimize(asked(inline_six(), **objective)).model_dump_json())
    assert checker().verify(body, answer)["verdict"] == "not covered"
