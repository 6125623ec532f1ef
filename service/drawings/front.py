"""The layout from the front: seen from +z at shaft angle 0, to scale."""

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import NamedTuple, TypeVar

from schemas.answer.counterweights import Counterweight
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.scroll_machine import ScrollMachine
from schemas.machine.webs import Web
from service.common.figures import digits
from service.drawings.svg import AFTER, BEFORE, FAINT, INK, MUTED, PAGE_WIDTH, SERIES, Drawing, Point, shortened

Each = TypeVar("Each", bound=tuple[float, str, object])

#: more names than this cannot be read
_MAX_LABELS = 24
_ALLOWED = SERIES[2]
_FRONT = 320.0
#: half the opening of the largest counterweight as it is drawn; areas are in proportion to the masses
_WIDEST_DEG = 55.0
_THICKNESS = 0.34


class _View(NamedTuple):
    """From metres to px."""

    scale: float
    centre: Point

    def __call__(self, radius: float, angle_deg: float) -> Point:
        angle = math.radians(angle_deg)
        x, y = self.centre
        return x + self.scale * radius * math.cos(angle), y - self.scale * radius * math.sin(angle)

    def arc(self, radius: float, start_deg: float, end_deg: float) -> list[Point]:
        steps = max(2, math.ceil(abs(end_deg - start_deg) / 3))
        return [self(radius, start_deg + (end_deg - start_deg) * step / steps) for step in range(steps + 1)]


def front(machine: Machine, fitted: Sequence[Counterweight], built: Sequence[Counterweight] = ()) -> Drawing:
    """Cranks, row axes and counterweights to scale, x to the right and y upwards.

    Parameters
    ----------
    built : what is fitted in place of them, dashed.
    """
    drawing = Drawing(PAGE_WIDTH, _FRONT, "layout from the front")
    reach = _reach(machine)
    view = _View((_FRONT / 2 - 26) / reach, (PAGE_WIDTH / 2, _FRONT / 2))
    _frame(drawing)
    if isinstance(machine, ReciprocatingMachine):
        _rows(drawing, view, machine, reach)
    _sectors(drawing, view, machine.webs)
    _counterweights(drawing, view, fitted, built)
    if isinstance(machine, ReciprocatingMachine):
        _cranks(drawing, view, machine)
    else:
        _scroll(drawing, view, machine)
    drawing.circle(view.centre, 3, fill="white")
    _sense(drawing, machine.rotation)
    return drawing


def _reach(machine: Machine) -> float:
    """Radius of what is drawn to scale, m; the row axes go on to it."""
    radii = [web.reach_m * (1 + _THICKNESS / 2) for web in machine.webs]
    if isinstance(machine, ReciprocatingMachine):
        return 1.25 * max([*radii, *(1.35 * throw.crank_radius_m for throw in machine.throws)])
    guide = machine.anti_rotation
    pins = [guide.pin_circle_radius_m] if guide.type == "crank_pins" else []
    return 1.15 * max([*radii, *pins, 1.5 * machine.orbit_radius_m])


def _frame(drawing: Drawing) -> None:
    x, y = 26.0, _FRONT - 22
    drawing.line([(x, y - 26), (x, y), (x + 26, y)], MUTED)
    drawing.text((x + 30, y + 4), "x", size=10, fill=MUTED)
    drawing.text((x - 3, y - 31), "y", size=10, fill=MUTED)


def _sense(drawing: Drawing, rotation: str) -> None:
    """An arrow in the sense of rotation, apart from the machine."""
    view = _View(1.0, (44.0, 44.0))
    ends = (200.0, 500.0) if rotation == "ccw" else (340.0, 40.0)
    arc = view.arc(18, *ends)
    drawing.line(arc, MUTED, 1.2)
    ahead = ends[1] + (90 if rotation == "ccw" else -90)
    tip = arc[-1]
    left, right = (_View(1.0, tip)(7, ahead + 180 + turn) for turn in (28, -28))
    drawing.area([tip, left, right], MUTED)
    drawing.text((44, 48), rotation, "middle", 10, MUTED)


def _rows(drawing: Drawing, view: _View, machine: ReciprocatingMachine, reach: float) -> None:
    axes = [
        (row.axis_deg % 360.0, row.name or "", throw.name or str(number))
        for number, throw in enumerate(machine.throws, start=1)
        for row in throw.rows
    ]
    for axis, group in _grouped(axes):
        drawing.line([view.centre, view(reach, axis)], MUTED, 0.9, "12 3 2 3")
        along, across = view(1.0, axis), view(1.0, axis + 90)
        dx, dy = ((along[i] - view.centre[i]) / view.scale for i in (0, 1))
        px, py = ((across[i] - view.centre[i]) / view.scale for i in (0, 1))
        end = view(reach, axis)
        body = [(end[0] + dx * a + px * b, end[1] + dy * a + py * b) for a, b in ((-14, -9), (4, -9), (4, 9), (-14, 9))]
        drawing.area(body, "white", stroke=MUTED)
        if len(machine.throws) > 2 and len({throw for _, _, throw in group}) == len(machine.throws):
            names = "all throws"
        else:
            names = _joined(name if name and len(machine.throws) <= 2 else f"throw {throw}" for _, name, throw in group)
        place = view(reach + 12 / view.scale, axis)
        _outside(drawing, view, place, f"{names}, {digits(axis)}°", MUTED)


def _sectors(drawing: Drawing, view: _View, webs: Sequence[Web]) -> None:
    """The angles that are allowed, an arc for each web that restricts them."""
    for index, web in enumerate(web for web in webs if web.sector is not None and web.max_mass_kg != 0):
        if web.sector is None or index >= _MAX_LABELS:
            break
        radius = web.reach_m * (1 + _THICKNESS / 2) + (4 + 3 * (index % 4)) / view.scale
        low, high = (web.sector.centre_deg + side * web.sector.half_angle_deg for side in (-1, 1))
        drawing.line(view.arc(radius, low, high), _ALLOWED, 1.4)
        for edge in (low, high):
            drawing.line([view(radius - 4 / view.scale, edge), view(radius + 4 / view.scale, edge)], _ALLOWED, 1.4)


def _counterweights(
    drawing: Drawing, view: _View, fitted: Sequence[Counterweight], built: Sequence[Counterweight]
) -> None:
    # area = half angle x thickness x radius^2 in proportion to the mass, the thickness in proportion to the radius
    unit = max((one.mass_kg / one.radius_m**2 for one in (*fitted, *built)), default=0.0)
    shown = [one for one in fitted if one.mass_kg > 0]
    for one in shown:
        drawing.area(_ring(view, one, unit), AFTER, 0.16, AFTER, 1.2)
    for one in built:
        if one.mass_kg > 0:
            drawing.area(_ring(view, one, unit), "none", stroke=BEFORE, width=1.2, dash="5 3")
    for one in shown[:_MAX_LABELS]:
        drawing.circle(view(one.radius_m, one.angle_deg), 2.2, AFTER, AFTER)
    places = [(round(one.angle_deg, 0) % 360.0, one.web, one.radius_m) for one in shown]
    for _, group in _grouped(places):
        angle, radius = group[0][0], max(each[2] for each in group)
        text = _joined(name for _, name, _ in group)
        # beside the row axes, which often lie along the counterweights
        place = view(radius, angle)
        drawing.text((place[0], place[1] - 7), text, "middle", 10.5, AFTER, halo=True)


def _ring(view: _View, one: Counterweight, unit: float) -> list[Point]:
    radius = one.radius_m
    half = _WIDEST_DEG * one.mass_kg / (unit * radius**2)
    outer, inner = radius * (1 + _THICKNESS / 2), radius * (1 - _THICKNESS / 2)
    low, high = one.angle_deg - half, one.angle_deg + half
    return [*view.arc(outer, low, high), *view.arc(inner, high, low)]


def _cranks(drawing: Drawing, view: _View, machine: ReciprocatingMachine) -> None:
    for radius in sorted({throw.crank_radius_m for throw in machine.throws}):
        drawing.circle(view.centre, view.scale * radius, FAINT, dash="3 3")
    cranks = [
        (throw.crank_angle_deg % 360.0, throw.name or str(number), throw.crank_radius_m)
        for number, throw in enumerate(machine.throws, start=1)
    ]
    for angle, group in _grouped(cranks):
        radius = max(each[2] for each in group)
        drawing.line([view.centre, view(radius, angle)], INK, 3.0)
        for each in group:
            drawing.circle(view(each[2], angle), 4.5, fill="white", width=1.6)
        x, y = view(radius + 15 / view.scale, angle)
        drawing.text((x, y + 4), _joined(name for _, name, _ in group), "middle", 11, halo=True)


def _scroll(drawing: Drawing, view: _View, machine: ScrollMachine) -> None:
    orbit, guide = machine.orbit_radius_m, machine.anti_rotation
    drawing.circle(view.centre, view.scale * orbit, MUTED, dash="3 3")
    drawing.line([view.centre, view(orbit, 0)], INK, 3.0)
    drawing.circle(view(orbit, 0), 4.5, fill="white", width=1.6)
    x, y = view(orbit, 270)
    drawing.text((x, y + 14), "orbiting scroll", "middle", 10, halo=True)
    if guide.type == "oldham":
        reach = _reach(machine)
        drawing.line([view(reach, guide.axis_deg + 180), view(reach, guide.axis_deg)], MUTED, 0.9, "12 3 2 3")
        _outside(drawing, view, view(reach, guide.axis_deg), f"ring, {digits(guide.axis_deg)}°", MUTED)
        return
    drawing.circle(view.centre, view.scale * guide.pin_circle_radius_m, FAINT, dash="3 3")
    for number in range(1, min(guide.count, 120) + 1):
        angle = (1 if machine.rotation == "ccw" else -1) * 360.0 * (number - 1) / guide.count
        place = view(guide.pin_circle_radius_m, angle)
        drawing.circle(place, 4.5, fill="white", width=1.4)
        if guide.count <= _MAX_LABELS:
            drawing.text((place[0], place[1] + 17), f"pin {number}", "middle", 10, halo=True)


def _outside(drawing: Drawing, view: _View, place: Point, text: str, fill: str) -> None:
    """A name beyond the end of a line, on the side where there is room."""
    aside = place[0] - view.centre[0]
    anchor = "middle" if abs(aside) < 40 else ("start" if aside > 0 else "end")
    drawing.text((place[0], place[1] + 4), text, anchor, 10.5, fill, halo=True)  # type: ignore[arg-type]


def _grouped(items: Iterable[Each]) -> Iterator[tuple[float, list[Each]]]:
    """Items by their angle."""
    for angle, group in groupby(sorted(items, key=lambda item: item[0]), key=lambda item: item[0]):
        yield angle, list(group)


def _joined(names: Iterable[str]) -> str:
    """Names as far as there is room for them."""
    found = [shortened(name, 18) for name in dict.fromkeys(names)]
    shown: list[str] = []
    for name in found:
        if len(shown) == 6 or sum(map(len, shown)) + len(name) > 36:
            break
        shown.append(name)
    return ", ".join(shown) + (f" and {len(found) - len(shown)} more" if len(shown) < len(found) else "")
