"""What a company files: title block, logo, revisions, the order of the first page, and how many pages there are."""

import base64
import io
import re
import struct
import zlib

import pytest
from pydantic import ValidationError
from pypdf import PdfReader

from schemas.base.images import png
from service.common.figures import typeset
from service.report.blocks import Table
from service.report.document import report
from service.report.html import html
from service.report.pdf import pdf
from tests.report_document.conftest import AT, request_of
from tests.report_document.test_as_built import FITTED


def part(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def image(width: int = 6, height: int = 4, lines: int = 4, filtered: int = 0) -> str:
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    pixels = zlib.compress(b"".join(bytes([filtered]) + b"\x10\x40\x90" * width for _ in range(lines)))
    note = part(b"tEXt", b"Comment\0<script>")
    content = b"\x89PNG\r\n\x1a\n" + part(b"IHDR", head) + note + part(b"IDAT", pixels) + part(b"IEND", b"")
    return "data:image/png;base64," + base64.b64encode(content).decode()


HEAD = {
    "company": "Weber Compressors",
    "customer": "Nordic Air",
    "number": "K-1047",
    "approver": "L. Berg",
    "date": "2026-11-24",
    "logo": image(),
    "revisions": [{"revision": "B", "date": "2026-11-24", "change": "counterweights as cast", "author": "M. Weber"}],
}


def pages(content: bytes) -> list[str]:
    return [re.sub(r"\s|\u200b", "", page.extract_text()) for page in PdfReader(io.BytesIO(content)).pages]


def test_the_first_page_is_title_block_decision_and_foundation() -> None:
    document = report(request_of("2d12", document=HEAD, fitted=FITTED), AT)
    first, *_ = actual_pages = pages(pdf(document))
    for words in ("WeberCompressors", "NordicAir", "L.Berg", "24November2026", "counterweightsascast"):
        assert words in first
    order = [
        first.index(words) for words in ("1Result", "Decision", "2Counterweights", "3Loadsonthefoundation", "Couples")
    ]
    assert order == sorted(order)
    # an ordinary machine
    assert len(actual_pages) <= 8
    assert "digestoftherequest" in actual_pages[-1]
    assert "digestoftherequest" not in first
    page = html(document).decode()
    assert 'src="data:image/png;base64,' in page
    assert "M. Weber" in page


def test_a_logo_is_its_pixels_alone() -> None:
    actual_png = png(image())
    assert b"tEXt" not in actual_png
    # analytic: six pixels of three bytes and a filter, four lines
    data = actual_png[actual_png.index(b"IDAT") + 4 : -16]
    assert len(zlib.decompress(data)) == 4 * (1 + 18)


@pytest.mark.parametrize(
    "logo",
    [
        "data:image/svg+xml;base64,PHN2Zy8+",
        "data:image/png;base64,%%%",
        "data:image/png;base64,AAAA",
        image()[:-8],
        image(width=2001, height=1, lines=1),
        image(lines=3),
        image(lines=5),
        image(filtered=9),
    ],
)
def test_what_is_no_picture_is_refused_at_its_field(logo: str) -> None:
    with pytest.raises(ValidationError) as refused:
        request_of("2d12", document={"logo": logo})
    assert refused.value.errors()[0]["loc"] == ("document", "logo")


@pytest.mark.parametrize("date", ["2026-02-30", "24.11.2026", "2026-1-1"])
def test_a_day_is_one_of_the_calendar(date: str) -> None:
    with pytest.raises(ValidationError):
        request_of("2d12", document={"date": date})


@pytest.mark.parametrize(
    ("figure", "printed"),
    [
        ("5003.07", "5\u202f003.07"),
        ("-1234567", "\u22121\u202f234\u202f567"),
        ("999.123456", "999.123456"),
        ("4.44685e-05", "4.44685e\u221205"),
        ("0.25", "0.25"),
    ],
)
def test_thousands_are_set_apart(figure: str, printed: str) -> None:
    assert typeset(figure) == printed


def test_rod_loads_without_gas_are_named_so() -> None:
    machine = request_of("2d12").machine.model_dump(mode="json", exclude_none=True)
    for throw in machine["throws"]:
        throw["rows"][0].pop("cylinder")
    machine.pop("friction")
    document = report(request_of("2d12", machine=machine, outputs=["rod_loads"]), AT)
    (chapter,) = [section for section in document.chapters if section.title == "Rod loads"]
    (cases,) = [
        block for block in chapter.blocks if isinstance(block, Table) and block.title == "Rod force by load case"
    ]
    assert [row[1] for row in cases.rows] == ["inertia only"] * 2
