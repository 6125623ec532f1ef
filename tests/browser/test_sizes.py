"""Standard sizes that counterweights are chosen from, and how the page words what is not closed to the bound."""

import json

from tests.browser.portal import Portal, ask


def test_standard_sizes_hold_step_list_sizes_and_pieces(portal: Portal) -> None:
    portal.open("2d12")
    portal.page.get_by_role("button", name="Add standard sizes").click()
    group = portal.page.locator("#form details[data-pointer='/machine/catalogue']")
    names = group.locator("label").all_text_contents()
    assert [name.removesuffix(" kg").removesuffix(" deg") for name in names] == [
        "Step of the sizes",
        "or a list of sizes",
        "Step of the angles",
        "Number of sizes",
        "Number of pieces",
    ]
    values = {"catalogue/mass_step_kg": "5", "catalogue/angle_step_deg": "30", "max_counterweights": "2"}
    for name, value in (values | {"catalogue/max_part_numbers": "1"}).items():
        portal.input(f"/machine/{name}").fill(value)
    portal.optimise()
    machine = portal.bodies("/v1/optimize")[-1]["machine"]
    assert machine["catalogue"] == {"mass_step_kg": 5, "angle_step_deg": 30, "max_part_numbers": 1}
    assert machine["max_counterweights"] == 2
    # once the sizes are gone the pieces stand in the machine again, once
    group.get_by_role("button", name="Remove standard sizes").click()
    assert portal.input("/machine/max_counterweights").count() == 1


def test_one_gap_is_told_and_nothing_is_proved_beside_it(portal: Portal, url: str) -> None:
    portal.open("catalogue-twin")
    answer = ask(url, "/v1/optimize", portal.bodies("/v1/optimize")[-1])
    words = portal.page.locator(".proof").inner_text()
    assert words.count("gap is") == 1
    assert "proved" not in words
    assert "Found" not in words
    # independent: the gap of the certificate, in per cent
    part = words.partition("gap is ")[2].partition(" %")[0]
    gap = 100 * answer["certificate"]["relative_gap"]
    assert part == "0" if gap <= 0 else float(part.removeprefix("less than ")) >= 0.99 * gap
    # what counterweights cost is no part of the objective: it is told of force and moment alone
    goals = [{"goal": "external", "allowance": 0.01}, {"goal": "pieces"}, {"goal": "mass"}]
    request = {"machine": portal.bodies("/v1/optimize")[-1]["machine"], "objective": {"priorities": goals}}
    portal.page.locator("#paste > summary").click()
    portal.page.fill("#json", json.dumps(request))
    with portal.asking():
        portal.page.click("#read")
    assert "can bring the weighted peaks of force and moment below" in portal.page.locator(".proof").inner_text()
