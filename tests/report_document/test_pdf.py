"""The document as PDF, read again by another library."""

import io
import json
import re
from collections.abc import Callable
from functools import cache

import pytest
from pypdf import PdfReader

from service.report.blocks import Document
from service.report.document import report
from service.report.pdf import pdf
from tests.night import part
from tests.report_document.conftest import AT, MARKUP, request_of

Make = Callable[..., Document]

#: A4 in points, ISO 216
_A4 = (595.28, 841.89)


def read(content: bytes) -> tuple[PdfReader, str]:
    """The reader, and all text with blanks taken out, which lines and columns put anywhere."""
    reader = PdfReader(io.BytesIO(content))
    text = "".join(page.extract_text() for page in reader.pages)
    return reader, re.sub(r"\s|\u200b", "", text)


@cache
def filed(example: str) -> tuple[Document, PdfReader, str]:
    document = report(request_of(example), AT)
    return document, *read(pdf(document))


@pytest.fixture(scope="module")
def of_names(hostile: Document) -> tuple[PdfReader, str]:
    return read(pdf(hostile))


@pytest.mark.parametrize("example", part(3, ["2d12", "v8-cross-plane", "scroll-three-pins"]))
def test_pages_are_a4_tagged_and_numbered(example: str) -> None:
    document, reader, text = filed(example)
    assert {(round(float(page.mediabox.width)), round(float(page.mediabox.height))) for page in reader.pages} == {
        (round(_A4[0]), round(_A4[1]))
    }
    assert reader.metadata is not None
    assert reader.metadata.title == document.title
    root = reader.root_object
    assert root["/MarkInfo"]["/Marked"]
    assert root["/Lang"] == "en"
    assert f"{len(reader.pages)}/{len(reader.pages)}" in text
    assert len(reader.pages) <= 8


def test_it_says_what_was_found() -> None:
    _, _, text = filed("2d12")
    # regression: as in the answer, to six digits
    for figure in ("10006.1", "5003.07", "48734.5", "20298.4", "19516.5", "52.7004"):
        assert figure in text
    assert "noneweighlessthan232.699kgtogether" in text


def test_the_request_is_attached(composer: Make) -> None:
    reader = PdfReader(io.BytesIO(pdf(composer("v60", outputs=["orders"]))))
    ((content,),) = [reader.attachments[name] for name in reader.attachments]
    assert json.loads(content) == request_of("v60", outputs=["orders"]).alone.model_dump(mode="json")
    assert list(reader.attachments) == ["request.json"]


def test_names_that_are_markup_are_names(hostile: Document, of_names: tuple[PdfReader, str]) -> None:
    reader, text = of_names
    assert text.count(re.sub(r"\s", "", MARKUP)) > 5
    assert reader.metadata is not None
    assert reader.metadata.title == MARKUP
    # the list of contents leads to its chapters; no name leads anywhere
    links = [link.get_object() for page in reader.pages for link in page.get("/Annots", [])]
    assert len(links) == len(hostile.chapters)
    assert not [link for link in links if "/A" in link and link["/A"]["/S"] != "/GoTo"]


def test_it_does_nothing_by_itself(of_names: tuple[PdfReader, str]) -> None:
    reader, _ = of_names
    assert not {"/OpenAction", "/AA", "/AcroForm"} & set(reader.root_object)
    assert "/JavaScript" not in reader.root_object.get("/Names", {})


def test_the_same_document_is_the_same_file(composer: Make) -> None:
    assert pdf(composer("v60")) == pdf(composer("v60"))
