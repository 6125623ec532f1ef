"""The machine from the front: seen from +z at shaft angle 0, to scale."""

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, groupby
from typing import TypeVar

from service.common.figures import digits
from service.drawings.labels import Label, Shape, labels
from service.drawings.layout import Balance, CrankMachine, Fitted, Layout, OrbitMachine, Outline, Pins, Place, Ring
from service.drawings.outline import bounded, points, rotation
from service.drawings.projection import SIZE, FrontProjection, disc
from service.drawings.svg import AFTER, FAINT, INK, MUTED, SERIES, Drawing, Point, shortened

Entry = TypeVar("Entry", bound=tuple[float, str, object])

#: how far the machine and the axes of its rows reach, px
_MACHINE, _AXES = 144.0, 164.0
#: as it stands on a page of the report
_SCALE = 0.8
#: more names than this cannot be read
_MAX_NAMES = 16
_PIN, _THIN_PIN = 7.0, 4.0
#: of a px: what a polygon is away from its arc
_FINE = 0.1
_ALLOWED = SERIES[2]
BUILT = SERIES[3]


def front(layout: Layout) -> Drawing:
    """Cranks, axes of rows and counterweights, x to the right and y upwards.

    Counterweights with an envelope are true to shape; a dashed disc stands for the others. What is built in
    place of them has no ground. Balance shafts are in their places.
    """
    machine, best, built = layout.machine, layout.best, layout.built
    names = ", ".join(f"{fitted.web.name} {_weight(fitted)}" for fitted in best)
    words = f"From the front, at shaft angle 0. Counterweights: {names or 'none'}."
    drawing = Drawing(SIZE, SIZE, words, _SCALE)
    view = FrontProjection(_MACHINE / _reach(layout))
    _frame(drawing)
    names_beside: list[Label] = []
    if isinstance(machine, CrankMachine):
        names_beside += _rows(drawing, view, machine)
    for web in machine.places:
        _allowed(drawing, view, web)
    optimum = (*best, *chain.from_iterable(shaft.best for shaft in layout.balance))
    every = (*optimum, *built, *chain.from_iterable(shaft.built for shaft in layout.balance))
    shapes = [_fitted(drawing, view, fitted, optimum) for fitted in sorted(best, key=lambda fitted: -fitted.mass_kg)]
    _as_built(drawing, view, built, every)
    beside: list[Shape] = []
    for shaft in layout.balance:
        name, outlines = _balance(drawing, view, shaft, optimum, every)
        names_beside.append(name)
        beside += outlines
    cranks = _cranks(drawing, view, machine) if isinstance(machine, CrankMachine) else _scroll(drawing, view, machine)
    drawing.circle(view.centre, 4, fill=INK)
    _sense(drawing, machine.rotation)
    pins = [FrontProjection(1.0, place).arc(_PIN, 0, 360) for place, _, _ in cranks]
    labels(
        drawing,
        [*_crank_names(view, cranks), *_web_names(view, best, shapes), *names_beside],
        [*shapes, *pins, *beside],
    )
    return drawing


def _balance(
    drawing: Drawing, view: FrontProjection, balance: Balance, optimum: Sequence[Fitted], every: Sequence[Fitted]
) -> tuple[Label, list[Shape]]:
    """Draws a balance shaft in its place, and gives its name and the outlines of what is on it.

    Parameters
    ----------
    optimum, every : weights of all shafts, and with them what is built.
    """
    shaft = balance.shaft
    around = view._replace(centre=view(*shaft.axis))
    way = f"{'with' if shaft.speed_ratio > 0 else 'against'}, {'n' if abs(shaft.speed_ratio) == 1 else '2n'}"
    contents = ", ".join(f"{fitted.web.name} {_weight(fitted)}" for fitted in balance.best)
    with drawing.group("balancer", f"{shaft.name}, {way}: {contents or 'nothing'}"):
        # the first circle is the axis, about which a page turns what is on it
        drawing.circle(around.centre, 3, MUTED, "white")
        for radius in sorted({web.radius_m for web in shaft.places if web.radius_m}):
            drawing.circle(around.centre, view.scale * radius, FAINT, dash="3 3")
        for web in shaft.places:
            _allowed(drawing, around, web)
        shapes = [_fitted(drawing, around, fitted, optimum) for fitted in balance.best]
        _as_built(drawing, around, balance.built, every)
    x, y = around.centre
    lowest = max((corner for shape in shapes for _, corner in shape), default=y)
    return Label((x, max(y, lowest) + 14.0), f"{shortened(shaft.name, 18)}: {way}", MUTED, 12.0), shapes


def _as_built(drawing: Drawing, view: FrontProjection, built: Sequence[Fitted], weights: Sequence[Fitted]) -> None:
    for fitted in built:
        with drawing.group("counterweight built", f"{fitted.web.name} as built: {_weight(fitted)}"):
            drawing.area(disc(view, fitted, weights), "none", stroke=BUILT, width=1.6, dash="6 3")


def _weight(fitted: Fitted) -> str:
    return f"{digits(round(fitted.mass_kg, 4))} kg at {digits(round(fitted.angle_deg, 2))}°"


def _reach(layout: Layout) -> float:
    """Radius of what is drawn to scale, m; the axes of rows go on beyond it."""
    machine = layout.machine
    radii = [1.22 * web.reach_m for web in machine.places if web.reach_m]
    radii += [
        1.22 * counterweight.radius_m for counterweight in (*layout.best, *layout.built) if counterweight.shape is None
    ]
    for shaft, *weights in layout.balance:
        far, _ = shaft.axis
        radii += [far + 1.22 * web.reach_m for web in shaft.places if web.reach_m]
        radii += [far + 1.22 * fitted.radius_m for fitted in chain(*weights) if fitted.shape is None]
    if isinstance(machine, CrankMachine):
        return max([*radii, *(1.25 * crank.crank_radius_m for _, crank in machine.cranks)], default=1.0)
    guide = machine.anti_rotation
    pins = [1.1 * guide.pin_circle_radius_m] if isinstance(guide, Pins) else []
    return max([*radii, *pins, 1.5 * machine.orbit_radius_m])


def _frame(drawing: Drawing) -> None:
    x, y = 14.0, SIZE - 14.0
    with drawing.group("axes"):
        drawing.line([(x, y - 26), (x, y), (x + 26, y)], MUTED)
        drawing.text((x + 30, y + 4), "x", size=12, fill=MUTED)
        drawing.text((x - 4, y - 31), "y", size=12, fill=MUTED)


def _sense(drawing: Drawing, rotation: str) -> None:
    """An arrow in the sense of rotation, apart from the machine."""
    view = FrontProjection(1.0, (32.0, 32.0))
    ends = (200.0, 500.0) if rotation == "ccw" else (340.0, 40.0)
    with drawing.group("sense", "turns counter-clockwise" if rotation == "ccw" else "turns clockwise"):
        arc = view.arc(18, *ends)
        drawing.line(arc, MUTED, 1.2)
        ahead = ends[1] + (90 if rotation == "ccw" else -90)
        tip = arc[-1]
        left, right = (FrontProjection(1.0, tip).at(7, ahead + 180 + turn) for turn in (28, -28))
        drawing.area([tip, left, right], MUTED)
        drawing.text((view.centre[0], view.centre[1] + 4), rotation, "middle", 11, MUTED)


def _rows(drawing: Drawing, view: FrontProjection, machine: CrankMachine) -> Iterator[Label]:
    cranks = machine.cranks
    axes = [
        (row.axis_deg % 360.0, row.name or "", throw)
        for throw, crank in cranks
        for row in crank.rows
        if row is not None
    ]
    for axis, group in _grouped(axes):
        if len(cranks) > 2 and len({throw for _, _, throw in group}) == len(cranks):
            names = "all throws"
        else:
            names = _name_list(name if name and len(cranks) <= 2 else f"throw {throw}" for _, name, throw in group)
        end = view.at(_AXES, axis)
        with drawing.group("row", f"axis of {names}, {digits(axis)}°"):
            drawing.line([view.centre, end], MUTED, 0.9, "12 3 2 3")
            drawing.circle(end, 3, "none", MUTED)
        # never on the axis itself
        steep = abs(math.sin(math.radians(axis))) > 0.5
        place = view.at(_AXES + 14, axis) if steep else (end[0], end[1] + 16)
        yield Label(place, f"{names}, {digits(axis)}°", MUTED, 12.0)


def _allowed(drawing: Drawing, view: FrontProjection, web: Place) -> None:
    """Where a weight may sit, if not anywhere."""
    if web.sector is None or web.reach_m is None or web.max_mass_kg == 0:
        return
    low, high = (web.sector.centre_deg + side * web.sector.half_angle_deg for side in (-1, 1))
    wedge = [view.centre, *view.arc(1.2 * view.scale * web.reach_m, low, high)]
    with drawing.group("sector", f"{web.name} may carry its counterweight here"):
        drawing.area(wedge, _ALLOWED, 0.08, _ALLOWED, 1.0, "4 4")


def _fitted(drawing: Drawing, view: FrontProjection, fitted: Fitted, weights: Sequence[Fitted]) -> Shape:
    """Draws a counterweight, and gives its outline."""
    shape = disc(view, fitted, weights) if fitted.shape is None else _cut(view, fitted, fitted.shape)
    kind = f"counterweight{' fixed' if fitted.fixed else ''}{' unknown' if fitted.shape is None else ''}"
    with drawing.group(kind, f"{fitted.web.name}: {_weight(fitted)}, radius {digits(fitted.radius_m)} m"):
        ground, edge = (MUTED, INK) if fitted.fixed else (AFTER, AFTER)
        drawing.area(shape, ground, 0.3, edge, 1.6, "5 3" if fitted.shape is None else None)
        drawing.circle(view(fitted.radius_m, fitted.angle_deg), 2.2, edge, edge)
    return shape


def _cut(view: FrontProjection, fitted: Fitted, shape: Outline) -> Shape:
    """True to shape."""
    hub = fitted.web.envelope.inner_radius_m if fitted.web.envelope else 0.0
    half_angle, chord = math.radians(shape.half_angle_deg), shape.chord_height_m is not None
    edges = bounded(shape.outer_radius_m, hub, half_angle, chord)
    corners = points(rotation(edges, math.radians(fitted.angle_deg - 90.0)), _FINE / view.scale)
    x0, y0 = view.centre
    return [(x0 + view.scale * x, y0 - view.scale * y) for x, y in corners]


#: place of the pin, names of what is there, their common name
Crank = tuple[Point, list[str], str]


def _cranks(drawing: Drawing, view: FrontProjection, machine: CrankMachine) -> list[Crank]:
    for radius in sorted({crank.crank_radius_m for _, crank in machine.cranks}):
        drawing.circle(view.centre, view.scale * radius, FAINT, dash="3 3")
    cranks = [(crank.crank_angle_deg % 360.0, name, crank.crank_radius_m) for name, crank in machine.cranks]
    pins = []
    thin = len(cranks) > _MAX_NAMES
    for angle, group in _grouped(cranks):
        for radius in sorted({member[2] for member in group}, reverse=True):
            names, pin = [name for _, name, own in group if own == radius], view(radius, angle)
            with drawing.group("throw", f"throw {_name_list(names)} at {digits(angle)}°"):
                drawing.line([view.centre, pin], INK, 1.0 if thin else 4.0)
                drawing.circle(pin, _THIN_PIN if thin else _PIN, fill="white", width=1.0 if thin else 2.0)
            pins.append((pin, names, "throws"))
    return pins


def _scroll(drawing: Drawing, view: FrontProjection, machine: OrbitMachine) -> list[Crank]:
    orbit, guide = machine.orbit_radius_m, machine.anti_rotation
    if isinstance(guide, Ring):
        ends = [view.at(_AXES, guide.axis_deg + turn) for turn in (180.0, 0.0)]
        with drawing.group("row", f"the Oldham ring slides along this line, {digits(guide.axis_deg)}°"):
            drawing.line(ends, MUTED, 0.9, "12 3 2 3")
    elif guide is not None:
        drawing.circle(view.centre, view.scale * guide.pin_circle_radius_m, FAINT, dash="3 3")
        for number in range(1, min(guide.count, 120) + 1):
            angle = (1 if machine.rotation == "ccw" else -1) * 360.0 * (number - 1) / guide.count
            with drawing.group("pin", f"pin {number} at {digits(round(angle % 360.0, 3))}°"):
                drawing.circle(view(guide.pin_circle_radius_m, angle), 4.5, fill="white", width=1.4)
    drawing.circle(view.centre, view.scale * orbit, MUTED, dash="3 3")
    with drawing.group("throw", "eccentric of the orbiting scroll"):
        drawing.line([view.centre, view(orbit, 0)], INK, 3.0)
        drawing.circle(view(orbit, 0), 4.5, fill="white", width=1.6)
    return [(view(orbit, 0), ["orbiting scroll"], "")]


def _crank_names(view: FrontProjection, cranks: Sequence[Crank]) -> Iterator[Label]:
    if len(cranks) > _MAX_NAMES:
        return
    for (x, y), names, common in cranks:
        text = f"{len(names)} {common}" if len(names) > 4 else _name_list(names)
        # never on the crank itself
        yield Label((x, y + 17 if y > view.centre[1] + 1 else y - 17), text, INK)


def _web_names(view: FrontProjection, weights: Sequence[Fitted], shapes: Sequence[Shape]) -> Iterator[Label]:
    """Of those in the same place one name: beyond the shape, or above it where the axes of rows run beside it."""
    places: dict[tuple[int, str], list[int]] = {}
    order = sorted(weights, key=lambda weight: -weight.mass_kg)
    for k, weight in enumerate(order):
        places.setdefault((round(weight.angle_deg), f"{weight.radius_m:.2g}"), []).append(k)
    if len(places) > _MAX_NAMES:
        return
    for group in places.values():
        names = sorted(order[k].web.name for k in group)
        text = f"{len(names)} webs" if len(names) > 4 else _name_list(names)
        first, shape = order[group[0]], shapes[group[0]]
        top = min(y for k in group for _, y in shapes[k])
        if abs(math.cos(math.radians(first.angle_deg))) > math.sqrt(0.5):
            yield Label((view(first.radius_m, first.angle_deg)[0], top - 10), text, AFTER)
            continue
        x0, y0 = view.centre
        distance = max(math.hypot(x - x0, y - y0) for x, y in shape) + 14
        x, y = view.at(distance, first.angle_deg)
        # beside a shape the name begins where the shape ends
        yield Label((x + 3.5 * len(text) * math.cos(math.radians(first.angle_deg)), y), text, AFTER)


def _grouped(items: Iterable[Entry]) -> Iterator[tuple[float, list[Entry]]]:
    """Items by their angle."""
    for angle, group in groupby(sorted(items, key=lambda item: item[0]), key=lambda item: item[0]):
        yield angle, list(group)


def _name_list(names: Iterable[str]) -> str:
    """Names as far as there is room for them."""
    texts = [shortened(name, 18) for name in dict.fromkeys(names)]
    entries: list[str] = []
    for name in texts:
        if entries and (len(entries) == 6 or sum(map(len, entries)) + len(name) > 36):
            break
        entries.append(name)
    return ", ".join(entries) + (f" and {len(texts) - len(entries)} more" if len(entries) < len(texts) else "")
