"""One service and one browser for all tests of the page."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import BrowserContext, Page, expect, sync_playwright

from tests.browser import chromium
from tests.browser.portal import Look, Portal
from tests.browser.serving import serving


@pytest.fixture(scope="session")
def url(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Address of a service."""
    with serving(tmp_path_factory.mktemp("service"), sweep_workers="1") as address:
        yield address


#: what is waited for, on a machine that is busy; what comes sooner is not waited for [ms]
PATIENCE_MS = 180_000
expect.set_options(timeout=PATIENCE_MS)


# for this folder only: an event loop of playwright would keep the tests of others from running theirs
@pytest.fixture(scope="package")
def context(url: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[BrowserContext]:
    """Chromium, headless; one for all: what was loaded and compiled once is kept, as for a reader who comes back."""
    path = chromium.find()
    if path is None:
        pytest.skip(chromium.MISSING)
    with sync_playwright() as playwright:
        # root has no sandbox, and containers little shared memory
        arguments = ["--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu", "--disable-background-networking"]
        # a page in a process of its own costs more than all that it does: 0.8 of 1.3 s of CPU
        arguments.append("--process-per-site")
        # without a profile no script stays compiled, which for that of the plots is a fifth of a page's CPU
        profile = tmp_path_factory.mktemp("profile")
        context = playwright.chromium.launch_persistent_context(profile, executable_path=path, args=arguments)
        context.set_default_timeout(PATIENCE_MS)
        # the process of the site ends with its last page, so one stays open
        context.pages[0].goto(f"{url}/healthz")
        yield context
        context.close()


@pytest.fixture
def options() -> Look:
    """How the page is looked at; tests override it."""
    return Look()


def _look(page: Page, options: Look) -> None:
    page.set_viewport_size({"width": options.width, "height": options.height})
    page.emulate_media(color_scheme=options.scheme)


def _innocent(troubles: list[str], strangers: set[str]) -> None:
    """Nothing was complained about, and nobody else asked."""
    assert troubles == []
    assert strangers == set()


@pytest.fixture
def visit(context: BrowserContext, url: str, options: Look) -> Iterator[Portal]:
    """A page of this test alone, as on a first visit."""
    page = context.new_page()
    _look(page, options)
    portal = Portal(page, url)
    yield portal
    page.close()
    _innocent(portal.troubles, portal.strangers)


@pytest.fixture(scope="package")
def desk() -> list[Portal]:
    """The page that stays open from test to test, if there is one."""
    return []


@pytest.fixture
def portal(
    request: pytest.FixtureRequest, context: BrowserContext, url: str, options: Look, desk: list[Portal]
) -> Iterator[Portal]:
    """The page as a reader has it who goes from machine to machine; a test that fails takes it away with it."""
    failures = request.session.testsfailed
    if not desk:
        desk.append(Portal(context.new_page(), url))
    (portal,) = desk
    _look(portal.page, options)
    yield portal
    portal.page.unroute_all()
    troubles, strangers = portal.troubles, portal.strangers
    if troubles or strangers or request.session.testsfailed > failures:
        desk.clear()
        portal.page.close()
    portal.clear()
    _innocent(troubles, strangers)
