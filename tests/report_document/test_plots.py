"""Plots read back (analytic): what is drawn has the values that the marks of its axes say, and is on the paper."""

import math
import re
from collections.abc import Iterator
from typing import NamedTuple
from xml.etree import ElementTree

import pytest

from schemas.request.accuracy import AccuracyAnswer
from service.drawings.svg import AFTER, FAINT, INK, MUTED, SERIES, Drawing
from service.report import charts
from service.report.accuracy_picture import draw
from service.report.loci import Curve, locus
from service.report.scatter import Column, scatter
from tests.report_document.subjects import subject_of

Point = tuple[float, float]
_NUMBER = r"-?\d+(?:\.\d+)?(?:e-?\d+)?"
#: px between a mark and the line that it names, and what hundredths of a px make of a value
_BESIDE, _ROUNDED = 6.0, 2e-3


class Shape(NamedTuple):
    """A line or a circle by its points, or a text by its place."""

    tag: str
    points: list[Point]
    attributes: dict[str, str]
    text: str


def shapes(svg: str) -> Iterator[Shape]:
    for element in ElementTree.fromstring(svg).iter():
        tag = element.tag.rpartition("}")[2]
        if tag == "path":
            numbers = [float(match) for match in re.findall(_NUMBER, element.attrib["d"])]
            yield Shape(tag, list(zip(numbers[::2], numbers[1::2], strict=True)), element.attrib, "")
        elif tag == "circle":
            yield Shape(tag, [(float(element.attrib["cx"]), float(element.attrib["cy"]))], element.attrib, "")
        elif tag == "text":
            turned = re.findall(_NUMBER, element.attrib.get("transform", ""))
            x, y = (turned[-2:]) if turned else (element.attrib["x"], element.attrib["y"])
            yield Shape(tag, [(float(x), float(y))], element.attrib, element.text or "")


class Axis(NamedTuple):
    """px at 0, and px to a unit."""

    start: float
    step: float

    def value(self, place: float) -> float:
        return (place - self.start) / self.step


def marked(text: str) -> float | None:
    """The number that a mark is."""
    plain = (
        text.replace("\N{MINUS SIGN}", "-").replace("\N{NO-BREAK SPACE}", "").replace("\N{NARROW NO-BREAK SPACE}", "")
    )
    return float(plain) if re.fullmatch(_NUMBER.replace("e-?", "e[+-]?"), plain) else None


def axes(svg: str, logarithms: bool = False) -> tuple[Axis, Axis]:
    """Both axes by their marks, each of which stands at a line of the grid; all marks of an axis agree."""
    every = list(shapes(svg))
    grid = [shape.points for shape in every if shape.tag == "path" and len(shape.points) == 2]
    upright = [a[0] for a, b in grid if a[0] == b[0]]
    level = [a[1] for a, b in grid if a[1] == b[1]]
    actual_axes = []
    for anchor, lines, side in (("middle", upright, 0), ("end", level, 1)):
        marks = []
        for front in every:
            number = (
                marked(front.text) if front.tag == "text" and front.attributes.get("text-anchor") == anchor else None
            )
            near = [line for line in lines if abs(line - front.points[0][side]) < _BESIDE] if front.points else []
            if number is not None:
                assert near, front
                marks.append(
                    (
                        math.log10(number) if logarithms else number,
                        min(near, key=lambda line: abs(line - front.points[0][side])),
                    )
                )
        assert len(marks) >= 2
        (low, start), (high, end) = min(marks), max(marks)
        axis = Axis(start - low * (end - start) / (high - low), (end - start) / (high - low))
        assert all(abs(axis.value(place) - number) < _ROUNDED * (high - low) for number, place in marks)
        actual_axes.append(axis)
    return actual_axes[0], actual_axes[1]


def values(svg: str, points: list[Point], logarithms: bool = False) -> list[Point]:
    """Points in the units of the axes."""
    x, y = axes(svg, logarithms)
    return [(x.value(across), y.value(upward)) for across, upward in points]


def near(entries: list[Point], rows: list[Point]) -> bool:
    """The same but for hundredths of a px."""
    assert len(entries) == len(rows)
    size = [max(abs(row[side]) for row in rows) or 1.0 for side in (0, 1)]
    return all(
        abs(point[side] - second_row[side]) < _ROUNDED * size[side]
        for point, second_row in zip(entries, rows, strict=True)
        for side in (0, 1)
    )


def on_paper(svg: str) -> bool:
    """Whether all that is drawn is inside the drawing, texts by their place."""
    root = ElementTree.fromstring(svg)
    _, _, width, height = map(float, root.attrib["viewBox"].split())
    inside = []
    for shape in shapes(svg):
        room = float(shape.attributes["r"]) if shape.tag == "circle" else 0.0
        inside += [room <= x <= width - room and room <= y <= height - room for x, y in shape.points]
    return all(inside)


def lines(svg: str, stroke: str) -> list[list[Point]]:
    """Lines of a colour, longest first."""
    points = [shape.points for shape in shapes(svg) if shape.tag == "path" and shape.attributes.get("stroke") == stroke]
    return sorted(points, key=len, reverse=True)


@pytest.mark.parametrize("factor", [1.0, 1e3])
def test_lines_of_a_chart_have_their_values(factor: float) -> None:
    places, first, second = [-0.4, 0.1, 0.3, 0.9], [3.0, -2.0, 7.0, 1.0], [1.0, 4.0, -5.0, 2.0]
    of_lines = [
        charts.Line(name, [factor * 40.0 * height for height in line]) for name, line in (("a", first), ("b", second))
    ]
    svg = charts.chart("load", "N", "z, m", places, of_lines).svg()
    for line, stroke in ((first, SERIES[0]), (second, SERIES[1])):
        entries = values(svg, lines(svg, stroke)[0])
        assert near(entries, [(place, 40.0 * height) for place, height in zip(places, line, strict=True)])
    assert any(shape.text == ("load, kN" if factor > 1 else "load, N") for shape in shapes(svg))
    assert on_paper(svg)


def test_designs_have_their_values_and_the_front_joins_those_that_none_beats() -> None:
    across, upward = [3.0, 1.0, 2.0, 4.0], [10.0, 40.0, 20.0, 5.0]
    svg = scatter(Column("mass", "kg", across), Column("force", "N", upward)).svg()
    drawn = [shape.points[0] for shape in shapes(svg) if shape.tag == "circle" and shape.attributes["stroke"] == AFTER]
    assert near(values(svg, drawn), list(zip(across, upward, strict=True)))
    assert on_paper(svg)


@pytest.mark.parametrize("factor", [1.0, 1e3])
@pytest.mark.parametrize("turn", range(4))
def test_a_circle_around_a_curve_is_where_it_is_and_on_the_paper(turn: int, factor: float) -> None:
    """Far from the origin, in every quadrant."""
    centre = (30.0 + 10.0j) * 1j**turn
    points = [centre + 8.0 * math.cos(angle / 9) + 5.0j * math.sin(angle / 9) for angle in range(57)]
    curve = Curve("A", [40.0 * factor * point for point in points], 40.0 * factor * centre, 320.0 * factor, SERIES[2])
    svg = locus("force", "N", [curve]).svg()
    points, centre = [40.0 * point for point in points], 40.0 * centre
    drawn = lines(svg, SERIES[2])[0]
    assert near(values(svg, drawn[:-1]), [(point.real, point.imag) for point in points])
    (circle,) = (shape for shape in shapes(svg) if shape.tag == "circle" and float(shape.attributes["r"]) > 5.0)
    assert near(values(svg, circle.points), [(centre.real, centre.imag)])
    x, y = axes(svg)
    # equal scales, y upwards
    assert x.step == pytest.approx(-y.step, rel=_ROUNDED)
    assert float(circle.attributes["r"]) == pytest.approx(320.0 * x.step, rel=_ROUNDED)
    assert on_paper(svg)


def test_a_hodograph_has_its_peak_in_the_units_of_its_axes() -> None:
    svg = charts.hodograph("force", "N", [charts.after("with", 30.0, 10.0, 25.0)]).svg()
    entries = values(svg, lines(svg, AFTER)[0])
    farthest = max(entries, key=lambda point: math.hypot(*point))
    assert math.hypot(*farthest) == pytest.approx(30.0, rel=_ROUNDED)
    assert math.degrees(math.atan2(farthest[1], farthest[0])) % 180 == pytest.approx(25.0, abs=1.1)
    assert min(math.hypot(*point) for point in entries) == pytest.approx(10.0, rel=_ROUNDED)
    x, y = axes(svg)
    assert x.step == pytest.approx(-y.step, rel=1e-9)
    assert on_paper(svg)


@pytest.mark.parametrize(
    ("svg", "dark"),
    [
        (charts.hodograph("force", "N", [charts.after("with", 30.0, 10.0, 25.0)]).svg(), MUTED),
        (locus("force", "N", [Curve("A", [3 + 4j, 5 - 2j, -1j], 3 + 1j, 4.0, SERIES[2])]).svg(), MUTED),
        (charts.chart("load", "N", "z", [-1.0, 0.0, 1.0], [charts.Line("a", [3.0, -2.0, 1.0])]).svg(), INK),
    ],
)
def test_the_line_of_nothing_is_darker_than_the_others(svg: str, dark: str) -> None:
    """That of a chart along one axis, of what is on equal scales along both."""
    for side, axis in enumerate(axes(svg)):
        along = [
            shape for shape in shapes(svg) if shape.tag == "path" and len({point[side] for point in shape.points}) == 1
        ]
        grid = [shape for shape in along if shape.attributes.get("stroke-width") == "0.8"]
        assert len(grid) > 2
        for front in grid if side == 1 or dark == MUTED else ():
            nothing = abs(axis.value(front.points[0][side])) < _ROUNDED
            assert (front.attributes["stroke"] == dark) == nothing


@pytest.mark.parametrize(("values", "room"), [([100.0, 200.0], 3.0), ([7.0, 7.0], 0.7), ([0.0, 0.0], 1.0)])
def test_an_axis_around_values_has_a_little_room_on_either_side(values: list[float], room: float) -> None:
    """Analytic: 3 % of what they span, or 10 % of one that is alone."""
    low, high, marks = charts.spread(values)
    assert (min(values) - low, high - max(values)) == (pytest.approx(room), pytest.approx(room))
    assert low <= min(marks) <= max(marks) <= high
    assert len(marks) >= 2


def test_methods_stand_at_their_time_and_error() -> None:
    """On decades: a time of 1.9 ms and an error of 1.3e-3, of one method."""
    answer = subject_of("accuracy").about
    assert isinstance(answer, AccuracyAnswer)
    svg = draw("ladder", answer)
    (row,) = answer.ladder
    drawn = [shape.points[0] for shape in shapes(svg) if shape.tag == "circle"]
    entries = values(svg, drawn, logarithms=True)
    assert row.time_ms is not None
    assert row.relative_error is not None
    assert near(entries, [(math.log10(row.time_ms), math.log10(row.relative_error))])
    assert on_paper(svg)
    assert any(shape.text == "ladder" for shape in shapes(svg))


def test_colours_of_the_grid_are_not_those_of_lines() -> None:
    assert FAINT not in SERIES
    assert isinstance(charts.chart("a", "N", "z", [0.0, 1.0], [charts.Line("a", [1.0, 2.0])]), Drawing)
