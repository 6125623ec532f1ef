"""The document as one HTML page."""

import re
from collections.abc import Callable
from dataclasses import replace
from html.parser import HTMLParser
from xml.etree import ElementTree

import pytest

from service.report.blocks import Document
from service.report.html import html
from tests.report_document.conftest import MARKUP

Make = Callable[..., Document]

_VOID = {"meta", "br", "img", "link", "input", "hr"}


class Page(HTMLParser):
    """A page that has been read: its elements with their attributes, and its text."""

    def __init__(self, content: bytes) -> None:
        super().__init__()
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.text = ""
        self._open: list[str] = []
        self.feed(content.decode())
        self.close()
        assert not self._open

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))
        if tag not in _VOID:
            self._open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        assert self._open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text += data


@pytest.fixture(scope="module")
def page(composer: Make) -> Page:
    return Page(html(composer("2d12", outputs=["torque", "orders"])))


def test_nothing_comes_from_outside_and_nothing_runs(page: Page) -> None:
    assert not {"script", "img", "link", "iframe", "object", "embed", "form", "base"} & {
        tag for tag, _ in page.elements
    }
    for tag, attributes in page.elements:
        assert not any(name.startswith("on") or name in ("src", "srcdoc", "style") for name in attributes), tag
        assert (attributes.get("href") or "#").startswith("#")
        # the name of the language of the drawings is an address that nobody visits
        assert not any("//" in (value or "") for name, value in attributes.items() if name != "xmlns")


def test_the_styles_load_nothing(composer: Make) -> None:
    styles = re.findall(rb"<style>(.*?)</style>", html(composer("2d12")), re.DOTALL)
    assert len(styles) == 1
    assert b"url(" not in styles[0]
    assert b"@import" not in styles[0]


def test_the_policy_forbids_what_is_not_there(page: Page) -> None:
    policies = [fields for tag, fields in page.elements if fields.get("http-equiv") == "Content-Security-Policy"]
    assert [policy["content"] for policy in policies] == [
        "default-src 'none'; img-src data:; style-src 'unsafe-inline'"
    ]


def test_whoever_cannot_see_it_is_told_what_is_what(page: Page) -> None:
    assert ("html", {"lang": "en"}) in page.elements
    drawings = [attributes for tag, attributes in page.elements if tag == "svg"]
    # four of machine and first order, the stages, the torque: higher orders of horizontal rows act along x alone, and
    # straight lines are not drawn
    assert len(drawings) == 6
    assert all(drawing["role"] == "img" and drawing["aria-label"] for drawing in drawings)
    assert all(fields["scope"] in ("col", "row") for tag, fields in page.elements if tag == "th")
    assert [tag for tag, _ in page.elements if re.fullmatch("h[1-6]", tag)][:2] == ["h1", "h2"]
    chapters = [fields["href"] for tag, fields in page.elements if tag == "a"]
    assert chapters == [f"#{fields['id']}" for tag, fields in page.elements if tag == "section"]


def test_figures_are_there_to_all_their_digits(composer: Make) -> None:
    answered = [fields for tag, fields in Page(html(composer("2d12"))).elements if tag == "data"]
    assert any(float(fields["value"] or "") == pytest.approx(5003.068, rel=1e-6) for fields in answered)


def test_a_minus_is_one_where_it_is_read_and_a_hyphen_where_it_is_computed_with(composer: Make) -> None:
    # throw 2 of the 2D12 stands at -0.175 m
    content = html(composer("2d12")).decode()
    assert '<data value="-0.175">\N{MINUS SIGN}0.175</data>' in content
    assert not re.search(r"<data[^>]*>[^<]*-", content)


def test_numbers_stand_below_their_heading(composer: Make) -> None:
    """On the right, both of them: also in a first column, which names its row."""
    rows: list[list[dict[str, str | None]]] = []
    first = []
    for tag, attributes in Page(html(composer("catalogue-twin"))).elements:
        if tag == "table":
            rows = []
        elif tag == "tr":
            rows.append([])
        elif tag in ("th", "td"):
            rows[-1].append(attributes)
            if len(rows) > 1 and rows[0][0].get("scope") == "col":
                heading = rows[0][len(rows[-1]) - 1]
                assert heading.get("class") == attributes.get("class")
                first += [attributes] if len(rows[-1]) == 1 and attributes.get("class") == "n" else []
    assert first


def test_names_that_are_markup_are_names(hostile: Document) -> None:
    content = html(hostile)
    page = Page(content)
    assert b"<script" not in content
    assert b"<b>" not in content
    assert "49" not in re.findall(r"_z_ (.*)", page.text)[0]
    assert page.text.count(MARKUP) > 10
    # in drawings names are cut
    assert any(MARKUP[:17] in "".join(drawing.itertext()) for drawing in drawings(content))


def test_characters_that_do_not_print_are_replaced(composer: Make) -> None:
    # the schema refuses these already; what is not the schema's matter is still safe
    machine = composer("2d12")
    spoiled = replace(machine, title="a\u202eb\x00")
    assert "a\ufffdb\ufffd" in html(spoiled).decode()


def test_every_drawing_is_well_formed_by_itself(hostile: Document) -> None:
    actual_drawings = drawings(html(hostile))
    assert len(actual_drawings) == 13
    shapes = {child.tag.rpartition("}")[2] for drawing in actual_drawings for child in drawing}
    assert shapes == {"path", "circle", "text", "g"}


def drawings(content: bytes) -> list[ElementTree.Element]:
    return [ElementTree.fromstring(match) for match in re.findall(rb"<svg.*?</svg>", content, re.DOTALL)]


def test_the_same_document_is_the_same_page(composer: Make) -> None:
    assert html(composer("v60")) == html(composer("v60"))
