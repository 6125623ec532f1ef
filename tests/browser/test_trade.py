"""Trade-offs and versions with all that was weighed or limited, and headlines that hide nothing."""

from typing import Any

import pytest

from tests.browser.portal import Portal, ask, cells, number
from tests.night import at_night


def _weigh(portal: Portal, **values: str) -> None:
    portal.unfold("/objective")
    for name, value in values.items():
        portal.input(f"/objective/{name}").fill(value)
    portal.optimise()


def test_force_and_moment_are_traded_with_a_bearing_weight(portal: Portal, url: str) -> None:
    portal.open("2d12")
    _weigh(portal, bearing_weight="1")
    panel = portal.open_panel("pareto")
    assert panel.locator(".error:not(:empty)").count() == 0
    panel.get_by_text("Point, from least force to least moment").wait_for()
    # independent: weights play no part in a front
    body = ask(url, "/v1/examples/2d12")
    body = {name: value for name, value in body.items() if name not in ("angles", "fidelity")}
    points = ask(url, "/v1/pareto", body | {"points": 21})["fronts"][0]["points"]
    panel.locator("#pareto-point").press("Home")
    panel.get_by_role("heading", name=f"Point 1 of {len(points)}").wait_for()


def test_three_responses_are_traded_by_name(portal: Portal, url: str) -> None:
    portal.open("2d12")
    _weigh(portal, bearing_weight="1")
    panel = portal.open_panel("pareto")
    panel.locator("#trade-z").select_option("bearings")
    panel.locator("[role=img][aria-label*='largest bearing load, N']").wait_for()
    body = portal.bodies("/v1/pareto")[-1]
    assert body["responses"] == ["force", "moment", "bearings"]
    points = ask(url, "/v1/pareto", body)["trades"][0]["points"]
    panel.locator("#pareto-point").press("Home")
    panel.get_by_role("heading", name=f"Point 1 of {len(points)}").wait_for()
    numbers = [number(text) for text in cells(panel.locator(".picked table").first)[0][:3]]
    assert numbers == pytest.approx(points[0]["values"], rel=1e-4)
    portal.page.wait_for_url("**trade=force,moment,bearings*")


def test_what_cannot_be_traded_leaves_the_choice(portal: Portal) -> None:
    portal.refusals = {422}
    portal.open("2d12", ("pareto",))
    portal.page.route(
        "**/v1/pareto",
        lambda route: route.fulfill(
            status=422, content_type="application/problem+json", body='{"title": "Refused", "detail": "No such front."}'
        ),
    )
    panel = portal.panel("pareto")
    panel.locator("#trade-y").select_option("mass")
    panel.get_by_text("No such front.").wait_for()
    portal.page.unroute("**/v1/pareto")
    panel.locator("#trade-y").select_option("moment")
    panel.get_by_text("Point, from least force to least moment").wait_for()


def test_versions_show_every_response_that_was_weighed(portal: Portal, url: str) -> None:
    portal.open("2d12", ("versions",))
    portal.page.evaluate("localStorage.removeItem('counterweight-versions')")
    panel = portal.panel("versions")
    answers: list[Any] = []
    for name, weight in (("light", "0.1"), ("heavy", "10")):
        _weigh(portal, bearing_weight=weight)
        answers.append(ask(url, "/v1/optimize", portal.bodies("/v1/optimize")[-1]))
        panel.locator("#version-name").fill(name)
        panel.get_by_role("button", name="Keep this version").click()
    panel.get_by_label("compare light").check()
    rows = {row[0]: row[1:] for row in cells(panel.locator(".compared table").first)}
    for title, largest in (
        ("peak bearing load, N", lambda subject: max(bearing["after"]["peak_N"] for bearing in subject["bearings"])),
        ("peak bending moment, N m", lambda subject: max(subject["bending"]["after_Nm"])),
    ):
        values = [largest(answer["main_bearings"]) for answer in answers]
        assert [number(text.partition(" (")[0]) for text in rows[title]] == pytest.approx(values, rel=1e-4)
        marks = [text.endswith("(best)") for text in rows[title]]
        assert marks == [figure == min(values) for figure in values]


def test_the_headline_says_what_rises_from_nothing(portal: Portal) -> None:
    # analytic: two throws at a half turn leave no force, which a counterweight for bearings brings back
    portal.open("two-rows-180")
    machine = portal.bodies("/v1/optimize")[-1]["machine"]
    row = {"axis_deg": 0, "reciprocating_mass_kg": 10, "connecting_rod": {"length_m": 0.5, "mass_kg": 4}}
    throws = [
        {
            "name": str(n),
            "position_m": 0.2 * n,
            "crank_radius_m": 0.1,
            "crank_angle_deg": 180 * n,
            "rotating_mass_kg": 8,
        }
        for n in (0, 1)
    ]
    request = {
        "machine": {
            "kind": "reciprocating",
            "speed_rpm": machine["speed_rpm"],
            "throws": [throw | {"rows": [row]} for throw in throws],
            "webs": [{"name": "a", "position_m": -0.05, "counterweight_radius_m": 0.2, "max_mass_kg": 10}],
        },
        "objective": {"force_weight": 0},
    }
    with portal.asking():
        portal.page.evaluate("one => { document.getElementById('json').value = JSON.stringify(one); }", request)
        portal.page.locator("#paste").evaluate("one => { one.open = true; }")
        portal.page.click("#read")
    answer = ask(portal.url, "/v1/optimize", request)
    headline = portal.page.locator("#answer h2").inner_text()
    assert answer["residual"]["after"]["force"]["peak_N"] > 100
    assert headline.startswith(f"{answer['total_mass_kg']:.5g} kg of counterweights: force 0 → ")
    assert "moment −" in headline


def test_where_something_may_be_off_the_worst_case_is_traded(portal: Portal, url: str) -> None:
    portal.open("two-rows-180")
    portal.page.locator("#form").get_by_role("button", name="Add tolerances").click()
    portal.unfold("/tolerances")
    portal.input("/tolerances/mass_relative").fill("0.05")
    portal.optimise()
    panel = portal.open_panel("pareto")
    panel.locator("[role=img][aria-label*='peak force in the worst case, N']").wait_for()
    points = ask(url, "/v1/pareto", portal.bodies("/v1/pareto")[-1])["fronts"][0]["points"]
    panel.locator("#pareto-point").press("Home")
    panel.get_by_role("heading", name=f"Point 1 of {len(points)}").wait_for()
    numbers = [number(text) for text in cells(panel.locator(".picked table").first)[0][:2]]
    worst = points[0]["worst_case"]
    assert numbers == pytest.approx([worst["force_peak_N"], worst["moment_peak_Nm"]], rel=1e-4)
    assert worst["moment_peak_Nm"] > 1.001 * points[0]["moment_peak_Nm"]


@at_night
def test_of_several_scenarios_the_worst_is_traded(portal: Portal, url: str) -> None:
    portal.open("two-rows-180")
    portal.unfold("/scenarios")
    portal.page.locator("#form").get_by_role("button", name="Add scenario").click()
    portal.unfold("/scenarios/0", "/scenarios/0/changes")
    portal.input("/scenarios/0/name").fill("fast")
    portal.page.locator("#form").get_by_role("button", name="Add change").click()
    portal.unfold("/scenarios/0/changes/0")
    portal.input("/scenarios/0/changes/0/path").fill("/machine/speed_rpm")
    portal.input("/scenarios/0/changes/0/value").fill("700")
    portal.optimise()
    panel = portal.open_panel("pareto")
    panel.locator("[role=img][aria-label*='peak force in the worst case, N']").wait_for()
    body = portal.bodies("/v1/pareto")[-1]
    points = ask(url, "/v1/pareto", body)["fronts"][0]["points"]
    panel.locator("#pareto-point").press("Home")
    panel.get_by_role("heading", name=f"Point 1 of {len(points)}").wait_for()
    numbers = [number(text) for text in cells(panel.locator(".picked table").first)[0][:2]]
    # analytic: forces are as the squares of the speeds
    force_peaks_N = [points[0]["force_peak_N"], points[0]["moment_peak_Nm"]]
    times = (700.0 / body["machine"]["speed_rpm"]) ** 2
    assert numbers == pytest.approx([times * peak for peak in force_peaks_N], rel=1e-4, abs=1e-4)


def test_points_show_what_balance_shafts_carry(portal: Portal, url: str) -> None:
    portal.open("single-balance-shaft")
    panel = portal.open_panel("pareto")
    panel.locator("#trade-y").select_option("mass")
    panel.get_by_text("Point, from least force to least mass").wait_for()
    body = portal.bodies("/v1/pareto")[-1]
    points = ask(url, "/v1/pareto", body)["trades"][0]["points"]
    panel.locator("#pareto-point").press("Home")
    panel.get_by_role("heading", name=f"Point 1 of {len(points)}").wait_for()
    panel.get_by_text("Balance shaft balancer: Turns against the crankshaft").wait_for()
    tables = panel.locator(".picked .beside table")
    masses = [sum(number(row[1]) for row in cells(table)) for table in (tables.nth(0), tables.nth(1))]
    expected = [points[0]["total_mass_kg"], points[0]["balance_shafts_mass_kg"]]
    assert masses == pytest.approx(expected, rel=1e-3)
    assert "roll" in panel.locator("#trade-y option").evaluate_all("all => all.map((each) => each.value)")


def test_named_responses_are_those_of_the_worst_case(portal: Portal, url: str) -> None:
    portal.open("two-rows-180")
    portal.page.locator("#form").get_by_role("button", name="Add tolerances").click()
    portal.unfold("/tolerances")
    portal.input("/tolerances/mass_relative").fill("0.05")
    portal.optimise()
    panel = portal.open_panel("pareto")
    panel.locator("#trade-y").select_option("mass")
    panel.locator("[role=img][aria-label*='peak force in the worst case, N']").wait_for()
    assert panel.locator("[role=img][aria-label*='mass in the worst']").count() == 0
    body = portal.bodies("/v1/pareto")[-1]
    assert body["responses"] == ["force", "mass"]
    points = ask(url, "/v1/pareto", body)["trades"][0]["points"]
    panel.locator("#pareto-point").press("Home")
    panel.get_by_role("heading", name=f"Point 1 of {len(points)}").wait_for()
    numbers = [number(text) for text in cells(panel.locator(".picked table").first)[0][:2]]
    assert numbers == pytest.approx(points[0]["values"], rel=1e-4)
    assert points[0]["values"][0] > 1.0001 * points[0]["nominal_values"][0]
