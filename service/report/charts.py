"""Charts: lines over the turn or along the shaft, and hodographs."""

import math
from collections.abc import Sequence
from typing import NamedTuple

from service.common.figures import typeset
from service.drawings.svg import (
    AFTER,
    BEFORE,
    DASHES,
    FAINT,
    INK,
    MUTED,
    PAGE_WIDTH,
    SERIES,
    Drawing,
    Point,
    shortened,
)
from service.report.blocks import prose, turns_of

#: nobody can distinguish more lines than this
MAX_LINES = len(SERIES)
#: points of a line that are separate on paper
_BINS = 720
#: components of a vector across the shaft, as they stand at the axes
FORCE_AXES = ("force along x", "force along y")
COUPLE_AXES = ("couple of the x forces", "couple of the y forces")
#: an ellipse smaller than this is marked by a circle of this radius, px
_DOT = 2.5
#: smallest value that a prefix is used for, factor and prefix
_PREFIXES = ((1e10, 1e9, "G"), (1e7, 1e6, "M"), (1e4, 1e3, "k"))


class Line(NamedTuple):
    """One line of a chart; it is broken where it has no value."""

    name: str
    values: Sequence[float | None]


class Ellipse(NamedTuple):
    """An ellipse about the origin, as the answers give it; or a circle."""

    name: str
    major: float
    minor: float
    axis_deg: float
    stroke: str
    width: float
    dash: str | None = None


class _Scale(NamedTuple):
    """From values to px."""

    low: float
    high: float
    start: float
    end: float

    def __call__(self, value: float) -> float:
        return self.start + (value - self.low) / (self.high - self.low) * (self.end - self.start)


def over_turn(title: str, unit: str, angle_deg: Sequence[float], lines: Sequence[Line]) -> Drawing:
    """Lines over the turns of the shaft after which all repeats; the samples go on at their end as they began."""
    closed = [Line(line.name, [*line.values, line.values[0]]) for line in lines]
    turns = turns_of(angle_deg)
    ticks = [60.0 * turns * mark for mark in range(7)]
    return chart(title, unit, "shaft angle, deg", [*angle_deg, ticks[-1]], closed, ticks)


def chart(
    title: str,
    unit: str,
    across: str,
    places: Sequence[float],
    lines: Sequence[Line],
    ticks: Sequence[float] | None = None,
) -> Drawing:
    """Lines over places on one axis.

    Parameters
    ----------
    ticks : marks of the axis across; by default round numbers.
    """
    longest = max((len(line.name) for line in lines), default=0)
    beside = 4 if longest <= 20 else 2
    rows = -(-len(lines) // beside) if len(lines) > 1 else 0
    top, left = 24.0 + 16.0 * rows, 66.0
    drawing = Drawing(PAGE_WIDTH, top + 190.0, f"{title}: {', '.join(line.name for line in lines)}")
    results = [value for line in lines for value in line.values if value is not None]
    factor, large = prefix(max(map(abs, results), default=0.0))
    low, high, steps = axis(min(results, default=0.0) / factor, max(results, default=0.0) / factor)
    bottom = top + 150.0
    x = _Scale(*_ends(places, ticks), left, PAGE_WIDTH - 14.0)
    y = _Scale(low, high, bottom, top)
    for value in steps:
        drawing.line([(left, y(value)), (x.end, y(value))], INK if value == 0 else FAINT, 0.8)
        drawing.text((left - 6, y(value) + 3.5), tick(value), "end", 10)
    for value in ticks or axis(x.low, x.high)[2]:
        if x.low <= value <= x.high:
            drawing.line([(x(value), top), (x(value), bottom + 4)], FAINT, 0.8)
            drawing.text((x(value), bottom + 16), tick(value), "middle", 10)
    drawing.line([(left, top), (left, bottom), (x.end, bottom)], MUTED, 0.8)
    drawing.text((left, 12), f"{title}, {large}{unit}", size=11)
    drawing.text((x.end, bottom + 32), across, "end", 10, MUTED)
    for index, line in enumerate(lines):
        stroke, dash = SERIES[index % MAX_LINES], DASHES[index % MAX_LINES]
        for points in _pieces(places, line.values):
            drawing.line([(x(place), y(value / factor)) for place, value in points], stroke, 1.5, dash)
        if rows:
            place = left + (index % beside) * 568.0 / beside, 27.0 + 16.0 * (index // beside)
            drawing.line([place, (place[0] + 22, place[1])], stroke, 1.5, dash)
            drawing.text((place[0] + 27, place[1] + 3.5), shortened(line.name, 80 // beside), size=10)
    return drawing


def hodograph(
    title: str, unit: str, ellipses: Sequence[Ellipse], least: float = 0.0, axes: tuple[str, str] = FORCE_AXES
) -> Drawing:
    """Ellipses that the tip of a vector runs along, on equal scales.

    Parameters
    ----------
    least : the drawing reaches at least so far, so that what is nothing beside it looks like nothing.
    axes : names of the components.
    """
    width = PAGE_WIDTH / 2 - 6
    drawing = Drawing(width, width + 46, f"hodograph of {title}: {', '.join(ellipse.name for ellipse in ellipses)}")
    largest = max([ellipse.major for ellipse in ellipses] + [least])
    factor, large = prefix(largest)
    low, high, steps = axis(-largest / factor, largest / factor, 8)
    x, y = _Scale(low, high, 42, width - 8), _Scale(low, high, width - 38, 12)
    for value in steps:
        stroke = MUTED if value == 0 else FAINT
        drawing.line([(x(low), y(value)), (x(high), y(value))], stroke, 0.8)
        drawing.line([(x(value), y(low)), (x(value), y(high))], stroke, 0.8)
        drawing.text((x(low) - 4, y(value) + 3.5), tick(value), "end", 9)
        drawing.text((x(value), y(low) + 12), tick(value), "middle", 9)
    drawing.text((x(high), y(low) + 24), f"{axes[0]}, {large}{unit}", "end", 9, MUTED)
    drawing.text((9, y(high)), f"{axes[1]}, {large}{unit}", "end", 9, MUTED, vertical=True)
    for index, ellipse in enumerate(ellipses):
        points = [(x(a / factor), y(b / factor)) for a, b in _ellipse(ellipse)]
        if ellipse.major / factor * (x.end - x.start) / (x.high - x.low) < _DOT:
            drawing.circle(points[0], _DOT, ellipse.stroke)
        drawing.line(points, ellipse.stroke, ellipse.width, ellipse.dash)
        place = 42.0, width + 2 + 16 * index
        drawing.line([place, (place[0] + 22, place[1])], ellipse.stroke, ellipse.width, ellipse.dash)
        drawing.text((place[0] + 27, place[1] + 3.5), f"{ellipse.name} {prose(ellipse.major)} {unit}", size=10)
    return drawing


def before(peak: float, minor: float, axis_deg: float) -> Ellipse:
    return Ellipse("without counterweights: peak", peak, minor, axis_deg, BEFORE, 1.4, "7 3")


def after(name: str, peak: float, minor: float, axis_deg: float) -> Ellipse:
    return Ellipse(name, peak, minor, axis_deg, AFTER, 2.0)


def as_built(peak: float, minor: float, axis_deg: float) -> Ellipse:
    return Ellipse("as built: peak", peak, minor, axis_deg, SERIES[3], 1.4, "9 3 2 3")


def floor(radius: float) -> Ellipse:
    return Ellipse("floor", radius, radius, 0.0, INK, 1.0, "2 2")


def _ellipse(ellipse: Ellipse) -> list[Point]:
    turn = complex(math.cos(math.radians(ellipse.axis_deg)), math.sin(math.radians(ellipse.axis_deg)))
    results = []
    for step in range(181):
        angle = math.radians(2 * step)
        tip = complex(ellipse.major * math.cos(angle), ellipse.minor * math.sin(angle)) * turn
        results.append((tip.real, tip.imag))
    return results


def prefix(largest: float) -> tuple[float, str]:
    return next(((factor, prefix) for least, factor, prefix in _PREFIXES if largest >= least), (1.0, ""))


def axis(low: float, high: float, parts: int = 5) -> tuple[float, float, list[float]]:
    """Ends and marks of an axis: round numbers around the values, 0 among them."""
    low, high = min(low, 0.0), max(high, 0.0)
    if high - low < 1e-200:
        low, high = -1.0, 1.0
    step = _round_step((high - low) / parts)
    first, last = math.floor(low / step + 1e-9), math.ceil(high / step - 1e-9)
    return first * step, last * step, [mark * step for mark in range(first, last + 1)]


def spread(values: Sequence[float], factor: float = 1.0) -> tuple[float, float, list[float]]:
    """Ends and marks of an axis around values in units of ``factor``, wherever these are; with room on either side."""
    low, high = min(values) / factor, max(values) / factor
    room = 0.03 * (high - low) or 0.1 * abs(high) or 1.0
    low, high = low - room, high + room
    step = _round_step((high - low) / 5)
    marks = range(math.ceil(low / step), math.floor(high / step) + 1)
    return low, high, [mark * step for mark in marks]


def _round_step(rough: float) -> float:
    power = 10.0 ** math.floor(math.log10(rough))
    return next(factor * power for factor in (1.0, 2.0, 2.5, 5.0, 10.0) if factor * power >= rough * (1 - 1e-9))


def _ends(places: Sequence[float], ticks: Sequence[float] | None) -> tuple[float, float]:
    if ticks is not None:
        return ticks[0], ticks[-1]
    low, high = min(places, default=0.0), max(places, default=0.0)
    room = 0.03 * (high - low) or 1.0
    return low - room, high + room


def _pieces(places: Sequence[float], values: Sequence[float | None]) -> list[list[Point]]:
    """The stretches that have values, thinned to the lowest and highest of every few."""
    pieces: list[list[Point]] = [[]]
    for place, value in zip(places, values, strict=True):
        if value is None:
            pieces.append([])
        else:
            pieces[-1].append((place, value))
    return [_thinned(piece) for piece in pieces if len(piece) > 1]


def _thinned(points: list[Point]) -> list[Point]:
    if len(points) <= 2 * _BINS:
        return points
    extremes = []
    for index in range(_BINS):
        bin_ = range(index * len(points) // _BINS, (index + 1) * len(points) // _BINS)
        # in the order of the line, which may come back
        ends = {choose(bin_, key=lambda k: points[k][1]) for choose in (min, max)}
        extremes += [points[k] for k in sorted(ends)]
    return [points[0], *extremes, points[-1]]


def tick(value: float) -> str:
    return typeset(f"{value + 0.0:.6g}") if abs(value) > 1e-300 else "0"
