"""Versions of a design beside the one of the report."""

from typing import Any

import pytest

from optimizer.analyze import analyze
from optimizer.errors import MissingInput
from optimizer.optimize import optimize
from schemas.request.report import ReportRequest
from schemas.request.requests import AnalyzeRequest
from service.common.validation import InvalidRequest, check
from service.guard.sizes import SizeLimits
from service.report.blocks import Number, Table
from service.report.chapters import versions
from service.report.document import report
from service.report.pdf import pdf
from tests.report_document.conftest import AT, request_of

FITTED = [{"web": web, "mass_kg": 55, "angle_deg": angle} for web, angle in (("1a", 180), ("2b", 0))]


def faster(speed_rpm: float) -> dict[str, Any]:
    machine: dict[str, Any] = request_of("2d12").machine.model_dump(mode="json")
    return {**machine, "speed_rpm": speed_rpm}


def tables(request: ReportRequest) -> list[Table]:
    chapters = [chapter for chapter in report(request, AT).chapters if chapter.title == "Versions compared"]
    return [block for chapter in chapters for block in chapter.blocks if isinstance(block, Table)]


def test_each_version_is_what_the_service_answers_for_it_alone() -> None:
    request = request_of(
        "2d12",
        versions=[{"name": "as built", "counterweights": FITTED}, {"name": "600 rpm", "machine": faster(600)}],
    )
    figures, weights, differences = tables(request)
    own = optimize(request_of("2d12"))
    built = analyze(AnalyzeRequest(machine=request.machine, counterweights=request.versions[0].counterweights or ()))
    answer = optimize(request_of("2d12", machine=faster(600)))
    force = [cell.value for cell in figures.rows[1][1:] if isinstance(cell, Number)]
    assert built.residual is not None
    # independent: the same through their own doors
    assert force == [
        left.force.peak_N
        for residual in (own.residual, built.residual, answer.residual)
        if (left := residual.after) is not None
    ]
    # analytic: forces go with the square of the speed, 1.44, and the counterweights are the same
    assert figures.rows[2][-1] == "+44.00 %"
    assert figures.rows[0] == ("counterweights", "optimal", "given", "optimal")
    assert [row[0] for row in weights.rows] == ["1a", "1b", "2a", "2b"]
    assert weights.rows[1][2] == "none"
    assert differences.rows == (("600 rpm", "/machine/speed_rpm", "500", "600"),)
    assert pdf(report(request, AT)).startswith(b"%PDF-")


def test_where_no_ceiling_is_kept_masses_are_those_of_the_peaks_beside_them() -> None:
    request = request_of(
        "2d12", objective={"force_ceiling_N": 1}, versions=[{"name": "600 rpm", "machine": faster(600)}]
    )
    figures, weights, _ = tables(request)
    why = optimize(request.alone).infeasibility
    assert why is not None
    masses = [counterweight.mass_kg for counterweight in why.closest.counterweights]
    assert figures.rows[0] == ("counterweights", *2 * ("infeasible: best compromise",))
    total = figures.rows[5][1]
    assert figures.rows[5][0] == "total mass, kg"
    assert isinstance(total, Number)
    assert total.value == pytest.approx(sum(masses), rel=1e-12)
    assert [row[1] == "none" for row in weights.rows] == [mass == 0 for mass in masses]


def test_without_versions_there_is_no_chapter() -> None:
    assert tables(request_of("2d12")) == []


@pytest.mark.parametrize(
    ("version", "field", "text"),
    [
        ({"counterweights": [{"web": "9", "mass_kg": 1, "angle_deg": 0}]}, ("counterweights", 0, "web"), "no web"),
        ({"counterweights": [], "objective": {}}, ("objective",), "counterweights of its own"),
        ({"objective": {"roll_weight": 1}}, ("objective", "roll_weight"), "balance shafts"),
        ({"name": ""}, ("name",), "at least 1"),
    ],
)
def test_a_wrong_version_is_refused_at_its_field(
    version: dict[str, Any], field: tuple[str | int, ...], text: str
) -> None:
    body = {**request_of("2d12").model_dump(mode="json"), "versions": [{"name": "x", **version}]}
    with pytest.raises(InvalidRequest) as refused:
        check(ReportRequest, body)
    (problem,) = refused.value.problems
    assert problem.path == ("versions", 0, *field)
    assert text in problem.message


def test_two_of_one_name_and_too_many_are_refused() -> None:
    with pytest.raises(ValueError, match="another version has this name"):
        request_of("2d12", versions=[{"name": "x"}, {"name": "x"}])
    with pytest.raises(ValueError, match="at most 4"):
        request_of("2d12", versions=[{"name": str(n)} for n in range(5)])


def test_what_the_machine_of_a_version_lacks_is_named_there() -> None:
    bare = {**faster(500), "bearings": []}
    with pytest.raises(MissingInput) as missing:
        report(request_of("2d12", versions=[{"name": "x", "machine": bare, "objective": {"bearing_weight": 1}}]), AT)
    assert missing.value.problems[0].path[:3] == ("versions", 0, "machine")


def test_what_an_operator_allows_holds_for_versions_too() -> None:
    request = request_of("2d12", machine={**faster(500), "webs": []}, versions=[{"name": "x", "machine": faster(600)}])
    with pytest.raises(InvalidRequest) as refused:
        SizeLimits(throws=500, rows=500, webs=3, angles=36_000, designs=10).require(request)
    assert [problem.path for problem in refused.value.problems] == [("versions", 0, "machine", "webs")]


def test_lists_are_compared_item_by_item_where_they_are_as_long() -> None:
    """Analytic: pointer, value here, value there; of lists of other lengths how many there are."""
    here = {
        "webs": [{"mass_kg": 1.5, "name": "a"}, {"mass_kg": 2.0}],
        "rows": [1, 2, 3],
        "plane": None,
        "own": {"x": 1.0},
    }
    there = {"webs": [{"mass_kg": 1.5, "name": "b"}, {"mass_kg": 2.5}], "rows": [1, 2], "plane": 0.25, "kind": "scroll"}
    assert list(versions._apart(("machine",), here, there)) == [
        ("/machine/webs/0/name", "a", "b"),
        ("/machine/webs/1/mass_kg", "2", "2.5"),
        ("/machine/rows", "3 of them", "2 of them"),
        ("/machine/plane", "none", "0.25"),
        ("/machine/own", "given", "none"),
        ("/machine/kind", "none", "scroll"),
    ]
    assert list(versions._apart(("machine",), here, here)) == []
