"""Three engineers with a machine each: what they have to type and to click until they have what they came for.

With SCREENSHOTS=1 pictures of each are left in `artefacts/portal`: wide, narrow and dark, on paper. The report of the
first is there as a PDF.
"""

from typing import Any

import pytest
from playwright.sync_api import expect
from pypdf import PdfReader

from tests.browser.hand import Hand
from tests.browser.portal import ARTEFACTS, PICTURES, POLLING_MS, Portal, ask
from tests.browser.test_accessibility import serious
from tests.browser.test_gas import COLUMNS

#: axe takes seconds for the whole page of a trial: by day it looks at what no page of another test shows
whole = pytest.param(None, marks=pytest.mark.nightly, id="whole")


def _come(portal: Portal, within: str | None) -> Hand:
    """The first visit, with the panels that it opens where the whole page is looked at."""
    portal.page.goto(f"{portal.url}/" if within is None else f"{portal.url}/#open=counterweights")
    return Hand(portal)


def _look(portal: Portal, name: str, within: str | None = None) -> None:
    """Screenshots, and what axe finds in the page or in the elements of a selector: wide and light, narrow and dark."""
    wide = serious(portal, within)
    portal.screenshot(f"{name}-1280")
    portal.page.set_viewport_size({"width": 390, "height": 844})
    portal.page.emulate_media(color_scheme="dark")
    narrow = serious(portal, within)
    # nothing is wider than the window, once plots have the width that there is
    portal.page.wait_for_function("() => document.documentElement.scrollWidth <= 390", polling=POLLING_MS)
    portal.screenshot(f"{name}-390-dark")
    if PICTURES:
        portal.page.set_viewport_size({"width": 1280, "height": 900})
        portal.page.emulate_media(color_scheme="light", media="print")
        portal.screenshot(f"{name}-print")
    assert (wide, narrow) == ([], [])


def _begun(portal: Portal, hand: Hand) -> Any:
    """The request of the first answer."""
    hand.click(".starter button[value=begin]")
    portal.page.wait_for_selector("#results[data-drawn]")
    return portal.bodies("/v1/optimize")[-1]


@pytest.fixture
def portal(visit: Portal) -> Portal:
    """An engineer comes for the first time."""
    return visit


@pytest.mark.parametrize(
    "within", [pytest.param("#answer .document, #form [data-pointer='/machine/catalogue']", id="its own"), whole]
)
def test_a_compressor_becomes_a_filed_report_with_castings(portal: Portal, within: str | None) -> None:
    hand = _come(portal, within)
    hand.click("#new")
    hand.click(".starter input[value=opposed]")
    masses = {"reciprocating": "185; 190; 210; 205", "rotating": "55"}
    sizes = {"pitch": "600 mm", "stroke": "180 mm", "rod": "450 mm", "radius": "200 mm"}
    hand.answer({"throws": "4", "speed": "900"} | masses | sizes | {"most": "80"})
    _begun(portal, hand)
    hand.click("#form button:has-text('Add standard sizes')")
    sizes = {"masses_kg": "10; 20; 30; 40", "angle_step_deg": "90", "max_part_numbers": "2"}
    for name, value in sizes.items():
        hand.cell(f"/machine/catalogue/{name}", value)
    with portal.asking():
        hand.click("#optimise")
    # what gets worse is in the headline, although the whole gets better
    answer = ask(portal.url, "/v1/optimize", portal.bodies("/v1/optimize")[-1])
    couples = answer["residual"]
    before, after = (couples[when]["moment"]["peak_y_Nm"] for when in ("before", "after"))
    assert after > before
    headline = portal.page.locator("#answer h2").first
    expect(headline).to_contain_text(f"couple of the y forces +{100 * (after / before - 1):.2g} %")
    hand.click("#answer .document > summary")
    head = {"company": "Weber Compressors", "customer": "Nordic Air", "project": "Nitrogen", "number": "K-1047"}
    for name, value in (head | {"revision": "A", "author": "M. W.", "checker": "A. O.", "approver": "L. B."}).items():
        hand.fill(f"#document-{name}", value)
    with portal.page.expect_download() as download:
        hand.click("#answer .report button:has-text('PDF')")
    ARTEFACTS.mkdir(parents=True, exist_ok=True)
    download.value.save_as(ARTEFACTS / "trial-a.pdf")
    assert "K-1047" in download.value.suggested_filename
    # what is filed on an ordinary machine
    assert len(PdfReader(ARTEFACTS / "trial-a.pdf").pages) <= 9
    assert hand.fields <= 25
    assert hand.clicks <= 12
    body = portal.bodies("/v1/report")[-1]
    assert {"foundation_loads", "residual"} <= set(body["outputs"])
    assert body["document"]["approver"] == "L. B."
    masses_kg = {counterweight["mass_kg"] for counterweight in answer["counterweights"]}
    # analytic: castings of at most two of the four sizes
    assert len(masses_kg - {0}) <= 2
    assert masses_kg <= {0, 10, 20, 30, 40}
    _look(portal, "trial-a", within)


@pytest.mark.parametrize("within", [pytest.param("#form .gas", id="its own"), whole])
def test_a_v_six_gets_bearings_and_gas(portal: Portal, within: str | None) -> None:
    hand = _come(portal, within)
    hand.click("#new")
    hand.click(".starter input[value=v]")
    form = {"throws": "3", "angle": "60", "split": "60", "offset": "30 mm", "pitch": "110 mm", "stroke": "86 mm"}
    hand.answer(form | {"speed": "5500", "reciprocating": "0,55", "rotating": "1,4", "rod": "150 mm"})
    hand.answer({"radius": "60 mm", "most": "2"})
    hand.click("#start-bearings")
    _begun(portal, hand)
    hand.drop("body", COLUMNS)
    for name, value in {"bore": "84 mm", "ambient": "1,05 bar", "order": "1-2-3-4-5-6"}.items():
        hand.fill(f"#gas-{name}", value)
    hand.click("#form .gas button:has-text('Give it to all 6 cylinders')")
    hand.click("#form details[data-pointer='/objective'] > summary")
    hand.cell("/objective/bearing_weight", "1")
    with portal.asking():
        hand.click("#optimise")
    hand.click("#panel-main-bearings > summary")
    portal.page.wait_for_selector("#panel-main-bearings[data-drawn]")
    hand.click("#panel-sweep > summary")
    hand.click("#panel-sweep button:has-text('Bearing loads over the speed')")
    portal.page.wait_for_selector("#panel-sweep[data-swept]")
    assert hand.fields <= 40
    assert hand.count <= 40
    request = portal.bodies("/v1/optimize")[-1]
    cylinders = [row["cylinder"] for throw in request["machine"]["throws"] for row in throw["rows"]]
    centres = [cylinder["pressure"]["dead_centre_deg"] for cylinder in cylinders]
    # analytic: an even V six fires every 120 degrees
    assert sorted(centre % 720 for centre in centres) == pytest.approx([60 + 120 * k for k in range(6)])
    assert len(request["machine"]["bearings"]) == 4
    assert "bearing load" in portal.page.locator("#answer h2").first.inner_text()
    portal.open_panel("picture-indicator")
    _look(portal, "trial-b", within)


def test_a_scroll_is_begun_from_nothing(portal: Portal) -> None:
    hand = _come(portal, "#answer")
    hand.click("#new")
    hand.click(".starter input[value=scroll]")
    hand.answer({"scrollSpeed": "3600", "orbit": "5 mm", "orbiting": "1,2", "plane": "90 mm", "device": "crank_pins"})
    hand.answer({"pins": "3", "circle": "48 mm", "torque": "12,5", "planes": "50 mm; -110 mm", "scrollRadius": "22 mm"})
    machine = _begun(portal, hand)["machine"]
    assert hand.fields <= 10
    # nothing but what was typed, and what follows from it
    assert machine == {
        "kind": "scroll",
        "speed_rpm": 3600,
        "orbit_radius_m": 0.005,
        "orbiting_mass_kg": 1.2,
        "orbiting_position_m": 0.09,
        "anti_rotation": {"type": "crank_pins", "count": 3, "pin_circle_radius_m": 0.048, "position_m": 0.09},
        "rotation_torque_Nm": 12.5,
        "webs": [
            {"name": "1", "position_m": 0.05, "counterweight_radius_m": 0.022, "max_mass_kg": None},
            {"name": "2", "position_m": -0.11, "counterweight_radius_m": 0.022, "max_mass_kg": None},
        ],
    }
    # what cancels is not said to have grown from nothing
    expect(portal.page.locator("#answer h2").first).to_have_text("0.40909 kg of counterweights: force −100 %")
    portal.open_panel("pin-loads")
    # the page of a scroll is looked at in tests/browser/test_accessibility.py
    _look(portal, "trial-c", "#answer")
