"""A service with keys: the page asks once, keeps the key in its tab, and shows it to nobody."""

import pytest
from playwright.sync_api import Route, expect

from tests.browser.portal import Portal

KEY = "cw_something-secret"
PROBLEM = '{"type": "/problems/unauthorized", "title": "Unauthorized", "status": 401, "detail": "Give a key."}'


@pytest.fixture
def portal(visit: Portal) -> Portal:
    """A tab without a key."""
    return visit


def _guard(route: Route) -> None:
    headers = route.request.headers
    if headers.get("authorization") == f"Bearer {KEY}":
        route.continue_()
    else:
        route.fulfill(status=401, content_type="application/problem+json", body=PROBLEM)


def test_the_key_is_asked_for_once(portal: Portal) -> None:
    portal.refusals = {401}
    page = portal.page
    page.route("**/v1/**", _guard)
    page.goto(f"{portal.url}/#example=2d12&open=counterweights")
    box = page.get_by_role("dialog")
    box.wait_for()
    assert "Give a key." in box.inner_text()
    page.fill("#key", "wrong")
    with page.expect_response(lambda answer: answer.request.headers.get("authorization") == "Bearer wrong"):
        page.get_by_role("button", name="Use it in this tab").click()
    # the dialog of before is gone: this is the next one
    expect(page.locator("#key")).to_have_value("")
    page.fill("#key", KEY)
    page.get_by_role("button", name="Use it in this tab").click()
    portal.drawn(1)
    assert page.get_by_role("dialog").count() == 0
    portal.panel("counterweights").get_by_role("button", name="Copy as curl or Python").click()
    for language in ("curl", "python"):
        code = page.locator(f"#call-{language}").input_value()
        assert "COUNTERWEIGHT_KEY" in code
        assert KEY not in code
    page.get_by_role("button", name="Close").click()
    assert KEY not in page.url
    page.reload()
    portal.drawn(1)
    # asked no more
    assert page.get_by_role("dialog").count() == 0


def test_without_a_key_the_refusal_is_shown(portal: Portal) -> None:
    portal.refusals = {401}
    portal.page.route("**/v1/**", _guard)
    portal.page.goto(portal.url)
    portal.page.get_by_role("button", name="Cancel").click()
    expect(portal.page.locator("#problem")).to_contain_text("Unauthorized")
    expect(portal.page.get_by_role("dialog")).to_have_count(0)
