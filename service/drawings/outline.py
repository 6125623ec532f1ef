"""Outlines of what is cut from a plate: straight lines and arcs about the shaft, closed, counter-clockwise.

Lengths are m, angles rad. The shaft is at the origin and the counterweight stands upwards, symmetric about the y axis,
until it is turned.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from math import acos, cos, pi, sin, sqrt

from schemas.machine.webs import Envelope

Point = tuple[float, float]


@dataclass(frozen=True)
class Line:
    """A straight edge."""

    start: Point
    end: Point

    def rotation(self, angle: float) -> "Line":
        """About the shaft, counter-clockwise."""
        return Line(_rotation(self.start, angle), _rotation(self.end, angle))


@dataclass(frozen=True)
class Arc:
    """An arc about the shaft, from one angle to another: counter-clockwise where the second is larger."""

    radius: float
    first: float
    last: float

    @property
    def start(self) -> Point:
        return self.radius * cos(self.first), self.radius * sin(self.first)

    @property
    def end(self) -> Point:
        return self.radius * cos(self.last), self.radius * sin(self.last)

    @property
    def outward(self) -> bool:
        """Whether the counterweight lies within the arc."""
        return self.last > self.first

    def rotation(self, angle: float) -> "Arc":
        """About the shaft, counter-clockwise."""
        return Arc(self.radius, self.first + angle, self.last + angle)


Edge = Line | Arc
Outline = tuple[Edge, ...]


def outline(envelope: Envelope, half_angle: float) -> Outline:
    """What is cut from a plate.

    Parameters
    ----------
    half_angle : half the opening at the outer radius as seen from the shaft, rad, above 0 and at most a right angle.
    """
    return bounded(envelope.outer_radius_m, envelope.inner_radius_m, half_angle, envelope.shape == "segment")


def bounded(outer: float, hub: float, half_angle: float, chord: bool) -> Outline:
    """What lies between the hub and an outer radius, m; bounded by a chord, or by two edges through the shaft."""
    return _closed(Arc(outer, pi / 2 - half_angle, pi / 2 + half_angle), _inside(outer, hub, half_angle, chord))


def _inside(outer: float, hub: float, half_angle: float, chord: bool) -> Arc | Point | None:
    """What bounds it towards the shaft: the hub, a corner, or nothing but the chord."""
    if not chord:
        return Arc(hub, pi / 2 + half_angle, pi / 2 - half_angle) if hub > 0 else (0.0, 0.0)
    height = outer * cos(half_angle)
    if height >= hub:
        return None
    hub_angle = acos(height / hub)
    return Arc(hub, pi / 2 + hub_angle, pi / 2 - hub_angle)


def _closed(rim: Arc, inside: Arc | Point | None) -> Outline:
    if inside is None:
        return rim, Line(rim.end, rim.start)
    if isinstance(inside, Arc):
        return rim, Line(rim.end, inside.start), inside, Line(inside.end, rim.start)
    return rim, Line(rim.end, inside), Line(inside, rim.start)


def rotation(edges: Outline, angle: float) -> Outline:
    """An outline turned about the shaft, counter-clockwise, rad."""
    return tuple(edge.rotation(angle) for edge in edges)


def points(edges: Outline, tolerance: float) -> Iterator[Point]:
    """Corners of a polygon inside the outline's arcs, none further from them than the tolerance, m."""
    for edge in edges:
        yield edge.start
        if isinstance(edge, Arc):
            # the height of a segment of half-angle a is r (1 - cos a), below r a^2 / 2
            most = 2.0 * sqrt(2.0 * tolerance / edge.radius)
            pieces = max(2, int(abs(edge.last - edge.first) / most) + 1)
            step = (edge.last - edge.first) / pieces
            for k in range(1, pieces):
                angle = edge.first + k * step
                yield edge.radius * cos(angle), edge.radius * sin(angle)


def _rotation(point: Point, angle: float) -> Point:
    x, y = point
    return x * cos(angle) - y * sin(angle), x * sin(angle) + y * cos(angle)
