"""As built is what is filed: beside the optimum in report, workbook, table and drawings."""

import csv
import io
import json
from math import radians
from pathlib import Path
from typing import Any

import pytest

from optimizer.analyze import analyze
from optimizer.errors import OutOfRange
from optimizer.optimize import optimize
from schemas.request.drawings import DrawingsRequest
from schemas.request.report import ReportRequest
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from service.common.figures import digits, typeset
from service.documents.examples import bodies
from service.drawings.bill import as_csv
from service.drawings.drawing_set import drawings
from service.drawings.sheet import sheet
from service.report import pictures
from service.report.blocks import Number, Paragraph, Table
from service.report.document import report
from service.report.pictures import Picture
from service.tables import as_built, tables
from service.workbook.answers import answered
from service.workbook.files import workbook_sheets
from service.workbook.sheets import BUILT, read
from tests.report_document.conftest import AT

FITTED = [
    {"web": "1a", "mass_kg": 60.0, "angle_deg": 180.0},
    {"web": "1b", "mass_kg": 59.5, "angle_deg": 181.0},
    {"web": "2a", "mass_kg": 52.5, "angle_deg": 359.0},
]


def request(**rest: Any) -> dict[str, Any]:
    return {**bodies()["2d12"], "fitted": FITTED, **rest}


def test_the_report_tells_what_the_mechanics_find_of_what_is_fitted() -> None:
    """Independent: the same counterweights given to an analysis."""
    body = ReportRequest.model_validate(request())
    alone = analyze(AnalyzeRequest.model_validate({"machine": request()["machine"], "counterweights": FITTED}))
    best = optimize(body.alone)
    assert alone.residual is not None
    assert alone.residual.after is not None
    assert best.residual.after is not None
    document = report(body, AT)
    blocks = {
        block.title: block for chapter in document.chapters for block in chapter.blocks if isinstance(block, Table)
    }
    decision = blocks["Decision"]
    assert [column.title for column in decision.columns][2:5] == ["optimum", "as built", "difference"]
    values = [cell.value for cell in decision.rows[0] if isinstance(cell, Number)]
    optimum, built = best.residual.after.force.peak_N, alone.residual.after.force.peak_N
    assert values[1:4] == [optimum, built, built - optimum]
    assert blocks["Optimum and as built"].rows[3][0] == "2b"
    words = " ".join(block.text for block in document.chapters[0].blocks if isinstance(block, Paragraph))
    assert "nothing is certified of it" in words


def test_differences_and_tolerance() -> None:
    body = OptimizeRequest.model_validate(request())
    answer = optimize(body)
    actual_as_built = as_built.required(body, answer)
    lines = {line[0]: dict(zip(as_built.HEADS, line, strict=True)) for line in as_built.lines(actual_as_built)[1:]}
    # analytic: the shorter way round, and a web that carries nothing
    assert lines["2a"]["difference, deg"] == pytest.approx(-1.0)
    assert lines["2b"]["as built, kg"] == 0.0
    assert lines["2b"]["as built, deg"] is None
    # independent: all angles off by the tolerance cost the allowance at most
    bears = actual_as_built.tolerance
    assert bears.angle_deg is not None
    assert answer.certificate is not None
    weight = 1.0 / 0.56
    for side in (-1.0, 1.0):
        turned = [
            {
                "web": counterweight.web,
                "mass_kg": counterweight.mass_kg,
                "angle_deg": counterweight.angle_deg + side * bears.angle_deg,
            }
            for counterweight in answer.counterweights
        ]
        off = analyze(AnalyzeRequest.model_validate({"machine": request()["machine"], "counterweights": turned}))
        assert off.residual is not None
        assert off.residual.after is not None
        objective = off.residual.after.force.peak_N + weight * off.residual.after.moment.peak_Nm
        rise = objective - answer.certificate.objective
        assert 0.0 < rise <= as_built.ALLOWANCE * answer.certificate.yardstick


def test_the_workbook_and_the_table_hold_numbers_and_are_read_back() -> None:
    body = OptimizeRequest.model_validate(request())
    sheets = workbook_sheets(answered(body, optimize(body)))
    heads, *lines = tables.built(body)
    assert sheets[BUILT][0] == heads
    for cells, line in zip(sheets[BUILT][1:5], lines, strict=True):
        # a cell has 16 digits
        assert [*cells, *(None,) * (len(line) - len(cells))] == [
            pytest.approx(text, rel=1e-14) if isinstance(text, float) else text for text in line
        ]
    assert tuple(sheets[BUILT][6]) == as_built.RESIDUAL_HEADS
    assert OptimizeRequest.model_validate(read(sheets).body) == body
    with pytest.raises(OutOfRange) as refused:
        tables.built(OptimizeRequest.model_validate(request(fitted=[])))
    assert refused.value.problems[0].path == ("fitted",)


def test_drawings_are_of_what_is_built() -> None:
    body = json.loads(Path("examples/drawings/2d12-plates.json").read_text())
    best = drawings(DrawingsRequest.model_validate({**body, "counterweights": None}))
    assert best.built is None
    counterweight = best.parts[0].places[0]
    fitted = [
        {"web": counterweight.web, "mass_kg": 0.9 * counterweight.mass_kg, "angle_deg": counterweight.angle_deg + 2.0}
    ]
    drawn = drawings(DrawingsRequest.model_validate({**body, "counterweights": None, "fitted": fitted}))
    (part,) = drawn.parts
    (place,) = part.places
    assert place.mass_kg == pytest.approx(0.9 * counterweight.mass_kg)
    assert place.shape is not None
    assert part.half_angle == radians(place.shape.half_angle_deg)
    (row,) = csv.DictReader(io.StringIO(as_csv(drawn).decode()))
    assert float(row["optimum, kg"]) == counterweight.mass_kg
    assert float(row["difference, kg"]) == place.mass_kg - counterweight.mass_kg
    assert float(row["difference, deg"]) == pytest.approx(2.0)
    svg = sheet(part, drawn.built).svg()
    assert f"as built {place.mass_kg:.6g} kg; optimum {counterweight.mass_kg:.6g} kg" in svg
    assert "tolerance ±" in svg


@pytest.mark.parametrize("picture", [pictures.front, pictures.side, pictures.force, pictures.moment])
def test_pictures_show_as_built_beside_the_optimum(picture: Picture) -> None:
    alone = picture(OptimizeRequest.model_validate(bodies()["2d12"])).svg()
    both = picture(OptimizeRequest.model_validate(request())).svg()
    assert len(both) > len(alone)
    dashes = "6 3" if picture in (pictures.front, pictures.side) else "9 3 2 3"
    # three weights are fitted; a hodograph has a curve and its key
    assert both.count(f'"{dashes}"') - alone.count(f'"{dashes}"') == (3 if dashes == "6 3" else 2)


def test_the_hodograph_tells_the_peak_as_built() -> None:
    alone = analyze(AnalyzeRequest.model_validate({"machine": request()["machine"], "counterweights": FITTED}))
    assert alone.residual is not None
    assert alone.residual.after is not None
    drawn = pictures.force(OptimizeRequest.model_validate(request())).svg()
    assert f"as built: peak {typeset(digits(alone.residual.after.force.peak_N))}" in drawn
