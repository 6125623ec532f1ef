"""A scatter of designs by two of their columns, with the front of those that no other beats in both."""

from collections.abc import Sequence
from typing import NamedTuple

from service.drawings.svg import AFTER, BEFORE, FAINT, MUTED, PAGE_WIDTH, Drawing, Point
from service.report.charts import prefix, spread, tick

#: designs that are separate points on paper; of more every so manieth is drawn, and all of the front
MOST_POINTS = 5_000
_LEFT, _RIGHT, _TOP, _HEIGHT = 72.0, 14.0, 34.0, 320.0


class Column(NamedTuple):
    """One column of rows: its name, its unit if there is one, and a value for each design."""

    name: str
    unit: str
    values: Sequence[float]


def front(across: Sequence[float], upward: Sequence[float]) -> list[int]:
    """Designs that no other beats, both columns to be small: places in the columns, by the first of them."""
    results: list[int] = []
    for place in sorted(range(len(across)), key=lambda place: (across[place], upward[place])):
        if not results or upward[place] < upward[results[-1]]:
            results.append(place)
    return results


def scatter(across: Column, upward: Column) -> Drawing:
    """A point for each design, those of the front joined; the values are finite, and there is at least one."""
    best = front(across.values, upward.values)
    count = len(across.values)
    drawing = Drawing(
        PAGE_WIDTH, _TOP + _HEIGHT + 42.0, f"{count} designs by {across.name} and {upward.name}, and their front"
    )
    bottom, right = _TOP + _HEIGHT, PAGE_WIDTH - _RIGHT
    (large_x, unit_x), (large_y, unit_y) = (prefix(max(map(abs, column.values))) for column in (across, upward))
    low_x, high_x, marks_x = spread(across.values, large_x)
    low_y, high_y, marks_y = spread(upward.values, large_y)

    def place(index: int) -> Point:
        x, y = across.values[index] / large_x, upward.values[index] / large_y
        part_x, part_y = (x - low_x) / (high_x - low_x), (y - low_y) / (high_y - low_y)
        return _LEFT + part_x * (right - _LEFT), bottom - part_y * _HEIGHT

    for value in marks_x:
        x = _LEFT + (value - low_x) / (high_x - low_x) * (right - _LEFT)
        drawing.line([(x, _TOP), (x, bottom + 4)], FAINT, 0.8)
        drawing.text((x, bottom + 16), tick(value), "middle", 10)
    for value in marks_y:
        y = bottom - (value - low_y) / (high_y - low_y) * _HEIGHT
        drawing.line([(_LEFT, y), (right, y)], FAINT, 0.8)
        drawing.text((_LEFT - 6, y + 3.5), tick(value), "end", 10)
    drawing.line([(_LEFT, _TOP), (_LEFT, bottom), (right, bottom)], MUTED, 0.8)
    for index in range(0, count, -(-count // MOST_POINTS)):
        drawing.circle(place(index), 2.0, AFTER, width=0.8)
    drawing.line([place(index) for index in best], BEFORE, 1.5)
    for index in best:
        drawing.circle(place(index), 2.5, BEFORE, BEFORE)
    drawing.text((_LEFT, 14), _title(upward, unit_y), size=11)
    drawing.text((right, bottom + 34), _title(across, unit_x), "end", 11)
    drawing.text((right, 14), f"{count} designs, {len(best)} on the front", "end", 10, MUTED)
    return drawing


def _title(column: Column, large: str) -> str:
    return f"{column.name}, {large}{column.unit}" if column.unit or large else column.name
