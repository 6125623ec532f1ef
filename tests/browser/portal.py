"""The page as a reader sees it, watched for what must never happen."""

import json
import os
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal
from urllib.parse import urlsplit

from playwright.sync_api import ConsoleMessage, Locator, Page, Request

ARTEFACTS = Path(__file__).parents[2] / "artefacts" / "portal"
#: ``SCREENSHOTS=1``: a picture of the whole page costs as much as to draw it
PICTURES = bool(os.environ.get("SCREENSHOTS"))
ALL_PANELS = (
    "counterweights",
    "foundation",
    "what-if",
    "versions",
    "cranks",
    "hodographs",
    "turning",
    "over-angle",
    "orders",
    "picture-orders",
    "picture-stages",
    "picture-indicator",
    "pareto",
    "accuracy",
    "torque",
    "rod-loads",
    "flywheel",
    "main-bearings",
    "picture-bearings",
    "pin-loads",
    "match",
    "sweep",
)


#: without it a page that waits draws sixty pictures a second, and takes a tenth of a core
POLLING_MS = 30
#: in the page: whether there is a newer question, all of whose answer is drawn
_DRAWN = """(before) => {
  const { asked, drawn } = document.getElementById("results").dataset;
  return asked !== (before ?? undefined) && drawn === asked;
}"""
#: in the page: a link is followed, even to the place that one is at; what was begun for another machine is left
_FOLLOW = """(link) => {
  document.getElementById("paste").open = false;
  document.querySelector("dialog")?.remove();
  location.hash = `${link}&visit=${performance.now()}`;
}"""
#: in the page: whether a panel shows the answer that stands there
_SHOWN = """(name) => {
  const { drawn } = document.getElementById(`panel-${name}`).dataset;
  return drawn && drawn === document.getElementById("results").dataset.drawn;
}"""
#: in the page: whether the part is there, which it opens with the folds of its own fields
_UNFOLD = """(pointer) => {
  const part = document.querySelector(`#form details[data-pointer="${CSS.escape(pointer)}"]`);
  if (!part) return false;
  part.open = true;
  part.build();
  const own = (fold) => fold.closest("[data-pointer]") === part;
  for (const fold of part.querySelectorAll(".more")) if (own(fold)) fold.open = true;
  return true;
}"""


@dataclass(frozen=True)
class Look:
    """The window, px, as high as that of a laptop, and the colours that the system has."""

    width: int = 1280
    scheme: Literal["light", "dark"] = "light"
    height: int = 600


@dataclass
class Portal:
    """A page on a service; ``refusals`` are statuses that a test provokes, which the browser reports as errors."""

    page: Page
    url: str
    refusals: set[int] = field(default_factory=set)
    troubles: list[str] = field(default_factory=list)
    requests: list[Request] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.page.on("console", self._note)
        self.page.on("pageerror", lambda error: self.troubles.append(f"uncaught: {error}"))
        self.page.on("request", lambda request: self.requests.append(request))

    def _note(self, message: ConsoleMessage) -> None:
        provoked = any(f"status of {status}" in message.text for status in self.refusals)
        if message.type in ("error", "warning") and not provoked:
            self.troubles.append(f"{message.type}: {message.text}")

    @property
    def strangers(self) -> set[str]:
        """Everything that was asked of anybody but the service."""
        home = urlsplit(self.url).netloc
        split_results = (urlsplit(request.url) for request in self.requests)
        return {url.geturl() for url in split_results if url.scheme not in ("data", "blob") and url.netloc != home}

    def clear(self) -> None:
        """Forget what was seen, before the page is another test's."""
        self.refusals, self.troubles, self.requests = set(), [], []

    def open(self, example: str = "2d12", panels: tuple[str, ...] = ("counterweights",)) -> None:
        """An example with some panels, by a link: from the page itself where it is there already."""
        link = f"#example={example}&open={','.join(panels)}"
        if self.page.url.startswith(f"{self.url}/"):
            with self.asking():
                self.page.evaluate(_FOLLOW, link)
            return
        self.page.goto(f"{self.url}/{link}")
        self.drawn(1)
        # the form comes after the result
        self.page.wait_for_selector("#form [data-pointer='/machine']")

    def drawn(self, run: int) -> None:
        """Wait for everything that a run draws."""
        self.page.wait_for_selector(f"#results[data-drawn='{run}']")

    def runs(self) -> int:
        return int(self.page.locator("#results").get_attribute("data-drawn") or 0)

    @contextmanager
    def asking(self) -> Iterator[None]:
        """Wait for everything that a run draws which is asked for within; one asked before may still be drawn first."""
        before = self.page.locator("#results").get_attribute("data-asked")
        yield
        self.page.wait_for_function(_DRAWN, arg=before, polling=POLLING_MS)

    def optimise(self) -> None:
        """Ask, and wait for everything that this very run draws."""
        with self.asking():
            self.page.click("#optimise")

    def panel(self, name: str) -> Locator:
        return self.page.locator(f"#panel-{name}")

    def open_panel(self, name: str) -> Locator:
        panel = self.panel(name)
        panel.locator("> summary").click()
        self.shown(name)
        return panel

    def shown(self, name: str) -> None:
        """Wait until a panel shows the answer that stands there."""
        self.page.wait_for_function(_SHOWN, arg=name, polling=POLLING_MS)

    def unfold(self, *pointers: str) -> None:
        """Open parts of the form, from the outside inwards, with all their fields.

        In one step of the page: what opens a part meanwhile, as an error in it does, changes nothing.
        """
        for pointer in pointers:
            self.page.wait_for_function(_UNFOLD, arg=pointer, polling=POLLING_MS)

    def input(self, pointer: str) -> Locator:
        return self.page.locator(f"#form .field[data-pointer='{pointer}']").locator("input, select, textarea")

    def paste(self, selector: str, text: str) -> None:
        """As the browser does on Ctrl+V with the caret at an element."""
        self.page.locator(selector).first.evaluate(
            """(node, text) => {
              const clipboardData = new DataTransfer();
              clipboardData.setData("text/plain", text);
              node.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true, cancelable: true }));
            }""",
            text,
        )

    def bodies(self, path: str) -> list[Any]:
        """What was posted to a path."""
        return [json.loads(request.post_data or "") for request in self.requests if urlsplit(request.url).path == path]

    def screenshot(self, name: str) -> None:
        screenshot(self.page, name)


def screenshot(page: Page, name: str) -> None:
    """For those who look."""
    if not PICTURES:
        return
    ARTEFACTS.mkdir(parents=True, exist_ok=True)
    page.screenshot(path=ARTEFACTS / f"{name}.png", full_page=True)


def ask(url: str, path: str, body: Any = None) -> Any:
    """The same question without the page."""
    data = None if body is None else json.dumps(body).encode()
    call = urllib.request.Request(url + path, data, {"Content-Type": "application/json"})
    with urllib.request.urlopen(call, timeout=180) as answer:
        return json.load(answer)


def cells(table: Locator) -> list[list[str]]:
    """The texts of a table, row by row, without its heads."""
    texts: list[list[str]] = table.locator("tbody tr").evaluate_all(
        "rows => rows.map((row) => [...row.querySelectorAll('th, td')].map((cell) => cell.innerText))"
    )
    return texts


def number(text: str) -> float:
    """A number as the page prints it: thousands apart, a true minus."""
    return float("".join(text.split()).replace("\N{MINUS SIGN}", "-"))
