"""The page: its weight, and the time from a click to what is drawn (``python -m tests.benchmarks.page``)."""

import argparse
import gzip
import statistics
import tempfile
from pathlib import Path

from playwright.sync_api import Page, sync_playwright
from rich.console import Console
from rich.table import Table

from service.portal.assets import PLOTS, asset, names, page
from tests.browser import chromium
from tests.browser.serving import serving

ANSWERED_WITHIN_MS = 60.0
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
        table = Table(title=f"milliseconds, median (and worst) of {repeats} clicks, everything of the page drawn")
        for heading in ("machine", "first visit", "click to answer on the screen", "click to all plots"):
            table.add_column(heading, justify="left" if heading == "machine" else "right")
        for name in MACHINES:
            table.add_row(
                name, f"{visit(view, url, name):.0f}", clicks(view, _RESULT, repeats), clicks(view, _CLICK, repeats)
            )
        console.print(table)
        console.print(f"asked for: the answer of the 2D12 within {ANSWERED_WITHIN_MS:.0f} ms of the click")
        browser.close()


def weigh(console: Console) -> None:
    """Kilobytes that travel, compressed, and that are read."""
    own = [asset(name) for name in names() if name != PLOTS]
    plots = asset(PLOTS)
    travel, read = sum(len(gzip.compress(one.content)) for one in own), sum(len(one.content) for one in own)
    console.print(
        f"page and the {len(own)} files of our own: {(len(page()) + travel) / 1e3:.0f} kB, {read / 1e3:.0f} kB read"
    )
    console.print(f"plots, loaded beside the first result: {len(gzip.compress(plots.content)) / 1e3:.0f} kB", end=", ")
    console.print(f"{len(plots.content) / 1e3:.0f} kB read")


def visit(view: Page, url: str, example: str) -> float:
    """Milliseconds from the address to everything drawn."""
    view.goto("about:blank")
    view.goto(f"{url}/#example={example}&open={_PANELS}")
    view.wait_for_selector("#results[data-drawn]")
    return float(view.evaluate("performance.now()"))


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
