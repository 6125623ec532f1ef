"""The drawing: true to shape, without dust, names never hidden; and the counterweights as a workshop makes them."""

import re
from typing import Any

import pytest

from service.portal.assets import STATIC
from service.portal.bundle import bundle
from tests.browser.portal import Portal, ask, cells, number

#: in the page: pairs of names that overlap by more than a pixel, and names with a counterweight above them
_HIDDEN = """(drawing) => {
  const names = [...drawing.querySelectorAll("text.name:not(.faint)")];
  const boxes = names.map((one) => one.getBoundingClientRect());
  const over = (one, other) => Math.min(one.right, other.right) - Math.max(one.left, other.left) > 1
    && Math.min(one.bottom, other.bottom) - Math.max(one.top, other.top) > 3;
  const pairs = names.flatMap((name, i) => names.slice(i + 1).filter((_, j) => over(boxes[i], boxes[i + 1 + j]))
    .map((other) => [name.textContent, other.textContent]));
  const below = names.filter((name) => [...drawing.querySelectorAll(".counterweight, .throw")]
    .some((shape) => name.compareDocumentPosition(shape) & Node.DOCUMENT_POSITION_FOLLOWING));
  return [names.length, pairs, below.map((name) => name.textContent)];
}"""


@pytest.mark.parametrize("example", ["2d12", "plate-single", "inline-six", "m-type-four", "v8-cross-plane"])
def test_no_name_is_hidden(portal: Portal, example: str) -> None:
    portal.open(example)
    for view in ("front", "side"):
        count, pairs, below = portal.page.locator(f"#drawings .{view}").evaluate(_HIDDEN)
        assert count > 1
        assert (pairs, below) == ([], [])


@pytest.mark.parametrize(
    ("example", "webs", "found"), [("2d12", 2, 4), ("v8-cross-plane", 2, 4), ("plate-single", 2, 2)]
)
def test_names_stand_clear_of_counterweights(portal: Portal, example: str, webs: int, found: int) -> None:
    portal.open(example)
    boxes = """(all) => all.map((one) => one.getBoundingClientRect())
      .map((box) => [box.left, box.top, box.right, box.bottom])"""
    names = portal.page.locator("#drawings .front text.name.web").evaluate_all(boxes)
    shapes = portal.page.locator("#drawings .front .counterweight :is(circle, polygon)").evaluate_all(boxes)
    assert (len(names), len(shapes)) == (webs, found)
    for left, top, right, bottom in names:
        assert all(right < one[0] or left > one[2] or bottom < one[1] or top > one[3] for one in shapes)


def _module(portal: Portal, name: str, call: str, given: Any) -> Any:
    text = bundle(STATIC, name)
    last = re.findall(r"^const (module\d+) = ", text, re.MULTILINE)[-1]
    return portal.page.evaluate(f"(given) => {{\n{text}const module = {last};\nreturn {call};\n}}", given)


def test_plates_are_drawn_as_they_are_cut(portal: Portal, url: str) -> None:
    """Independent: mass and centre of mass of the polygon (shoelace) are those of the answer."""
    portal.open("plate-single")
    request = ask(url, "/v1/examples/plate-single")
    answer = ask(url, "/v1/optimize", request)
    for one, web in zip(answer["counterweights"], request["machine"]["webs"], strict=True):
        outline = _module(
            portal, "drawing/outline.js", "module.outline(given.one, given.web)", {"one": one, "web": web}
        )
        sides = list(zip(outline, outline[1:] + outline[:1], strict=True))
        area = sum(a[0] * b[1] - b[0] * a[1] for a, b in sides) / 2
        along = sum((a[0] + b[0]) * (a[0] * b[1] - b[0] * a[1]) for a, b in sides) / 6 / area
        thickness = float(web["envelope"]["thickness_m"].split()[0]) / 1e3
        # a polygon of 24 sides instead of an arc
        assert area * thickness * 7850 == pytest.approx(one["mass_kg"], rel=5e-3)
        assert along == pytest.approx(one["radius_m"], rel=5e-3)
    assert portal.page.locator("#drawings .counterweight.unknown").count() == 0


def test_dust_is_not_drawn(portal: Portal) -> None:
    portal.open("2d12")
    masses = [{"web": "a", "mass_kg": 60}, {"web": "b", "mass_kg": 1e-9}, {"web": "c", "mass_kg": 0}]
    drawn = _module(portal, "drawing/outline.js", "module.carried(given)", masses)
    assert [one["web"] for one in drawn] == ["a"]


def test_counterweights_come_first(portal: Portal, url: str) -> None:
    portal.open("plate-single")
    answer = ask(url, "/v1/optimize", ask(url, "/v1/examples/plate-single"))
    first = portal.page.locator("#answer > :not(h2)").first
    rows = cells(first)
    for row, one in zip(rows, answer["counterweights"], strict=True):
        assert row[0] == one["web"]
        figures = [number(text) for text in row[1:6]]
        expected = [one["mass_kg"], 1e3 * one["position_m"], 1e3 * one["radius_m"], one["angle_from_crank_deg"]]
        assert figures == pytest.approx([*expected, one["angle_deg"]], rel=1e-4)
    assert [row[6].split(",")[0] for row in rows] == ["segment", "sector"]
