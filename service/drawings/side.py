"""The machine from the side: the planes along the shaft, z to the right."""

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, pairwise
from typing import NamedTuple

from service.common.figures import digits, typeset
from service.drawings.front import BUILT
from service.drawings.layout import Balancer, CrankMachine, Fitted, Layout, OrbitMachine, Place, Ring
from service.drawings.projection import LEFT, MIDDLE, RIGHT, WIDTH, SideProjection
from service.drawings.sheet import millimetres
from service.drawings.svg import AFTER, FAINT, INK, MUTED, SERIES, Drawing, Point, shortened

_ROOM, _BOTTOM = 100.0, 260.0
#: what stands towards the reader is drawn down and to the left, shortened
OBLIQUE = (-0.32, 0.26)
_STRAIGHT = (0.0, 0.0)
#: of a weight of unknown shape: how far it reaches about its centre of mass
_INNER, _OUTER = 0.82, 1.18
#: between texts beside one another, and between lines of names
_GAP, _LINE = 34.0, 15.0
_MAX_NAMES = 24
_DIMENSIONS = 56.0


class _Plane(NamedTuple):
    position_m: float
    name: str
    colour: str


def side(layout: Layout, dimensions: bool = False) -> Drawing:
    """Throws, counterweights, bearings and the reference plane along the shaft; the first crank points upwards.

    Parameters
    ----------
    dimensions : with places and distances in mm, and seen straight from the side; else obliquely, so that no throw
        hides another.
    """
    machine, planes = layout.machine, list(_planes(layout))
    reference = layout.reference_plane_m
    view = _view(layout, planes, _STRAIGHT if dimensions else OBLIQUE)
    labels_at = planes if len(planes) <= _MAX_NAMES else []
    below = _BOTTOM + (_DIMENSIONS if dimensions else 0.0)
    lines = list(_lines(view, labels_at))
    height = below + 14.0 + _LINE * max([2, *(row + 1 for _, _, row in lines)])
    caption = ", ".join(f"{plane.name} at {digits(plane.position_m)} m" for plane in planes)
    drawing = Drawing(WIDTH, height, f"From the side: {caption}.")
    with drawing.group("reference", f"reference plane of moments, {digits(reference)} m"):
        drawing.line([(view.z(reference), 14), (view.z(reference), _BOTTOM - 2)], SERIES[2], 1.0, "9 3 2 3")
        late = view.z(reference) > WIDTH - 130
        place = (view.z(reference) + (-4 if late else 4), 20.0)
        drawing.text(place, "reference plane", "end" if late else "start", 12.0, MUTED)
    heaviest = max((weight.mass_kg for weight in _every_weight(layout)), default=0.0)
    _weights(drawing, view, machine.places, layout.best, layout.built, heaviest)
    shafts = [(view.about(*balance.shaft.axis), balance) for balance in layout.balance]
    for around, (shaft, best, built) in shafts:
        with drawing.group("balancer", shaft.name):
            _axis_of(drawing, around, shaft)
            _weights(drawing, around, shaft.places, best, built, heaviest)
    drawing.line([(LEFT - 26, MIDDLE), (RIGHT + 26, MIDDLE)], INK, 4.0)
    if isinstance(machine, CrankMachine):
        _throws(drawing, view, machine)
        _bearings(drawing, view, machine)
    else:
        _scroll(drawing, view, machine)
    if dimensions:
        _axis(drawing, view, planes)
        for around, fitted in ((view, layout.best), *((around, balance.best) for around, balance in shafts)):
            _radii(drawing, around, fitted)
        _distances(drawing, view, sorted({web.position_m for web in machine.places}))
    _names(drawing, view, lines, below)
    return drawing


def _view(layout: Layout, planes: Sequence[_Plane], depth: Point) -> SideProjection:
    machine = layout.machine
    places = [*(plane.position_m for plane in planes), layout.reference_plane_m]
    thick = [(web.position_m, 0.5 * (web.envelope.thickness_m or 0.0)) for web in machine.places if web.envelope]
    places += [place + end * half for place, half in thick for end in (-1, 1)]
    low, high = min(places), max(places)
    room = 0.04 * (high - low) or 0.5
    per_m = (RIGHT - LEFT) / (high - low + 2 * room)
    weights = (*layout.best, *layout.built)
    radii = [web.reach_m for web in machine.places if web.reach_m]
    radii += [weight.shape.outer_radius_m if weight.shape else _OUTER * weight.radius_m for weight in weights]
    for shaft, *fitted in layout.balance:
        far, _ = shaft.axis
        radii += [far, *(far + web.reach_m for web in shaft.places if web.reach_m)]
        radii += [far + _OUTER * weight.radius_m for weight in chain(*fitted)]
    if isinstance(machine, CrankMachine):
        radii += [crank.crank_radius_m for _, crank in machine.cranks]
        facing = machine.cranks[0][1].crank_angle_deg if machine.cranks else 0.0
    else:
        radii, facing = [*radii, 2.0 * machine.orbit_radius_m], 0.0
    return SideProjection(low - room, per_m, _ROOM / max(radii, default=1.0), facing, depth)


def _planes(layout: Layout) -> Iterator[_Plane]:
    """Planes along the shaft with names and colours."""
    machine = layout.machine
    if isinstance(machine, CrankMachine):
        for name, crank in machine.cranks:
            yield _Plane(crank.position_m, f"throw {name}", INK)
        for name, bearing in machine.supports:
            yield _Plane(bearing.position_m, f"bearing {name}", MUTED)
    else:
        yield _Plane(machine.orbiting_position_m, "orbiting scroll", INK)
        guide = machine.anti_rotation
        if guide is not None:
            yield _Plane(guide.position_m, "ring" if isinstance(guide, Ring) else "pins", MUTED)
    for web in chain(machine.places, *(balance.shaft.places for balance in layout.balance)):
        yield _Plane(web.position_m, web.name, AFTER)


def _every_weight(layout: Layout) -> Iterator[Fitted]:
    yield from (*layout.best, *layout.built)
    for _, best, built in layout.balance:
        yield from (*best, *built)


def _axis_of(drawing: Drawing, view: SideProjection, shaft: Balancer) -> None:
    """The axis of a balance shaft beside the crankshaft, along its webs."""
    planes = [web.position_m for web in shaft.places]
    if planes and shaft.axis[0] > 0.0:
        (left, y), (right, _) = (view(place, 0.0, 0.0) for place in (min(planes), max(planes)))
        drawing.line([(left - 20, y), (right + 20, y)], INK, 2.0)


def _throws(drawing: Drawing, view: SideProjection, machine: CrankMachine) -> None:
    places = sorted({view.z(crank.position_m) for _, crank in machine.cranks})
    half = min([7.0, *(0.3 * (right - left) for left, right in pairwise(places))])
    width = min(1.0, half / 7.0)
    for name, crank in machine.cranks:
        x, y = view(crank.position_m, crank.crank_radius_m, crank.crank_angle_deg)
        middle = view.z(crank.position_m)
        with drawing.group("throw", f"throw {name}, plane {digits(crank.position_m)} m"):
            for aside in (-half, half):
                drawing.line([(middle + aside, MIDDLE), (x + aside, y)], INK, 2.0 * width)
            if abs(y - MIDDLE) < 6 and abs(x - middle) < 6:
                # it stands towards the reader, or away
                drawing.circle((x, y), 5.0 * width, fill="white", width=1.6)
            else:
                drawing.line([(x - half, y), (x + half, y)], INK, 5.0 * width)
            for row in crank.rows:
                if row is not None:
                    place = crank.position_m + row.offset_m
                    drawing.circle(view(place, crank.crank_radius_m, crank.crank_angle_deg), 2.5, "none", MUTED)


def _scroll(drawing: Drawing, view: SideProjection, machine: OrbitMachine) -> None:
    x, y = view(machine.orbiting_position_m, machine.orbit_radius_m, 0.0)
    with drawing.group("throw", "orbiting scroll"):
        drawing.line([(x, y - 55), (x, y + 55)], INK, 2.5)
        drawing.circle((x, y), 4, fill="white", width=1.6)


def _bearings(drawing: Drawing, view: SideProjection, machine: CrankMachine) -> None:
    for name, bearing in machine.supports:
        x = view.z(bearing.position_m)
        with drawing.group("bearing", f"bearing {name}"):
            drawing.area([(x, MIDDLE + 3), (x - 8, MIDDLE + 17), (x + 8, MIDDLE + 17)], "white", stroke=INK)


def _weights(
    drawing: Drawing,
    view: SideProjection,
    places: Sequence[Place],
    best: Sequence[Fitted],
    built: Sequence[Fitted],
    heaviest: float,
) -> None:
    """What a shaft carries.

    Parameters
    ----------
    heaviest : of all shafts, kg.
    """
    carrying = {weight.web.name for weight in best}
    for web in places:
        if web.name not in carrying:
            x, y = view(web.position_m, 0.0, 0.0)
            with drawing.group("free", f"{web.name}: nothing"):
                drawing.line([(x, y + aside) for aside in (-7, 7)], AFTER, 1.2)
    for weight in best:
        words = f"{digits(round(weight.mass_kg, 4))} kg at {digits(round(weight.angle_deg, 2))}°"
        kind = f"counterweight{' fixed' if weight.fixed else ''}{' unknown' if weight.shape is None else ''}"
        with drawing.group(kind, f"{weight.web.name}: {words}, plane {digits(weight.web.position_m)} m"):
            ground, edge = (MUTED, INK) if weight.fixed else (AFTER, AFTER)
            place, plate = weight.web.position_m, _plate(view, weight, heaviest)
            drawing.line([view(place, 0.0, 0.0), _mean(plate[:2])], FAINT, 1.0)
            drawing.area(plate, ground, 0.3, edge, 1.6, "5 3" if weight.shape is None else None)
            drawing.circle(view(place, weight.radius_m, weight.angle_deg), 2.2, edge, edge)
    for weight in built:
        words = f"{digits(round(weight.mass_kg, 4))} kg at {digits(round(weight.angle_deg, 2))}°"
        with drawing.group("counterweight built", f"{weight.web.name} as built: {words}"):
            drawing.area(
                _plate(view, weight._replace(shape=None), heaviest), "none", stroke=BUILT, width=1.6, dash="6 3"
            )


def _plate(view: SideProjection, fitted: Fitted, heaviest: float) -> list[Point]:
    """From the inner to the outer radius and as thick as it is; of unknown shape as wide as its mass asks for."""
    plate, place = fitted.web.envelope, fitted.web.position_m
    if fitted.shape is None:
        inner, outer, half = _INNER * fitted.radius_m, _OUTER * fitted.radius_m, 3.0 + 9.0 * fitted.mass_kg / heaviest
    else:
        inner = max(plate.inner_radius_m if plate else 0.0, fitted.shape.chord_height_m or 0.0)
        outer = fitted.shape.outer_radius_m
        half = max(1.0, 0.5 * view.per_m * ((plate.thickness_m if plate else None) or 0.0))
    (x1, y1), (x2, y2) = (view(place, radius, fitted.angle_deg) for radius in (inner, outer))
    return [(x1 - half, y1), (x1 + half, y1), (x2 + half, y2), (x2 - half, y2)]


def _mean(ends: Sequence[Point]) -> Point:
    return sum(x for x, _ in ends) / len(ends), sum(y for _, y in ends) / len(ends)


# ---- dimensions


def _axis(drawing: Drawing, view: SideProjection, planes: Iterable[_Plane]) -> None:
    """The planes in mm, as far as they do not run into each other."""
    drawing.line([(LEFT - 14, _BOTTOM), (RIGHT + 14, _BOTTOM)], MUTED, 0.8)
    drawing.text((LEFT - 46, _BOTTOM + 15), "z, mm", size=9.5, fill=MUTED)
    last = -math.inf
    for position in sorted({plane.position_m for plane in planes}):
        x = view.z(position)
        drawing.line([(x, _BOTTOM - 3), (x, _BOTTOM + 3)], MUTED, 0.8)
        drawing.line([(x, MIDDLE + 6), (x, _BOTTOM - 4)], FAINT, 0.6)
        if x - last >= _GAP:
            drawing.text((x, _BOTTOM + 15), typeset(millimetres(position)), "middle", 9.5)
            last = x


def _radii(drawing: Drawing, view: SideProjection, weights: Sequence[Fitted]) -> None:
    """The radius of the centre of mass beyond the end of each weight, mm, where there is room."""
    ends = {-1: -math.inf, 1: -math.inf}
    for fitted in sorted(weights, key=lambda weight: weight.web.position_m):
        reach = fitted.shape.outer_radius_m if fitted.shape else _OUTER * fitted.radius_m
        x, y = view(fitted.web.position_m, reach, fitted.angle_deg)
        where = -1 if y < view(fitted.web.position_m, 0.0, 0.0)[1] else 1
        if x - ends[where] >= _GAP:
            text = f"R {typeset(millimetres(fitted.radius_m))}"
            drawing.text((x, y + (-6 if where < 0 else 14)), text, "middle", 9.5, AFTER, halo=True)
            ends[where] = x


def _distances(drawing: Drawing, view: SideProjection, planes: Sequence[float]) -> None:
    """From web to web, and over all of them, mm."""
    for row, pairs in enumerate((list(pairwise(planes)), [(planes[0], planes[-1])] if len(planes) > 2 else [])):
        height = _BOTTOM + 34 + 20 * row
        for low, high in pairs:
            left, right = view.z(low), view.z(high)
            text = typeset(millimetres(high - low))
            if right - left < 6.0 * len(text) + 12.0:
                continue
            for x in (left, right):
                drawing.line([(x, height - 4), (x, height + 4)], MUTED, 0.8)
            drawing.line([(left, height), (right, height)], MUTED, 0.8)
            for x, inward in ((left, 1), (right, -1)):
                drawing.area([(x, height), (x + 6 * inward, height - 2), (x + 6 * inward, height + 2)], MUTED)
            drawing.text((0.5 * (left + right), height - 4), text, "middle", 9.5, halo=True)


# ---- names


def _lines(view: SideProjection, planes: Sequence[_Plane]) -> Iterator[tuple[_Plane, float, int]]:
    """Where each name stands, and on which line below the drawing: on the first where there is room."""
    ends: list[float] = []
    for plane in sorted(planes):
        half = 3.9 * len(_short(plane)) + 3.0
        x = min(max(view.z(plane.position_m), half), WIDTH - half)
        row = next((row for row, end in enumerate(ends) if end < x - half), len(ends))
        ends[row : row + 1] = [x + half]
        yield plane, x, row


def _names(drawing: Drawing, view: SideProjection, lines: Sequence[tuple[_Plane, float, int]], below: float) -> None:
    with drawing.group("names"):
        for plane, x, row in lines:
            at = view.z(plane.position_m)
            drawing.line([(at, below), (at, below + 6)], FAINT, 1.0)
            drawing.text((x, below + 21 + _LINE * row), _short(plane), "middle", 13.0, plane.colour, halo=True)


def _short(plane: _Plane) -> str:
    return shortened(plane.name, 24)
