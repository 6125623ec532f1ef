"""The page in the frame of a portal on another origin: machine in; answer, picture and errors out; no strangers."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest
from playwright.sync_api import BrowserContext, Page

from tests.browser.portal import POLLING_MS, ask, screenshot
from tests.browser.serving import serving

EXAMPLE = Path(__file__).parents[2] / "examples" / "portal"


class _Quiet(SimpleHTTPRequestHandler):
    def log_message(self, format: str, *args: object) -> None:  # noqa: A002 - the name is the library's
        pass


@contextmanager
def _site() -> Iterator[str]:
    """Another origin, with the example's page."""
    with ThreadingHTTPServer(("127.0.0.1", 0), partial(_Quiet, directory=str(EXAMPLE))) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            yield f"http://127.0.0.1:{server.server_port}"
        finally:
            server.shutdown()
            thread.join()


@pytest.fixture(scope="module")
def sites(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, str, str]]:
    """A service, the portal that it knows, and one that it does not know."""
    with (
        _site() as site,
        _site() as stranger,
        serving(tmp_path_factory.mktemp("service"), frame_origins=site) as url,
    ):
        yield url, site, stranger


@pytest.fixture
def page(context: BrowserContext) -> Iterator[Page]:
    page = context.new_page()
    yield page
    page.close()


def _open(page: Page, portal: str, url: str) -> None:
    page.goto(f"{portal}/?service={url}")
    page.wait_for_selector("#send:enabled")


def test_a_portal_gives_a_machine_and_takes_answer_and_picture(page: Page, sites: tuple[str, str, str]) -> None:
    url, site, _ = sites
    troubles: list[str] = []
    page.on("console", lambda message: troubles.append(message.text) if message.type in ("error", "warning") else None)
    _open(page, site, url)
    page.click("#send")
    page.wait_for_function("document.getElementById('verdict').textContent.startsWith('optimal')", polling=POLLING_MS)
    page.wait_for_function("document.getElementById('picture').naturalWidth > 0", polling=POLLING_MS)
    frame = page.frame_locator("#service")
    assert frame.locator("body > header").is_hidden()
    frame.locator("#results[data-drawn]").wait_for()
    passage = page.locator("#verdict").inner_text()
    machine = {
        "kind": "reciprocating",
        "speed_rpm": 980,
        "throws": [
            {
                "position_m": 0, "crank_radius_m": 0.08, "crank_angle_deg": 0, "rotating_mass_kg": 6,
                "rows": [{"axis_deg": 90, "reciprocating_mass_kg": 5}],
            }
        ],
        "webs": [
            {"name": "left", "position_m": -0.1, "counterweight_radius_m": 0.12, "max_mass_kg": 8},
            {"name": "right", "position_m": 0.1, "counterweight_radius_m": 0.12, "max_mass_kg": 8},
        ],
    }  # fmt: skip
    # independent: the same machine without the page
    assert passage == f"optimal: {ask(url, '/v1/optimize', {'machine': machine})['total_mass_kg']:.2f} kg"
    # the frame is as high as the page in it, which scrolls no more
    page.wait_for_function(
        "() => Math.abs(document.getElementById('service').clientHeight - "
        "parseFloat(document.getElementById('service').style.height)) <= 2",
        polling=POLLING_MS,
    )
    screenshot(page, "embedded")
    assert troubles == []


def test_what_is_wrong_with_the_machine_is_said_to_the_portal(page: Page, sites: tuple[str, str, str]) -> None:
    url, site, _ = sites
    _open(page, site, url)
    page.fill("#speed", "-1")
    page.click("#send")
    page.wait_for_function("document.getElementById('verdict').textContent.startsWith('Refused: ')", polling=POLLING_MS)


def test_the_page_hears_nobody_but_its_portal(page: Page, sites: tuple[str, str, str]) -> None:
    url, site, _ = sites
    _open(page, site, url)
    (frame,) = [page_frame for page_frame in page.frames if page_frame.url.startswith(url)]
    frame.get_by_role("heading", name="Begin with your machine").wait_for()
    # from within the frame itself, whose origin is not the portal's
    frame.evaluate("() => postMessage({type: 'counterweight.machine', machine: {kind: 'scroll'}}, location.origin)")
    # the next message comes after it, and is answered
    page.click("#send")
    page.wait_for_function("document.getElementById('verdict').textContent.startsWith('optimal')", polling=POLLING_MS)
    # the beginning is the first, the portal's machine the second
    frame.wait_for_selector("#results[data-drawn='2']")
    assert frame.locator("#problem").inner_text() == ""


def test_a_stranger_may_not_frame_it(page: Page, sites: tuple[str, str, str]) -> None:
    url, _, stranger = sites
    with page.expect_console_message(lambda message: "frame-ancestors" in message.text):
        page.goto(f"{stranger}/?service={url}")
    assert page.locator("#send").is_disabled()
    assert not [frame for frame in page.frames if frame.url.startswith(url)]


#: messages that a portal may send by mistake: what can be cloned for another window is far more than JSON
_ODD = """
() => {
  const throws = [{position_m: 0, crank_radius_m: 0.08, crank_angle_deg: 0, rotating_mass_kg: 6,
    rows: [{axis_deg: 90, reciprocating_mass_kg: 5}]}];
  const machine = {kind: "reciprocating", speed_rpm: 980, throws,
    webs: [{position_m: 0.1, counterweight_radius_m: 0.12, max_mass_kg: 8}]};
  const cycle = {...machine};
  cycle.webs = [cycle];
  const request = {machine};
  request.objective = request;
  let deep = {};
  for (let level = 0; level < 500; level += 1) deep = {deep};
  const machines = [cycle, {...machine, speed_rpm: 980n}, 7n, {...machine, webs: deep}, {...machine, speed_rpm: NaN},
    {...machine, webs: [{...machine.webs[0], max_mass_kg: Infinity}]},
    new Map([["kind", "reciprocating"]]), new Date(0), new Date(NaN), /x/, [], "machine", 7, true, new Uint8Array(3),
    {}, {throws: 7}, {throws: [null]}, {throws: [[]]}, {...machine, throws: {}}, {...machine, webs: 7},
    {...machine, webs: [null]}, {...machine, bearings: 7}, {...machine, bearings: [null, 1]}, {kind: {}},
    {kind: "scroll", anti_rotation: 7}, {...machine, kind: "scroll"}, {...machine, flywheel: [], name: {}},
    {...machine, throws: [{...throws[0], rows: 7}]}, {...machine, throws: [{...throws[0], rows: [7, null]}]},
    {...machine, cylinder: null}, ...[{toString: 1}, {valueOf: {}, toString: null}].flatMap((text) => [
      {...machine, speed_rpm: text}, {...machine, name: text}, {...machine, kind: text},
      {...machine, catalogue: [text]},
      {...machine, webs: [{...machine.webs[0], name: text, max_mass_kg: text, hole_angles_deg: [text]}]},
      {...machine, throws: [{...throws[0], name: text, rows: [{...throws[0].rows[0], name: text, axis_deg: text}]}]},
      {...machine, bearings: [{name: text, position_m: text}]}])];
  const requests = [request, {machine: null}, {machine: 7}, {machine: []}, {machine, outputs: 7}, {machine, angles: 7},
    {machine, objective: [1n]}, {machine, scenarios: {}}, {machine, accuracy: "high"}];
  return [...machines.map((given) => ({type: "machine", machine: given})),
    ...requests.map((given) => ({type: "machine", request: given})), {type: "machine"},
    {type: "picture"}, {type: "picture", name: {toString: 1}}, {type: "picture", name: "\\ud800"},
    {type: "picture", name: 7n}];
}
"""
#: sends one after the other, and says what the first answer to each was
_ANSWERS = (
    f"async () => {{ const wrong = ({_ODD})();"
    + """
  const frame = document.getElementById("service");
  const origin = new URL(frame.src).origin;
  const answers = [];
  for (const [number, odd] of wrong.entries()) {
    const id = {number: BigInt(number)};
    answers.push(await new Promise((resolve) => {
      const late = setTimeout(() => resolve(`${number}: nothing`), 120_000);
      addEventListener("message", function heard({data}) {
        if (data?.id?.number !== id.number) return;
        removeEventListener("message", heard);
        clearTimeout(late);
        resolve(`${data.type.replace("counterweight.", "")} ${data.title} ${data.message}`);
      });
      frame.contentWindow.postMessage({...odd, type: `counterweight.${odd.type}`, id}, origin);
    }));
  }
  return answers;
}
"""
)


def test_a_message_that_is_no_machine_is_answered_and_the_next_one_is_heard(
    page: Page, sites: tuple[str, str, str]
) -> None:
    url, site, _ = sites
    troubles: list[str] = []
    page.on("pageerror", lambda error: troubles.append(str(error)))
    _open(page, site, url)
    answers = page.evaluate(_ANSWERS)
    assert [answer for answer in answers if not answer.startswith("error ")] == []
    assert troubles == []
    page.click("#send")
    page.wait_for_function("document.getElementById('verdict').textContent.startsWith('optimal')", polling=POLLING_MS)
