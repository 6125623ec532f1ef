"""The page: its weight, and the time from a click to what is drawn (``python -m tests.benchmarks.page``)."""

import argparse
import gzip
import statistics
import tempfile
from pathlib import Path

from playwright.sync_api import Browser, Page, sync_playwright
from rich.console import Console
from rich.table import Table

from service.portal.assets import PLOTS, SCHEMAS, asset, names, page
from tests.browser import chromium
from tests.browser.serving import serving

ANSWERED_WITHIN_MS = 60.0
KEY_WITHIN_MS = 50.0
VISIT_WITHIN_MS = 1000.0
VISITS = 5
MACHINES = ("2d12", "v8-cross-plane", "scroll-three-pins")
_PANELS = "counterweights,hodographs,over-angle,orders"
#: in the page: milliseconds from the click until everything that the run draws is on the screen
_CLICK = """() => new Promise((resolve) => {
  const results = document.getElementById("results");
  const started = performance.now();
  new MutationObserver((_, observer) => {
    observer.disconnect();
    requestAnimationFrame(() => setTimeout(() => resolve(performance.now() - started)));
  }).observe(results, { attributeFilter: ["data-drawn"] });
  document.getElementById("optimise").click();
})"""
#: and until counterweights, residual and drawing are
_RESULT = """() => new Promise((resolve) => {
  const started = performance.now();
  new MutationObserver((_, observer) => {
    observer.disconnect();
    requestAnimationFrame(() => setTimeout(() => resolve(performance.now() - started)));
  }).observe(document.getElementById("answer"), { childList: true });
  document.getElementById("optimise").click();
})"""


#: in the page: milliseconds of a key stroke in the first fitted mass
_KEY = """(number) => new Promise((resolve) => {
  const [input, result] = [".cell input", ".residual"].map((one) => document.querySelector(`#panel-what-if ${one}`));
  const started = performance.now();
  new MutationObserver((_, observer) => {
    observer.disconnect();
    resolve(performance.now() - started);
  }).observe(result, { attributeFilter: ["data-of"] });
  input.value = String(50 + number);
  input.dispatchEvent(new InputEvent("input", { bubbles: true }));
})"""
#: before the page: when what is first seen of it is on the screen
_SEEN = """
const seen = globalThis.seen = {};
const marks = {
  begun: () => document.querySelector("#form details[data-pointer]") && document.querySelector("#answer .beginning"),
  answered: () => document.querySelector("#answer h2.status"),
  drawn: () => document.querySelector("#results[data-drawn]"),
};
new MutationObserver(() => {
  for (const [name, there] of Object.entries(marks)) {
    if (name in marks && there()) {
      delete marks[name];
      requestAnimationFrame(() => setTimeout(() => { seen[name] = performance.now(); }));
    }
  }
}).observe(document, { subtree: true, childList: true, attributes: true });
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeats", type=int, default=20, help="clicks on every machine")
    repeats = parser.parse_args().repeats
    console = Console(width=120)
    weigh(console)
    path = chromium.find()
    if path is None:
        console.print(chromium.MISSING)
        return
    with tempfile.TemporaryDirectory() as folder, serving(Path(folder)) as url, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox", "--disable-dev-shm-usage"])
        view = browser.new_page(viewport={"width": 1280, "height": 900})
        visits(console, browser, url)
        table = Table(title=f"milliseconds, median (and worst) of {repeats}")
        for heading in ("machine", "click to answer on the screen", "click to all plots", "key stroke to residual"):
            table.add_column(heading, justify="left" if heading == "machine" else "right")
        for name in MACHINES:
            view.goto("about:blank")
            view.goto(f"{url}/#example={name}&open={_PANELS}")
            view.wait_for_selector("#results[data-drawn]")
            table.add_row(name, clicks(view, _RESULT, repeats), clicks(view, _CLICK, repeats), keys(view, repeats))
        console.print(table)
        console.print(
            f"asked for: the answer of the 2D12 within {ANSWERED_WITHIN_MS:.0f} ms of the click, "
            f"the residual within {KEY_WITHIN_MS:.0f} ms of a key stroke, a first visit within {VISIT_WITHIN_MS:.0f} ms"
        )
        browser.close()


def weigh(console: Console) -> None:
    """Kilobytes that travel, compressed, and that are read."""
    own = [asset(name) for name in names() if name not in (PLOTS, SCHEMAS)]
    schemas, plots = asset(SCHEMAS), asset(PLOTS)
    travel, read = (
        sum(len(gzip.compress(single_asset.content)) for single_asset in own),
        sum(len(single_asset.content) for single_asset in own),
    )
    console.print(
        f"page and the {len(own)} files of our own: {(len(gzip.compress(page())) + travel) / 1e3:.0f} kB, "
        f"{read / 1e3:.0f} kB read; schemas of the form: {len(gzip.compress(schemas.content)) / 1e3:.0f} kB"
    )
    console.print(
        f"plots, loaded when the first one is drawn: {len(gzip.compress(plots.content)) / 1e3:.0f} kB, "
        f"{len(plots.content) / 1e3:.0f} kB read"
    )


def visits(console: Console, browser: Browser, url: str) -> None:
    """First visits, each by a browser that has nothing: of the empty machine, and of a link with an example."""
    table = Table(title=f"milliseconds from the address on a first visit, median (and worst) of {VISITS}")
    for heading in ("what is on the screen", "by then"):
        table.add_column(heading, justify="left" if heading != "by then" else "right")
    example = f"/#example={MACHINES[0]}&open={_PANELS}"
    cases = [("form and beginning of an empty machine", "/", "begun"), ("answer of an example", example, "answered")]
    for title, path, mark in (*cases, ("all of its plots", example, "drawn")):
        times = []
        for _ in range(VISITS):
            context = browser.new_context(viewport={"width": 1280, "height": 900})
            view = context.new_page()
            view.add_init_script(_SEEN)
            view.goto(f"{url}{path}")
            view.wait_for_function("(what) => what in globalThis.seen", arg=mark)
            times.append(float(view.evaluate(f"globalThis.seen.{mark}")))
            context.close()
        table.add_row(title, f"{statistics.median(times):.0f} ({max(times):.0f})")
    console.print(table)


def keys(view: Page, repeats: int) -> str:
    """Milliseconds from a key stroke in a fitted mass until what remains of it is in the page."""
    panel = view.locator("#panel-what-if")
    panel.locator("> summary").click()
    view.wait_for_selector("#panel-what-if[data-drawn]")
    if not panel.locator(".cell input").count():
        return "-"
    view.wait_for_selector("#panel-what-if .residual[data-of]")
    times = sorted(float(view.evaluate(_KEY, number)) for number in range(repeats))
    panel.locator("> summary").click()
    return f"{statistics.median(times):.0f} ({times[-1]:.0f})"


def clicks(view: Page, script: str, repeats: int) -> str:
    for _ in range(2):
        view.evaluate(_CLICK)
    times = []
    for _ in range(repeats):
        times.append(float(view.evaluate(script)))
        # the plots of one click are not to be in the way of the next
        view.wait_for_timeout(250)
    return f"{statistics.median(times):.0f} ({max(times):.0f})"


if __name__ == "__main__":
    main()
