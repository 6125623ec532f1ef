"""Bodies of a document in the shaft's frame, and what their mass does. Needs FreeCAD's Part, no window."""

from __future__ import annotations

from math import cos, sin

import FreeCAD as App
import Part

from .faces import MM, inside
from .moments import Moments

STEEL_KG_M3 = 7850.0


def shape_of(body):
    """The shape of a body where it is in the document, in whatever part it lies."""
    shape = Part.getShape(body).copy()
    shape.Placement = body.getGlobalPlacement() if hasattr(body, "getGlobalPlacement") else body.Placement
    return shape


def in_frame(body, frame):
    """The shape of a body as seen from the shaft's frame."""
    return inside(shape_of(body), frame)


def moments(shape, density_kg_m3):
    """Volume integrals of a shape about the origin, the products of inertia too: exact for force and for moment."""
    total = Moments()
    for solid in shape.Solids:
        volume, centre, inertia = solid.Volume, solid.CenterOfMass, solid.MatrixOfInertia
        # off its diagonal stand minus the products of inertia, about the centre of mass
        xz, yz = -inertia.A13 + volume * centre.x * centre.z, -inertia.A23 + volume * centre.y * centre.z
        scale = density_kg_m3 * MM**3
        static = scale * MM * volume * complex(centre.x, centre.y)
        total += Moments(scale * volume, static, scale * MM**2 * complex(xz, yz))
    return total


def extruded(outline, thickness):
    """The solid of an outline (:mod:`plate`, m), extruded to both sides of the plane z = 0; thickness mm."""
    wire = Part.Wire([_edge(*edge) for edge in outline])
    face = Part.Face(wire)
    face.translate(App.Vector(0, 0, -thickness / 2))
    return face.extrude(App.Vector(0, 0, thickness))


def _edge(kind, *figures):
    if kind == "line":
        return Part.makeLine(*(App.Vector(x / MM, y / MM, 0) for x, y in figures))
    radius, first, last = figures
    ends = (_at(radius / MM, angle) for angle in (first, (first + last) / 2, last))
    return Part.Arc(*ends).toShape()


def _at(radius, angle):
    return App.Vector(radius * cos(angle), radius * sin(angle), 0)
