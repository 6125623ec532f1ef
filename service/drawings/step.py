"""Solids as STEP (ISO 10303-21, AP214): outlines that are extruded along the shaft; lengths are mm.

Every solid is a product of its own: a shell of two plane ends and one face for each edge of its outline. The face is a
plane for a straight edge, and a cylinder about the shaft for an arc.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import hypot

from service.drawings.outline import Arc, Edge, Line, Outline, Point

_HEADER = """ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME({name},'1970-01-01T00:00:00',(''),(''),'counterweight','counterweight','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 1 1 1 1 }}'));
ENDSEC;
DATA;
"""
_END = "ENDSEC;\nEND-ISO-10303-21;\n"

Vector = tuple[float, float, float]
#: number of an entity, as others refer to it
Reference = str

_UP: Vector = (0.0, 0.0, 1.0)
_DOWN: Vector = (0.0, 0.0, -1.0)
_ALONG_X: Vector = (1.0, 0.0, 0.0)


@dataclass(frozen=True)
class Solid:
    """An outline that is extruded from one plane of the shaft to another, m.

    axis : where the shaft crosses these planes.
    """

    name: str
    outline: Outline
    low: float
    high: float
    axis: Point = (0.0, 0.0)


def step(name: str, solids: Sequence[Solid]) -> bytes:
    """A file of some solids."""
    file = _File()
    for solid in solids:
        file.axis = solid.axis
        body_of_solid = _body(file, solid)
        file.axis = (0.0, 0.0)
        _product(file, solid.name, body_of_solid)
    body = "".join(f"#{number}={entity};\n" for number, entity in enumerate(file.entities, 1))
    return (_HEADER.format(name=_text(name)) + body + _END).encode("ascii")


class _File:
    """The entities of a file, each referred to by its number."""

    def __init__(self) -> None:
        self.entities: list[str] = []
        #: about which points are, m
        self.axis: Point = (0.0, 0.0)
        self.application = self.add("APPLICATION_CONTEXT('core data for automotive mechanical design processes')")
        standard = (
            f"APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,{self.application})"
        )
        self.add(standard)
        self.product = self.add(f"PRODUCT_CONTEXT('',{self.application},'mechanical')")
        self.design = self.add(f"PRODUCT_DEFINITION_CONTEXT('part definition',{self.application},'design')")
        length = self.add("(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.))")
        angle = self.add("(NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($,.RADIAN.))")
        solid_angle = self.add("(NAMED_UNIT(*) SI_UNIT($,.STERADIAN.) SOLID_ANGLE_UNIT())")
        fine = f"UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-07),{length},'distance_accuracy_value','')"
        self.units = self.add(
            f"(GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({self.add(fine)})) "
            f"GLOBAL_UNIT_ASSIGNED_CONTEXT(({length},{angle},{solid_angle})) REPRESENTATION_CONTEXT('','3D'))"
        )

    def add(self, entity: str) -> Reference:
        self.entities.append(entity)
        return f"#{len(self.entities)}"

    # ---- geometry

    def point(self, at: Vector) -> Reference:
        (x, y, level), (across, up) = at, self.axis
        return self.add(f"CARTESIAN_POINT('',{_reals((x + 1e3 * across, y + 1e3 * up, level))})")

    def direction(self, along: Vector) -> Reference:
        return self.add(f"DIRECTION('',{_reals(along)})")

    def placement(self, at: Vector, axis: Vector, reference: Vector) -> Reference:
        parts = f"{self.point(at)},{self.direction(axis)},{self.direction(reference)}"
        return self.add(f"AXIS2_PLACEMENT_3D('',{parts})")

    def line(self, start: Vector, along: Vector) -> Reference:
        vector = self.add(f"VECTOR('',{self.direction(along)},1.)")
        return self.add(f"LINE('',{self.point(start)},{vector})")

    def plane(self, at: Vector, normal: Vector, reference: Vector) -> Reference:
        return self.add(f"PLANE('',{self.placement(at, normal, reference)})")

    # ---- topology

    def vertex(self, at: Vector) -> Reference:
        return self.add(f"VERTEX_POINT('',{self.point(at)})")

    def edge(self, start: Reference, end: Reference, curve: Reference, same: bool = True) -> Reference:
        return self.add(f"EDGE_CURVE('',{start},{end},{curve},{_logical(same)})")

    def face(self, loop: Sequence[tuple[Reference, bool]], surface: Reference, same: bool = True) -> Reference:
        """A face within edges that are walked with the face on the left, each along its own direction or not."""
        walked = [self.add(f"ORIENTED_EDGE('',*,*,{edge},{_logical(along)})") for edge, along in loop]
        around = self.add(f"EDGE_LOOP('',({_list(walked)}))")
        bound = self.add(f"FACE_OUTER_BOUND('',{around},.T.)")
        return self.add(f"ADVANCED_FACE('',({bound}),{surface},{_logical(same)})")


def _body(file: _File, solid: Solid) -> Reference:
    """The solid itself, of its shell."""
    edges, count = solid.outline, len(solid.outline)
    levels = 1e3 * solid.low, 1e3 * solid.high
    corners = [[file.vertex(_at(edge, level)) for edge in edges] for level in levels]
    around = [
        [
            file.edge(ring[k], ring[(k + 1) % count], _curve(file, edge, level), not _inward(edge))
            for k, edge in enumerate(edges)
        ]
        for ring, level in zip(corners, levels, strict=True)
    ]
    rising = [
        file.edge(low, high, file.line(_at(edge, levels[0]), _UP))
        for edge, low, high in zip(edges, *corners, strict=True)
    ]
    bottom, top = around
    faces = [
        file.face([(edge, False) for edge in reversed(bottom)], file.plane((0.0, 0.0, levels[0]), _DOWN, _ALONG_X)),
        file.face([(edge, True) for edge in top], file.plane((0.0, 0.0, levels[1]), _UP, _ALONG_X)),
    ]
    for k, edge in enumerate(edges):
        loop = [(bottom[k], True), (rising[(k + 1) % count], True), (top[k], False), (rising[k], False)]
        faces.append(file.face(loop, _surface(file, edge, levels[0]), not _inward(edge)))
    shell = file.add(f"CLOSED_SHELL('',({_list(faces)}))")
    return file.add(f"MANIFOLD_SOLID_BREP({_text(solid.name)},{shell})")


def _inward(edge: Edge) -> bool:
    """Whether the shaft's cylinder that the edge lies on has the solid outside of it."""
    return isinstance(edge, Arc) and not edge.outward


def _at(edge: Edge, level: float) -> Vector:
    x, y = edge.start
    return 1e3 * x, 1e3 * y, level


def _along(edge: Line) -> Vector:
    (x, y), (u, v) = edge.start, edge.end
    length = hypot(u - x, v - y)
    return (u - x) / length, (v - y) / length, 0.0


def _curve(file: _File, edge: Edge, level: float) -> Reference:
    if isinstance(edge, Line):
        return file.line(_at(edge, level), _along(edge))
    return file.add(f"CIRCLE('',{file.placement((0.0, 0.0, level), _UP, _ALONG_X)},{_real(1e3 * edge.radius)})")


def _surface(file: _File, edge: Edge, level: float) -> Reference:
    if isinstance(edge, Line):
        x, y, _ = along = _along(edge)
        # the solid is on the left of its outline
        return file.plane(_at(edge, level), (y, -x, 0.0), along)
    axis = file.placement((0.0, 0.0, level), _UP, _ALONG_X)
    return file.add(f"CYLINDRICAL_SURFACE('',{axis},{_real(1e3 * edge.radius)})")


def _product(file: _File, name: str, body: Reference) -> None:
    """What a tree of parts shows, and that the solid is its shape."""
    product = file.add(f"PRODUCT({_text(name)},{_text(name)},'',({file.product}))")
    formation = file.add(f"PRODUCT_DEFINITION_FORMATION('','',{product})")
    definition = file.add(f"PRODUCT_DEFINITION('design','',{formation},{file.design})")
    shape = file.add(f"PRODUCT_DEFINITION_SHAPE('','',{definition})")
    origin = file.placement((0.0, 0.0, 0.0), _UP, _ALONG_X)
    represented = file.add(f"ADVANCED_BREP_SHAPE_REPRESENTATION('',({origin},{body}),{file.units})")
    file.add(f"SHAPE_DEFINITION_REPRESENTATION({shape},{represented})")


def _list(references: Sequence[Reference]) -> str:
    return ",".join(references)


def _logical(value: bool) -> str:
    return ".T." if value else ".F."


def _reals(values: Vector) -> str:
    return f"({','.join(_real(value) for value in values)})"


def _real(value: float) -> str:
    """To the last digit of a double, with the point that a real must have."""
    mantissa, power, exponent = f"{value + 0.0:.17G}".partition("E")
    return (mantissa if "." in mantissa else f"{mantissa}.") + power + exponent


def _text(text: str) -> str:
    """A string: apostrophes and backslashes twice, what is not printable ASCII by its number."""
    return f"'{''.join(_characters(text))}'"


def _characters(text: str) -> Iterator[str]:
    for character in text:
        if character in "'\\":
            yield 2 * character
        elif " " <= character <= "~":
            yield character
        elif ord(character) < 0x10000:
            yield f"\\X2\\{ord(character):04X}\\X0\\"
        else:
            yield f"\\X4\\{ord(character):08X}\\X0\\"
