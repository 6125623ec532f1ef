"""Draw the three pictures of README.md from a running service: ``python docs/readme_pictures.py [FOLDER]``.

The page with an answer, the first page of a report, and the designs of a sweep with their front.
"""

import json
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path

from playwright.sync_api import Browser, Page, sync_playwright

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))
from tests.browser import chromium  # noqa: E402
from tests.browser.portal import Portal  # noqa: E402
from tests.browser.serving import serving  # noqa: E402

DOCS = ROOT / "docs"
PAGE, REPORT, FRONT = "page-2d12.png", "report-2d12.png", "sweep-2d12.svg"
MACHINE, SWEEP = ROOT / "examples" / "2d12.json", ROOT / "examples" / "sweeps" / "2d12-grid.json"
#: columns that the sweep is drawn by
ACROSS, UPWARD = "total_mass_kg", "moment_peak_Nm"
#: a sheet of A4 at 96 points an inch, px
SHEET = {"width": 794, "height": 1123}


def _read(url: str, body: bytes | None = None, accept: str = "application/json") -> bytes:
    headers = {"Content-Type": "application/json", "Accept": accept}
    with urllib.request.urlopen(urllib.request.Request(url, body, headers), timeout=300) as answer:
        content: bytes = answer.read()
    return content


def page(browser: Browser, url: str, to: Path) -> None:
    """The page with the answer of the 2D12."""
    # the first answer of a service is slower than all others
    _read(f"{url}/v1/optimize", MACHINE.read_bytes())
    view = browser.new_page(viewport={"width": 1280, "height": 900})
    Portal(view, url).open("2d12", ("counterweights", "hodographs"))
    view.get_by_text("claims").first.wait_for()
    _shot(view, to)


def report(browser: Browser, url: str, to: Path) -> None:
    """Page one of the report of the 2D12."""
    view = browser.new_page(viewport=SHEET)
    view.set_content(_read(f"{url}/v1/report", MACHINE.read_bytes(), "text/html").decode())
    _shot(view, to)


def _shot(view: Page, to: Path) -> None:
    view.screenshot(path=to, animations="disabled")
    view.close()


def front(url: str, to: Path) -> None:
    """The designs of a sweep by mass and moment, with those that no other beats in both."""
    job = json.loads(_read(f"{url}/v1/sweeps", SWEEP.read_bytes()))
    state, deadline = job["state"], time.monotonic() + 300
    while state in ("queued", "running") and time.monotonic() < deadline:
        time.sleep(0.2)
        state = json.loads(_read(f"{url}/v1/sweeps/{job['id']}"))["state"]
    if state != "done":
        raise RuntimeError(f"the sweep is {state}")
    with tempfile.TemporaryDirectory() as folder:
        rows = Path(folder) / "rows.parquet"
        rows.write_bytes(_read(f"{url}/v1/sweeps/{job['id']}/results?format=parquet&select=all"))
        command = [sys.executable, "-m", "service", "plot", str(rows), "--x", ACROSS, "--y", UPWARD, "--out", str(to)]
        subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)


def draw(into: Path) -> None:
    """All three, into a folder.

    Raises
    ------
    RuntimeError
        where there is no browser, or the sweep does not end.
    """
    path = chromium.find()
    if path is None:
        raise RuntimeError(chromium.MISSING)
    with tempfile.TemporaryDirectory() as data, serving(Path(data), sweep_workers="1") as url:
        front(url, into / FRONT)
        with sync_playwright() as playwright:
            arguments = ["--no-sandbox", "--disable-gpu", "--disable-background-networking"]
            browser = playwright.chromium.launch(executable_path=path, args=arguments)
            page(browser, url, into / PAGE)
            report(browser, url, into / REPORT)
            browser.close()


if __name__ == "__main__":
    draw(Path(sys.argv[1]) if len(sys.argv) > 1 else DOCS)
