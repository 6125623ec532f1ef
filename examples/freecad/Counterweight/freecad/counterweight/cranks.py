"""A crankshaft as its faces show it: axis, journals, crank pins, webs. Needs FreeCAD's Part, no window; lengths mm."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from math import atan2, degrees, hypot, pi, sqrt

import FreeCAD as App
import Part

#: mm by which measures of one thing differ at most
_SAME = 1e-4


class NoShaft(ValueError):
    """The faces show no crankshaft."""


@dataclass(frozen=True)
class Cylinder:
    """A round outer face along the shaft: centre, radius, both ends, share of a full turn."""

    x: float
    y: float
    radius: float
    low: float
    high: float
    turn: float

    @property
    def offset(self):
        return hypot(self.x, self.y)

    @property
    def angle_deg(self):
        return degrees(atan2(self.y, self.x))

    @property
    def middle(self):
        return (self.low + self.high) / 2


@dataclass(frozen=True)
class Web:
    """The stretch between two neighbours of which one is a pin.

    hub : radius that is free opposite the crank.
    reach : of its round faces from the axis.
    """

    low: float
    high: float
    hub: float
    reach: float


@dataclass(frozen=True)
class Cranks:
    """What was found, in the order along the shaft.

    doubtful : pins that may be eccentric round webs: a smaller pin stands on them.
    """

    journals: list
    pins: list
    doubtful: list
    webs: list


def frame_of(shape):
    """Placement of the shaft's own frame: z along the axis, x towards the first crank pin.

    Raises
    ------
    NoShaft
    """
    point, axis = _axis(shape)
    upright = App.Placement(point, App.Rotation(App.Vector(0, 0, 1), axis))
    pins = read(inside(shape, upright)).pins
    turned = App.Rotation(App.Vector(0, 0, 1), pins[0].angle_deg)
    return App.Placement(point, upright.Rotation.multiply(turned))


def inside(shape, frame):
    """The shape as seen from a frame."""
    seen = shape.copy()
    seen.Placement = frame.inverse().multiply(seen.Placement)
    return seen


def read(shape):
    """The cranks of a shaft whose axis is z.

    Raises
    ------
    NoShaft
    """
    faces = _round_faces(shape)
    whole = [one for one in faces if one.turn > 1 - 1e-6]
    journals = [one for one in whole if one.offset < 10 * _SAME]
    off_axis = [one for one in whole if one.offset >= 10 * _SAME]
    if not off_axis:
        raise NoShaft("there is no crank pin: no full cylinder beside the axis, parallel to it")
    doubtful = [one for one in off_axis if any(_stands_on(other, one) for other in off_axis)]
    pins = [one for one in off_axis if one not in doubtful]
    solid = sorted(journals + pins, key=lambda one: one.low)
    webs = [
        Web(a.high, b.low, *_radii(faces, a.high, b.low))
        for a, b in zip(solid, solid[1:])
        if b.low - a.high > 10 * _SAME and (a in pins or b in pins)
    ]
    return Cranks(journals, pins, doubtful, webs)


def _stands_on(pin, web):
    """Whether a smaller cylinder beside the axis begins where another ends."""
    touching = min(abs(pin.low - web.high), abs(pin.high - web.low)) < _SAME
    return touching and pin.radius < web.radius - _SAME


def _radii(faces, low, high):
    """How far round faces between two planes reach opposite to where they stand, up to a right angle; and at most."""
    within = [one for one in faces if one.low < high - _SAME and one.high > low + _SAME]
    hub = max((sqrt(max(0.0, one.radius**2 - one.offset**2)) for one in within), default=0.0)
    return hub, max((one.offset + one.radius for one in within), default=0.0)


def _axis(shape):
    """Point and direction of the line that has most area of outer cylinders about it."""
    areas, exact = defaultdict(float), {}
    for face in shape.Faces:
        surface = face.Surface
        if isinstance(surface, Part.Cylinder) and _outward(face):
            axis = surface.Axis
            if max(axis, key=abs) < 0:
                axis = axis * -1
            point = surface.Center - axis * surface.Center.dot(axis)
            key = tuple(round(value / _SAME) for value in (*axis, *point))
            exact.setdefault(key, (point, axis))
            areas[key] += face.Area
    if not areas:
        raise NoShaft("there is no cylinder: nothing says where the axis is")
    return exact[max(areas, key=areas.get)]


def _outward(face):
    """Whether the material is inside the cylinder, which is no bore."""
    u0, u1, v0, v1 = face.ParameterRange
    u, v = (u0 + u1) / 2, (v0 + v1) / 2
    out = face.valueAt(u, v) - face.Surface.Center
    out -= face.Surface.Axis * out.dot(face.Surface.Axis)
    return face.normalAt(u, v).dot(out) > 0


def _round_faces(shape):
    """Outer cylinders along z; faces of one cylinder that is cut lengthways are put together."""
    turns, exact = defaultdict(float), {}
    for face in shape.Faces:
        surface = face.Surface
        if not isinstance(surface, Part.Cylinder) or hypot(surface.Axis.x, surface.Axis.y) > 1e-7 or not _outward(face):
            continue
        u0, u1, v0, v1 = face.ParameterRange
        low, high = sorted(surface.Center.z + v * surface.Axis.z for v in (v0, v1))
        found = surface.Center.x, surface.Center.y, surface.Radius, low, high
        key = tuple(round(value / _SAME) for value in found)
        exact.setdefault(key, found)
        turns[key] += (u1 - u0) / (2 * pi)
    return sorted((Cylinder(*exact[key], turn) for key, turn in turns.items()), key=lambda one: one.low)
