"""Weighed parts on the page: typed and pasted, matched with the figures of the API, errors in their cells."""

import pytest
from playwright.sync_api import Locator, expect

from tests.browser.portal import POLLING_MS, Look, Portal, ask, cells, number
from tests.browser.test_accessibility import serious

_PASTED = """kind\tname\tmass (g)
crosshead\tK1\t90700
crosshead\tK2\t89600
balance nut\tlong\t24500
balance nut\tshort\t8000
"""


def pasted(panel: Locator, text: str, cell: str = "#match-kind-0") -> None:
    panel.locator(cell).evaluate(
        """(input, text) => {
            const clipboardData = new DataTransfer();
            clipboardData.setData("text/plain", text);
            input.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true, cancelable: true }));
        }""",
        text,
    )


def match(panel: Locator) -> None:
    panel.get_by_role("button", name="Match the parts").click()


def test_pasted_parts_are_matched(portal: Portal, url: str) -> None:
    portal.open("2d12", ("match",))
    panel = portal.panel("match")
    pasted(panel, _PASTED)
    match(panel)
    panel.locator(".proof").wait_for()
    panel.locator("#match-weights").select_option("none")
    match(panel)
    panel.locator(".proof").get_by_text("Certified: ").wait_for()
    fitted, body = portal.bodies("/v1/match")
    assert [counterweight["web"] for counterweight in fitted["counterweights"]] == ["1a", "1b", "2a", "2b"]
    assert body["counterweights"] == []
    assert body["parts"] == [{"class": "crosshead", "names": ["K1", "K2"], "masses_kg": ["90700 g", "89600 g"]}]
    assert body["balance_nuts_kg"] == ["24500 g", "8000 g"]
    # analytic: the mean of the crossheads, 90.15 kg, comes off 277.79 and 251.72 kg
    masses = [throw["rows"][0]["reciprocating_mass_kg"] for throw in body["machine"]["throws"]]
    assert masses == pytest.approx([187.64, 161.57])
    answer = ask(url, "/v1/match", body)["residual"]
    tables = panel.locator(".result table")
    parts, (force, moment) = cells(tables.nth(0)), cells(tables.nth(1))
    assert [row[0] for row in parts] == ["1 I", "2 II"]
    # analytic: of 26 kg between the rows the nut of 24.5 kg on the lighter one takes most
    assert parts[1][2] == "long (24.5 kg)"
    assert panel.get_by_text("Left over: short (8 kg).").is_visible()
    for row, (of, peak) in ((force, ("force", "peak_N")), (moment, ("moment", "peak_Nm"))):
        numbers = [number(text) for text in row[1:3]]
        assert numbers == pytest.approx([answer[when][of][peak] for when in ("before", "after")], rel=1e-4)
    assert force[3].startswith("−")
    portal.screenshot("match-1280")


def test_what_is_wrong_stands_in_its_cell(portal: Portal) -> None:
    portal.refusals.add(422)
    portal.open("2d12", ("match",))
    panel = portal.panel("match")
    match(panel)
    # as many lines as rows, to be weighed
    expect(panel.locator("#match-mass-0-error")).to_have_text("weigh it")
    panel.locator("#match-mass-0").fill("90,7")
    panel.locator("#match-mass-1").fill("heavy")
    panel.locator("#match-name-1").fill("K1")
    match(panel)
    expect(panel.locator("#match-mass-1-error")).to_contain_text("must be a number in kg")
    assert panel.locator("#match-mass-1").get_attribute("aria-invalid") == "true"
    assert panel.locator("#match-mass-0").get_attribute("aria-invalid") is None
    panel.locator("#match-mass-1").fill("89.6")
    match(panel)
    expect(panel.locator("#match-name-1-error")).to_contain_text("named already")
    panel.locator("#match-name-1").fill("K2")
    panel.locator("#match-rows-1").fill("2 II, 3 III")
    match(panel)
    expect(panel.locator("#match-rows-1-error")).to_contain_text("no row is called 3 III; there are 1 I, 2 II")
    panel.locator("#match-rows-1").fill("1 I")
    match(panel)
    expect(panel.locator("#match-name-0-error")).to_contain_text("there is 1 row for 2 parts")


@pytest.mark.parametrize("options", [Look(390, "dark")])
def test_chosen_counterweights_on_a_phone_and_after_a_reload(portal: Portal) -> None:
    portal.open("2d12", ("match",))
    panel = portal.panel("match")
    pasted(panel, "K1\t90.7\nK2\t89.6", "#match-name-0")
    panel.locator("#match-weights").select_option("chosen")
    match(panel)
    panel.locator(".proof.optimal").wait_for()
    assert portal.bodies("/v1/match")[0]["choose_counterweights"] is True
    # all else of such a page is looked at in tests/browser/test_accessibility.py
    assert serious(portal, "#panel-match") == []
    assert portal.page.evaluate("document.documentElement.scrollWidth") <= 390
    portal.screenshot("match-390")
    # the link is written a moment after the last key stroke
    portal.page.wait_for_function(
        "location.hash.includes('89.6') && location.hash.includes('chosen')", polling=POLLING_MS
    )
    portal.page.reload()
    portal.drawn(1)
    expect(portal.panel("match").locator("#match-mass-1")).to_have_value("89.6")
    expect(portal.panel("match").locator("#match-weights")).to_have_value("chosen")
