"""The worst case of scenarios and tolerances in the report, on the terminal and for the checker."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from optimizer.optimize import optimize
from schemas.request.report import ReportRequest
from schemas.request.requests import OptimizeRequest
from service.cli import app
from service.common.validation import InvalidRequest, check
from service.common.validation import pointer as spelled
from service.report.document import report
from service.report.html import html
from service.verification import checker
from tests.optimize.robust import crank, scenario

TWO = [scenario("as it is"), scenario("turned", throws__0__crank_angle_deg=60)]
BODY = {"machine": crank(), "scenarios": TWO, "tolerances": {"mass_relative": 0.02}}


def test_the_report_says_what_was_asked_and_what_it_costs() -> None:
    request = ReportRequest.model_validate(BODY)
    document, answer = html(report(request)).decode(), optimize(request)
    assert "Scenarios: the largest weighted objective counts" in document
    assert "mass of a counterweight, share of it" in document
    worst, price = answer.worst_case, answer.price_of_robustness
    assert worst is not None
    assert price is not None
    for figure in (worst.force_peak_N, price.nominal_optimum_worst_case):
        assert f'value="{figure!r}"' in document


def test_conflicting_scenarios_are_named_in_the_report() -> None:
    request = ReportRequest.model_validate({**BODY, "objective": {"force_ceiling_N": 90}})
    assert "scenarios as it is, turned conflict" in html(report(request)).decode()


def test_no_compromise_seems_to_be_below_what_is_certified() -> None:
    """The compromise is shown on the unchanged machine, below what the worst case is certified to be: both say so."""
    request = ReportRequest.model_validate({**BODY, "objective": {"force_ceiling_N": 90}})
    document, why = html(report(request)).decode(), optimize(request).infeasibility
    assert why is not None
    assert why.closest.first_order.force.peak_N < why.smallest_force_lower_bound_N
    for words in ("Smallest feasible peaks, in the worst case", "best compromise, on the unchanged machine"):
        assert words in document
    # all that an infeasible answer certifies is of the worst case
    assert "without the other ceiling, in the worst case: the force is never below" in document


def test_the_terminal_shows_the_worst_case(tmp_path: Path) -> None:
    file = tmp_path / "asked.json"
    file.write_text(json.dumps(BODY))
    process = CliRunner().invoke(app, ["optimize", str(file)])
    assert process.exit_code == 0
    assert "In the worst case" in process.output


def test_a_stranger_holds_scenarios_and_tolerances() -> None:
    for body in (BODY, {**BODY, "scenarios": []}):
        answer = json.loads(optimize(OptimizeRequest.model_validate(body)).model_dump_json())
        assert checker().verify(body, answer)["verdict"] == "held"


def test_a_wrong_scenario_is_named_by_its_pointer() -> None:
    wrong = {"name": "b", "changes": [{"path": "/machine/throws/3/crank_radius_m", "value": 1}]}
    with pytest.raises(InvalidRequest) as caught:
        check(OptimizeRequest, {**BODY, "scenarios": [TWO[0], wrong]})
    assert [spelled(path) for path, _ in caught.value.problems] == ["/scenarios/1/changes/0/path"]
