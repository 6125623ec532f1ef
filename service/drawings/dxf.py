"""Outlines as DXF of AutoCAD R12, which every CAD and every laser cutter reads; lengths are mm."""

from collections.abc import Iterator
from math import degrees

from service.drawings.outline import Arc, Edge, Outline

#: half of the cross that marks the shaft, mm
_CROSS = 5.0


def dxf(edges: Outline) -> bytes:
    """The outline on the layer OUTLINE, the shaft as a cross on the layer SHAFT.

    R12 needs no more than a section of entities; it has no units, so that the program that opens it asks or takes mm.
    """
    pairs = [(0, "SECTION"), (2, "ENTITIES"), *_entities(edges), *_cross(), (0, "ENDSEC"), (0, "EOF")]
    return "".join(f"{code}\n{value}\n" for code, value in pairs).encode("ascii")


def _entities(edges: Outline) -> Iterator[tuple[int, str]]:
    for edge in edges:
        yield from _arc(edge) if isinstance(edge, Arc) else _line("OUTLINE", *_mm(edge))


def _arc(edge: Arc) -> Iterator[tuple[int, str]]:
    # always counter-clockwise
    low, high = sorted((edge.first, edge.last))
    yield from ((0, "ARC"), (8, "OUTLINE"), (10, "0.0"), (20, "0.0"), (30, "0.0"), (40, _number(1e3 * edge.radius)))
    yield from ((50, _number(degrees(low))), (51, _number(degrees(high))))


def _mm(edge: Edge) -> tuple[float, float, float, float]:
    x, y, u, v = (1e3 * value for value in (*edge.start, *edge.end))
    return x, y, u, v


def _line(layer: str, x: float, y: float, u: float, v: float) -> Iterator[tuple[int, str]]:
    yield from ((0, "LINE"), (8, layer))
    yield from ((code, _number(value)) for code, value in ((10, x), (20, y), (30, 0.0), (11, u), (21, v), (31, 0.0)))


def _cross() -> Iterator[tuple[int, str]]:
    yield from _line("SHAFT", -_CROSS, 0.0, _CROSS, 0.0)
    yield from _line("SHAFT", 0.0, -_CROSS, 0.0, _CROSS)


def _number(value: float) -> str:
    return f"{value + 0.0:.12f}"
