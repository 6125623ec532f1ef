"""Loads on the foundation in the report's blocks and in the workbook: numbers in cells of their own."""

from optimizer.optimize import optimize
from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import OptimizeRequest
from service.documents.examples import bodies
from service.report.blocks import Number, Paragraph, Table
from service.report.chapters.foundation import foundation_loads
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
    found = answer.foundation_loads
    assert found is not None
    chapter = foundation_loads(found)
    forces, couples = (block for block in chapter.blocks if isinstance(block, Table))
    assert [row[0] for row in forces.rows] == ["1", "1", "2", "2", "4", "4", "6", "6"]
    assert "as built, N" in [column.title for column in forces.columns]
    built = found[0].as_built
    assert found[0].after is not None
    assert built is not None
    first = [cell.value for cell in forces.rows[0] if isinstance(cell, Number)]
    sets = (found[0].before, found[0].after, built)
    assert first == [value for one in sets for value in (one.force_x.amplitude_N, one.force_x.phase_deg)]
    second = [cell.value for cell in couples.rows[3] if isinstance(cell, Number)]
    assert second[0] == found[1].before.couple_of_y_forces.amplitude_Nm
    words = " ".join(block.text for block in chapter.blocks if isinstance(block, Paragraph))
    assert "Nothing of order 3, 5 loads the foundation." in words


def test_the_workbook_has_a_sheet_of_numbers_that_is_read_back_as_nothing_of_the_machine() -> None:
    request, answer = _solved()
    sheets = workbook_sheets(answered(request, answer))
    heads, *lines = sheets[FOUNDATION]
    assert len(lines) == 6
    assert all(isinstance(cell, int | float) for line in lines for cell in line)
    place = heads.index("as_built.couple_of_x_forces.amplitude_Nm")
    assert answer.foundation_loads is not None
    built = answer.foundation_loads[0].as_built
    assert built is not None
    assert lines[0][place] == built.couple_of_x_forces.amplitude_Nm
    assert not [line for line in sheets["answer"] if str(line[0]).startswith(FOUNDATION)]
    assert OptimizeRequest.model_validate(read(sheets).body) == request
