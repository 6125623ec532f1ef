"""The sheets of the counterweights that are cut from plates."""

import json
from pathlib import Path

from schemas.request.report import ReportRequest
from service.report.blocks import Figure
from service.report.document import report
from service.report.html import html
from service.report.pdf import pdf
from tests.report_document.conftest import AT, request_of


def test_every_part_has_a_sheet() -> None:
    body = json.loads(Path("examples/drawings/2d12-plates.json").read_text())
    document = report(ReportRequest.model_validate(body), AT)
    (chapter,) = [section for section in document.chapters if section.title == "Workshop sheets"]
    sheets = [block for block in chapter.blocks if isinstance(block, Figure)]
    text = "".join(sheet.drawings[0].svg() for sheet in sheets)
    for web in ("1a", "1b", "2a", "2b"):
        assert f"{web}: plane z = " in text
    assert html(document).decode().count("dimensions in mm") == len(sheets)
    assert pdf(document).startswith(b"%PDF-")


def test_without_plates_there_are_none() -> None:
    assert "Workshop sheets" not in [chapter.title for chapter in report(request_of("2d12"), AT).chapters]
