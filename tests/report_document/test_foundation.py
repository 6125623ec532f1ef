"""Loads on the foundation in the report's blocks and in the workbook: numbers in cells of their own."""

import csv
import io

from starlette.testclient import TestClient
from typer.testing import CliRunner

from optimizer.optimize import optimize
from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import OptimizeRequest
from service.app import create_app
from service.cli import app
from service.common.figures import digits
from service.documents.examples import bodies
from service.report.blocks import Number, Paragraph, Table
from service.report.chapters.foundation import foundation_loads
from service.settings import Settings
from service.workbook.answers import answered
from service.workbook.files import workbook_sheets
from service.workbook.sheets import FOUNDATION, read


def _solved() -> tuple[OptimizeRequest, OptimizeAnswer]:
    body = bodies()["2d12"]
    fitted = [{"web": body["machine"]["webs"][0]["name"], "mass_kg": 20.0, "angle_deg": 180.0}]
    request = OptimizeRequest.model_validate({**body, "outputs": ["foundation_loads"], "fitted": fitted})
    return request, optimize(request)


def test_the_chapter_holds_every_figure_and_no_row_of_zeros() -> None:
    _, answer = _solved()
    foundations = answer.foundation_loads
    assert foundations is not None
    chapter = foundation_loads(foundations)
    forces, couples = (block for block in chapter.blocks if isinstance(block, Table))
    # regression: along y only what a counterweight alone leaves; order 6 is below a thousandth
    assert [row[:2] for row in forces.rows] == [
        ("1", "along x"),
        ("1", "along y"),
        ("2", "along x"),
        ("4", "along x"),
    ]
    assert "as built, N" in [column.title for column in forces.columns]
    built = foundations[0].as_built
    assert foundations[0].after is not None
    assert built is not None
    first = [cell.value for cell in forces.rows[0] if isinstance(cell, Number)]
    force_xes = [load.force_x for load in (foundations[0].before, foundations[0].after, built)]
    assert first == [
        figure
        for force_x in force_xes
        for figure in (force_x.amplitude_N, force_x.amplitude_N / 1e3, force_x.phase_deg)
    ]
    assert couples.rows[0][1] == "horizontal"
    second = [cell.value for cell in couples.rows[0] if isinstance(cell, Number)]
    assert second[0] == foundations[0].before.couple_of_x_forces.amplitude_Nm
    words = [block.text for block in chapter.blocks if isinstance(block, Paragraph)]
    left_out = max(
        foundation.after.force_x.amplitude_N for foundation in foundations[4:] if foundation.after is not None
    )
    assert any(text.startswith(f"Forces that are not listed are at most {digits(left_out)} N") for text in words)


def test_the_table_is_csv_of_numbers_by_rest_and_on_the_command_line() -> None:
    request, answer = _solved()
    with TestClient(create_app(Settings(), warm=False)) as client:
        response = client.post("/v1/tables/foundation_loads", json=request.model_dump(mode="json"))
    assert response.status_code == 200
    assert response.headers["content-type"] == "text/csv; charset=utf-8; header=present"
    heads, *lines = csv.reader(io.StringIO(response.text))
    assert len(lines) == 24
    row = dict(zip(heads, lines[2], strict=True))
    assert row["load"] == "horizontal couple"
    assert answer.foundation_loads is not None
    built = answer.foundation_loads[0].as_built
    assert built is not None
    # analytic: both units of one amplitude
    assert float(row["as built, N or N m"]) == built.couple_of_x_forces.amplitude_Nm
    assert float(row["as built, kN or kN m"]) == built.couple_of_x_forces.amplitude_Nm / 1e3
    ran = CliRunner().invoke(app, ["table", "foundation_loads", "-"], input=request.model_dump_json())
    assert ran.exit_code == 0
    assert ran.stdout.splitlines() == response.text.splitlines()
    assert CliRunner().invoke(app, ["table", "none", "-"], input="{}").exit_code == 2


def test_the_workbook_has_a_sheet_of_numbers_that_is_read_back_as_nothing_of_the_machine() -> None:
    request, answer = _solved()
    sheets = workbook_sheets(answered(request, answer))
    heads, *lines = sheets[FOUNDATION]
    assert len(lines) == 24
    assert all(isinstance(cell, int | float) for line in lines for cell in (line[0], *line[2:]))
    place = heads.index("as built, N or N m")
    assert answer.foundation_loads is not None
    built = answer.foundation_loads[0].as_built
    assert built is not None
    assert lines[2][place] == built.couple_of_x_forces.amplitude_Nm
    assert lines[2][place + 1] == built.couple_of_x_forces.amplitude_Nm / 1e3
    assert not [line for line in sheets["answer"] if str(line[0]).startswith(FOUNDATION)]
    assert OptimizeRequest.model_validate(read(sheets).body) == request
