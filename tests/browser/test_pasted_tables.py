"""Tables that are pasted find their place: bearings and fitted weights have one, and the wrong table is refused."""

from typing import Any

from playwright.sync_api import expect

from tests.browser.portal import Portal

BEARINGS = "Bearing;Position (mm);Diameter (mm)\nA;-400,5;180\nB;0;180\nC;400,5;180\n"
READ = [("A", "-400.5 mm", "180 mm"), ("B", "0 mm", "180 mm"), ("C", "400.5 mm", "180 mm")]


def _request(portal: Portal) -> Any:
    portal.optimise()
    return portal.bodies("/v1/optimize")[-1]


def _bearings(request: Any) -> list[tuple[str, str, str]]:
    return [
        (bearing["name"], bearing["position_m"], bearing["diameter_m"]) for bearing in request["machine"]["bearings"]
    ]


def test_bearings_pasted_beside_the_form_leave_the_throws(portal: Portal) -> None:
    portal.open("v60")
    before = portal.bodies("/v1/optimize")[-1]["machine"]
    portal.paste("body", BEARINGS)
    expect(portal.page.locator("#progress")).to_have_text("Pasted: 3 bearings. Press Optimise.")
    request = _request(portal)
    assert _bearings(request) == READ
    assert [request["machine"][name] for name in ("throws", "webs")] == [before[name] for name in ("throws", "webs")]


def test_bearings_pasted_into_throws_are_refused_with_their_place(portal: Portal) -> None:
    portal.open("v60")
    before = portal.bodies("/v1/optimize")[-1]["machine"]
    portal.paste("#form .grid-throw .wide", BEARINGS)
    element = portal.page.locator("#form .grid-throw .said")
    expect(element).to_contain_text("This is a table of main bearings: nothing was pasted here.")
    assert _request(portal)["machine"] == before
    portal.paste("#form .grid-throw .wide", BEARINGS)
    element.get_by_role("button", name="Paste it into the main bearings").click()
    expect(portal.page.locator("#form .grid-bearing tbody tr")).to_have_count(3)
    request = _request(portal)
    assert _bearings(request) == READ
    assert request["machine"]["throws"] == before["throws"]


def test_the_head_of_a_table_gives_names(portal: Portal) -> None:
    portal.open("2d12")
    portal.unfold("/machine/bearings")
    for kind, table in (("throw", "throws"), ("web", "webs"), ("bearing", "bearings")):
        text = f"{kind.title()}\tposition\ndrive end\t0,45\nfree end\t-0,45\n"
        portal.paste(f"#form .grid-{kind} .wide", text)
        items = _request(portal)["machine"][table][:2]
        assert [(bearing["name"], bearing["position_m"]) for bearing in items] == [
            ("drive end", 0.45),
            ("free end", -0.45),
        ]
        assert portal.page.locator(f"#form .grid-{kind} .said").inner_text() == ""


def test_fitted_weights_are_a_table(portal: Portal) -> None:
    portal.open("2d12", ("foundation",))
    portal.paste("body", "Web\tMass (kg)\tAngle (deg)\n1a\t30,5\t170\n2b\t25\t10\n")
    expect(portal.page.locator("#progress")).to_have_text("Pasted: 2 weights. Press Optimise.")
    assert _request(portal)["fitted"] == [
        {"web": "1a", "mass_kg": 30.5, "angle_deg": 170},
        {"web": "2b", "mass_kg": 25, "angle_deg": 10},
    ]
    assert "as built" in portal.panel("foundation").inner_text()


def test_names_and_planes_alone_are_bearings_unless_a_title_says_otherwise(portal: Portal) -> None:
    portal.open("2d12")
    before = portal.bodies("/v1/optimize")[-1]["machine"]
    for title, place in (("", "bearings"), ("Main bearings\n", "bearings"), ("Webs\n", "webs")):
        portal.paste("body", f"{title}Name\tPosition (mm)\nD\t-410\nE\t410\n")
        expect(portal.page.locator("#progress")).to_have_text(f"Pasted: 2 {place}. Press Optimise.")
        machine = _request(portal)["machine"]
        assert [part["name"] for part in machine[place]][:2] == ["D", "E"]
        # all else is as it was
        assert {**machine, place: before[place]} == before
        portal.page.click("#undo")


def test_two_machines_and_ten_thousand_lines_are_refused(portal: Portal) -> None:
    portal.open("2d12")
    before = portal.bodies("/v1/optimize")[-1]["machine"]
    webs = "Web\tposition\tcounterweight radius\nx\t0\t0,3\n"
    portal.paste("body", f"{webs}\n{webs}")
    expect(portal.page.locator("#progress")).to_contain_text(
        "There are two tables of webs: paste one machine at a time."
    )
    portal.page.click("#undo")
    portal.paste("#form .grid-web .wide", "Web\tposition\n" + "x\t0\n" * 10_000)
    element = portal.page.locator("#form .grid-web .said")
    expect(element).to_contain_text(
        "10000 lines are more than the 500 webs that a machine may have: nothing was pasted."
    )
    assert _request(portal)["machine"] == before


GERMAN = "Web;Position (mm);counterweight radius (mm);max mass\nA;-1.450,5;180;12,5\nB;1.450,5;180;12,5\n"
POSITIONS = {
    GERMAN: ["-1450.5 mm", "1450.5 mm"],
    # a decimal comma anywhere in a table makes a point one that groups
    "Web;Position (mm);max mass\nA;-1.450;12,5\nB;1.450;12,5\n": ["-1450 mm", "1450 mm"],
    "Web,Position (mm),max mass\nA,-1450.5,12.5\nB,1450.5,12.5\n": ["-1450.5 mm", "1450.5 mm"],
    'Web,Position (mm),max mass\nA,"-1,450",12.5\nB,"1,450",12.5\n': ["-1450 mm", "1450 mm"],
}


def test_numbers_of_a_table_are_read_by_the_mark_that_it_has(portal: Portal) -> None:
    portal.open("2d12")
    for text, positions in POSITIONS.items():
        portal.paste("body", text)
        expect(portal.page.locator("#progress")).to_have_text("Pasted: 2 webs. Press Optimise.")
        webs = _request(portal)["machine"]["webs"][:2]
        assert [web["position_m"] for web in webs] == positions
        assert [web["max_mass_kg"] for web in webs] == [12.5, 12.5]
        # as the machine was before
        portal.page.click("#undo")


def test_a_comma_that_may_group_is_asked_about(portal: Portal) -> None:
    portal.open("2d12")
    portal.paste("body", "Web\tmax mass\nA\t1,125\nB\t1,250\n")
    element = portal.page.locator("#form .grid-web .question")
    expect(element).to_contain_text("max mass: 1,125 is read as 1.125.")
    assert [web["max_mass_kg"] for web in _request(portal)["machine"]["webs"][:2]] == [1.125, 1.25]
    element.get_by_role("button", name="1125 meant").click()
    assert [web["max_mass_kg"] for web in _request(portal)["machine"]["webs"][:2]] == [1125, 1250]
    # what the page prints it reads: thousands stand apart
    portal.input("/machine/speed_rpm").fill("1\u202f125,5")
    assert _request(portal)["machine"]["speed_rpm"] == 1125.5


def test_an_empty_column_takes_nothing_away(portal: Portal) -> None:
    portal.open("2d12")
    before = portal.bodies("/v1/optimize")[-1]["machine"]["webs"]
    portal.paste("#form .grid-web .wide", "Web\tmax mass\t\tcounterweight radius\nA\t12\t\t\nB\t13\t\t\n")
    expect(portal.page.locator("#form .grid-web .said")).to_contain_text("Nothing stands under “counterweight radius”")
    after = _request(portal)["machine"]["webs"]
    assert [web["max_mass_kg"] for web in after[:2]] == [12, 13]
    assert [web["counterweight_radius_m"] for web in after] == [web["counterweight_radius_m"] for web in before]


def test_a_pressure_pasted_into_a_table_is_refused_with_its_place(portal: Portal) -> None:
    portal.open("v60")
    before = portal.bodies("/v1/optimize")[-1]["machine"]
    portal.paste(
        "#form .grid-web .wide", "angle\tpressure\n" + "".join(f"{20 * k}\t{1.5 + k % 3}\n" for k in range(18))
    )
    element = portal.page.locator("#form .grid-web .said")
    expect(element).to_contain_text("This is a pressure over the angle: nothing was pasted here.")
    element.get_by_role("button", name="Paste it into the indicated pressure").click()
    expect(portal.page.locator("#form .gas .said")).to_contain_text("18 lines: one revolution, 1.5 to 3.5 bar")
    assert _request(portal)["machine"] == before


def test_a_table_is_dropped_as_a_file(portal: Portal) -> None:
    portal.open("2d12")
    portal.page.locator("body").evaluate(
        """(node, text) => {
          const dataTransfer = new DataTransfer();
          dataTransfer.items.add(new File([text], "webs.csv", { type: "text/csv" }));
          node.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
        }""",
        GERMAN,
    )
    expect(portal.page.locator("#progress")).to_have_text("Pasted: 2 webs. Press Optimise.")
