"""Names in a drawing: above everything else, none over another, and none on a shape where there is room beside it."""

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from service.drawings.svg import FAINT, Anchor, Drawing, Point

#: width of a letter and height of a line, as shares of the size of the text
_LETTER, _LINE = 0.58, 1.2
#: so many lines above or below its place a name is still looked for room
_FARTHEST = 12

Box = tuple[float, float, float, float]
Shape = Sequence[Point]


class Label(NamedTuple):
    """A name, and the middle of where it wants to stand."""

    place: Point
    text: str
    fill: str
    size: float = 13.0


def labels(drawing: Drawing, names: Sequence[Label], shapes: Sequence[Shape]) -> None:
    """Each name at its place, or at the nearest one above or below that is free, with a thin line back.

    Parameters
    ----------
    shapes : closed lines on which names are hard to read.
    """
    boxes: list[Box] = []
    bounded = [(_around(shape), shape) for shape in shapes]
    with drawing.group("names"):
        for label in names:
            box = _room(drawing, label, boxes, bounded)
            if box is not None:
                boxes.append(box)
                _write(drawing, label, box)


def _room(drawing: Drawing, label: Label, boxes: Sequence[Box], shapes: Sequence[tuple[Box, Shape]]) -> Box | None:
    """Where a name stands: clear of everything, or else of other names alone; None where it finds no room."""
    line = _LINE * label.size
    half = 0.5 * _LETTER * label.size * len(label.text) + 2.0
    x = min(max(label.place[0], half), drawing.width - half)
    second = None
    for number in range(2 * _FARTHEST + 1):
        y = label.place[1] + (-1 if number % 2 else 1) * -(-number // 2) * line
        box = (x - half, y - line / 2, x + half, y + line / 2)
        if box[1] < 0 or box[3] > drawing.height or any(_overlap(box, neighbour) for neighbour in boxes):
            continue
        if not any(_overlap(box, around) and _meet(box, shape) for around, shape in shapes):
            return box
        second = second or box
    return second


def _write(drawing: Drawing, label: Label, box: Box) -> None:
    x, middle = (box[0] + box[2]) / 2, (box[1] + box[3]) / 2
    if abs(middle - label.place[1]) > box[3] - box[1]:
        drawing.line([label.place, (x, box[1] if middle > label.place[1] else box[3])], FAINT, 0.8)
    anchor: Anchor = "middle"
    drawing.text((x, middle + 0.35 * label.size), label.text, anchor, label.size, label.fill, halo=True)


def _around(shape: Shape) -> Box:
    return min(x for x, _ in shape), min(y for _, y in shape), max(x for x, _ in shape), max(y for _, y in shape)


def _overlap(first: Box, second: Box) -> bool:
    return first[2] > second[0] and first[0] < second[2] and first[3] > second[1] and first[1] < second[3]


def _meet(box: Box, shape: Shape) -> bool:
    """A corner of one in the other, or the middle of the box in the shape."""
    left, up, right, down = box
    if any(left < x < right and up < y < down for x, y in shape):
        return True
    middle = ((left + right) / 2, (up + down) / 2)
    return any(_within(point, shape) for point in ((left, up), (right, up), (left, down), (right, down), middle))


def _within(point: Point, shape: Shape) -> bool:
    """Whether a line from the point to the right crosses the outline an odd number of times."""
    x, y = point
    inside = False
    for (x1, y1), (x2, y2) in pairwise([shape[-1], *shape]):
        if (y1 > y) != (y2 > y) and x < x1 + (y - y1) / (y2 - y1) * (x2 - x1):
            inside = not inside
    return inside
