"""Back, while something has not come yet: whatever comes late is written into no place that one went to."""

from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from playwright.sync_api import Route, expect

from tests.browser.portal import POLLING_MS, Portal

SPEED = "/machine/speed_rpm"
LEFT, GONE_TO, LATE = "w60", "two-rows-180", "v60"
#: in the page: what is written into the history from now on, beside what is in the address
_WATCH = """() => {
  globalThis.written = [];
  for (const name of ["pushState", "replaceState"]) {
    const own = history[name].bind(history);
    history[name] = (state, title, link) => {
      written.push([name, location.hash, link]);
      own(state, title, link);
    };
  }
}"""
#: in the page: links that are packed wait until one leaves, and are there between popstate and hashchange
_HOLD_LINKS = """() => {
  const own = Blob.prototype.arrayBuffer;
  const held = new Promise((resolve) => addEventListener("popstate", resolve, { once: true }));
  globalThis.packing = 0;
  Blob.prototype.arrayBuffer = async function () {
    const content = await own.call(this);
    packing += 1;
    await held;
    return content;
  };
}"""
#: in the page: whether all is drawn that was asked for
_DRAWN = """() => {
  const { asked, drawn } = document.getElementById("results").dataset;
  return asked === drawn;
}"""
#: in the page: whatever follows at once has happened
_SETTLED = "() => new Promise((resolve) => setTimeout(() => setTimeout(resolve)))"


@contextmanager
def held(portal: Portal, path: str) -> Iterator[list[Route]]:
    """What is asked for at a path and waits until it is let go; at the end it no longer does."""
    routes: list[Route] = []
    pattern = f"{portal.url}{path}"
    portal.page.route(pattern, lambda route: routes.append(route))
    yield routes
    portal.page.unroute(pattern)


def come(portal: Portal, routes: list[Route]) -> None:
    """Let it go on, and wait until the page has made of it whatever it does."""
    [route] = routes
    with portal.page.expect_response(route.request.url) as answered:
        route.continue_()
    answered.value.finished()
    portal.page.evaluate(_SETTLED)


def wait_for_request(portal: Portal, routes: list[Route]) -> None:
    while not routes:
        portal.page.wait_for_timeout(10)


@pytest.fixture
def portal(visit: Portal) -> Portal:
    """A history of its own, whose functions are replaced."""
    return visit


@pytest.fixture
def two_places(portal: Portal) -> Portal:
    """A page that has been at two examples, of which the second is shown."""
    portal.open(GONE_TO)
    portal.page.wait_for_url(f"**#example={GONE_TO}*")
    with portal.asking():
        portal.page.select_option("#example", LEFT)
    portal.page.wait_for_url(f"**#example={LEFT}*")
    return portal


def back(portal: Portal) -> None:
    portal.page.go_back()
    portal.page.wait_for_url(f"**#example={GONE_TO}*")


def expect_nothing_else(portal: Portal) -> None:
    """What one went to is there, and nothing was written into its place; forward leads to where one was."""
    expect(portal.page.locator("#example")).to_have_value(GONE_TO)
    portal.page.wait_for_function(_DRAWN, polling=POLLING_MS)
    here = portal.page.evaluate("location.hash")
    assert here.startswith(f"#example={GONE_TO}&")
    assert [figure for figure in portal.page.evaluate("written") if figure[1] == here] == []
    portal.page.go_forward()


def test_an_answer_that_comes_after_one_has_left(two_places: Portal) -> None:
    portal = two_places
    portal.input(SPEED).fill("777")
    portal.page.wait_for_url("**#r=*")
    with held(portal, "/v1/optimize") as answers, held(portal, f"/v1/examples/{GONE_TO}") as machines:
        portal.page.click("#optimise")
        wait_for_request(portal, answers)
        portal.page.evaluate(_WATCH)
        back(portal)
        wait_for_request(portal, machines)
        # the answer comes while nothing of the other place is there
        come(portal, answers)
        expect(portal.page.locator("#progress")).to_contain_text("Answered")
        assert portal.page.evaluate("written") == []
        answers.clear()
        portal.page.unroute(f"{portal.url}/v1/optimize")
        come(portal, machines)
    expect_nothing_else(portal)
    expect(portal.input(SPEED)).to_have_value("777")


def test_a_link_that_is_packed_when_one_leaves(two_places: Portal) -> None:
    portal = two_places
    portal.page.evaluate(_HOLD_LINKS)
    portal.input(SPEED).fill("777")
    portal.page.wait_for_function("() => packing > 0", polling=POLLING_MS)
    portal.page.evaluate(_WATCH)
    back(portal)
    expect_nothing_else(portal)
    expect(portal.page.locator("#example")).to_have_value(LEFT)


def test_an_example_that_comes_after_one_has_left(two_places: Portal) -> None:
    portal = two_places
    portal.page.evaluate(_WATCH)
    with held(portal, f"/v1/examples/{LATE}") as machines:
        portal.page.select_option("#example", LATE)
        wait_for_request(portal, machines)
        back(portal)
        come(portal, machines)
    expect_nothing_else(portal)
    expect(portal.page.locator("#example")).to_have_value(LEFT)


def test_an_example_that_waits_for_a_link_when_one_leaves(two_places: Portal) -> None:
    portal = two_places
    portal.page.evaluate(_HOLD_LINKS)
    portal.input(SPEED).fill("777")
    portal.page.wait_for_function("() => packing > 0", polling=POLLING_MS)
    before = portal.page.evaluate("packing")
    portal.page.evaluate(_WATCH)
    with portal.page.expect_response(f"**/v1/examples/{LATE}"):
        portal.page.select_option("#example", LATE)
    # what is left is kept before it is left
    portal.page.wait_for_function("before => packing > before", arg=before, polling=POLLING_MS)
    back(portal)
    expect_nothing_else(portal)
    expect(portal.page.locator("#example")).to_have_value(LEFT)
