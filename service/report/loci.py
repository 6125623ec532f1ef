"""Loci: curves and circles across the shaft, on equal scales and wherever they are."""

from collections.abc import Sequence
from typing import NamedTuple

from service.common.figures import digits
from service.drawings.svg import FAINT, INK, MUTED, PAGE_WIDTH, Drawing
from service.report.charts import axis, prefix, tick


class Curve(NamedTuple):
    """A closed curve, and the smallest circle around it."""

    name: str
    points: Sequence[complex]
    centre: complex
    radius: float
    stroke: str
    dash: str | None = None


def locus(title: str, unit: str, curves: Sequence[Curve]) -> Drawing:
    """Curves that the tip of a vector runs along, each with its circle; the origin is in the picture."""
    side = PAGE_WIDTH / 2 - 6
    drawing = Drawing(side, side + 46, f"{title}: {', '.join(curve.name for curve in curves)}")
    corners = [0j] + [curve.centre + curve.radius * way for curve in curves for way in (-1 - 1j, 1 + 1j)]
    factor, large = prefix(max(max(abs(corner.real), abs(corner.imag)) for corner in corners))
    low_x, high_x = min(corner.real for corner in corners), max(corner.real for corner in corners)
    low_y, high_y = min(corner.imag for corner in corners), max(corner.imag for corner in corners)
    half = 0.54 * max(high_x - low_x, high_y - low_y) / factor or 1.0
    middle = complex(low_x + high_x, low_y + high_y) / (2.0 * factor)
    per_unit = (side - 50) / (2.0 * half)

    def place(value: complex) -> tuple[float, float]:
        away = value / factor - middle
        return 42 + (side - 50) / 2 + per_unit * away.real, 12 + (side - 50) / 2 - per_unit * away.imag

    left, bottom = 42.0, 12.0 + side - 50
    for value in _within(middle.real - half, middle.real + half):
        x, _ = place(complex(value * factor, 0.0))
        drawing.line([(x, 12), (x, bottom)], MUTED if value == 0 else FAINT, 0.8)
        drawing.text((x, bottom + 12), tick(value), "middle", 9)
    for value in _within(middle.imag - half, middle.imag + half):
        _, y = place(complex(0.0, value * factor))
        drawing.line([(left, y), (side - 8, y)], MUTED if value == 0 else FAINT, 0.8)
        drawing.text((left - 4, y + 3.5), tick(value), "end", 9)
    drawing.text((side - 8, bottom + 24), f"{title} x, {large}{unit}", "end", 9, MUTED)
    drawing.text((9, 12), f"{title} y, {large}{unit}", "end", 9, MUTED, vertical=True)
    for index, curve in enumerate(curves):
        closed = [*curve.points, *curve.points[:1]]
        drawing.line([place(point) for point in closed], curve.stroke, 1.6, curve.dash)
        drawing.circle(place(curve.centre), per_unit * curve.radius / factor, curve.stroke, width=0.8, dash="2 2")
        drawing.circle(place(curve.centre), 1.5, curve.stroke, curve.stroke)
        key = 42.0, side + 2 + 16 * index
        drawing.line([key, (key[0] + 22, key[1])], curve.stroke, 1.6, curve.dash)
        drawing.text((key[0] + 27, key[1] + 3.5), f"{curve.name}: circle {digits(curve.radius)} {unit}", size=10)
    drawing.circle(place(0j), 2.0, INK, INK)
    return drawing


def _within(low: float, high: float) -> list[float]:
    """Round values between two ends."""
    return [value for value in axis(low, high, 6)[2] if low <= value <= high]
