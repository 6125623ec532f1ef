"""A sweep from the page: started, watched, drawn, taken away; wrong ranges are refused at their fields."""

from pathlib import Path

import pytest
from playwright.sync_api import expect

from tests.browser.portal import Portal, ask, number


@pytest.fixture
def portal(visit: Portal) -> Portal:
    """A panel that has not swept yet, nor holds what was typed for a sweep."""
    return visit


def _count(portal: Portal, *counts: str) -> None:
    for index, count in enumerate(counts):
        portal.page.fill(f"#axis-{index}-count", count)


def test_a_grid_becomes_a_heat_map(portal: Portal) -> None:
    portal.open("2d12", ("sweep",))
    _count(portal, "5", "4")
    portal.page.get_by_role("button", name="Start the sweep").click()
    portal.page.wait_for_selector("#panel-sweep[data-swept]", timeout=60_000)
    panel = portal.panel("sweep")
    assert "20 of 20 designs are drawn" in panel.inner_text()
    assert panel.locator(".heatmaplayer image, .heatmaplayer .hm").count() > 0
    portal.screenshot("sweep-heat-map")
    panel.locator("#sweep-shown").select_option("total_mass_kg")
    panel.locator("[role=img][aria-label*='total mass']").wait_for()
    panel.locator("#sweep-form").select_option("points")
    panel.locator(".scatterlayer .point").first.wait_for()
    with portal.page.expect_download() as download:
        panel.get_by_role("link", name="csv").click()
    lines = Path(download.value.path()).read_text().splitlines()
    assert len(lines) == 21
    # the link leads back to the sweep
    portal.page.wait_for_url("**sweep=*")
    portal.page.reload()
    portal.page.wait_for_selector("#panel-sweep[data-swept]")
    assert "20 of 20 designs are drawn" in panel.inner_text()
    assert lines[0].startswith('"index","/machine/throws/0/rows/0/reciprocating_mass_kg"')


def test_a_latin_hypercube_becomes_points(portal: Portal) -> None:
    portal.open("scroll-three-pins", ("sweep",))
    portal.page.locator("#sweep-design").select_option("latin_hypercube")
    portal.page.fill("#sweep-samples", "30")
    portal.page.get_by_role("button", name="Start the sweep").click()
    portal.page.wait_for_selector("#panel-sweep[data-swept]", timeout=60_000)
    assert portal.panel("sweep").locator(".scatterlayer .point").count() == 30


def test_bearing_loads_over_the_speed_are_one_click(portal: Portal, url: str) -> None:
    portal.open("inline-four-engine", ("sweep",))
    panel = portal.panel("sweep")
    panel.get_by_role("button", name="Bearing loads over the speed").click()
    portal.page.wait_for_selector("#panel-sweep[data-swept]")
    bearings = ask(url, "/v1/examples/inline-four-engine")["machine"]["bearings"]
    expect(panel.locator(".scatterlayer .trace")).to_have_count(len(bearings))
    body = portal.bodies("/v1/sweeps")[-1]
    assert body["task"] == "analyze"
    axis = body["axes"][0]
    # independent: the fastest speed by itself
    base = body["base"]
    base["machine"]["speed_rpm"] = axis["stop"]
    loads = ask(url, "/v1/analyze", base)["main_bearings"]["bearings"]
    largest = max(load["after"]["peak_N"] for load in loads)
    words = panel.locator("[role=img][aria-label*='Largest load']").get_attribute("aria-label") or ""
    assert number(words.partition("up to ")[2].removesuffix(" N.")) == pytest.approx(largest, rel=1e-4)


def test_a_wrong_range_is_refused_at_its_field(portal: Portal) -> None:
    portal.refusals = {422}
    portal.open("2d12", ("sweep",))
    portal.page.fill("#axis-0-start", "3 m")
    portal.page.fill("#axis-1-count", "0")
    portal.page.get_by_role("button", name="Start the sweep").click()
    portal.page.locator("#panel-sweep [aria-invalid='true']").first.wait_for()
    wrong = portal.page.locator("#panel-sweep .wrong")
    assert {element.get_attribute("data-pointer") for element in wrong.all()} <= {"/axes/0/start", "/axes/1/count"}


def test_another_field_and_an_end_before_its_time(portal: Portal) -> None:
    portal.open("2d12", ("sweep",))
    portal.page.get_by_role("button", name="Add a field").click()
    portal.page.locator("#axis-2-path").select_option("/machine/speed_rpm")
    assert portal.page.locator("#axis-2-start").input_value() == "400"
    _count(portal, "300", "300", "100")
    portal.page.get_by_role("button", name="Start the sweep").click()
    cancel = portal.page.get_by_role("button", name="Cancel")
    cancel.wait_for()
    cancel.click()
    portal.page.get_by_text("Cancelled").wait_for()
