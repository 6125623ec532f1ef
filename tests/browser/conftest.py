"""One service and one browser for all tests of the page."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, BrowserContext, expect, sync_playwright

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
def browser() -> Iterator[Browser]:
    """Chromium, headless."""
    path = chromium.find()
    if path is None:
        pytest.skip(chromium.MISSING)
    with sync_playwright() as playwright:
        # root has no sandbox, and containers little shared memory
        arguments = ["--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu", "--disable-background-networking"]
        # a page in a process of its own costs more than all that it does: 0.8 of 1.3 s of CPU
        arguments.append("--process-per-site")
        found = playwright.chromium.launch(executable_path=path, args=arguments)
        yield found
        found.close()


@pytest.fixture(scope="package")
def context(browser: Browser, url: str) -> Iterator[BrowserContext]:
    """One for all: what was loaded once is kept, as for a reader who comes back."""
    context = browser.new_context()
    context.set_default_timeout(PATIENCE_MS)
    # the process of the site ends with its last page, so one stays open
    context.new_page().goto(f"{url}/healthz")
    yield context
    context.close()


@pytest.fixture
def options() -> Look:
    """How the page is looked at; tests override it."""
    return Look()


@pytest.fixture
def portal(context: BrowserContext, url: str, options: Look) -> Iterator[Portal]:
    """A fresh page; afterwards nothing must have been complained about, and nobody else asked."""
    page = context.new_page()
    page.set_viewport_size({"width": options.width, "height": 900})
    page.emulate_media(color_scheme=options.scheme)
    found = Portal(page, url)
    yield found
    page.close()
    assert found.troubles == []
    assert found.strangers == set()
