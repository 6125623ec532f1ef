"""What FreeCAD knows of faces and bodies, as the service takes it: lengths in m. Needs FreeCAD's Part, no window."""

from __future__ import annotations

from math import degrees

import Part

MM = 1e-3
#: that the service takes of one face
_MOST_POINTS = 64
_ROUND = 1e-9


def inside(shape, frame):
    """The shape as seen from a frame."""
    copy = shape.copy()
    copy.Placement = frame.inverse().multiply(copy.Placement)
    return copy


def faces_of(shape, label):
    """Every face of a shape, in the coordinates of the document."""
    return [_fields(face, f"{label}.Face{number}"[-64:]) for number, face in enumerate(shape.Faces, start=1)]


def body_of(shape, label, density_kg_m3):
    """Mass, centre and inertia of all solids of a shape together, in the coordinates of the document."""
    solids = shape.Solids
    volume = sum(solid.Volume for solid in solids)
    centre = [sum(solid.Volume * solid.CenterOfMass[k] for solid in solids) / volume for k in range(3)]
    tensor = [[0.0] * 3 for _ in range(3)]
    for solid in solids:
        arm = [solid.CenterOfMass[k] - centre[k] for k in range(3)]
        square = sum(value * value for value in arm)
        own = solid.MatrixOfInertia.A
        for i in range(3):
            for j in range(3):
                steiner = (square if i == j else 0.0) - arm[i] * arm[j]
                tensor[i][j] += own[4 * i + j] + solid.Volume * steiner
    return {
        "name": label[-64:],
        "mass_kg": density_kg_m3 * volume * MM**3,
        "volume_m3": volume * MM**3,
        "centre_m": [value * MM for value in centre],
        "inertia_kg_m2": [[density_kg_m3 * value * MM**5 for value in row] for row in tensor],
    }


def _fields(face, name):
    surface = face.Surface
    u0, u1, v0, v1 = face.ParameterRange
    if isinstance(surface, Part.Cylinder):
        angle = degrees(u1 - u0)
        fields = {
            "type": "cylinder",
            "centre_m": _metres(surface.Center),
            "axis": list(surface.Axis),
            "radius_m": surface.Radius * MM,
            "ends_m": [v0 * MM, v1 * MM],
            "angle_deg": 360.0 if angle > 360.0 - _ROUND else angle,
            "outer": _outward(face),
        }
        whole = fields["angle_deg"] == 360.0
        return {**fields, "name": name, **({} if whole else _points(face))}
    if isinstance(surface, Part.Plane):
        normal = list(face.normalAt((u0 + u1) / 2, (v0 + v1) / 2))
        fields = {
            "type": "plane",
            "centre_m": _metres(face.CenterOfMass),
            "normal": normal,
            "area_m2": face.Area * MM**2,
        }
        return {**fields, "name": name, **_points(face)}
    return {"type": "other", "name": name, **_points(face)}


def _points(face):
    """Ends and middles of all edges; none where they are too many to be the side of a web."""
    points = [vertex.Point for vertex in face.Vertexes]
    points += [
        edge.valueAt((edge.FirstParameter + edge.LastParameter) / 2) for edge in face.Edges if not edge.Degenerated
    ]
    return {"points_m": [_metres(point) for point in points] if len(points) <= _MOST_POINTS else []}


def _outward(face):
    """Whether the material is inside the cylinder, which is no bore."""
    u0, u1, v0, v1 = face.ParameterRange
    u, v = (u0 + u1) / 2, (v0 + v1) / 2
    out = face.valueAt(u, v) - face.Surface.Center
    out -= face.Surface.Axis * out.dot(face.Surface.Axis)
    return face.normalAt(u, v).dot(out) > 0


def _metres(point):
    return [value * MM for value in point]
