"""What if: weights as fitted, limits and speed; versions side by side. Every figure is that of the API."""

import re
from pathlib import Path

import pytest
from playwright.sync_api import expect

from tests.browser.portal import Portal, ask, cells, number


def test_what_remains_of_weights_as_fitted(portal: Portal, url: str) -> None:
    portal.open("2d12", ("what-if",))
    panel = portal.panel("what-if")
    panel.get_by_label("mass, kg, 2a, as fitted").fill("50,5")
    panel.get_by_label("angle, °, 1a, as fitted").fill("175")
    expect(panel.locator(".residual")).to_have_attribute("data-of", "[[60,175],[60,180],[50.5,0],[60,0]]")
    request = ask(url, "/v1/examples/2d12")
    weights = [("1a", 60, 175), ("1b", 60, 180), ("2a", 50.5, 0), ("2b", 60, 0)]
    counterweights = [{"web": web, "mass_kg": mass, "angle_deg": angle} for web, mass, angle in weights]
    body = {"machine": request["machine"], "counterweights": counterweights, "outputs": ["residual"]}
    after = ask(url, "/v1/analyze", body)["residual"]["after"]
    rows = cells(panel.locator(".residual"))
    assert number(rows[0][3]) == pytest.approx(after["force"]["peak_N"], rel=1e-4)
    assert number(rows[1][3]) == pytest.approx(after["moment"]["peak_Nm"], rel=1e-4)
    # analytic: the sum of the masses
    assert number(rows[2][3]) == 230.5


def test_weights_of_balance_shafts_are_changed_as_well(portal: Portal, url: str) -> None:
    portal.open("single-balance-shaft", ("what-if",))
    panel = portal.panel("what-if")
    panel.get_by_label("mass, kg, balancer, as fitted").fill("0.5")
    expect(panel.locator(".residual")).to_have_attribute("data-of", re.compile(r"\[0\.5,270\]\]$"))
    request = ask(url, "/v1/examples/single-balance-shaft")
    masses = {"a": 0.72, "b": 0.72, "balancer": 0.5}
    counterweights = [{"web": web, "mass_kg": mass, "angle_deg": 270} for web, mass in masses.items()]
    after = ask(url, "/v1/analyze", {"machine": request["machine"], "counterweights": counterweights})["residual"][
        "after"
    ]
    rows = cells(panel.locator(".residual"))
    assert number(rows[0][3]) == pytest.approx(after["force"]["peak_N"], rel=1e-3)
    # analytic: the sum of the masses, on whichever shaft
    assert number(rows[2][3]) == 1.94
    assert portal.page.locator("#answer h2").first.inner_text().startswith("2.34 kg of counterweights")


def test_a_rounding_is_suggested(portal: Portal) -> None:
    portal.open("2d12", ("what-if",))
    panel = portal.panel("what-if")
    portal.refusals.add(422)
    assert panel.get_by_label("step of angles").input_value() == "5"
    panel.get_by_label("step of masses").fill("2")
    panel.get_by_role("button", name="Suggest a rounding").click()
    panel.get_by_text("Rounded to 2 kg and 5°. The objective rises by").wait_for()
    # independent: whole steps on either side of the optimum
    assert panel.get_by_label("mass, kg, 2a, as fitted").input_value() in ("52", "54")
    assert float(panel.get_by_label("angle, °, 2a, as fitted").input_value()) % 5 == 0
    panel.get_by_label("step of masses").fill("500")
    panel.get_by_role("button", name="Suggest a rounding").click()
    panel.get_by_text("larger than the largest mass of every web").wait_for()


def test_limits_and_speed_are_moved(portal: Portal, url: str) -> None:
    portal.open("2d12", ("what-if",))
    panel = portal.panel("what-if")
    panel.locator("#what-mass").fill("80")
    panel.locator("#what-speed").fill("110")
    request = ask(url, "/v1/examples/2d12")
    request["machine"]["speed_rpm"] = 550
    for web in request["machine"]["webs"]:
        web["max_mass_kg"] = 48
    answer = ask(url, "/v1/optimize", request)
    force = f"{answer['residual']['after']['force']['peak_N']:,.1f}".replace(",", "\u202f")
    panel.locator(".moved").get_by_text(force).wait_for()
    with portal.asking():
        panel.get_by_role("button", name="Take these limits").click()
    machine = portal.bodies("/v1/optimize")[-1]["machine"]
    assert (machine["speed_rpm"], machine["webs"][0]["max_mass_kg"]) == (550, 48)
    assert portal.input("/machine/speed_rpm").input_value() == "550"


def test_versions_stand_side_by_side(portal: Portal) -> None:
    portal.open("v60", ("versions",))
    portal.page.evaluate("localStorage.removeItem('counterweight-versions')")
    panel = portal.panel("versions")
    for name, speed in (("slow", "600"), ("fast", "900")):
        portal.input("/machine/speed_rpm").fill(speed)
        portal.optimise()
        panel.locator("#version-name").fill(name)
        panel.get_by_role("button", name="Keep this version").click()
    panel.get_by_label("compare slow").check()
    results, element = panel.locator(".compared table").all()
    rows = {row[0]: row[1:] for row in cells(results)}
    # the smaller one is marked, and the other says by how much it is above it
    assert [text.partition(" (")[2] for text in rows["peak force, N"]] == ["best)", "+120 %)"]
    slow, fast = (number(text.partition(" (")[0]) for text in rows["peak force, N"])
    # analytic: forces grow with the square of the speed
    assert fast == pytest.approx(2.25 * slow, rel=1e-3)
    assert cells(element) == [["speed", "600", "900"]]
    with portal.page.expect_download() as download:
        panel.get_by_role("button", name="Export all").click()
    panel.get_by_role("button", name="Remove slow").click()
    expect(panel.locator(".versions li")).to_have_count(1)
    panel.locator("#version-file").set_input_files(Path(download.value.path()))
    expect(panel.locator(".versions li")).to_have_count(2)
    with portal.asking():
        panel.get_by_role("button", name="Open slow").click()
    assert portal.bodies("/v1/optimize")[-1]["machine"]["speed_rpm"] == 600


def test_what_is_on_a_balance_shaft_is_fitted_and_rounded(portal: Portal, url: str) -> None:
    portal.open("single-balance-shaft", ("what-if",))
    panel = portal.panel("what-if")
    panel.get_by_label("step of masses").fill("0.2")
    panel.get_by_role("button", name="Suggest a rounding").click()
    panel.get_by_text("Rounded to 0.2 kg and 5°").wait_for()
    request = portal.bodies("/v1/round")[-1]
    answer = ask(url, "/v1/round", request)
    (on_shaft,) = answer["balance_shafts"][0]["counterweights"]
    text = panel.get_by_label(f"mass, kg, {on_shaft['web']}, as fitted").input_value()
    assert float(text) == on_shaft["mass_kg"]
    after = answer["residual"]["after"]
    panel.get_by_label(f"mass, kg, {on_shaft['web']}, as fitted").press("End")
    rows = cells(panel.locator(".residual"))
    assert number(rows[0][3]) == pytest.approx(after["force"]["peak_N"], rel=1e-3, abs=1e-3)
    assert number(rows[2][3]) == pytest.approx(answer["total_mass_kg"] + answer["balance_shafts_mass_kg"], rel=1e-4)
