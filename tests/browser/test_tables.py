"""The tables of throws, rows and webs: typed, pasted, copied, mirrored, put in another order."""

from typing import Any

import pytest
from playwright.sync_api import expect

from tests.browser.portal import Portal

THROWS = "/machine/throws"
WEBS = "/machine/webs"
FOUR = """Name\tPosition (mm)\tcrank radius, mm\tangle\trotating mass [kg]
1\t-450\t80\t0\t9,5
2\t-150\t80\t90\t9,5
3\t150\t80\t270\t9,5
4\t450\t80\t180\t9,5
"""


def _paste(portal: Portal, grid: str, text: str, within: str = ".wide") -> None:
    portal.paste(f"#form .grid-{grid} {within}", text)


def _machine(portal: Portal) -> Any:
    portal.optimise()
    return portal.bodies("/v1/optimize")[-1]["machine"]


def _tool(portal: Portal, grid: str, name: str) -> None:
    portal.page.locator(f"#form .grid-{grid} .tools").get_by_role("button", name=name).click()


LENGTHS = {
    "0,14": 0.14,
    "140,5 mm": "140.5 mm",
    "5.5 in": "5.5 in",
    "140 MM": "140 mm",
    "−0.14": -0.14,
    "1.234,5 mm": "1234.5 mm",
}


def test_lengths_and_speeds_are_read_as_people_write_them(portal: Portal) -> None:
    portal.refusals = {422}
    portal.open("v60")
    radius = portal.input(f"{THROWS}/0/crank_radius_m")
    before = radius.input_value()
    for length, value in LENGTHS.items():
        radius.fill(length)
        with portal.page.expect_response("**/v1/optimize"):
            portal.page.click("#optimise")
        assert portal.bodies("/v1/optimize")[-1]["machine"]["throws"][0]["crank_radius_m"] == value
    radius.fill(before)
    for number, unit in enumerate(("RPM", "1/min", "min-1", "U/min"), 777):
        portal.input("/machine/speed_rpm").fill(f"{number} {unit}")
        assert _machine(portal)["speed_rpm"] == f"{number} rpm"


def test_metres_that_are_none_are_asked_about(portal: Portal) -> None:
    portal.open("two-rows-180")
    for throw in (0, 1):
        portal.input(f"{THROWS}/{throw}/crank_radius_m").fill("100")
    question = portal.page.locator("#form .grid-throw .question")
    assert "crank radius: 100 m?" in question.inner_text()
    question.get_by_role("button", name="100 mm meant").click()
    assert question.count() == 0
    assert [crank["crank_radius_m"] for crank in _machine(portal)["throws"]] == ["100 mm", "100 mm"]


def test_a_table_is_pasted(portal: Portal) -> None:
    portal.open("two-rows-180")
    _paste(portal, "throw", FOUR)
    element = portal.page.locator("#form .grid-throw .said")
    element.get_by_role("button", name="Yes, crank angle").click()
    throws = _machine(portal)["throws"]
    assert [throw["position_m"] for throw in throws] == ["-450 mm", "-150 mm", "150 mm", "450 mm"]
    assert [throw["crank_angle_deg"] for throw in throws] == [0, 90, 270, 180]
    assert [throw["rotating_mass_kg"] for throw in throws] == [9.5] * 4
    # new throws are like the last one, with its row
    assert len({throw["name"] for throw in throws}) == 4


def test_cells_are_pasted_where_the_caret_is(portal: Portal) -> None:
    portal.open("two-rows-180")
    _paste(portal, "web", "0,3\t20\n0,31\t21", f"[data-pointer='{WEBS}/1/counterweight_radius_m'] input")
    webs = _machine(portal)["webs"]
    pairs = [(web["counterweight_radius_m"], web["max_mass_kg"]) for web in webs]
    assert pairs[1:3] == [(0.3, 20), (0.31, 21)]


def test_what_is_copied_can_be_pasted(portal: Portal) -> None:
    portal.page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    portal.open("v60")
    before = _machine(portal)
    _tool(portal, "row", "Copy table")
    portal.page.get_by_text("Copied").wait_for()
    text = portal.page.evaluate("navigator.clipboard.readText()")
    assert text.splitlines()[0].split("\t")[:3] == ["throw", "name", "axis_deg"]
    portal.input(f"{THROWS}/0/rows/1/axis_deg").fill("11")
    _paste(portal, "row", text)
    assert _machine(portal)["throws"] == before["throws"]


def test_rows_are_mirrored_and_put_in_another_order(portal: Portal) -> None:
    portal.open("two-rows-180")
    before = [web["name"] for web in portal.bodies("/v1/optimize")[-1]["machine"]["webs"]]
    portal.input(f"{WEBS}/0/name").focus()
    _tool(portal, "web", "Down")
    webs = _machine(portal)["webs"]
    assert [web["name"] for web in webs] == [before[1], before[0], *before[2:]]
    portal.page.locator("#form .grid-web .plane").fill("1000 mm")
    _tool(portal, "web", "Mirror about")
    mirrored = _machine(portal)["webs"]
    assert mirrored[: len(webs)] == webs
    places = sorted(2 - web["position_m"] for web in webs)
    assert sorted(web["position_m"] for web in mirrored[len(webs) :]) == pytest.approx(places)
    assert len({web["name"] for web in mirrored}) == len(mirrored)


def test_sectors_opposite_their_cranks(portal: Portal) -> None:
    portal.open("2d12")
    _tool(portal, "web", "Sectors opposite their cranks")
    webs = _machine(portal)["webs"]
    # analytic: against the nearest crank, at 0 and 180 degrees
    assert [web["sector"]["centre_deg"] for web in webs] == [180, 180, 0, 0]
    assert portal.input(f"{WEBS}/2/sector/centre_deg").input_value() == "0"


def test_an_envelope_takes_the_place_of_radius_and_mass(portal: Portal) -> None:
    portal.open("2d12")
    _tool(portal, "web", "envelopes")
    for name, value in (("outer_radius_m", "300 mm"), ("inner_radius_m", "60 mm"), ("thickness_m", "60 mm")):
        portal.input(f"{WEBS}/0/envelope/{name}").fill(value)
    assert portal.input(f"{WEBS}/0/max_mass_kg").input_value() == ""
    web = _machine(portal)["webs"][0]
    assert web["envelope"] == {
        "shape": "segment",
        "outer_radius_m": "300 mm",
        "inner_radius_m": "60 mm",
        "thickness_m": "60 mm",
    }
    assert "max_mass_kg" not in web
    assert portal.page.locator("#drawings .front .counterweight:not(.unknown)").count() == 1


def test_headings_and_drawing_follow_what_is_typed(portal: Portal) -> None:
    portal.open("two-rows-180")
    portal.input(f"{THROWS}/1/name").fill("drive end")
    heading = portal.page.locator(f"#form details[data-pointer='{THROWS}/1'] > summary")
    expect(heading).to_have_text("throw drive end", ignore_case=True)
    count = len(portal.bodies("/v1/optimize"))
    portal.page.locator("#drawings .side").get_by_text("throw drive end", exact=True).wait_for()
    portal.input(f"{THROWS}/1/crank_angle_deg").fill("90")
    portal.page.locator("#drawings .front title", has_text="throw drive end at 90°").wait_for(state="attached")
    assert len(portal.bodies("/v1/optimize")) == count


def test_the_keyboard_goes_through_a_table(portal: Portal) -> None:
    portal.open("two-rows-180")
    portal.input(f"{THROWS}/0/rotating_mass_kg").focus()
    keyboard = portal.page.keyboard
    keyboard.press("Control+A")
    keyboard.type("11")
    keyboard.press("Enter")
    keyboard.type("12")
    # after the last row another is begun
    keyboard.press("Enter")
    keyboard.type("13")
    keyboard.press("ArrowUp")
    keyboard.type("14")
    assert [throw["rotating_mass_kg"] for throw in _machine(portal)["throws"]] == [11, 14, 13]


def test_all_of_a_column_is_edited_at_once_and_filled_down(portal: Portal) -> None:
    portal.open("2d12")
    portal.page.locator("#form .grid-web .tools").get_by_role("button", name="sectors", exact=True).click()
    heads = portal.page.locator("#form .grid-web thead th")
    for name, value in (("max mass", "42,5"), ("sector half angle", "35"), ("counterweight radius", "310 mm")):
        heads.filter(has_text=name).click()
        portal.page.keyboard.press("Control+A")
        portal.page.keyboard.type(value)
    # the first cell is typed, the others take it
    portal.input(f"{WEBS}/0/sector/centre_deg").fill("180")
    portal.input(f"{WEBS}/0/sector/centre_deg").press("Control+d")
    portal.input(f"{WEBS}/1/max_mass_kg").focus()
    keyboard = portal.page.keyboard
    for key in ("Shift+ArrowDown", "Shift+ArrowDown", "Shift+ArrowUp", "Control+A"):
        keyboard.press(key)
    keyboard.type("40")
    webs = _machine(portal)["webs"]
    assert [web["max_mass_kg"] for web in webs] == [42.5, 40, 40, 42.5]
    assert [web["counterweight_radius_m"] for web in webs] == ["310 mm"] * 4
    assert [web["sector"] for web in webs] == [{"centre_deg": 180, "half_angle_deg": 35}] * 4
    # one step back each
    portal.page.click("#undo")
    assert portal.input(f"{WEBS}/1/max_mass_kg").input_value() == "42.5"


def test_cylinders_of_a_compressor_are_columns_of_its_rows(portal: Portal) -> None:
    portal.open("two-rows-180")
    heads = ["bore (mm)", "suction pressure (bar)", "discharge pressure (bar)", "relative clearance"]
    lines = ["\t".join(["throw", *heads]), "\t".join(["1", "730", "2,86", "8,52", "0,1"]), "2\t630\t2,86\t8,52\t0,12"]
    _paste(portal, "row", "\n".join(lines))
    rows = [throw["rows"][0]["cylinder"] for throw in _machine(portal)["throws"]]
    assert [row["bore_m"] for row in rows] == ["730 mm", "630 mm"]
    assert [row["relative_clearance"] for row in rows] == [0.1, 0.12]
    assert rows[0]["suction_pressure_Pa"] == "2.86 bar"
    assert portal.input(f"{THROWS}/1/rows/0/cylinder/discharge_pressure_Pa").input_value() == "8.52 bar"
