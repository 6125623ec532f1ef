"""A machine of several hundred kB: what a key stroke costs does not grow with it. Counted, not timed."""

import json
from typing import Any

from playwright.sync_api import expect

from tests.browser.portal import Portal

WEBS = 40
KEYS = 12
#: faults that one refusal names at most
FIRST_MESSAGES = 50
#: counts what reads or writes a large text, and every step into an object
_COUNT = """() => {
  globalThis.counted = { large: 0, steps: 0 };
  const [text, parse, own] = [JSON.stringify, JSON.parse, Object.hasOwn];
  const large = (found) => { if (found?.length > 50_000) counted.large += 1; return found; };
  JSON.stringify = (...all) => large(text(...all));
  JSON.parse = (given, ...more) => parse(large(given), ...more);
  Object.hasOwn = (...all) => { counted.steps += 1; return own(...all); };
}"""
#: all strokes in one turn of the loop: whatever they do at once is in the counts, nothing that waits is
_TYPE = """(input, keys) => {
  const before = { ...counted };
  for (let key = 0; key < keys; key += 1) {
    input.value += "1";
    input.dispatchEvent(new InputEvent("input", { bubbles: true }));
  }
  return { large: counted.large - before.large, steps: counted.steps - before.steps };
}"""


def _machine(webs: int) -> dict[str, Any]:
    def web(number: int) -> dict[str, Any]:
        radii = {"inner_radius_m": 0.0612345678901, "outer_radius_m": 0.3012345678901, "thickness_m": 0.0412345678901}
        return {
            "name": f"web number {number} of {webs}, between its two throws" + " and as long as a name may be" * 2,
            "position_m": -1.0 + 2.0 * number / webs,
            "envelope": {"shape": "segment", **radii, "max_half_angle_deg": 75.12345678901},
            "sector": {"centre_deg": (37.123456789 * number) % 360, "half_angle_deg": 44.123456789},
        }

    row = {"axis_deg": 90, "reciprocating_mass_kg": 30}
    throw = {"position_m": 0, "crank_radius_m": 0.08, "crank_angle_deg": 0, "rotating_mass_kg": 9.5, "rows": [row]}
    webs_ = [web(number) for number in range(webs)]
    return {
        "kind": "reciprocating",
        "speed_rpm": 750,
        "throws": [{"name": "1", **throw}],
        "webs": webs_,
        "trace": [0.1 * step for step in range(800 * webs)],
    }


def _typed(portal: Portal, webs: int) -> dict[str, int]:
    """What the strokes cost in the speed and in the last cell of the table of webs."""
    portal.page.locator("#paste").evaluate("one => { one.open = true; }")
    portal.page.fill("#json", json.dumps(_machine(webs)))
    portal.page.click("#read")
    # every name is too long: the refusal opens the webs by itself, and a click at that moment would close them
    expect(portal.page.locator("#progress")).to_have_text(
        f"Not computed: {min(webs + 1, FIRST_MESSAGES)} fields are wrong."
    )
    portal.unfold("/machine", "/machine/webs")
    last = portal.input(f"/machine/webs/{webs - 1}/position_m")
    last.wait_for()
    costs = [element.evaluate(_TYPE, KEYS) for element in (portal.input("/machine/speed_rpm"), last)]
    return {name: sum(cost[name] for cost in costs) for name in ("large", "steps")}


def test_a_key_stroke_costs_the_same_on_a_large_machine(visit: Portal) -> None:
    portal = visit
    # an unknown field, as long as a trace of a sensor: the service refuses it at once, and need not compute
    portal.refusals = {422}
    portal.open("single-vertical")
    portal.page.evaluate(_COUNT)
    small = _typed(portal, 2)
    assert len(json.dumps(_machine(WEBS))) > 300_000
    large = _typed(portal, WEBS)
    # nothing is written or read as a whole while one types
    assert large["large"] == 0
    assert large["steps"] == small["steps"] <= 40 * 2 * KEYS
    # and all of it is there afterwards: in the link, and in what is undone and done again
    portal.page.wait_for_url("**#r=*")
    field = portal.input("/machine/speed_rpm")
    typed = field.input_value()
    assert len(typed) == len("750") + KEYS
    for _ in range(2):
        portal.page.click("#undo")
    expect(field).to_have_value("750")
    for _ in range(2):
        portal.page.click("#redo")
    expect(field).to_have_value(typed)
