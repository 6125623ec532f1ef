"""What a design office needs of a document: a head, the order of its pages, and a name for its file."""

import io
import re
from functools import cache
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pypdf import PdfReader
from starlette.testclient import TestClient

from service.app import create_app
from service.http.file_names import file_name
from service.report.blocks import Document
from service.report.document import report
from service.report.html import html
from service.report.pdf import pdf
from service.settings import Settings
from tests.night import part
from tests.report_document.conftest import AT, MARKUP, request_of

HEAD = {
    "project": "Nitrogen plant",
    "number": "K-1047",
    "revision": "B",
    "drawing": "D-2212",
    "author": "M. Weber",
    "checker": "A. Okafor",
    "notes": "For approval.\n\nSupersedes revision A.",
}


def pages(content: bytes) -> list[str]:
    return [re.sub(r"\s|\u200b", "", page.extract_text()) for page in PdfReader(io.BytesIO(content)).pages]


@cache
def filed(example: str) -> tuple[Document, bytes]:
    """A document with the head, and its file."""
    document = report(request_of(example, document=HEAD), AT)
    return document, pdf(document)


def test_the_head_says_what_the_request_gives() -> None:
    document, content = filed("2d12")
    assert dict(document.head.rows[:6]) == {name: value for name, value in HEAD.items() if name != "notes"}
    assert document.notes == ("For approval.", "Supersedes revision A.")
    page = html(document).decode()
    first, *_ = pages(content)
    for text in HEAD.values():
        for line in filter(None, text.splitlines()):
            assert line in page
            assert line.replace(" ", "") in first


def test_what_is_not_given_leaves_no_gap() -> None:
    document = report(request_of("2d12", document={"revision": "B"}), AT)
    assert [row[0] for row in document.head.rows[:2]] == ["revision", "status"]
    assert document.notes == ()


def test_names_of_the_head_are_names() -> None:
    document = report(request_of("2d12", document=dict.fromkeys(("project", "author", "notes"), MARKUP)), AT)
    assert "<script>x" not in html(document).decode()
    assert "".join(pages(pdf(document))).count(re.sub(r"\s", "", MARKUP)) >= 3


@pytest.mark.parametrize("example", part(2, ["2d12", "v8-cross-plane"]))
def test_verdict_and_counterweights_are_on_the_first_page_and_the_contents_follow(example: str) -> None:
    document, content = filed(example)
    actual_pages = pages(content)
    assert "1Result" in actual_pages[0]
    assert "2Counterweights" in actual_pages[0]
    (contents,) = [page for page in actual_pages if "Contents1Result" in page]
    assert contents in actual_pages[:2]
    bodies = [re.sub(r"\d{4}-\d\d-\d\dT[0-9:]+Z\d+/\d+$", "", page) for page in actual_pages]
    for number, chapter in enumerate(document.chapters, start=1):
        heading = f"{number}{chapter.title}".replace(" ", "")
        assert f"{heading}..." in contents
        # no heading is the last thing on its page
        assert not any(body.endswith(heading) for body in bodies)


def test_no_page_is_half_empty() -> None:
    reader = PdfReader(io.BytesIO(filed("2d12")[1]))
    lowest = []
    for page in reader.pages:
        heights: list[float] = []

        def seen(text: str, page: Any, line: Any, *_: Any, heights: list[float] = heights) -> None:
            height = line[4] * page[1] + line[5] * page[3] + page[5]
            # above the foot of the page
            if text.strip() and height > 60:
                heights.append(height)

        page.extract_text(visitor_text=seen)
        lowest.append(min(heights))
    # points from below; half of the page is at 421
    assert max(lowest[:-1]) < 421


def test_it_is_filed_after_machine_number_and_revision() -> None:
    with TestClient(create_app(Settings(), warm=False)) as client:
        body = request_of("2d12", document=HEAD).model_dump(mode="json")
        response = client.post("/v1/report", json=body, headers={"Accept": "application/pdf"})
        assert response.headers["content-disposition"] == 'inline; filename="2D12-90-2-20 K-1047 B.pdf"'
        body["machine"]["name"] = "Kältemaschine 冷/../x\"; filename*=UTF-8''evil"
        text = client.post("/v1/report", json=body).headers["content-disposition"]
        assert text.startswith('inline; filename="K')
        assert text.count("filename*=") == 1
        wrong = client.post("/v1/report", json={**body, "document": {"revision": "x" * 121}})
        assert (wrong.status_code, wrong.json()["errors"][0]["pointer"]) == (422, "/document/revision")


@given(st.text())
def test_no_text_makes_a_header_or_a_path_of_a_name(stem: str) -> None:
    name = file_name(stem, ".pdf")
    assert re.fullmatch(r"filename=\"[A-Za-z0-9_ .()+,=@-]+\.pdf\"(; filename\*=UTF-8''[A-Za-z0-9_.~%-]+)?", name)
