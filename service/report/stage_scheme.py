"""The scheme of the balancing stages: the layout, and on it the directions of forces and the planes of moments.

The slides on balancing draw each of the stages I to VI so before they write its formula. They show the layout, the
directions on it, what counterweights can do, and what is left. Stage VII shows the counterweights, stage VIII what is
left of all.
"""

import math
from collections.abc import Sequence

from schemas.answer.outputs import Stage
from schemas.answer.stages import Acting, StageIron
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import ReciprocatingMachine
from service.common.figures import digits
from service.drawings.svg import AFTER, BEFORE, FAINT, INK, MUTED, PAGE_WIDTH, SERIES, Drawing, Point

_COLUMNS, _SIDE, _HEIGHT = 4, 154.0, 204.0
#: radius that the largest of a stage is drawn with
_REACH = 50.0
_CENTRE = (_SIDE / 2, 92.0)
#: where the words below a picture begin
_BELOW = 168.0
#: rows and cranks that are drawn
_MOST = 24
_WORDS = {
    "with_shaft": "with the shaft",
    "against_shaft": "against the shaft",
    "fixed": "one direction",
    "ellipse": "ellipse",
}


def stage_scheme(machine: Machine, stages: Sequence[Stage]) -> Drawing:
    """The eight stages, four to a row: without counterweights dashed, what they leave solid."""
    rows = -(-len(stages) // _COLUMNS)
    drawing = Drawing(PAGE_WIDTH, rows * _HEIGHT, "scheme of the eight balancing stages")
    gap = (PAGE_WIDTH - _COLUMNS * _SIDE) / (_COLUMNS - 1)
    for k, stage in enumerate(stages):
        drawing.inset(_stage(machine, stage), ((_SIDE + gap) * (k % _COLUMNS), _HEIGHT * (k // _COLUMNS)))
    return drawing


def _stage(machine: Machine, stage: Stage) -> Drawing:
    drawing = Drawing(_SIDE, _HEIGHT, stage.title)
    drawing.text((0, 12), stage.stage, size=12)
    words = stage.title.split()
    # in two lines, of which the number takes a part of the first
    first = " ".join(words[: (len(words) + 1) // 2])
    drawing.text((24, 10), first, size=9)
    drawing.text((24, 21), " ".join(words[(len(words) + 1) // 2 :]), size=9)
    _layout(drawing, machine)
    if stage.stage == "VII":
        _iron(drawing, stage.iron)
    elif stage.stage == "VIII":
        _summary(drawing, stage)
    else:
        _vectors(drawing, machine, stage)
    return drawing


def _layout(drawing: Drawing, machine: Machine) -> None:
    """Row axes dash-dotted, cranks solid, from the front at shaft angle 0."""
    drawing.circle(_CENTRE, 2.0, MUTED, MUTED)
    if not isinstance(machine, ReciprocatingMachine):
        return
    largest = max(throw.crank_radius_m for throw in machine.throws)
    axes = dict.fromkeys(row.axis_deg % 360.0 for throw in machine.throws for row in throw.rows)
    for axis in list(axes)[:_MOST]:
        drawing.line([_CENTRE, _at(_REACH + 12, axis)], MUTED, 0.8, "9 3 2 3")
    for throw in machine.throws[:_MOST]:
        tip = _at(18.0 * throw.crank_radius_m / largest, throw.crank_angle_deg)
        drawing.line([_CENTRE, tip], INK, 2.0)
        drawing.circle(tip, 2.6, INK, "white")


def _vectors(drawing: Drawing, machine: Machine, stage: Stage) -> None:
    """Before and after, on one scale."""
    left = () if stage.left is None else stage.left
    largest = max([vector.peak for vector in (*stage.acting, *left)], default=0.0)
    sense = 1.0 if machine.rotation == "ccw" else -1.0
    for vector in stage.acting:
        _vector(drawing, vector, largest, sense, BEFORE, "5 3")
    for vector in left:
        _vector(drawing, vector, largest, sense, AFTER, None)
    y = _BELOW
    for name, result, stroke in (("without", stage.acting, BEFORE), ("left", left, AFTER)):
        for vector in result:
            drawing.text((0, y), f"{name}: {_words(vector)}", size=8.5, fill=stroke)
            y += 11
    times = f"order {stage.acting[0].order}, " if stage.acting else ""
    drawing.text((0, y), f"{times}{stage.frequency}", size=8.5, fill=MUTED)


def _vector(drawing: Drawing, vector: Acting, largest: float, sense: float, stroke: str, dash: str | None) -> None:
    """A circle with an arrow that turns, a line to both sides, or an ellipse; of a moment, its plane is drawn so."""
    if vector.motion == "none" or vector.direction_deg is None or largest == 0.0:
        return
    major, minor = (_REACH * size / largest for size in (vector.peak, vector.minor))
    if major < 2.0:
        drawing.circle(_CENTRE, 3.0, stroke)
        return
    if vector.motion == "fixed":
        tips = [_at(major, vector.direction_deg), _at(major, vector.direction_deg + 180.0)]
        drawing.line(tips, stroke, 1.8, dash)
        for tip, away in zip(tips, (vector.direction_deg, vector.direction_deg + 180.0), strict=True):
            _head(drawing, tip, away, stroke)
        return
    turns = vector.motion != "ellipse"
    points = [_ellipse(major, major if turns else minor, vector.direction_deg, 5.0 * step) for step in range(73)]
    drawing.line(points, stroke, 1.0 if turns else 1.6, dash)
    if turns:
        tip = _at(major, vector.direction_deg)
        drawing.line([_CENTRE, tip], stroke, 1.8, dash)
        _head(drawing, tip, vector.direction_deg, stroke)
        ahead = sense * (1.0 if vector.motion == "with_shaft" else -1.0)
        # which way it runs, a quarter of a turn on
        _head(drawing, _at(major, vector.direction_deg + 90.0 * ahead), vector.direction_deg + 180.0 * ahead, stroke)


def _iron(drawing: Drawing, iron: Sequence[StageIron]) -> None:
    """Mass times radius in both planes: against rotating masses solid, for the whole reciprocating force dashed."""
    parts = [
        (complex(web.rotating_x_kg_m, web.rotating_y_kg_m), complex(web.reciprocating_x_kg_m, web.reciprocating_y_kg_m))
        for web in iron
    ]
    largest = max((abs(vector) for pair in parts for vector in pair), default=0.0)
    y = _BELOW
    for k, (web, pair) in enumerate(zip(iron, parts, strict=True)):
        stroke = SERIES[k]
        for value, dash in zip(pair, (None, "5 3"), strict=True):
            if largest and abs(value) > 0.02 * largest:
                away = math.degrees(math.atan2(value.imag, value.real))
                tip = _at(_REACH * abs(value) / largest, away)
                drawing.line([_CENTRE, tip], stroke, 1.8, dash)
                _head(drawing, tip, away, stroke)
        sizes = " + k ".join(digits(abs(value)) for value in pair)
        drawing.text((0, y), f"z = {digits(web.position_m)} m: {sizes}", size=8.5, fill=stroke)
        y += 11
    words = "kg m: rotating + k reciprocating" if iron else "no webs"
    drawing.text((0, y), words, size=8.5, fill=MUTED)


def _summary(drawing: Drawing, stage: Stage) -> None:
    """All that is left, in words: forces and moments of both orders have no scale in common."""
    y = 32.0
    drawing.area([(0, 28), (_SIDE, 28), (_SIDE, 196), (0, 196)], "white", stroke=FAINT)
    for vector in stage.acting if stage.left is None else stage.left:
        drawing.text((6, y + 8), f"{vector.quantity} of order {vector.order}", size=9.5)
        drawing.text((6, y + 20), _words(vector), size=9, fill=BEFORE if stage.left is None else AFTER)
        if vector.direction_deg is not None:
            drawing.text((6, y + 32), f"at {digits(round(vector.direction_deg, 1))}°", size=9, fill=MUTED)
        y += 40.0


def _words(vector: Acting) -> str:
    return "none" if vector.motion == "none" else f"{digits(vector.peak)} {vector.unit}, {_WORDS[vector.motion]}"


def _at(radius: float, angle_deg: float) -> Point:
    """A point about the shaft, x to the right and y upwards."""
    angle = math.radians(angle_deg)
    return _CENTRE[0] + radius * math.cos(angle), _CENTRE[1] - radius * math.sin(angle)


def _ellipse(major: float, minor: float, axis_deg: float, angle_deg: float) -> Point:
    axis, angle = math.radians(axis_deg), math.radians(angle_deg)
    along, across = major * math.cos(angle), minor * math.sin(angle)
    x = along * math.cos(axis) - across * math.sin(axis)
    y = along * math.sin(axis) + across * math.cos(axis)
    return _CENTRE[0] + x, _CENTRE[1] - y


def _head(drawing: Drawing, tip: Point, away_deg: float, stroke: str) -> None:
    """An arrow head."""
    ends = []
    for side in (150.0, -150.0):
        angle = math.radians(away_deg + side)
        ends.append((tip[0] + 8 * math.cos(angle), tip[1] - 8 * math.sin(angle)))
    drawing.area([tip, *ends], stroke)
