"""The link keeps what is seen, and the calls behind it can be taken away."""

import subprocess
import sys
from pathlib import Path

import pytest

from tests.browser.portal import Portal, ask


def test_the_link_keeps_an_edited_machine_and_its_panels(portal: Portal) -> None:
    portal.open("v60")
    portal.unfold("/machine")
    portal.input("/machine/speed_rpm").fill("777 rpm")
    portal.optimise()
    portal.open_panel("orders")
    portal.page.wait_for_url("**#r=*open=*orders*")
    link = portal.page.url
    portal.page.goto("about:blank")
    portal.page.goto(link)
    portal.drawn(1)
    portal.unfold("/machine")
    assert portal.input("/machine/speed_rpm").input_value() == "777 rpm"
    assert portal.panel("orders").get_attribute("open") is not None
    assert portal.panel("hodographs").get_attribute("open") is None


def test_examples_have_short_links(portal: Portal) -> None:
    portal.open("w60")
    portal.page.wait_for_url("**#example=w60*")


def test_a_broken_link_says_so_and_begins_anew(portal: Portal) -> None:
    for fragment in ("#r=%%%", "#r=AAAA"):
        portal.page.goto("about:blank")
        portal.page.goto(f"{portal.url}/{fragment}")
        portal.page.get_by_text("The machine in this link cannot be read.").wait_for()
        assert portal.page.locator("#example").input_value() == ""
        assert portal.page.locator("#form .grid-throw tbody tr").count() == 0


def _code(portal: Portal, panel: str, language: str) -> str:
    portal.panel(panel).get_by_role("button", name="Copy as curl or Python").click()
    code = portal.page.locator(f"#call-{language}").input_value()
    portal.page.get_by_role("button", name="Close").click()
    return code


def test_the_python_behind_a_panel_runs(portal: Portal) -> None:
    portal.open("2d12", ("torque",))
    code = _code(portal, "torque", "python") + "print(answer['torque']['mean_torque_Nm'])"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=180, check=True)
    text = portal.panel("torque").locator("tbody th").inner_text()
    assert f"{float(ran.stdout):,.0f}".replace(",", "\u202f") == text


def test_the_curl_behind_a_panel_runs(portal: Portal, url: str) -> None:
    portal.open("single-vertical")
    ran = subprocess.run(
        ["bash", "-c", _code(portal, "counterweights", "curl")], capture_output=True, timeout=180, check=True
    )
    answer = ask(url, "/v1/optimize", ask(url, "/v1/examples/single-vertical"))
    assert f'"total_mass_kg":{answer["total_mass_kg"]}'.encode() in ran.stdout


@pytest.mark.parametrize(("format_", "begins"), [("HTML", b"<!doctype html>"), ("PDF", b"%PDF-")])
def test_the_report_is_saved(portal: Portal, format_: str, begins: bytes) -> None:
    portal.open("2d12")
    with portal.page.expect_download() as download:
        portal.page.locator("#answer").get_by_role("button", name=format_).click()
    content = Path(download.value.path()).read_bytes()
    assert content[:20].lower().startswith(begins.lower())
    outputs = portal.bodies("/v1/report")[0]["outputs"]
    assert {"torque", "main_bearings", "flywheel"} <= set(outputs)
