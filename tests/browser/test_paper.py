"""On a phone no column is cut off; on paper nothing lies over anything else; what is wrong is said where the eye is."""

import io
import unicodedata

import pytest
from playwright.sync_api import expect
from pypdf import PdfReader

from tests.browser.portal import Look, Portal

PANELS = ("counterweights", "what-if", "cranks", "hodographs", "orders", "main-bearings")
#: in the page: as wide as a sheet without the window having another size, then pairs of texts that overlap
_OVER = """() => {
  document.documentElement.style.width = "700px";
  dispatchEvent(new Event("beforeprint"));
  const walker = document.createTreeWalker(document.getElementById("results"), NodeFilter.SHOW_TEXT);
  const found = [];
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const around = node.parentElement;
    if (!node.data.trim() || !around.checkVisibility() || around.closest("title, option")) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    for (const { left, right, top, bottom } of range.getClientRects()) {
      found.push({ text: node.data.trim(), left, right, top, bottom });
    }
  }
  const over = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 2
    && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 4;
  const wide = found.filter((one) => one.right > 702).map((one) => one.text);
  const pairs = found.flatMap((one, i) => found.slice(i + 1).filter((other) => over(one, other))
    .map((other) => [one.text, other.text]));
  return [found.length, pairs, wide];
}"""


@pytest.mark.parametrize("options", [Look(390)])
def test_no_column_is_cut_off_on_a_phone(portal: Portal) -> None:
    portal.open("2d12", PANELS)
    tables = portal.page.locator("#results .wide")
    assert tables.count() > 5
    cut = tables.evaluate_all(
        "all => all.filter((one) => one.scrollWidth > one.clientWidth + 1).map((one) => one.ariaLabel)"
    )
    assert cut == []
    # what is typed into stands in labelled cards, as wide as the page
    portal.unfold("/machine", "/machine/throws", "/machine/webs")
    typed = portal.page.locator("#form .grid .wide")
    assert typed.evaluate_all("all => all.filter((one) => one.scrollWidth > one.clientWidth + 1).length") == 0
    cell = typed.first.locator("td").nth(1)
    assert cell.evaluate("one => getComputedStyle(one, '::before').content") == '"position, m"'
    assert (cell.locator("input").bounding_box() or {})["width"] > 120
    # heads stand beside their figures
    first = portal.page.locator("#answer table.cards td").first
    assert first.evaluate("one => getComputedStyle(one, '::before').content") == '"mass, kg"'


def test_nothing_overlaps_on_paper(visit: Portal) -> None:
    portal = visit
    portal.open("2d12", PANELS)
    portal.page.emulate_media(media="print")
    count, pairs, wide = portal.page.evaluate(_OVER)
    assert count > 100
    assert (pairs, wide) == ([], [])
    pages = PdfReader(io.BytesIO(portal.page.pdf(format="A4"))).pages
    # ligatures are read as their letters
    text = unicodedata.normalize("NFKC", "".join(page.extract_text() for page in pages))
    for words in ("Counterweights to fit", "232.7 kg", "couple of the x forces, N m", "Balance rates"):
        assert words in text
    # what was not opened, and what can only be clicked, is not printed
    for words in ("Optimise", "Copy as curl", "Accuracy against time"):
        assert words not in text


def test_what_is_wrong_is_said_above_the_button_and_beside_it(portal: Portal) -> None:
    portal.refusals = {422}
    portal.open("2d12")
    portal.input("/machine/speed_rpm").fill("-1")
    portal.input("/machine/throws/0/crank_radius_m").fill("3 kg")
    portal.page.click("#optimise")
    expect(portal.page.locator("#progress")).to_have_text("Not computed: 2 fields are wrong.")
    element = portal.page.locator("#trouble")
    assert element.is_visible()
    assert element.inner_text().startswith("speed: must be")
    portal.input("/machine/speed_rpm").fill("500")
    portal.input("/machine/throws/0/crank_radius_m").fill("140 mm")
    portal.optimise()
    expect(element).to_have_text("")
    expect(portal.page.locator("#progress")).to_contain_text("Answered")


def test_what_has_no_ceiling_is_not_named_where_another_cannot_be_met(portal: Portal) -> None:
    portal.open("2d12")
    portal.unfold("/objective")
    portal.input("/objective/moment_ceiling_Nm").fill("1")
    portal.optimise()
    words = portal.page.locator(".proof").inner_text()
    assert "cannot be met" in words
    assert "– N" not in words


@pytest.mark.parametrize("theme", ["system", "chosen"])
def test_paper_is_light_whatever_the_screen_is(visit: Portal, theme: str) -> None:
    """In the colours of a dark screen nobody could read what is printed."""
    portal = visit
    portal.page.emulate_media(color_scheme="dark" if theme == "system" else "light")
    portal.open("2d12", ("hodographs",))
    if theme == "chosen":
        portal.page.evaluate("document.documentElement.dataset.theme = 'dark'")
    ink = "() => getComputedStyle(document.documentElement).getPropertyValue('--ink').trim()"
    title = "() => document.querySelector('#panel-hodographs .xtitle').style.fill"
    dark = portal.page.evaluate(ink)
    portal.page.evaluate("dispatchEvent(new Event('beforeprint'))")
    light = portal.page.evaluate(ink)
    assert (dark, light) == ("#e8ecf0", "#1a1f25")
    assert portal.page.evaluate(title) == "rgb(26, 31, 37)"
    portal.page.evaluate("dispatchEvent(new Event('afterprint'))")
    assert portal.page.evaluate(ink) == dark
    expect(portal.page.locator("#panel-hodographs .xtitle").first).to_have_css("fill", "rgb(232, 236, 240)")
