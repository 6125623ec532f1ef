"""The axis of a shaft: the line about which its outer round faces stand."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from optimizer.errors import refuse
from optimizer.mechanics.crankshaft.faces import Cylinders, Frame, Numbers
from optimizer.numerics.arrays import Real
from schemas.base.model import FieldProblem
from schemas.request.shaft import ShaftFrame

#: sine of an angle below which directions are parallel, at least
_PARALLEL = 1e-4
#: of the largest area about a line, below which another line is none of the shaft's axis
_COMPARABLE = 0.4
#: of the area about the axis, above which round faces about other directions are another shaft
_ANOTHER = 0.1
_ROUND_DEG = 300.0


class Line(NamedTuple):
    """A point (3,) and a unit direction (3,)."""

    point: Real
    direction: Real


def axis_of(cylinders: Cylinders, tolerance: float) -> Line:
    """The line with the longest stretch of round faces among those with much area about them.

    Raises
    ------
    OutOfRange
        with round faces about two directions.
    """
    groups = list(_groups(cylinders, tolerance))
    area = np.array([np.sum(cylinders.area[group]) for group in groups])
    span = np.array([_span(cylinders, group) for group in groups])
    best = int(np.argmax(np.where(area >= _COMPARABLE * np.max(area), span, -1.0)))
    group = groups[best]
    refuse(_leaning(cylinders, group, float(area[best]), tolerance))
    return _line(cylinders, group)


def frame_on(line: Line, towards: Real | None = None) -> Frame:
    """The frame with z along a line and x towards a point; its origin is the point nearest to that of the model."""
    z = line.direction if line.direction[np.argmax(np.abs(line.direction))] > 0 else -line.direction
    origin = line.point - z * (line.point @ z)
    # any direction across does for a while
    start = np.eye(3)[np.argmin(np.abs(z))] if towards is None else towards - origin
    return Frame(origin, _across(z, start))


def frame_of(frame: ShaftFrame) -> Frame:
    """The frame of a request."""
    z, x = (np.array(axis, dtype=float) for axis in (frame.z, frame.x))
    z, x = (axis / np.max(np.abs(axis)) for axis in (z, x))
    return Frame(np.array(frame.origin_m, dtype=float), _across(z / np.linalg.norm(z), x))


def lean(direction: Real, reference: Real) -> Real:
    """Sine of the angle between unit directions (..., 3), whatever their senses."""
    return np.linalg.norm(np.cross(direction, reference), axis=-1)


def parallel(cylinders: Cylinders, tolerance: float) -> float:
    """Sine below which directions are parallel: a slip of ten tolerances along the shaft, if that is more."""
    return max(_PARALLEL, 10 * tolerance / extent(cylinders))


def extent(cylinders: Cylinders) -> float:
    """Diagonal of the box about all axes, with the largest radius."""
    tips = cylinders.tips.reshape(-1, 3)
    return float(np.linalg.norm(np.ptp(tips, axis=0)) + np.max(cylinders.radius))


def _across(z: Real, towards: Real) -> Real:
    x = towards - z * (towards @ z)
    x = x / np.linalg.norm(x)
    return np.stack([x, np.cross(z, x), z])


def _groups(cylinders: Cylinders, tolerance: float) -> Iterator[Numbers]:
    """Faces about one line each, those with the largest first."""
    left = np.ones(len(cylinders.radius), dtype=bool)
    order = np.argsort(-cylinders.area, kind="stable")
    bound = parallel(cylinders, tolerance) if len(order) else 0.0
    for first in order:
        if left[first]:
            point, direction = cylinders.point[first], cylinders.direction[first]
            apart = np.linalg.norm(np.cross(cylinders.point - point, direction), axis=-1)
            near = left & (lean(cylinders.direction, direction) <= bound) & (apart <= 10 * tolerance)
            near[first] = True
            left &= ~near
            yield np.flatnonzero(near)


def _line(cylinders: Cylinders, group: Numbers) -> Line:
    """The mean of faces about one line, by area."""
    share = cylinders.area[group] / np.sum(cylinders.area[group])
    directions = cylinders.direction[group]
    directions = directions * np.where(directions @ directions[0] < 0, -1.0, 1.0)[:, None]
    mean = share @ directions
    mean = mean / np.linalg.norm(mean)
    points = cylinders.point[group]
    feet = points - (points @ mean)[:, None] * mean
    return Line(share @ feet, mean)


def _span(cylinders: Cylinders, group: Numbers) -> float:
    along = cylinders.tips[group] @ cylinders.direction[group[0]]
    return float(np.ptp(along))


def _leaning(cylinders: Cylinders, group: Numbers, area: float, tolerance: float) -> Iterator[FieldProblem]:
    """Round faces about another direction, where there is much of them."""
    sine = lean(cylinders.direction, cylinders.direction[group[0]])
    oblique = (sine > parallel(cylinders, tolerance)) & (cylinders.angle_deg >= _ROUND_DEG)
    if np.sum(cylinders.area[oblique]) > _ANOTHER * area:
        worst = int(np.argmax(np.where(oblique, cylinders.area, -1.0)))
        angle = float(np.rad2deg(np.arcsin(min(1.0, sine[worst]))))
        message = f"leans by {angle:.3g} degrees against the axis of the other faces: list the faces of one shaft"
        yield FieldProblem(("faces", int(cylinders.number[worst]), "axis"), message)
