"""A reader of STEP files that knows what ours hold: solids of planes and cylinders, and what is wrong with them."""

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from math import atan2, hypot, pi

Vector = tuple[float, ...]
_ENTITY = re.compile(r"^#(\d+)=([A-Z0-9_]*)\((.*)\);$")


@dataclass(frozen=True)
class Walked:
    """An edge as a face walks it."""

    edge: int
    along: bool
    start: Vector
    end: Vector
    #: about the z axis, of an arc; 0 of a straight line
    swept: float


class File:
    """The entities of a file, by number."""

    def __init__(self, content: bytes) -> None:
        lines = content.decode("ascii").splitlines()
        assert (lines[0], lines[-1]) == ("ISO-10303-21;", "END-ISO-10303-21;")
        self._entities = {}
        for line in lines[lines.index("DATA;") + 1 : -2]:
            match = _ENTITY.match(line)
            assert match, line
            self._entities[int(match[1])] = match[2], match[3]
        # what is referred to is there
        assert all(k in self._entities for _, text in self._entities.values() for k in _references(text))

    def _all(self, kind: str) -> list[tuple[int, str]]:
        return [(k, text) for k, (name, text) in self._entities.items() if name == kind]

    def _of(self, number: int, kind: str) -> list[int]:
        name, text = self._entities[number]
        assert name == kind
        return _references(text)

    def products(self) -> list[str]:
        return [text.split(",")[0] for _, text in self._all("PRODUCT")]

    def volumes(self) -> list[float]:
        """Of the solids, mm^3, by the divergence theorem; every one is closed, with its faces outwards."""
        return [self._volume(_references(text)[-1]) for _, text in self._all("MANIFOLD_SOLID_BREP")]

    def _volume(self, shell: int) -> float:
        faces = self._of(shell, "CLOSED_SHELL")
        walked = [self._loop(face) for face in faces]
        uses = Counter((side.edge, side.along) for loop in walked for side in loop)
        # each edge once in either direction: the shell is closed, and its faces agree about outside
        assert set(uses.values()) == {1}
        assert all((edge, not along) in uses for edge, along in uses)
        corners = {side.start for loop in walked for side in loop}
        assert len(corners) - len(uses) // 2 + len(faces) == 2
        return sum(self._flux(face, loop) for face, loop in zip(faces, walked, strict=True)) / 3.0

    def _loop(self, face: int) -> list[Walked]:
        bound = self._of(face, "ADVANCED_FACE")[0]
        edges = self._of(self._of(bound, "FACE_OUTER_BOUND")[0], "EDGE_LOOP")
        loop = [self._walked(edge) for edge in edges]
        for side, following in zip(loop, [*loop[1:], loop[0]], strict=True):
            assert side.end == following.start
        return loop

    def _walked(self, oriented: int) -> Walked:
        (edge,) = self._of(oriented, "ORIENTED_EDGE")
        along = self._entities[oriented][1].endswith(".T.")
        first, last, curve = self._of(edge, "EDGE_CURVE")
        start, end = (self._point(self._of(vertex, "VERTEX_POINT")[0]) for vertex in (first, last))
        swept = 0.0
        if self._entities[curve][0] == "CIRCLE":
            swept = (atan2(end[1], end[0]) - atan2(start[1], start[0])) % (2 * pi)
            if not self._entities[edge][1].endswith(".T."):
                swept -= 2 * pi
            radius = float(self._entities[curve][1].split(",")[-1])
            assert all(abs(hypot(x, y) - radius) < 1e-9 * radius for x, y, _ in (start, end))
        return Walked(edge, along, start, end, swept) if along else Walked(edge, along, end, start, -swept)

    def _flux(self, face: int, loop: list[Walked]) -> float:
        """Integral of the place over the outward area."""
        _, surface = self._of(face, "ADVANCED_FACE")
        sign = 1.0 if self._entities[face][1].endswith(".T.") else -1.0
        kind, text = self._entities[surface]
        at, axis, _ = (self._vector(k) for k in self._of(_references(text)[0], "AXIS2_PLACEMENT_3D"))
        if kind == "PLANE":
            distance = sum(a * b for a, b in zip(at, axis, strict=True))
            corners = [side.start for side in loop]
            assert all(abs(sum(a * b for a, b in zip(c, axis, strict=True)) - distance) < 1e-8 for c in corners)
            return sign * distance * self._area(loop, axis)
        assert kind == "CYLINDRICAL_SURFACE"
        radius = float(text.split(",")[-1])
        low, high = (f(side.start[2] for side in loop) for f in (min, max))
        swept = {abs(side.swept) for side in loop} - {0.0}
        return sign * radius * radius * max(swept) * (high - low)

    def _area(self, loop: list[Walked], normal: Vector) -> float:
        """What the loop goes round, counter-clockwise about the normal: half the sum of r x dr."""
        total = 0.0
        for side in loop:
            if side.swept:
                total += 0.5 * normal[2] * hypot(*side.start[:2]) ** 2 * side.swept
            else:
                total += 0.5 * _triple(normal, side.start, side.end)
        return total

    def _vector(self, number: int) -> Vector:
        return tuple(float(part) for part in self._entities[number][1].split(",", 1)[1].strip("()").split(","))

    _point = _vector


def _references(text: str) -> list[int]:
    return [int(match) for match in re.findall(r"#(\d+)", re.sub(r"'(?:[^']|'')*'", "", text))]


def _triple(a: Vector, b: Vector, c: Vector) -> float:
    (p, q, r), (u, v, w), (x, y, z) = a, b, c
    return p * (v * z - w * y) + q * (w * x - u * z) + r * (u * y - v * x)


def names(products: list[str]) -> Iterator[str]:
    """What the strings of a file say."""
    for text in products:
        yield re.sub(r"\\X[24]\\([0-9A-F]+)\\X0\\|''|\\\\", _character, text[1:-1])


def _character(match: re.Match[str]) -> str:
    return chr(int(match[1], 16)) if match[1] else match[0][0]
