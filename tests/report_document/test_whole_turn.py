"""Reports of objectives over the whole turn, feasible and not; the checker says that it does not cover them."""

import json
from typing import Any, get_args

import pytest

from optimizer.optimize import optimize
from schemas.answer.limits import MachineLimit, WebLimit
from schemas.request.report import ReportRequest
from schemas.request.requests import OptimizeRequest
from service.report.blocks import Document, Number, Table
from service.report.chapters.limits import limits
from service.report.document import report
from service.report.html import html
from service.verification import checker
from tests.optimize.whole_turn import inline_six, request_of, single_throw
from tests.report_document.conftest import request_of as asked_of


def of(request: OptimizeRequest) -> ReportRequest:
    """The report on a request."""
    return ReportRequest.model_validate(request.model_dump())


def rows_of(document: Document, title: str) -> list[list[Any]]:
    """The cells of the one table of this title."""
    blocks = (block for chapter in document.chapters for block in chapter.blocks)
    (table,) = [block for block in blocks if isinstance(block, Table) and block.title == title]
    return [[cell.value if isinstance(cell, Number) else cell for cell in row] for row in table.rows]


@pytest.mark.parametrize(
    ("objective", "words"),
    [
        ({"bearing_weight": 1, "priorities": [{"goal": "external"}, {"goal": "bearings"}]}, "external, bearings"),
        ({"bearing_ceiling_N": 1e-3}, "the ceiling of the bearing loads"),
    ],
)
def test_the_report_names_goals_and_ceilings(objective: dict[str, Any], words: str) -> None:
    request = request_of(single_throw(), **objective)
    assert words in html(report(of(request))).decode()


def test_what_goals_came_to_and_their_allowance_stand_in_the_report() -> None:
    goals = [{"goal": "external", "allowance": 0.01}, {"goal": "bearings"}]
    request = request_of(single_throw(), bearing_weight=1, priorities=goals)
    document = html(report(of(request))).decode()
    assert "Goals in their order" in document
    assert "as the shaft sees them" in document


def test_every_limit_has_words() -> None:
    named = [*get_args(WebLimit), *get_args(MachineLimit)]
    assert len({limits([name]) for name in named}) == len(named)


def test_a_ceiling_that_is_reached_is_named_and_has_its_price() -> None:
    """105 kN lie above the smallest peak of the 2D12, and below what the best force and moment leave."""
    record = report(asked_of("2d12", objective={"bearing_ceiling_N": 1.05e5}))
    document = html(record).decode()
    assert "ceiling of the bearing loads" in document.split("limits of the machine reached")[1].split("</tr>")[0]
    rows = rows_of(record, "Shadow prices of the limits")
    assert [row[3] for row in rows if row[0] == "ceiling of the bearing loads"] == ["N/N"]


@pytest.mark.parametrize(
    ("fields", "machine", "why"),
    [
        ({"tolerances": {"angle_deg": 1}}, {}, "of scenarios and tolerances"),
        (
            {"objective": {"bearing_weight": 1, "priorities": [{"goal": "external"}, {"goal": "bearings"}]}},
            {},
            "of goals in their order",
        ),
        ({}, {"web_groups": [{"name": "all", "webs": ["0a", "1a"]}]}, "where webs form groups"),
        ({}, {"catalogue": {"masses_kg": [1, 2, 3], "angle_step_deg": 30}}, "where counterweights are chosen"),
    ],
)
def test_why_there_are_no_shadow_prices(fields: dict[str, Any], machine: dict[str, Any], why: str) -> None:
    body = {"machine": inline_six() | machine, "angles": {"step_deg": 30}, **fields}
    document = html(report(ReportRequest.model_validate(body))).decode()
    assert f"There are no shadow prices {why}" in document


def test_of_ceilings_out_of_reach_the_one_that_each_figure_is_of() -> None:
    """Analytic: one throw, rod without end: m_rec / 4 a bearing; a ceiling in Pa counts by the area of the bearing."""
    machine = single_throw()
    for bearing in machine["bearings"]:
        bearing |= {"diameter_m": 0.06, "length_m": 0.02}
    request = request_of(machine, bearing_ceiling_N=0.1, specific_load_ceiling_Pa=0.05 / 0.0012)
    rows = rows_of(report(of(request)), "Other responses under a ceiling, each by itself")
    specific = "specific bearing loads, times diameter and length"
    # both bearings are alike, so that either may stand for both
    assert {tuple(row[1:3]) for row in rows} == {("bearing loads", "N"), (specific, "N")}
    for row in rows:
        assert row[3] == pytest.approx(0.05 if row[1] == specific else 0.1, rel=1e-12)
        assert row[4] == pytest.approx(0.25, rel=1e-6)


def test_warnings_and_balance_rates_stand_in_the_report() -> None:
    request = asked_of("2d12")
    document = html(report(request)).decode()
    warnings = optimize(request).warnings
    assert warnings
    assert all(warning.message in document for warning in warnings)
    assert "balance rate" in document


@pytest.mark.parametrize(
    ("objective", "places"),
    [
        ({"orders": "all"}, {"/answer/certificate/mass_yardstick_kg"}),
        ({"bearing_weight": 1}, {"/answer/sensitivity"}),
        ({"bearing_ceiling_N": 1e3}, set()),
    ],
)
def test_the_checker_names_what_it_does_not_cover(objective: dict[str, Any], places: set[str]) -> None:
    """What has no proof of its own in an answer over a revolution is said, and nothing else is left open."""
    request = request_of(inline_six(), **objective)
    verdict = checker().verify(json.loads(request.model_dump_json()), json.loads(optimize(request).model_dump_json()))
    assert verdict["verdict"] == ("not covered" if places else "held")
    assert {*verdict["not_covered"]} == places
    assert not [claim for claim in verdict["claims"] if claim["verdict"] == "broken"]
