"""What stands in the way of the counterweights over a turn. Needs FreeCAD's Part, no window.

Volumes that overlap, not distances: distances between coaxial faces fail now and then.
"""

from __future__ import annotations

from math import asin, cos, degrees, hypot, radians, sin

import FreeCAD as App
import Part

from .faces import inside
from .features import request_of
from .sheets import Wrong
from .solids import MM, in_frame, shape_of

#: positions of a rod over a turn
STEPS = 72
#: mm3 below which bodies only touch
_TOUCH = 1e-3


def clearance(machine):
    """What stands in the way, in words; nothing if all is clear.

    Every counterweight against the shaft as it is drawn, against obstacles along its whole way, and against the rods
    that the table of rows names, in so many positions of a turn.

    Raises
    ------
    Wrong
        if a rod is not there, or is not drawn where it is at shaft angle 0.
    """
    weights = {weight: inside(weight.Shape, machine.Frame) for weight in machine.Counterweights}
    rods = list(_rods(machine))
    room = machine.Clearance.Value
    lines = overlaps(machine)
    for weight, shape in weights.items():
        ring = _ring(weight, shape.BoundBox, room)
        for body in machine.Obstacles:
            words = f"within {room:g} mm of its way"
            lines += _overlap_line(weight, body, words, _overlap(ring, in_frame(body, machine.Frame)))
        grown = shape.makeOffsetShape(room, 1e-3, join=2) if room else shape
        for rod in rods:
            volume, angle = rod.worst(grown)
            lines += _overlap_line(weight, rod.body, f"within {room:g} mm at shaft angle {angle:g} degrees", volume)
    return lines


def overlaps(machine):
    """Counterweights that stand in their own shaft, in words: what is of both would weigh twice."""
    return [
        line
        for weight in machine.Counterweights
        for body in machine.Shaft
        for line in _overlap_line(weight, body, "overlap", _overlap(weight.Shape, shape_of(body)))
    ]


def _overlap_line(solid, body, words, volume):
    return [f"{solid.Label} and {body.Label}: {volume:.4g} mm3 {words}"] if volume > _TOUCH else []


def _overlap(shape, other):
    if not shape.BoundBox.intersect(other.BoundBox):
        return 0.0
    return shape.common(other).Volume


def _ring(solid, box, room):
    """What a counterweight sweeps over a turn, grown by the clearance."""
    inner, outer = solid.InnerRadius.Value, solid.OuterRadius.Value
    if solid.Outline == "segment":
        inner = max(inner, outer * cos(radians(solid.HalfAngle.Value)))
    low, height = App.Vector(0, 0, box.ZMin - room), box.ZLength + 2 * room
    disc = Part.makeCylinder(outer + room, height, low)
    return disc.cut(Part.makeCylinder(inner - room, height, low)) if inner > room else disc


def _rods(machine):
    """The rods that the rows name."""
    question = request_of(machine)
    for (number, place), label in question.rods.items():
        bodies = machine.Document.getObjectsByLabel(label)
        if not bodies:
            raise Wrong([f"rows: rod: there is no body {label!r}"])
        throw = question.body["machine"]["throws"][number]
        yield _Rod(bodies[0], in_frame(bodies[0], machine.Frame), throw, throw["rows"][place])


class _Rod:
    """A connecting rod, which in the frame that turns with the shaft swings about its pin."""

    def __init__(self, body, shape, throw, row):
        length = (row.get("connecting_rod") or {}).get("length_m")
        if not length:
            raise Wrong([f"{body.Label}: its row needs connecting_rod.length_m"])
        self.body, self._shape = body, shape
        self._ratio, self._axis = throw["crank_radius_m"] / length, radians(row["axis_deg"])
        self._crank = radians(throw["crank_angle_deg"])
        radius = throw["crank_radius_m"] / MM
        self._pin = App.Vector(radius * cos(self._crank), radius * sin(self._crank), 0)
        if not any(self._around_pin(face.Surface) for face in shape.Faces):
            raise Wrong([f"{body.Label}: no bore about its crank pin: it must be where it is at shaft angle 0"])

    def worst(self, grown):
        """Largest volume of the rod within a shape over a turn, and the shaft angle there."""
        return max((self._within(grown, 360.0 * step / STEPS), 360.0 * step / STEPS) for step in range(STEPS))

    def _around_pin(self, surface):
        if not isinstance(surface, Part.Cylinder) or hypot(surface.Axis.x, surface.Axis.y) > 1e-6:
            return False
        return hypot(surface.Center.x - self._pin.x, surface.Center.y - self._pin.y) < 1e-2

    def _within(self, grown, angle_deg):
        box = self._shape.BoundBox
        if box.ZMin > grown.BoundBox.ZMax or box.ZMax < grown.BoundBox.ZMin:
            return 0.0
        copy = self._shape.copy()
        angle = radians(angle_deg)
        copy.rotate(self._pin, App.Vector(0, 0, 1), degrees(self._swing(angle) - angle - self._swing(0.0)))
        return _overlap(grown, copy)

    def _swing(self, angle):
        """Direction from pin to crosshead."""
        return self._axis - asin(self._ratio * sin(self._crank + angle - self._axis))
