"""Names that would reorder, hide or command what stands beside them, in everything that quotes them."""

import io
import json
import sys
import unicodedata
from datetime import UTC, datetime
from typing import Any

import openpyxl
import pytest
from typer.testing import CliRunner

from optimizer.optimize import optimize
from schemas.request.report import ReportRequest
from schemas.request.requests import OptimizeRequest
from service.cli import app
from service.common.plain import plain
from service.documents.examples import load
from service.http.file_names import file_name
from service.report.document import report
from service.report.html import html
from service.report.pictures import bearings, front, side, svg
from service.workbook.answers import answered

#: of format characters, those that scripts need: soft hyphens, breaks, joiners, signs that stand over numbers
_NEEDED = "\u00ad\u200b\u200c\u200d\u0600\u0601\u0602\u0603\u0604\u0605\u06dd\u070f\u0890\u0891\u08e2"
_DIRECTIONS = ("LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI")
#: a name that the schema takes
ODD = "a\u061c\u202e\u2066<b>\"'\x9b31m\ufeff;=1"
_PICTURES = {"front": front, "side": side, "bearings": bearings}
_HIDDEN = "\u061c\u202e\u2066\x9b\ufeff"


def test_what_is_plain_is_every_character_that_is_seen_or_needed() -> None:
    """Independent: the properties that Unicode gives them."""
    for code in range(sys.maxunicode + 1):
        character = chr(code)
        kind, stays = unicodedata.category(character), plain(character) == character
        if unicodedata.bidirectional(character) in _DIRECTIONS or character in "\u200e\u200f\u061c":
            assert not stays, hex(code)
        elif kind == "Cs" or code & 0xFFFE == 0xFFFE or 0xFDD0 <= code <= 0xFDEF:
            # no text holds these
            assert not stays, hex(code)
        elif kind == "Cc":
            assert stays == (character in "\t\n\r"), hex(code)
        elif kind == "Cf" and code < 0x10000:
            assert stays == (character in _NEEDED), hex(code)
        elif kind[0] in "LMNPS" or kind == "Zs":
            assert stays, hex(code)


def _body() -> dict[str, Any]:
    body: dict[str, Any] = json.loads(load("2d12"))
    machine = body["machine"]
    machine["name"] = machine["throws"][0]["name"] = machine["throws"][0]["rows"][0]["name"] = ODD
    machine["webs"][0]["name"] = machine["bearings"][0]["name"] = ODD
    return body


def _forms() -> dict[str, str]:
    """What is said of a machine with such names, by form."""
    body = _body()
    request = OptimizeRequest.model_validate(body)
    book = openpyxl.load_workbook(io.BytesIO(answered(request, optimize(request))))
    cells = [str(cell.value) for sheet in book for line in sheet.iter_rows() for cell in line]
    document = report(
        ReportRequest.model_validate({**body, "document": {"project": ODD, "notes": ODD}}), datetime.now(UTC)
    )
    terminal = CliRunner().invoke(app, ["optimize", "-"], input=json.dumps(body).encode())
    assert terminal.exit_code == 0
    return {
        "page": html(document).decode(),
        "workbook": "\n".join(cells),
        "terminal": terminal.stdout,
        **{name: svg(draw(request)).decode() for name, draw in _PICTURES.items()},
    }


def test_nothing_that_quotes_a_name_is_reordered_or_commanded_by_it() -> None:
    forms = _forms()
    assert [(form, hex(ord(words))) for form, text in forms.items() for words in _HIDDEN if words in text] == []
    # the name is there
    assert [form for form, text in forms.items() if "a\ufffd\ufffd\ufffd" not in text] == []
    # as a name
    assert [form for form, text in forms.items() if "<b>" in text] == ["workbook", "terminal"]


def test_a_message_that_quotes_a_file_commands_no_terminal() -> None:
    body = {**_body(), "\x1b]0;x\x07\r\x9b2J\u202e": 1}
    process = CliRunner().invoke(app, ["optimize", "-"], input=json.dumps(body).encode())
    assert process.exit_code == 2
    assert process.stderr == "/\ufffd]0;x\ufffd\ufffd\ufffd2J\ufffd: unknown field\n"


@pytest.mark.parametrize("form", ["NFC", "NFD"])
def test_a_letter_with_its_mark_stays_one_in_the_name_of_a_file(form: Any) -> None:
    name = file_name(unicodedata.normalize(form, "Kälte é"), ".pdf")
    assert name.endswith("filename*=UTF-8''K%C3%A4lte%20%C3%A9.pdf")
