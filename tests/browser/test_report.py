"""The report from the page: what its head says, the versions that it compares, the name of its file."""

from pathlib import Path

import pytest
from playwright.sync_api import expect

from tests.browser.portal import Portal


@pytest.fixture
def portal(visit: Portal) -> Portal:
    """A tab that has no head yet, which it keeps."""
    return visit


def test_the_head_and_the_versions_are_given_on_the_page(portal: Portal) -> None:
    portal.open("v60", ("versions",))
    portal.page.evaluate("localStorage.removeItem('counterweight-versions')")
    panel = portal.panel("versions")
    panel.locator("#version-name").fill("slow")
    panel.get_by_role("button", name="Keep this version").click()
    portal.input("/machine/speed_rpm").fill("900")
    portal.optimise()
    head = portal.page.locator("#answer .document")
    head.locator("> summary").click()
    office = {"company": "Weber Compressors", "customer": "Nordic Air", "approver": "L. Berg"}
    revisions = "A; 2026-10-01; first issue; M. Weber\nB; 2026-11-23; counterweights as cast"
    document = {"number": "K-1047", "revision": "B", "author": "M. Weber", "notes": "For approval."} | office
    for name, text in (document | {"revisions": revisions}).items():
        head.locator(f"#document-{name}").fill(text)
    head.get_by_label("slow").check()
    expect(head.locator("> summary")).to_have_text("Head of the report: K-1047, revision B; compared with slow")
    with portal.page.expect_download() as download:
        portal.page.locator("#answer").get_by_role("button", name="HTML").click()
    assert "K-1047" in download.value.suggested_filename
    content = Path(download.value.path()).read_text()
    for words in ("M. Weber", "For approval.", "slow", *office.values(), "counterweights as cast"):
        assert words in content
    (body,) = portal.bodies("/v1/report")
    assert body["document"]["revision"] == "B"
    assert [revision["revision"] for revision in body["document"]["revisions"]] == ["A", "B"]
    # the day where the reader is
    assert body["document"]["date"] == portal.page.evaluate("new Date().toLocaleDateString('sv-SE')")
    (version,) = body["versions"]
    assert (version["name"], version["machine"]["speed_rpm"] != 900) == ("slow", True)
    # of the tab: there after a reload, and said beside the buttons
    portal.page.reload()
    portal.drawn(1)
    expect(portal.page.locator("#answer .document > summary")).to_have_text("Head of the report: K-1047, revision B")
    portal.page.evaluate("localStorage.removeItem('counterweight-versions')")


def test_what_the_head_may_not_hold_is_said(portal: Portal) -> None:
    portal.refusals = {422}
    portal.open("v60")
    portal.page.locator("#answer .document > summary").click()
    portal.page.fill("#document-notes", "n" * 4001)
    portal.page.locator("#answer").get_by_role("button", name="PDF").click()
    expect(portal.page.locator("#answer .report [role=status]")).to_contain_text("notes: ")
