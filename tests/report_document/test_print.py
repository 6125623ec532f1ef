"""The page in a browser: printed on A4, read by machines that help, narrow."""

import io
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page, sync_playwright
from pypdf import PdfReader

from service.report.blocks import Document
from service.report.html import html
from tests.browser import chromium
from tests.night import part

Make = Callable[..., Document]


#: rows of tables that are made as those before
_ALIKE = "tbody tr:nth-child(n + 5)"


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    path = chromium.find()
    if path is None:
        pytest.skip(chromium.MISSING)
    with sync_playwright() as playwright:
        actual_browser = playwright.chromium.launch(
            executable_path=path, args=["--no-sandbox", "--disable-dev-shm-usage"]
        )
        yield actual_browser
        actual_browser.close()


@pytest.fixture
def opened(browser: Browser, composer: Make, tmp_path: Path) -> Iterator[Callable[..., Page]]:
    """Open the report on an example from a file; nothing must be complained about and nothing else be asked for."""
    texts: list[str] = []
    pages: list[Page] = []

    def open_(example: str, width: int, **changes: Any) -> Page:
        file = tmp_path / "report.html"
        file.write_bytes(html(composer(example, **changes)))
        page = browser.new_page(viewport={"width": width, "height": 900})
        pages.append(page)
        page.on("console", lambda message: texts.append(message.text))
        page.on("request", lambda request: texts.append(request.url) if request.url != file.as_uri() else None)
        page.goto(file.as_uri())
        return page

    yield open_
    for page in pages:
        page.close()
    assert texts == []


@pytest.mark.parametrize("example", part(2, ["v8-cross-plane", "scroll-three-pins"]))
def test_it_prints_on_a4_and_light(opened: Callable[..., Page], example: str) -> None:
    page = opened(example, 1280)
    printed = PdfReader(io.BytesIO(page.pdf(prefer_css_page_size=True)))
    sizes = {(round(float(sheet.mediabox.width)), round(float(sheet.mediabox.height))) for sheet in printed.pages}
    # ISO 216 in points, to what a browser rounds
    assert sizes == {(595, 842)}
    assert 4 <= len(printed.pages) <= 10
    # what is printed is all there, and light whatever the screen is
    assert "Appendix: request" in "".join(sheet.extract_text() for sheet in printed.pages)
    page.emulate_media(media="print", color_scheme="dark")
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"


# colours are looked at once, which is half of the time: they are the same at every width
@pytest.mark.parametrize(("width", "contrast"), part(2, [(390, False), (1280, True)], rows=True))
def test_nothing_keeps_anybody_from_reading_it(opened: Callable[..., Page], width: int, contrast: bool) -> None:
    page = opened("2d12", width, outputs=["torque", "main_bearings"])
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    options = {"resultTypes": ["violations"], "rules": {"color-contrast": {"enabled": contrast}}}
    assert page.locator(_ALIKE).count() > 0
    assert Axe().run(page, {"exclude": [_ALIKE]}, options).response["violations"] == []
