"""The drawings while one types: the latest is drawn, what is missing is said; and counterweights as they are made."""

import pytest
from playwright.sync_api import Route, expect

from tests.browser.portal import Portal, ask, cells, number

THROW = "/machine/throws/0"
#: in the page: names, and pairs of them that overlap by more than a pixel
_HIDDEN = """(drawing) => {
  const names = [...drawing.querySelectorAll(".names text")];
  const boxes = names.map((one) => one.getBoundingClientRect());
  const over = (one, other) => Math.min(one.right, other.right) - Math.max(one.left, other.left) > 1
    && Math.min(one.bottom, other.bottom) - Math.max(one.top, other.top) > 3;
  const pairs = names.flatMap((name, i) => names.slice(i + 1).filter((_, j) => over(boxes[i], boxes[i + 1 + j]))
    .map((other) => [name.textContent, other.textContent]));
  return [names.length, pairs];
}"""


def test_no_name_is_hidden(portal: Portal) -> None:
    """In the letters that a browser has; tests/drawings/test_views.py looks at more machines."""
    portal.open("v8-cross-plane")
    for view in ("front", "side"):
        count, pairs = portal.page.locator(f"#drawings .{view}").evaluate(_HIDDEN)
        assert count > 1
        assert pairs == []


def _last_angle(portal: Portal, angles: list[str]) -> None:
    """Type angles of the first crank, all of them in one moment."""
    portal.input(f"{THROW}/crank_angle_deg").evaluate(
        """(input, angles) => {
          for (const angle of angles) {
            input.value = angle;
            input.dispatchEvent(new InputEvent("input", { bubbles: true }));
          }
        }""",
        angles,
    )


def _pointed(portal: Portal, angle: int) -> None:
    title = portal.page.locator("#drawings .front .throw title", has_text=f"throw 1 at {angle}°")
    title.wait_for(state="attached")


def test_the_latest_of_many_key_strokes_is_drawn(portal: Portal) -> None:
    """One question at a time; one whose answer comes late is neither drawn, nor does it stand in the answer's place."""
    portal.open("single-vertical")
    held: list[Route] = []
    most = 1

    def hold(route: Route) -> None:
        if len(held) < most:
            held.append(route)
        else:
            route.continue_()

    portal.page.route("**/v1/layout", hold)
    before = len(portal.bodies("/v1/layout"))
    with portal.page.expect_request("**/v1/layout"):
        _last_angle(portal, ["1", "2", "3"])
    _last_angle(portal, [str(angle) for angle in range(10, 30)])
    fitted = portal.page.locator("#drawings .counterweight")
    # what stands there is that of the answer before, until there is another
    count = fitted.count()
    assert count > 0
    held[0].continue_()
    _pointed(portal, 29)
    typed = [body["machine"]["throws"][0]["crank_angle_deg"] for body in portal.bodies("/v1/layout")[before:]]
    assert typed == [3, 29]
    assert fitted.count() == 0
    most = 2
    with portal.page.expect_request("**/v1/layout"):
        _last_angle(portal, ["40"])
    with portal.asking():
        with portal.page.expect_response("**/v1/optimize"):
            portal.page.click("#optimise")
        held[1].continue_()
    assert fitted.count() > 0


def test_the_page_stays_usable_where_nothing_is_drawn(portal: Portal) -> None:
    portal.open("single-vertical")
    drawings = portal.page.locator("#drawings")
    portal.page.route("**/v1/layout", lambda route: route.fulfill(status=404, json={"detail": "Gone."}))
    portal.refusals = {404}
    _last_angle(portal, ["50"])
    expect(drawings).to_contain_text("Not drawn anew: Gone.")
    expect(drawings).to_have_class("drawings old")
    assert drawings.locator(".front").count() == 1
    portal.page.unroute("**/v1/layout")
    _last_angle(portal, ["60"])
    _pointed(portal, 60)
    expect(drawings).to_have_class("drawings")
    # half-typed: what is known is drawn, and what is missing is said in the page's words
    _last_angle(portal, [""])
    expect(drawings).to_contain_text("Not drawn yet: throw 1: crank angle: this field is required.")
    assert drawings.locator(".front .throw").count() == 0
    assert drawings.locator(".side").count() == 1


def test_counterweights_come_first(portal: Portal, url: str) -> None:
    portal.open("plate-single")
    answer = ask(url, "/v1/optimize", ask(url, "/v1/examples/plate-single"))
    first = portal.page.locator("#answer > :not(h2)").first
    rows = cells(first)
    for row, counterweight in zip(rows, answer["counterweights"], strict=True):
        assert row[0] == counterweight["web"]
        figures = [number(text) for text in row[1:6]]
        expected = [
            counterweight["mass_kg"],
            1e3 * counterweight["position_m"],
            1e3 * counterweight["radius_m"],
            counterweight["angle_from_crank_deg"],
        ]
        assert figures == pytest.approx([*expected, counterweight["angle_deg"]], rel=1e-4)
    assert [row[6].split(",")[0] for row in rows] == ["segment", "sector"]
