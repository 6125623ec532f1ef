"""A machine of one's own: from a few questions, typed or pasted into an empty one, and nothing of an example in it."""

from typing import Any

import pytest
from playwright.sync_api import expect

from tests.browser.hand import Hand
from tests.browser.portal import Portal
from tests.browser.test_tables import FOUR

ROWS = "throw\tname\taxis_deg\treciprocating_mass_kg\n" + "".join(
    f"{n}\t{n}\t90\t{m}\n" for n, m in enumerate((31, 30, 30, 31), 1)
)
WEBS = "name\tposition (mm)\tcounterweight radius (mm)\tmax mass\n" + "".join(
    f"{n}{side}\t{-750 + 300 * n + shift}\t110\t25\n" for n in (1, 2, 3, 4) for side, shift in (("a", -75), ("b", 75))
)


def _computed(portal: Portal, before: int) -> None:
    portal.page.wait_for_selector(f"#results[data-drawn]:not([data-drawn='{before}']):not(.stale)")


def test_four_throws_are_typed(portal: Portal) -> None:
    portal.open("2d12")
    hand = Hand(portal)
    hand.click("#new")
    answers = {"throws": "4", "pitch": "300 mm", "stroke": "160 mm", "speed": "750 RPM", "reciprocating": "30"}
    for name, value in (answers | {"rotating": "9,5", "radius": "110 mm", "most": "25"}).items():
        hand.fill(f"#start-{name}", value)
    hand.click(".starter button[value=begin]")
    # whatever differs is typed into its cell
    hand.cell("/machine/throws/0/rows/0/reciprocating_mass_kg", "31")
    hand.cell("/machine/throws/3/rows/0/reciprocating_mass_kg", "31")
    hand.cell("/machine/throws/1/rotating_mass_kg", "9,7")
    hand.cell("/machine/webs/0/max_mass_kg", "22")
    before = portal.runs()
    hand.click("#optimise")
    _computed(portal, before)
    assert hand.count <= 30
    request = portal.bodies("/v1/optimize")[-1]
    machine = request["machine"]
    assert machine["speed_rpm"] == 750
    assert [throw["crank_angle_deg"] for throw in machine["throws"]] == [0, 90, 270, 180]
    assert [throw["position_m"] for throw in machine["throws"]] == pytest.approx([-0.45, -0.15, 0.15, 0.45])
    assert [throw["rotating_mass_kg"] for throw in machine["throws"]] == [9.5, 9.7, 9.5, 9.5]
    assert [web["max_mass_kg"] for web in machine["webs"]] == [22, *[25] * 7]
    # nothing of the example that was there
    assert set(machine) == {"kind", "speed_rpm", "throws", "webs"}
    assert all(set(throw["rows"][0]) == {"axis_deg", "reciprocating_mass_kg"} for throw in machine["throws"])


def _four(portal: Portal, before: int) -> None:
    """The four-throw machine is answered, and holds nothing of what was there."""
    _computed(portal, before)
    machine = portal.bodies("/v1/optimize")[-1]["machine"]
    assert [throw["rows"][0]["reciprocating_mass_kg"] for throw in machine["throws"]] == [31, 30, 30, 31]
    assert [throw["rows"][0]["axis_deg"] for throw in machine["throws"]] == [90] * 4
    assert [throw["position_m"] for throw in machine["throws"]] == ["-450 mm", "-150 mm", "150 mm", "450 mm"]
    assert [throw["crank_angle_deg"] for throw in machine["throws"]] == [0, 90, 270, 180]
    assert [web["position_m"] for web in machine["webs"]][:3] == ["-525 mm", "-375 mm", "-225 mm"]
    assert machine["speed_rpm"] in (750, "750 rpm")
    assert set(machine) == {"kind", "speed_rpm", "throws", "webs"}
    assert " %" in portal.page.locator("#answer h2").inner_text()


def test_tables_are_pasted_on_a_first_visit(visit: Portal) -> None:
    portal = visit
    portal.page.goto(f"{portal.url}/")
    portal.page.get_by_role("heading", name="Begin with your machine").wait_for()
    assert portal.page.locator("#panels").is_hidden()
    assert portal.bodies("/v1/optimize") == []
    hand = Hand(portal)
    hand.paste("throw", FOUR.replace("angle", "crank angle"))
    hand.paste("row", ROWS)
    hand.paste("web", WEBS)
    hand.cell("/machine/speed_rpm", "750 1/min")
    hand.click("#optimise")
    assert hand.count <= 5
    _four(portal, 0)


def test_throws_with_their_rows_are_pasted_onto_the_questions(portal: Portal) -> None:
    portal.open("2d12")
    before = portal.runs()
    hand = Hand(portal)
    hand.click("#new")
    heads, *lines = FOUR.replace("angle", "crank angle").splitlines()
    masses = ("31", "30", "30", "31")
    wide = [
        f"{heads}\taxis\treciprocating mass",
        *(f"{line}\t90\t{mass}" for line, mass in zip(lines, masses, strict=True)),
    ]
    hand.drop(".starter #start-throws", "\n".join(wide))
    portal.page.locator("#form .grid-throw tbody tr").nth(3).wait_for()
    hand.drop("#form .grid-web .wide", WEBS)
    hand.cell("/machine/speed_rpm", "750 RPM")
    hand.click("#optimise")
    assert hand.count <= 5
    _four(portal, before)


def test_a_whole_sheet_is_pasted(portal: Portal) -> None:
    portal.open("2d12")
    before = portal.runs()
    hand = Hand(portal)
    hand.click("#new")
    throws = FOUR.replace("angle", "crank angle")
    sheet = f"Speed (rpm)\t750\t\t\nColour\t7\n\n{throws}\n\t\t\nRows\n{ROWS}\n{WEBS}"
    hand.drop(".starter", sheet)
    text = "Pasted: 4 throws, 4 rows, 8 webs, Speed (rpm). Not understood: Colour. Press Optimise."
    portal.page.locator("#progress").get_by_text(text).wait_for()
    hand.click("#optimise")
    assert hand.count <= 5
    _four(portal, before)


def test_a_machine_as_text_is_pasted_anywhere(portal: Portal) -> None:
    portal.open("2d12")
    portal.paste("h1", portal.page.evaluate("fetch('v1/examples/w60').then((answer) => answer.text())"))
    portal.page.wait_for_url("**#r=*")
    expect(portal.page.locator("#form .grid-row tbody tr")).to_have_count(3)


def test_examples_without_gas_data_come_first(visit: Portal) -> None:
    portal = visit
    portal.page.goto(f"{portal.url}/")
    groups = portal.page.locator("#example optgroup")
    groups.nth(1).wait_for(state="attached")
    assert [element.get_attribute("label") for element in groups.all()] == ["Masses alone", "With gas data"]
    gas = [element.get_attribute("value") for element in groups.nth(1).locator("option").all()]
    assert gas == ["2d12", "inline-four-engine"]
    assert not {"two-rows-180"} & set(gas)
    portal.page.locator(".beginning a").first.click()
    portal.page.wait_for_selector("#results[data-drawn]")
    assert portal.bodies("/v1/optimize")[-1]["machine"]["throws"]


def test_what_a_question_lacks_is_named(portal: Portal) -> None:
    portal.open("2d12")
    portal.page.click("#new")
    portal.page.fill("#start-stroke", "160")
    portal.page.click(".starter button[value=begin]")
    words = portal.page.locator(".starter .error").inner_text()
    assert "Speed" in words
    assert "160 m? Write 160 mm" in words
    portal.page.get_by_role("button", name="Cancel").click()
    assert portal.page.locator("#example").input_value() == "2d12"


ARRANGEMENTS = {
    # published: the usual cranks of a four-throw opposed compressor and of a V machine
    "opposed": ([[0], [180], [0], [180]], [0, 180, 90, 270]),
    "v": ([[45, 135]] * 4, [0, 90, 180, 270]),
    # analytic: pairs half a turn apart, the second the mirror image of the first
    "boxer": ([[0], [180], [0], [180]], [0, 180, 180, 0]),
}


def test_arrangements(portal: Portal) -> None:
    portal.open("2d12")
    answers = {"throws": "4", "pitch": "0.3", "stroke": "0.16", "speed": "750", "reciprocating": "30", "rotating": "9"}
    for arrangement, (axes, cranks) in ARRANGEMENTS.items():
        portal.page.click("#new")
        portal.page.check(f".starter input[value={arrangement}]")
        for name, value in answers.items():
            portal.page.fill(f"#start-{name}", value)
        portal.page.select_option("#start-rule", "ends")
        portal.page.check("#start-plates")
        for name, value in {"inner": "60 mm", "outer": "200 mm", "thickness": "50 mm"}.items():
            portal.page.fill(f"#start-{name}", value)
        before = portal.runs()
        portal.page.click(".starter button[value=begin]")
        _computed(portal, before)
        machine = portal.bodies("/v1/optimize")[-1]["machine"]
        assert [[row["axis_deg"] for row in throw["rows"]] for throw in machine["throws"]] == axes
        assert [throw["crank_angle_deg"] for throw in machine["throws"]] == cranks
        assert [web["name"] for web in machine["webs"]] == ["front", "rear"]
        # analytic: a boxer of four leaves nothing to balance
        fitted = portal.page.locator("#drawings .front .counterweight:not(.unknown)").count()
        assert (fitted > 0) == (arrangement != "boxer")


def _begin(portal: Portal, arrangement: str, answers: dict[str, str]) -> Any:
    """The request that the page makes of some answers."""
    portal.open("single-vertical")
    portal.page.click("#new")
    portal.page.check(f".starter input[value={arrangement}]")
    for name, value in answers.items():
        field = portal.page.locator(f"#start-{name}")
        if field.evaluate("node => node.tagName") == "SELECT":
            field.select_option(value)
        else:
            field.fill(value)
    with portal.asking():
        portal.page.click(".starter button[value=begin]")
    return portal.bodies("/v1/optimize")[-1]


SIX = {"throws": "3", "pitch": "100 mm", "stroke": "80 mm", "speed": "3000", "reciprocating": "0,5", "rotating": "1,2"}


def test_a_v_engine_with_split_pins(portal: Portal) -> None:
    split = {"angle": "60", "split": "60", "offset": "20 mm", "radius": "60 mm"}
    machine = _begin(portal, "v", SIX | split)["machine"]
    # analytic: with pins as far apart as the rows of a V six both pistons of a throw move 120 degrees apart
    assert [throw["crank_angle_deg"] for throw in machine["throws"]] == [0, 300, 120, 60, 240, 180]
    assert [throw["rows"][0]["axis_deg"] for throw in machine["throws"]] == [60, 120] * 3
    assert [throw["position_m"] for throw in machine["throws"]][:2] == pytest.approx([-0.11, -0.09])
    assert {throw["rotating_mass_kg"] for throw in machine["throws"]} == {0.6}
    assert {web["max_mass_kg"] for web in machine["webs"]} == {None}


def test_an_engine_with_balance_shafts_and_a_mass_for_each_row(portal: Portal) -> None:
    shafts = {"shafts": "double", "rod": "150 mm", "radius": "60 mm", "shaftRadius": "20 mm", "shaftMost": "1"}
    request = _begin(portal, "vertical", SIX | {"throws": "4", "reciprocating": "0,5; 0,5; 0,51; 0,5"} | shafts)
    assert request["objective"] == {"orders": "all"}
    assert [shaft["speed_ratio"] for shaft in request["machine"]["balance_shafts"]] == [2, -2]
    masses = [throw["rows"][0]["reciprocating_mass_kg"] for throw in request["machine"]["throws"]]
    assert masses == [0.5, 0.5, 0.51, 0.5]


def test_masses_that_may_be_one_or_several_are_asked_about(portal: Portal) -> None:
    portal.open("single-vertical")
    portal.page.click("#new")
    for name, value in (SIX | {"throws": "2", "reciprocating": "1 575", "radius": "60 mm"}).items():
        portal.page.fill(f"#start-{name}", value)
    portal.page.click(".starter button[value=begin]")
    expect(portal.page.locator(".starter .error")).to_have_text(
        "Reciprocating mass of a row kg: one value of 1575, or 2? Write 1575 or 1; 575."
    )
