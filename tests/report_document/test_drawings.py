"""The drawings are to scale."""

import math
import re
from collections.abc import Sequence
from xml.etree import ElementTree

import pytest

from optimizer.optimize import optimize
from schemas.answer.counterweights import Counterweight
from service.drawings.front import front
from service.drawings.layout import layout_of
from service.drawings.side import side
from service.drawings.svg import AFTER, Drawing
from service.report import charts
from tests.report_document.conftest import request_of

Point = tuple[float, float]


def shapes(drawing: Drawing, tag: str) -> list[dict[str, str]]:
    root = ElementTree.fromstring(drawing.svg())
    return [shape.attrib for shape in root.iter() if shape.tag.endswith(tag)]


def points(path: str) -> list[Point]:
    return [(float(x), float(y)) for x, y in re.findall(r"(-?[\d.]+) (-?[\d.]+)", path)]


def area(outline: Sequence[Point]) -> float:
    """Shoelace formula."""
    ends = [*outline[1:], outline[0]]
    return abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(outline, ends, strict=True))) / 2


def fitted(example: str, masses: Sequence[float]) -> list[Counterweight]:
    counterweights = optimize(request_of(example)).counterweights
    return [
        counterweight.model_copy(update={"mass_kg": mass})
        for counterweight, mass in zip(counterweights, masses, strict=True)
    ]


def test_crank_pins_stand_where_the_machine_says() -> None:
    machine = request_of("inline-six").machine
    drawing = front(layout_of(machine, ()))
    x0, y0 = drawing.width / 2, drawing.height / 2
    pins = [shape for shape in shapes(drawing, "circle") if shape["r"] == "7"]
    # analytic: y points upwards
    for crank, pin in zip(sorted({throw.crank_angle_deg % 360 for throw in machine.throws}), pins, strict=True):
        angle = math.degrees(math.atan2(y0 - float(pin["cy"]), float(pin["cx"]) - x0)) % 360
        assert angle == pytest.approx(crank, abs=0.1)


def test_areas_of_counterweights_are_in_proportion_to_their_masses() -> None:
    drawing = front(layout_of(request_of("2d12").machine, fitted("2d12", (40, 20, 10, 5))))
    areas = [area(points(shape["d"])) for shape in shapes(drawing, "path") if shape["fill"] == AFTER]
    # analytic, but for the corners of arcs and hundredths of a px
    assert [single_area / areas[0] for single_area in areas] == pytest.approx([1, 0.5, 0.25, 0.125], rel=0.01)


def test_no_counterweights_are_drawn_where_there_are_none() -> None:
    drawing = front(layout_of(request_of("2d12").machine, fitted("2d12", (0, 0, 0, 0))))
    assert not [shape for shape in shapes(drawing, "path") if shape["fill"] == AFTER]


def test_planes_along_the_shaft_are_to_scale() -> None:
    machine = request_of("2d12").machine
    drawing = side(layout_of(machine, fitted("2d12", (40, 20, 10, 5))), dimensions=True)
    bars = [points(shape["d"]) for shape in shapes(drawing, "path") if shape["fill"] == AFTER]
    middles = [(bar[0][0] + bar[1][0]) / 2 for bar in bars]
    planes = [web.position_m for web in machine.webs]
    per_m = (middles[0] - middles[-1]) / (planes[0] - planes[-1])
    assert [middle - middles[0] for middle in middles] == pytest.approx(
        [(plane - planes[0]) * per_m for plane in planes], abs=0.02
    )
    assert 0 < min(middles) < max(middles) < drawing.width


def test_a_hodograph_reaches_its_peak_in_the_direction_of_its_axis() -> None:
    drawing = charts.hodograph("force", "N", [charts.after("peak", 3.0, 1.0, 30.0)])
    (path,) = (
        points(shape["d"]) for shape in shapes(drawing, "path") if shape["stroke"] == AFTER and len(shape["d"]) > 100
    )
    x0, y0 = (sum(values) / len(values) for values in zip(*path[:-1], strict=True))
    tips = [(math.hypot(x - x0, y0 - y), math.degrees(math.atan2(y0 - y, x - x0)) % 180) for x, y in path]
    longest, shortest = max(tips), min(tips)
    assert longest[1] == pytest.approx(30, abs=0.2)
    assert longest[0] / shortest[0] == pytest.approx(3, rel=0.01)


def test_what_is_nothing_looks_like_nothing() -> None:
    drawing = charts.hodograph("force", "N", [charts.after("peak", 1e-9, 1e-9, 0.0)], least=10.0)
    assert [float(shape["r"]) for shape in shapes(drawing, "circle")] == [2.5]
    ends = [points(shape["d"]) for shape in shapes(drawing, "path") if shape["stroke"] == AFTER]
    assert area(ends[0]) < 0.01


def test_a_line_is_broken_where_it_has_no_value() -> None:
    drawing = charts.chart("load", "N", "z", [0, 1, 2, 3, 4, 5], [charts.Line("a", [1, 2, None, 3, 4, 5])])
    drawn = [points(shape["d"]) for shape in shapes(drawing, "path") if shape["stroke-width"] == "1.5"]
    assert [len(values) for values in drawn] == [2, 3]


def test_thinned_lines_keep_their_extremes() -> None:
    count = 36_000
    values = [math.sin(2 * math.pi * k / count) for k in range(count)]
    values[12_345] = 7.5
    drawing = charts.over_turn("load", "N", [360 * k / count for k in range(count)], [charts.Line("a", values)])
    (line,) = (points(shape["d"]) for shape in shapes(drawing, "path") if shape["stroke-width"] == "1.5")
    assert len(line) < 2000
    heights = [y for _, y in line]
    zero = heights[0]
    # analytic: the spike is 7.5 times as far from zero as the smallest value, -1
    assert (zero - min(heights)) / (max(heights) - zero) == pytest.approx(7.5, rel=0.01)


@pytest.mark.parametrize("turns", [1, 2])
def test_lines_over_the_turns_end_where_all_begins_anew(turns: int) -> None:
    angle = [30.0 * step for step in range(12 * turns)]
    drawing = charts.over_turn("torque", "N m", angle, [charts.Line("machine", [1.0, *angle[1:]])])
    texts = [element.text for element in ElementTree.fromstring(drawing.svg()).iter() if element.tag.endswith("text")]
    assert {"0", f"{120 * turns}", f"{360 * turns}"} <= set(texts)
    assert "720" in texts or turns == 1
