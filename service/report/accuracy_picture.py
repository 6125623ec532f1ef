"""Error against time, method by method, with the frontier: a picture for the command line and the documents."""

import math
from collections.abc import Iterator
from itertools import groupby, pairwise

from schemas.request.accuracy import AccuracyAnswer, AccuracyRow, ChoiceRow
from service.drawings.svg import DASHES, FAINT, INK, MUTED, SERIES, Drawing, Point, shortened
from service.report.chapters.accuracy import method_name

_WIDTH, _HEIGHT = 860.0, 460.0
#: px, of the plot; names of methods stand on its right
_LEFT, _RIGHT, _TOP, _BOTTOM = 74.0, 640.0, 34.0, 412.0
_LEGEND, _LINE = 656.0, 20.0
#: decades between the smallest value and the axis
_MARGIN = 0.1
_FONT = "sans-serif"

Row = AccuracyRow | ChoiceRow


def draw(title: str, answer: AccuracyAnswer) -> str:
    """The picture as SVG; errors below the resolution are drawn there."""
    resolution = answer.reference.resolution if answer.reference else 0.0
    ladder: tuple[Row, ...] = answer.choices_ladder or answer.ladder
    points_of_rows = [(row, at) for row in ladder if (at := _place(row, resolution)) is not None]
    drawing = Drawing(_WIDTH, _HEIGHT, f"{title}: true relative error against time of one solve")
    drawing.text((_LEFT, 18), shortened(title, 80), size=13)
    errors = [error for _, (_, error) in points_of_rows] + ([resolution] if resolution > 0.0 else [])
    x = _Decades([time for _, (time, _) in points_of_rows], _LEFT, _RIGHT)
    y = _Decades(errors, _BOTTOM, _TOP)
    _axes(drawing, x, y)
    best = sorted(at for row, at in points_of_rows if row.on_frontier)
    if best:
        drawing.line([(x(time), y(error)) for time, error in _steps(best)], FAINT, 6.0)
    if resolution > 0.0:
        drawing.line([(_LEFT, y(resolution)), (_RIGHT, y(resolution))], MUTED, 1.0, "1 3")
    row_of_legend = _TOP + 6
    for number, (method, rows) in enumerate(groupby(points_of_rows, key=lambda pair: pair[0].method)):
        stroke, dash = SERIES[number % len(SERIES)], DASHES[number % len(DASHES)]
        points = []
        for row, (time, error) in rows:
            points.append((x(time), y(error)))
            drawing.circle(points[-1], 3.0, stroke, stroke)
            drawing.text((points[-1][0] + 5, points[-1][1] - 4), _setting(row), size=9, fill=stroke, halo=True)
        drawing.line(points, stroke, 1.0, dash)
        _legend_line(drawing, row_of_legend, method_name(method), stroke, 1.5, dash)
        row_of_legend += _LINE
    if best:
        _legend_line(drawing, row_of_legend, "frontier", FAINT, 6.0)
        row_of_legend += _LINE
    if resolution > 0.0:
        _legend_line(drawing, row_of_legend, "errors are known to here", MUTED, 1.0, "1 3")
    return drawing.svg(_FONT)


class _Decades:
    """From values above 0 to px, by their logarithms: whole decades around all of them, none on an axis."""

    def __init__(self, values: list[float], start: float, end: float) -> None:
        logs = [math.log10(value) for value in values if value > 0.0] or [0.0]
        self.low = math.floor(min(logs) - _MARGIN)
        self.high = max(math.ceil(max(logs)), self.low + 1)
        self._start, self._end = start, end

    def __call__(self, value: float) -> float:
        share = (math.log10(value) - self.low) / (self.high - self.low) if value > 0.0 else 0.0
        return self._start + share * (self._end - self._start)

    @property
    def ticks(self) -> Iterator[float]:
        """Decades, of many every second or third."""
        step = 1 + (self.high - self.low - 1) // 8
        return (10.0**power for power in range(self.low, self.high + 1, step))


def _axes(drawing: Drawing, x: _Decades, y: _Decades) -> None:
    for value in x.ticks:
        drawing.line([(x(value), _TOP), (x(value), _BOTTOM + 4)], FAINT, 0.8)
        drawing.text((x(value), _BOTTOM + 18), f"{value:g}", "middle", 10)
    for value in y.ticks:
        drawing.line([(_LEFT - 4, y(value)), (_RIGHT, y(value))], FAINT, 0.8)
        drawing.text((_LEFT - 8, y(value) + 3.5), f"{value:.0e}", "end", 10)
    drawing.line([(_LEFT, _TOP), (_LEFT, _BOTTOM), (_RIGHT, _BOTTOM)], INK, 0.8)
    drawing.text((0.5 * (_LEFT + _RIGHT), _BOTTOM + 38), "time of one solve [ms]", "middle", 11)
    drawing.text((16, 0.5 * (_TOP + _BOTTOM)), "true relative error", "middle", 11, vertical=True)


def _legend_line(drawing: Drawing, place: float, name: str, stroke: str, width: float, dash: str | None = None) -> None:
    """A line of the legend."""
    drawing.line([(_LEGEND, place), (_LEGEND + 24, place)], stroke, width, dash)
    drawing.text((_LEGEND + 32, place + 4), shortened(name, 30), size=10)


def _place(row: Row, resolution: float) -> Point | None:
    """Time [ms] and error of a row; None where it has no place on axes of logarithms."""
    if row.time_ms is None or row.relative_error is None:
        return None
    error = max(row.relative_error, resolution)
    return (row.time_ms, error) if row.time_ms > 0.0 and error > 0.0 else None


def _steps(best: list[Point]) -> Iterator[Point]:
    """What is reached with time: no better until the next is."""
    yield best[0]
    for (_, error), (time, lower) in pairwise(best):
        yield time, error
        yield time, lower


def _setting(row: Row) -> str:
    """What a method is set to, in a word; of a scenario its name."""
    if row.method == "one_scenario":
        return shortened(row.setting.removeprefix("scenario "), 14)
    words = row.setting.split()
    return words[0] if row.setting[0].isdigit() else words[-1]
