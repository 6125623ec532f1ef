"""Nothing that was typed is lost: undone, done again, reloaded, left with Back, saved, offered again."""

import json
from pathlib import Path

from playwright.sync_api import expect

from tests.browser.portal import Portal

SPEED = "/machine/speed_rpm"
RADIUS = "/machine/throws/0/crank_radius_m"


def test_a_reload_keeps_what_was_typed(portal: Portal) -> None:
    portal.open("two-rows-180")
    portal.input(SPEED).fill("777")
    portal.input(RADIUS).fill("99 mm")
    # at once: neither link nor session has been written by a timer
    portal.page.reload()
    portal.page.wait_for_selector(f"#form .field[data-pointer='{SPEED}']")
    assert portal.input(SPEED).input_value() == "777"
    assert portal.input(RADIUS).input_value() == "99 mm"


def test_everything_is_undone_and_done_again(visit: Portal) -> None:
    portal = visit
    portal.open("two-rows-180")
    before = portal.input(SPEED).input_value()
    portal.input(SPEED).press("End")
    portal.input(SPEED).press_sequentially("00")
    portal.page.locator("#form .grid-web").get_by_role("button", name="Remove web 1a").click()
    webs = portal.page.locator("#form .grid-web tbody tr")
    few = webs.count()
    portal.page.select_option("#example", "w60")
    expect(portal.page.locator("#form .grid-throw tbody tr")).to_have_count(1)
    portal.page.click("#undo")
    expect(webs).to_have_count(few)
    assert portal.page.locator("#form .grid-throw tbody tr").count() == 2
    portal.page.click("#undo")
    expect(webs).to_have_count(few + 1)
    # two key strokes in one field are one edit; by the keyboard as well
    portal.input(SPEED).press("Control+z")
    assert portal.input(SPEED).input_value() == before
    assert portal.page.locator("#undo").is_disabled()
    for _ in range(2):
        portal.page.keyboard.press("Control+y")
    assert portal.input(SPEED).input_value() != before
    assert webs.count() == few
    portal.optimise()
    assert str(portal.bodies("/v1/optimize")[-1]["machine"]["speed_rpm"]).endswith("00")


def test_back_leads_to_the_machine_that_was_left(portal: Portal) -> None:
    portal.open("two-rows-180")
    portal.input(SPEED).fill("777")
    portal.page.select_option("#example", "w60")
    portal.page.wait_for_url("**#example=w60*")
    portal.page.go_back()
    portal.page.wait_for_url("**#r=*")
    expect(portal.input(SPEED)).to_have_value("777")
    portal.page.go_forward()
    portal.page.wait_for_url("**#example=w60*")
    expect(portal.page.locator("#example")).to_have_value("w60")


def test_a_machine_is_saved_and_opened(portal: Portal) -> None:
    portal.open("two-rows-180")
    portal.input("/machine/name").fill("Nr. 7/b")
    with portal.page.expect_download() as download:
        portal.page.click("#save")
    assert download.value.suggested_filename == "Nr.-7-b.machine.json"
    content = Path(download.value.path()).read_text()
    assert json.loads(content)["machine"]["name"] == "Nr. 7/b"
    portal.input("/machine/name").fill("another")
    portal.page.set_input_files("#file", download.value.path())
    expect(portal.input("/machine/name")).to_have_value("Nr. 7/b")


def test_leaving_with_unanswered_edits_is_asked_about(visit: Portal) -> None:
    portal = visit
    portal.open("two-rows-180")
    portal.input(SPEED).fill("777")
    with portal.page.expect_event("dialog") as info:
        portal.page.once("dialog", lambda dialog: dialog.dismiss())
        portal.page.close(run_before_unload=True)
    assert info.value.type == "beforeunload"
    portal.optimise()
    assert portal.bodies("/v1/optimize")[-1]["machine"]["speed_rpm"] == 777


def test_unfinished_work_is_offered_in_another_tab(visit: Portal) -> None:
    portal = visit
    portal.open("two-rows-180")
    portal.input("/machine/name").fill("unfinished")
    # kept with the link
    portal.page.wait_for_url("**#r=*")
    portal.page.reload()
    expect(portal.input("/machine/name")).to_have_value("unfinished")
    page = portal.page.context.new_page()
    try:
        page.goto(f"{portal.url}/")
        page.get_by_text("unfinished").wait_for()
        page.get_by_role("button", name="Go on with it").click()
        expect(page.locator("#form .field[data-pointer='/machine/name'] input")).to_have_value("unfinished")
        expect(page.locator("#recover")).to_be_hidden()
    finally:
        page.close()
