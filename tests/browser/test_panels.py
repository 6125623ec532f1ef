"""Every panel is drawn, with the figures that the API gives, for three kinds of machine and at two widths."""

import json
from typing import Any

import pytest
from playwright.sync_api import Request, expect

from tests.browser.portal import ALL_PANELS, POLLING_MS, Portal, ask, cells, number
from tests.night import but

ALWAYS = (
    "counterweights",
    "foundation",
    "what-if",
    "versions",
    "hodographs",
    "turning",
    "over-angle",
    "orders",
    "pareto",
    "accuracy",
    "sweep",
    "picture-orders",
    "picture-stages",
)
DRIVEN = ("torque", "rod-loads", "flywheel", "main-bearings")
MACHINES = {
    "2d12": (*ALWAYS, "cranks", "match", "picture-indicator", "picture-bearings", *DRIVEN),
    # by inertia alone
    "v8-cross-plane": (*ALWAYS, "cranks", "match", "torque", "rod-loads"),
    "scroll-three-pins": (*ALWAYS, "pin-loads"),
}
#: plots of each panel; the others hold tables and forms
PLOTS = {"hodographs": 2, "over-angle": 2, "orders": 2, "pareto": 1, "accuracy": 1, "torque": 1, "rod-loads": 2} | {
    "flywheel": 1,
    "main-bearings": 4,
    "pin-loads": 1,
}


#: in the page: times of the ladder are taken once, not three times; nobody reads them here, and they are half of the
#: test. A route of the browser would do it too, and keep nothing that was loaded.
_MEASURED_ONCE = """{
  const own = fetch;
  const once = ({ body, ...how }) => ({ ...how, body: JSON.stringify({ ...JSON.parse(body), repeats: 1 }) });
  globalThis.fetch = (address, how) => own(address, String(address).endsWith("/v1/accuracy") ? once(how) : how);
}"""
#: in the page: every panel by its name, with what is wrong in it and, for each of its plots, how much is drawn and said
_PANELS = """(panels) => panels.map((panel) => [panel.id.replace("panel-", ""), {
  drawn: panel.dataset.drawn ?? null,
  wrong: panel.querySelectorAll(".error:not(:empty)").length,
  plots: [...panel.querySelectorAll(".plot")].map((plot) => [
    plot.querySelectorAll(".trace, .bars .point").length, (plot.getAttribute("aria-label") ?? "").length]),
}])"""


@pytest.mark.parametrize("example", but(("2d12",), MACHINES))
def test_every_panel_is_drawn(visit: Portal, example: str, url: str) -> None:
    portal = visit
    portal.page.add_init_script(_MEASURED_ONCE)
    portal.open(example, ALL_PANELS)
    panels = dict(portal.page.locator("details.panel").evaluate_all(_PANELS))
    assert sorted(panels) == sorted(MACHINES[example])
    for name, panel in panels.items():
        assert (panel["drawn"], panel["wrong"]) == ("1", 0), name
        assert len(panel["plots"]) == PLOTS.get(name, 0), name
        for marks, letters in panel["plots"]:
            assert marks > 0, name
            # what cannot be seen is said
            assert letters > 20, name
    for width in (1280, 390):
        portal.page.set_viewport_size({"width": width, "height": 900})
        # the page itself never scrolls sideways, once plots have the width that there is
        portal.page.wait_for_function(
            "width => document.documentElement.scrollWidth <= width", arg=width, polling=POLLING_MS
        )
        portal.screenshot(f"{example}-{width}")
    _shows_what_the_api_answers(portal, example, url)


def _shows_what_the_api_answers(portal: Portal, example: str, url: str) -> None:
    answer = ask(url, "/v1/optimize", ask(url, f"/v1/examples/{example}"))
    rows = cells(portal.panel("counterweights").locator("table"))
    assert [row[0] for row in rows] == [counterweight["web"] for counterweight in answer["counterweights"]]
    for row, weight in zip(rows, answer["counterweights"], strict=True):
        if weight["mass_kg"] == 0:
            assert row[1] == "none"
        else:
            assert number(row[1]) == pytest.approx(weight["mass_kg"], rel=1e-3, abs=1e-4)
            assert float(row[2]) == pytest.approx(weight["angle_deg"], abs=0.1)
    bound = answer["certificate"]["mass_lower_bound_kg"]
    proof = portal.page.locator(".proof").inner_text()
    assert f"none weighs less than {bound:.4f}"[:-2] in proof
    # one counterweight each in both drawings
    carrying = sum(counterweight["mass_kg"] > 0 for counterweight in answer["counterweights"])
    for view in ("front", "side"):
        assert portal.page.locator(f"#answer .{view} .counterweight").count() == carrying


def test_only_open_panels_are_simulated(portal: Portal) -> None:
    portal.open("2d12")
    assert portal.bodies("/v1/analyze") == []
    panel = portal.open_panel("torque")
    assert [body["outputs"] for body in portal.bodies("/v1/analyze")] == [["torque"]]
    panel.locator("> summary").click()
    panel.locator("> summary").click()
    assert len(portal.bodies("/v1/analyze")) == 1
    assert not portal.bodies("/v1/pareto")
    assert not portal.bodies("/v1/accuracy")


def test_what_is_asked_of_the_shaft_is_told_and_explained(portal: Portal, url: str) -> None:
    portal.open("2d12")
    portal.unfold("/objective")
    _bearing_loads_that_are_weighed(portal, url)
    portal.input("/objective/bearing_weight").fill("")
    _a_ceiling_of_bearings(portal)
    portal.input("/objective/bearing_ceiling_N").fill("")
    _a_ceiling_that_cannot_be_met(portal)


def _optimise_with(portal: Portal, field: str, value: str) -> None:
    portal.input(f"/objective/{field}").fill(value)
    portal.optimise()


def _a_ceiling_that_cannot_be_met(portal: Portal) -> None:
    portal.open_panel("hodographs")
    _optimise_with(portal, "force_ceiling_N", "1 kN")
    assert "No counterweights meet these ceilings" in portal.page.locator("#answer h2").inner_text()
    captions = portal.page.locator("#answer caption").all_inner_texts()
    assert captions[0] == "The closest compromise, which does not keep the ceilings"
    # analytic: half of the unbalanced 26.07 kg turns against the shaft, whatever the counterweights
    floor = 26.07 * 0.14 * (500 * 3.141592653589793 / 30) ** 2 / 2
    assert f"{floor:,.0f}".replace(",", "\u202f") in portal.page.locator(".proof").inner_text()


def _bearing_loads_that_are_weighed(portal: Portal, url: str) -> None:
    _optimise_with(portal, "bearing_weight", "1")
    request = ask(url, "/v1/examples/2d12") | {"objective": {"bearing_weight": 1}}
    loads = ask(url, "/v1/optimize", request)["main_bearings"]["bearings"]
    largest = [max(load[when]["peak_N"] for load in loads) for when in ("before", "after")]
    (row,) = (row for row in cells(portal.page.locator("#answer")) if row[0] == "largest bearing load, N")
    assert [number(text) for text in row[1:3]] == pytest.approx(largest, rel=1e-4)
    assert "sum of peak force, peak moment and the largest bearing load" in portal.page.locator(".proof").inner_text()
    assert "bearing load +" in portal.page.locator("#answer h2").inner_text()


def test_what_stands_beside_the_answer(portal: Portal, url: str) -> None:
    """Orders 1 and 2, balance rates, goals in their order, and what errors cost: the figures of the API."""
    portal.open("2d12", ("cranks", "orders"))
    answer = ask(url, "/v1/optimize", ask(url, "/v1/examples/2d12"))
    rows = cells(portal.panel("orders").locator("table"))
    assert [row[0] for row in rows] == ["1, once a revolution", "2, twice a revolution"]
    second = answer["residual"]["orders"]["after"][1]
    assert number(rows[1][2]) == pytest.approx(second["force"]["peak_N"], rel=1e-4)
    rates = cells(portal.panel("cranks").locator("table"))
    assert [float(row[1]) for row in rates] == pytest.approx(
        [rate["rate"] for rate in answer["balance_rate"]], rel=5e-3
    )
    words = portal.page.locator("#answer").inner_text()
    assert "one per cent of their mass" in words
    assert "Goals in their order" not in words


def _a_ceiling_of_bearings(portal: Portal) -> None:
    _optimise_with(portal, "bearing_ceiling_N", "105 kN")
    assert "ceiling of the bearing loads is reached" in portal.panel("counterweights").inner_text()
    _optimise_with(portal, "bearing_ceiling_N", "20 kN")
    words = portal.page.locator(".proof").inner_text()
    assert "The ceiling of the bearing loads cannot be met." in words
    assert "the ceiling of the bearing loads asks for 20\u202f000 N" in words
    assert "– N" not in words


def test_choosing_a_point_of_the_front(portal: Portal, url: str) -> None:
    portal.open("2d12", ("pareto",))
    points = ask(url, "/v1/pareto", portal.bodies("/v1/pareto")[0])["fronts"][0]["points"]
    panel = portal.panel("pareto")
    slider = panel.locator("#pareto-point")
    slider.focus()
    slider.press("End")
    _shows(panel, points[-1], len(points), len(points))
    # a plot that is drawn anew forgets what the pointer is on
    panel.locator(".plot:not([aria-busy])").wait_for()
    markers = panel.locator(".scatterlayer .trace").first.locator(".point")
    markers.nth(7).click(force=True)
    panel.get_by_text(f"Point 8 of {len(points)}").wait_for()
    _shows(panel, points[7], 8, len(points))
    portal.page.wait_for_url("**point=8*")
    portal.page.reload()
    _shows(panel, points[7], 8, len(points))


def _shows(panel: Any, point: Any, place: int, count: int) -> None:
    panel.get_by_role("heading", name=f"Point {place} of {count}").wait_for()
    rows = cells(panel.locator(".picked table").nth(1))
    masses = [number(row[1]) for row in rows]
    assert masses == pytest.approx(
        [counterweight["mass_kg"] for counterweight in point["counterweights"]], rel=1e-3, abs=1e-3
    )


def _of_a_clearance(request: Request) -> bool:
    if not request.url.endswith("/v1/scroll/pin-loads"):
        return False
    return any(pin.get("clearance_m") for pin in json.loads(request.post_data or "{}")["pins"])


def test_the_pins_turn(portal: Portal, url: str) -> None:
    portal.refusals = {422}
    portal.open("scroll-three-pins", ("pin-loads",))
    panel = portal.panel("pin-loads")
    slider = panel.locator("#pin-angle")
    scroll = panel.locator("svg .scroll")
    slider.fill("0")
    right = float(scroll.get_attribute("cx") or "")
    slider.fill("45")
    # analytic: after a quarter of a turn the eccentric points straight up
    assert panel.locator("output").inner_text() == "90°"
    assert float(scroll.get_attribute("cx") or "") == pytest.approx(right - 26, abs=0.1)
    turn = panel.get_by_role("button", name="Turn")
    turn.click()
    expect(slider).not_to_have_value("45")
    panel.get_by_role("button", name="Stop").click()
    # stiffness and clearance are in view, and typed
    for pin in (1, 2, 3):
        panel.get_by_label(f"stiffness, N/µm, pin {pin}").fill("20")
    panel.get_by_label("clearance, µm, pin 2").fill("10")
    # each pin that is typed is a question, and the last may come after those before it are answered
    with portal.page.expect_request(_of_a_clearance):
        panel.get_by_label("clearance, µm, pin 2").press("Tab")
    body = portal.bodies("/v1/scroll/pin-loads")[-1]
    assert [body_pin.get("clearance_m", 0) for body_pin in body["pins"]] == pytest.approx([0, 1e-5, 0])
    peaks = [ask_pin["peak_N"] for ask_pin in ask(url, "/v1/scroll/pin-loads", body)["pins"]]
    loads = panel.locator("table", has_text="peak load, N")
    # any of them may be what it was before
    for row, peak in enumerate(peaks):
        expect(loads.locator("tbody tr").nth(row).locator("td").first).to_have_text(f"{peak:.5g}")
    assert [number(row[1]) for row in cells(loads)] == pytest.approx(peaks, rel=1e-4)
    expect(panel).to_contain_text("Peaks are proven for every angle")
    expect(panel.locator(".wait")).to_have_text("")
    panel.get_by_label("stiffness, N/µm, pin 3").fill("soft")
    panel.get_by_label("stiffness, N/µm, pin 3").press("Tab")
    expect(panel.get_by_role("alert")).to_contain_text("pin 3: stiffness")


def test_bearings_are_chosen_by_name(portal: Portal) -> None:
    portal.open("2d12", ("main-bearings",))
    panel = portal.panel("main-bearings")
    panel.locator("select").select_option(label="B")
    panel.locator("[role=img][aria-label*='bearing B']").first.wait_for()


def test_an_engine_is_drawn_over_both_turns(portal: Portal) -> None:
    portal.open("inline-four-engine", ("torque", "rod-loads"))
    marks = portal.panel("torque").locator(".xtick text").all_text_contents()
    # analytic: six equal parts of two turns
    assert [mark.strip() for mark in marks] == ["0", "120", "240", "360", "480", "600", "720"]
    # analytic: inertia pulls most at the outer dead centre, whatever rounding leaves of 0
    loads = cells(portal.panel("rod-loads").locator("table"))
    assert [line[3] for line in loads if line[1] == "no load"] == ["0", "180", "180", "0"]


def test_any_two_responses_are_traded(portal: Portal, url: str) -> None:
    portal.open("v60", ("pareto",))
    panel = portal.panel("pareto")
    # without bearings there is nothing to trade of them
    names = [element.get_attribute("value") for element in panel.locator("#trade-x option").all()]
    assert {"force", "moment", "mass"} <= set(names)
    assert not {"bearings", "bending"} & set(names)
    panel.locator("#trade-y").select_option("mass")
    panel.locator("[role=img][aria-label*='total mass, kg']").wait_for()
    body = portal.bodies("/v1/pareto")[-1]
    assert body["responses"] == ["force", "mass"]
    points = ask(url, "/v1/pareto", body)["trades"][0]["points"]
    slider = panel.locator("#pareto-point")
    slider.focus()
    slider.press("Home")
    _shows(panel, points[0], 1, len(points))
    chosen = cells(panel.locator(".picked table").first)[0]
    values = [number(text) for text in chosen[:2]]
    assert values == pytest.approx(points[0]["values"], rel=1e-4, abs=1e-4)
    # chosen twice: they change places; and a link keeps it
    panel.locator("#trade-x").select_option("mass")
    panel.get_by_text("Point, from least mass to least force").wait_for()
    portal.page.wait_for_url("**trade=mass,force*")


def test_numbers_of_counterweights_are_traded_where_there_is_a_catalogue(portal: Portal, url: str) -> None:
    portal.open("catalogue-twin", ("pareto",))
    panel = portal.panel("pareto")
    panel.get_by_text("Point, from fewest to most").wait_for()
    body = portal.bodies("/v1/pareto")[-1]
    assert body["counts"] == {"of": "weights", "least": "objective"}
    # without a ceiling the least mass is none
    assert [element.get_attribute("value") for element in panel.locator("#count-least option").all()] == ["objective"]
    points = ask(url, "/v1/pareto", body)["counts"][0]["points"]
    for key, place in (("Home", 0), ("End", len(points) - 1)):
        panel.locator("#pareto-point").press(key)
        panel.get_by_text(f"Point {place + 1} of {len(points)}").wait_for()
        numbers = [number(text) for text in cells(panel.locator(".picked table").first)[0][:2]]
        assert numbers == pytest.approx([points[place]["at_most"], points[place]["value"]], rel=1e-4)
    portal.screenshot("counts")
    # part numbers in their place; and a link keeps them
    panel.locator("#count-of").select_option("part_numbers")
    panel.locator("[role=img][aria-label*='part numbers']").wait_for()
    assert portal.bodies("/v1/pareto")[-1]["counts"]["of"] == "part_numbers"
    portal.page.wait_for_url("**count=part_numbers,objective*")


def test_the_crank_turns_with_its_force_and_moment(portal: Portal, url: str) -> None:
    portal.open("v60", ("turning",))
    panel = portal.panel("turning")
    panel.locator("#turning-angle").fill("45")
    assert panel.locator("output").inner_text() == "90°"
    # analytic: a clockwise shaft has turned by a right angle, which is positive where y points down
    assert (panel.locator("svg .throw").first.get_attribute("transform") or "").startswith("rotate(90 ")
    request = portal.bodies("/v1/optimize")[0]
    after = ask(url, "/v1/optimize", request)["hodograph"]["after"]
    size = (after["force_x_N"][45] ** 2 + after["force_y_N"][45] ** 2) ** 0.5
    words = panel.locator("figcaption").nth(1).inner_text()
    variant = words.rsplit("after ", 1)[1].removesuffix(" N").replace(",", "")
    assert number(variant) == pytest.approx(size, rel=1e-3, abs=1e-3)
    panel.get_by_role("button", name="Turn").click()
    stop = panel.get_by_role("button", name="Stop")
    assert stop.get_attribute("aria-pressed") == "true"
    stop.click()
    panel.get_by_role("button", name="Turn").wait_for()


def test_a_balance_shaft_turns_about_its_own_axis(portal: Portal) -> None:
    portal.open("single-balance-shaft", ("turning",))
    panel = portal.panel("turning")
    panel.locator("#turning-angle").fill("45")
    shaft = panel.locator("svg .balancer")
    x, y = (float(shaft.locator("circle").first.get_attribute(name) or "") for name in ("cx", "cy"))
    # analytic: against the crankshaft, which has turned by a right angle counter-clockwise
    assert (panel.locator("svg .throw").first.get_attribute("transform") or "").startswith("rotate(-90 ")
    assert shaft.get_attribute("transform") == f"rotate(90 {x:g} {y:g})"
    assert shaft.locator(".counterweight").get_attribute("transform") is None


def test_who_asks_for_less_motion_turns_by_hand(visit: Portal) -> None:
    portal = visit
    portal.page.emulate_media(reduced_motion="reduce")
    portal.open("v60", ("turning",))
    panel = portal.panel("turning")
    panel.get_by_role("button", name="Turn by 30°").click()
    assert panel.locator("output").inner_text() == "30°"


def test_the_answer_comes_first_and_then_the_plots_in_view(visit: Portal) -> None:
    portal = visit
    portal.open("2d12", ("hodographs", "over-angle", "orders"))
    # what is drawn, in its order, and whether the answer was there by then
    portal.page.evaluate(
        """() => {
          document.getElementById("panel-orders").scrollIntoView();
          window.standing = [...document.querySelectorAll(".plot")];
          window.turns = [];
          const [{ react }, old] = [Plotly, document.querySelector("#answer h2")];
          Plotly.react = (node, ...more) => {
            const panel = node.closest(".panel").id;
            window.turns.push([panel, document.querySelector("#answer h2") !== old, window.standing.includes(node)]);
            return react(node, ...more);
          };
          document.getElementById("optimise").click();
        }"""
    )
    portal.drawn(2)
    turns = portal.page.evaluate("window.turns")
    assert [panel for panel, _, _ in turns[:2]] == ["panel-orders"] * 2
    assert sorted(panel for panel, _, _ in turns) == sorted(
        f"panel-{name}" for name in ("hodographs", "over-angle", "orders") for _ in "fm"
    )
    # each is changed in its place
    assert all(answered and standing for _, answered, standing in turns)
