"""Reports of objectives over the whole turn, feasible and not; the checker says that it does not cover them."""

import json
from typing import Any, get_args

import pytest

from optimizer.optimize import optimize
from schemas.limits import MachineLimit, WebLimit
from schemas.report import ReportRequest
from schemas.requests import OptimizeRequest
from service.report.chapters.balance import limits
from service.report.document import report
from service.report.html import html
from service.verification import checker
from tests.optimize.whole_turn import asked, inline_six
from tests.report_document.conftest import asked as asked_of


def of(request: OptimizeRequest) -> ReportRequest:
    """The report on a request."""
    return ReportRequest.model_validate(request.model_dump())


@pytest.mark.parametrize(
    ("objective", "words"),
    [
        ({"bearing_weight": 1, "priorities": [{"goal": "external"}, {"goal": "bearings"}]}, "external, bearings"),
        ({"bearing_ceiling_N": 1e3}, "the ceiling of the bearing loads"),
    ],
)
def test_the_report_names_goals_and_ceilings(objective: dict[str, Any], words: str) -> None:
    request = asked(inline_six(), **objective)
    assert words in html(report(of(request))).decode()


def test_what_goals_came_to_and_their_allowance_stand_in_the_report() -> None:
    goals = [{"goal": "external", "allowance": 0.01}, {"goal": "bearings"}]
    request = asked(inline_six(), bearing_weight=1, priorities=goals)
    document = html(report(of(request))).decode()
    assert "Goals before the last, in their order" in document
    assert "as the shaft sees them" in document


def test_every_limit_has_words() -> None:
    named = [*get_args(WebLimit), *get_args(MachineLimit)]
    assert len({limits([name]) for name in named}) == len(named)


def test_a_ceiling_that_is_reached_is_named_and_no_price_is_claimed() -> None:
    """105 kN lie above the smallest peak of the 2D12, and below what the best force and moment leave."""
    document = html(report(asked_of("2d12", objective={"bearing_ceiling_N": 1.05e5}))).decode()
    assert "ceiling of the bearing loads" in document.split("limits of the machine reached")[1].split("</tr>")[0]
    assert "all shadow prices are 0" not in document
    assert "first order alone" in document


def test_warnings_and_balance_rates_stand_in_the_report() -> None:
    request = asked_of("2d12")
    document = html(report(request)).decode()
    warnings = optimize(request).warnings
    assert warnings
    assert all(warning.message in document for warning in warnings)
    assert "balance rate" in document


@pytest.mark.parametrize("objective", [{"orders": "all"}, {"bearing_weight": 1}, {"bearing_ceiling_N": 1e3}])
def test_the_checker_does_not_cover_the_whole_turn(objective: dict[str, Any]) -> None:
    body = {"machine": inline_six(), "objective": objective}
    answer = json.loads(optimize(asked(inline_six(), **objective)).model_dump_json())
    assert checker().verify(body, answer)["verdict"] == "not covered"
