"""The sheet of a part: seen along the shaft and from the side, with dimensions in mm, and where it goes."""

from collections.abc import Iterator
from math import cos, degrees, pi, sin
from typing import NamedTuple

from schemas.answer.counterweights import Counterweight
from service.drawings.outline import Arc, Point, points
from service.drawings.parts import Part
from service.drawings.svg import FAINT, INK, MUTED, PAGE_WIDTH, Anchor, Drawing, shortened
from service.tables.as_built import AsBuilt

_TOP, _BOTTOM = 36.0, 300.0
_MIDDLE = 0.36 * PAGE_WIDTH
#: widest and highest that the part is drawn
_WIDTH, _HEIGHT = 380.0, _BOTTOM - _TOP - 12.0
_SIDE = 0.8 * PAGE_WIDTH
_LINE = 16.0
_SERIF = 4.0
#: of a px: what a polygon is away from its arc
_FINE = 0.05


class _View(NamedTuple):
    """From m about the shaft to px; y upwards."""

    per_m: float

    def at(self, point: Point) -> Point:
        return _MIDDLE + self.per_m * point[0], _BOTTOM - self.per_m * point[1]


def sheet(part: Part, built: AsBuilt | None = None) -> Drawing:
    """Everything that a workshop needs to make the part and to fit it.

    Parameters
    ----------
    built : what the part is as built, beside the optimum.
    """
    notes = [*_notes(part), *_as_built(part, built)]
    drawing = Drawing(PAGE_WIDTH, _BOTTOM + 70.0 + _LINE * len(notes), f"drawing of part {part.number}")
    drawing.text((12.0, 20.0), f"Part {part.number}", size=14.0)
    drawing.text((PAGE_WIDTH - 12.0, 20.0), "dimensions in mm", "end", fill=MUTED)
    outer = part.envelope.outer_radius_m
    view = _View(min(_WIDTH / (2.0 * outer * sin(part.half_angle)), _HEIGHT / outer))
    _front(drawing, view, part)
    _side(drawing, view, part)
    for k, note in enumerate(notes):
        drawing.text((12.0, _BOTTOM + 66.0 + _LINE * k), note)
    return drawing


def millimetres(length: float) -> str:
    """A length in m as it stands on a drawing: mm, to a hundredth."""
    return f"{1e3 * length:.2f}".rstrip("0").rstrip(".")


# ---- views


def _front(drawing: Drawing, view: _View, part: Part) -> None:
    """As seen along the shaft, upwards from it."""
    envelope, edges = part.envelope, part.outline
    shaft = view.at((0.0, 0.0))
    top = view.at((0.0, envelope.outer_radius_m))
    drawing.line([(shaft[0], top[1] - 10.0), (shaft[0], shaft[1] + 12.0)], FAINT, 1.0, "9 3 2 3")
    if envelope.inner_radius_m > 0:
        hub = points((Arc(envelope.inner_radius_m, 0.0, pi),), _FINE / view.per_m)
        drawing.line([view.at(point) for point in hub], FAINT, dash="4 4")
    drawing.area([view.at(point) for point in points(edges, _FINE / view.per_m)], FAINT, 0.5, INK, 1.6)
    _cross(drawing, shaft)
    _centre_of_mass(drawing, view, part)
    for edge in edges:
        if isinstance(edge, Arc):
            _radius(drawing, view, edge, 0.55 * part.half_angle if edge.outward else -0.55 * _half(edge))
    if envelope.shape == "sector":
        _opening(drawing, view, part)
    else:
        _height(drawing, view, part)
    _width(drawing, view, part)


def _cross(drawing: Drawing, at: Point) -> None:
    x, y = at
    drawing.line([(x - 6.0, y), (x + 6.0, y)], INK)
    drawing.line([(x, y - 6.0), (x, y + 6.0)], INK)


def _half(edge: Arc) -> float:
    return 0.5 * abs(edge.last - edge.first)


def _centre_of_mass(drawing: Drawing, view: _View, part: Part) -> None:
    radius = part.places[0].radius_m
    x, y = view.at((0.0, radius))
    drawing.circle((x, y), 3.0, INK, INK)
    drawing.text((x + 7.0, y + 4.0), f"S  {millimetres(radius)}", halo=True)


def _radius(drawing: Drawing, view: _View, edge: Arc, off: float) -> None:
    """A line from the shaft to the arc, off the middle by an angle."""
    angle = pi / 2 - off
    end = view.at((edge.radius * cos(angle), edge.radius * sin(angle)))
    drawing.line([view.at((0.0, 0.0)), end], MUTED, 0.7)
    _arrow(drawing, end, angle)
    anchor: Anchor = "start" if off > 0 else "end"
    beyond = end[0] + (5.0 if off > 0 else -5.0), end[1] - 5.0
    drawing.text(beyond, f"R {millimetres(edge.radius)}", anchor, halo=True)


def _arrow(drawing: Drawing, tip: Point, angle: float) -> None:
    """An arrow head that points along an angle, y upwards."""
    x, y = tip
    wings = [(x - 7.0 * cos(angle + turn), y + 7.0 * sin(angle + turn)) for turn in (0.25, -0.25)]
    drawing.area([tip, *wings], MUTED)


def _opening(drawing: Drawing, view: _View, part: Part) -> None:
    """The angle between the edges, at the shaft."""
    for side in (-1.0, 1.0):
        angle = pi / 2 + side * part.half_angle
        hub = part.envelope.inner_radius_m
        drawing.line([view.at((0.0, 0.0)), view.at((hub * cos(angle), hub * sin(angle)))], MUTED, 0.7, "2 2")
    x, y = view.at((0.0, 0.0))
    drawing.text((x, y + 40.0), f"opening {degrees(2.0 * part.half_angle):.4g}° about the shaft", "middle")


def _height(drawing: Drawing, view: _View, part: Part) -> None:
    """The distance of the chord from the shaft, on the left."""
    height = part.envelope.outer_radius_m * cos(part.half_angle)
    left = view.at((-part.envelope.outer_radius_m * sin(part.half_angle), 0.0))[0] - 14.0
    low, high = view.at((0.0, 0.0))[1], view.at((0.0, height))[1]
    for y in (low, high):
        drawing.line([(left - _SERIF, y), (left + 12.0, y)], MUTED, 0.7)
    drawing.line([(left, low), (left, high)], MUTED, 0.7)
    drawing.text((left - 5.0, 0.5 * (low + high)), millimetres(height), "middle", vertical=True)


def _width(drawing: Drawing, view: _View, part: Part) -> None:
    """From corner to corner, below the shaft."""
    half = part.envelope.outer_radius_m * sin(part.half_angle)
    low = _BOTTOM + 10.0
    left, shaft, right = (view.at((x, 0.0))[0] for x in (-half, 0.0, half))
    corner = view.at((0.0, part.envelope.outer_radius_m * cos(part.half_angle)))[1]
    for x in (left, right):
        drawing.line([(x, corner), (x, low + _SERIF)], MUTED, 0.7, "2 2")
    drawing.line([(left, low), (right, low)], MUTED, 0.7)
    # beside the middle, where the shaft is
    drawing.text((0.5 * (shaft + right), low + 14.0), millimetres(2.0 * half), "middle", halo=True)


def _side(drawing: Drawing, view: _View, part: Part) -> None:
    """As seen across the shaft."""
    low = min(y for _, y in points(part.outline, _FINE / view.per_m))
    wide = view.per_m * part.envelope.thickness_m
    # a thick one would leave the page: then only its height is to scale
    wide = min(wide, 0.3 * PAGE_WIDTH)
    (_, top), (_, bottom) = view.at((0.0, part.envelope.outer_radius_m)), view.at((0.0, low))
    left, right = _SIDE - 0.5 * wide, _SIDE + 0.5 * wide
    drawing.area([(left, top), (right, top), (right, bottom), (left, bottom)], FAINT, 0.5, INK, 1.6)
    drawing.line([(_SIDE - 60.0, _BOTTOM), (_SIDE + 60.0, _BOTTOM)], FAINT, 1.0, "9 3 2 3")
    for x in (left, right):
        drawing.line([(x, bottom), (x, _BOTTOM + 14.0)], MUTED, 0.7, "2 2")
    drawing.line([(left, _BOTTOM + 10.0), (right, _BOTTOM + 10.0)], MUTED, 0.7)
    drawing.text((_SIDE, _BOTTOM + 26.0), f"thickness {millimetres(part.envelope.thickness_m)}", "middle")


# ---- words


def _notes(part: Part) -> Iterator[str]:
    piece, envelope = part.places[0], part.envelope
    many = f"{len(part.places)} pieces" if len(part.places) > 1 else "1 piece"
    yield f"{many}, {piece.mass_kg:.6g} kg each at {envelope.density_kg_m3:g} kg/m³, {piece.mass_radius_kg_m:.6g} kg m"
    for place in part.places:
        yield _place(place)


def _as_built(part: Part, built: AsBuilt | None) -> Iterator[str]:
    """As built, optimum and difference of each place."""
    webs = {place.web for place in part.places}
    for pair in () if built is None else built.pairs:
        if pair.web not in webs:
            continue
        best, mass = pair.masses
        angle, rotation = "", ""
        if pair.optimum is not None and pair.rotation_deg is not None:
            angle, rotation = f" at {pair.optimum.angle_deg:.4g}°", f" and {pair.rotation_deg:+.3g}°"
        yield (
            f"{shortened(pair.web, 24)}: as built {mass:.6g} kg; optimum {best:.6g} kg{angle}; "
            f"difference {mass - best:+.4g} kg{rotation}{_tolerance(built, best)}"
        )


def _tolerance(built: AsBuilt | None, mass: float) -> str:
    if built is None or built.tolerance.share is None or not mass:
        return ""
    return f"; tolerance ±{built.tolerance.share * mass:.2g} kg and ±{built.tolerance.angle_deg:.2g}°"


def _place(weight: Counterweight) -> str:
    crank = "" if weight.angle_from_crank_deg is None else f", {weight.angle_from_crank_deg:.4g}° from its crank"
    where = f"plane z = {millimetres(weight.position_m)} mm{crank}, {weight.angle_deg:.4g}° as drawn at shaft angle 0"
    return f"{shortened(weight.web, 24)}: {where}, {weight.centrifugal_force_N:.5g} N to hold"
