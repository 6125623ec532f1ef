"""The layout from the side: the planes along the shaft, z to the right."""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from schemas.answer.counterweights import Counterweight
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import ReciprocatingMachine
from service.common.figures import typeset
from service.drawings.sheet import millimetres
from service.drawings.svg import AFTER, BEFORE, FAINT, INK, MUTED, PAGE_WIDTH, SERIES, Anchor, Drawing, shortened

_LEFT, _RIGHT = 44.0, PAGE_WIDTH - 30.0
_MIDDLE = 150.0
_ROOM = 92.0
_BOTTOM = 268.0
_GAP = 34.0


class _View(NamedTuple):
    """From places along the shaft and heights above it, m, to px."""

    low: float
    per_m: float
    height_per_m: float
    facing_deg: float

    def z(self, position: float) -> float:
        return _LEFT + (position - self.low) * self.per_m

    def y(self, height: float) -> float:
        return _MIDDLE - height * self.height_per_m

    def height(self, radius: float, angle_deg: float) -> float:
        return radius * math.cos(math.radians(angle_deg - self.facing_deg))


def facing_deg(machine: Machine) -> float:
    """The direction across the shaft that points upwards in the side view: that of the first crank."""
    return machine.throws[0].crank_angle_deg if isinstance(machine, ReciprocatingMachine) else 0.0


def side(
    machine: Machine,
    fitted: Sequence[Counterweight],
    reference_plane_m: float,
    built: Sequence[Counterweight] = (),
) -> Drawing:
    """Throws, counterweights, bearings and the reference plane along the shaft.

    Heights are components along the direction of the first crank; a counterweight is as wide as its mass asks for.

    Parameters
    ----------
    built : what is fitted in place of them, dashed.
    """
    drawing = Drawing(PAGE_WIDTH, _BOTTOM + 74, "layout from the side, with dimensions")
    planes = [position for position, _, _ in _planes(machine)] + [reference_plane_m]
    low, high = min(planes), max(planes)
    room = 0.07 * (high - low) or 1.0
    per_m = (_RIGHT - _LEFT) / (high - low + 2 * room)
    radii = [web.reach_m for web in machine.webs] + _radii(machine)
    view = _View(low - room, per_m, _ROOM / max(radii), facing_deg(machine))
    drawing.line([(_LEFT - 14, _MIDDLE), (_RIGHT + 14, _MIDDLE)], INK, 5.0)
    _reference(drawing, view, reference_plane_m)
    _counterweights(drawing, view, machine, fitted, built)
    if isinstance(machine, ReciprocatingMachine):
        _throws(drawing, view, machine)
        _bearings(drawing, view, machine)
    else:
        place = machine.orbiting_position_m
        drawing.line([(view.z(place), view.y(-0.5 * max(radii))), (view.z(place), view.y(0.5 * max(radii)))], INK, 2.5)
    _axis(drawing, view, machine)
    _radius_texts(drawing, view, fitted)
    _distances(drawing, view, machine)
    _names(drawing, view, machine)
    return drawing


def _planes(machine: Machine) -> Iterator[tuple[float, str, str]]:
    """Planes along the shaft with names and colours."""
    if isinstance(machine, ReciprocatingMachine):
        for number, throw in enumerate(machine.throws, start=1):
            yield throw.position_m, f"throw {throw.name or number}", INK
        for bearing in machine.bearings:
            yield bearing.position_m, f"bearing {bearing.name}", MUTED
    else:
        yield machine.orbiting_position_m, "orbiting scroll", INK
        guide = machine.anti_rotation
        yield guide.position_m, "ring" if guide.type == "oldham" else "pins", MUTED
    for web in machine.webs:
        yield web.position_m, web.name, AFTER


def _radii(machine: Machine) -> list[float]:
    if isinstance(machine, ReciprocatingMachine):
        return [throw.crank_radius_m for throw in machine.throws]
    return [2 * machine.orbit_radius_m]


def _reference(drawing: Drawing, view: _View, plane: float) -> None:
    drawing.line([(view.z(plane), 44), (view.z(plane), _BOTTOM)], SERIES[2], 1.0, "9 3 2 3")


def _throws(drawing: Drawing, view: _View, machine: ReciprocatingMachine) -> None:
    for throw in machine.throws:
        middle = view.z(throw.position_m)
        top = view.y(view.height(throw.crank_radius_m, throw.crank_angle_deg))
        for aside in (-7, 7):
            drawing.line([(middle + aside, _MIDDLE), (middle + aside, top)], INK, 2.0)
        if abs(top - _MIDDLE) < 6:
            drawing.circle((middle, top), 5.0, fill="white", width=1.6)
        else:
            drawing.line([(middle - 7, top), (middle + 7, top)], INK, 5.0)
        for row in throw.rows:
            place = view.z(throw.position_m + row.offset_m)
            drawing.line([(place, _MIDDLE - _ROOM - 8), (place, _MIDDLE + _ROOM + 8)], MUTED, 0.8, "12 3 2 3")


def _bearings(drawing: Drawing, view: _View, machine: ReciprocatingMachine) -> None:
    for bearing in machine.bearings:
        place = view.z(bearing.position_m)
        drawing.area([(place, _MIDDLE + 3), (place - 6, _MIDDLE + 14), (place + 6, _MIDDLE + 14)], "white", stroke=INK)


def _counterweights(
    drawing: Drawing, view: _View, machine: Machine, fitted: Sequence[Counterweight], built: Sequence[Counterweight]
) -> None:
    webs = {web.name: web for web in machine.webs}
    for web in machine.webs:
        drawing.line([(view.z(web.position_m), _MIDDLE - 5), (view.z(web.position_m), _MIDDLE + 5)], AFTER, 1.2)
    heaviest = max((one.mass_kg for one in (*fitted, *built)), default=0.0)
    for number, one in enumerate((*fitted, *built)):
        # weights of balance shafts are not on this one
        if not one.mass_kg > 0 or one.web not in webs:
            continue
        place, half = view.z(webs[one.web].position_m), 2.0 + 7.0 * one.mass_kg / heaviest
        end = view.y(view.height(one.radius_m, one.angle_deg))
        around = [(place - half, _MIDDLE), (place + half, _MIDDLE), (place + half, end), (place - half, end)]
        if number < len(fitted):
            drawing.area(around, AFTER, 0.16, AFTER, 1.2)
            drawing.circle((place, end), 2.2, AFTER, AFTER)
        else:
            drawing.area(around, "none", stroke=BEFORE, width=1.2, dash="5 3")


def _axis(drawing: Drawing, view: _View, machine: Machine) -> None:
    """The planes in metres, as far as they do not run into each other."""
    drawing.line([(_LEFT - 14, _BOTTOM), (_RIGHT + 14, _BOTTOM)], MUTED, 0.8)
    drawing.text((_LEFT - 14, _BOTTOM + 15), "z, mm", "middle", 9.5, MUTED)
    last = -math.inf
    for position in sorted({position for position, _, _ in _planes(machine)}):
        place = view.z(position)
        drawing.line([(place, _BOTTOM - 3), (place, _BOTTOM + 3)], MUTED, 0.8)
        drawing.line([(place, _MIDDLE + 6), (place, _BOTTOM - 4)], FAINT, 0.6)
        if place - last >= _GAP:
            drawing.text((place, _BOTTOM + 15), typeset(millimetres(position)), "middle", 9.5)
            last = place


def _radius_texts(drawing: Drawing, view: _View, fitted: Sequence[Counterweight]) -> None:
    """The radius of the centre of mass beyond the end of each counterweight, mm, where there is room."""
    ends = {-1: -math.inf, 1: -math.inf}
    for one in sorted(fitted, key=lambda each: each.position_m):
        if not one.mass_kg > 0:
            continue
        place, end = view.z(one.position_m), view.y(view.height(one.radius_m, one.angle_deg))
        side = -1 if end < _MIDDLE else 1
        if place - ends[side] >= _GAP:
            drawing.text(
                (place, end + (-6 if side < 0 else 14)),
                f"R {millimetres(one.radius_m)}",
                "middle",
                9.5,
                AFTER,
                halo=True,
            )
            ends[side] = place


def _distances(drawing: Drawing, view: _View, machine: Machine) -> None:
    """From web to web, and over all of them, mm."""
    planes = sorted({web.position_m for web in machine.webs})
    for row, pairs in enumerate((list(pairwise(planes)), [(planes[0], planes[-1])] if len(planes) > 2 else [])):
        height = _BOTTOM + 34 + 20 * row
        for low, high in pairs:
            left, right = view.z(low), view.z(high)
            text = millimetres(high - low)
            if right - left < 6.0 * len(text) + 12.0:
                continue
            for x in (left, right):
                drawing.line([(x, height - 4), (x, height + 4)], MUTED, 0.8)
            drawing.line([(left, height), (right, height)], MUTED, 0.8)
            for x, inward in ((left, 1), (right, -1)):
                drawing.area([(x, height), (x + 6 * inward, height - 2), (x + 6 * inward, height + 2)], MUTED)
            drawing.text((0.5 * (left + right), height - 4), text, "middle", 9.5, halo=True)


def _names(drawing: Drawing, view: _View, machine: Machine) -> None:
    """Names over the planes, on as many lines as keep them apart; those that find no room are left to the tables."""
    ends = [-math.inf] * 3
    for position, name, colour in sorted(_planes(machine)):
        place, text = view.z(position), shortened(name, 22)
        width = 5.6 * len(text)
        start = min(max(place - width / 2, 2.0), PAGE_WIDTH - width - 2.0)
        for line, end in enumerate(ends):
            if start - end >= 5.0:
                anchor: Anchor = "start"
                drawing.text((start, 14.0 + 13.0 * line), text, anchor, 10, colour)
                ends[line] = start + width
                break
