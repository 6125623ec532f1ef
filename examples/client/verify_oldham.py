"""Losses of pins beside those of an Oldham ring: friction of both journals of a pin, and of four keys that slide.

A torque T loads the keys of the frame, and those of the scroll, with T / (2 R) each. The latter carry half of the
ring's inertia m e w^2 cos(t - u) beside. They slide with e w |sin(t - u)| and e w |cos(t - u)|.
"""

from __future__ import annotations

from math import asin, cos, degrees, pi, radians, sin
from typing import Callable, Iterable, Iterator, Sequence

from verify_bearings import within
from verify_claims import Claims, same
from verify_numbers import ONE, Place
from verify_pins import Torque, Turn
from verify_pistons import integral

#: of what is largest: by which doubles are off; of a loss, by which its integral may be
EXACT, SMOOTH = 1e-12, 1e-9
#: pins that leave a line by so little have peaks that no panel of the service shows; and pieces times pins to look at
_NARROW, _MOST = 0.05, 20_000
#: after which the ends of an interval are neighbours
_HALVINGS = 60


def comparison(claim: str, pattern: Place, turn: Turn, place: Place) -> Claims:
    """Of both, and their ratio."""
    design, pins, torque = pattern / "comparison", turn.pins, turn.torque
    omega = (design / "speed_rpm").double() * pi / 30
    lost = place / "pins_W"
    per_force = (design / "pin_diameter_m").double() * (design / "pin_friction_coefficient").double() * omega
    is_covered = pins.rest >= _NARROW and not pins.loose and (len(torque.angles) + 4) * pins.count <= _MOST
    if turn.is_unbounded:
        yield same(claim, lost, None)
    elif not is_covered:
        yield claim, lost, None, ONE
    else:
        loads = sum(_load(turn, k) for k in range(pins.count))
        yield within(claim, lost, loads * per_force, loads * per_force, SMOOTH * loads * per_force)
    ring = place / "oldham_ring"
    yield from _ring(claim, design / "oldham_ring", (pattern / "orbit_radius_m").double(0.0), omega, turn, ring)
    loss, ratio = (ring / "loss_W").double(), place / "ratio"
    if lost and loss:
        value = lost.double() / loss
        yield within(claim, ratio, value, value, EXACT * value)
    else:
        yield same(claim, ratio, None)


def _load(turn: Turn, k: int) -> float:
    """The mean size of what a pin carries."""
    pins, torque = turn.pins, turn.torque
    zero = degrees(pins.shapes[k].phase)
    breaks = [zero, zero + 180, *_changes(torque.at, torque.angles)]
    return _mean(lambda angle: abs(pins.load(k, torque.at(angle), angle)[0]), torque, breaks)


def _changes(curve: Callable[[float], float], edges: Iterable[float]) -> Iterator[float]:
    """Where a curve changes its sign [degrees], which between two edges it does once at most."""
    ends = sorted({0.0, 360.0, *(angle % 360 for angle in edges)})
    for low, high in zip(ends, ends[1:]):
        first = curve(low)
        if first * curve(high) < 0:
            for _ in range(_HALVINGS):
                middle = (low + high) / 2
                low, high = (middle, high) if first * curve(middle) > 0 else (low, middle)
            yield low


def _mean(curve: Callable[[float], float], torque: Torque, breaks: Sequence[float]) -> float:
    """Over a revolution, piece by piece."""
    edges = sorted({0.0, 360.0, *torque.angles, *(angle % 360 for angle in breaks)})
    pieces = [(a + (b - a) * 1e-12, b - (b - a) * 1e-12) for a, b in zip(edges, edges[1:])]
    size = max((abs(curve(end)) for piece in pieces for end in piece), default=0.0)
    size = max([size, *(abs(curve((a + b) / 2)) for a, b in pieces)])
    return sum(integral(curve, a, b, size) for a, b in pieces) / 360


def _ring(claim: str, design: Place, orbit: float, omega: float, turn: Turn, place: Place) -> Claims:
    """Loads and speeds of the keys, and what they lose."""
    radius, axis = (design / "key_radius_m").double(), (design / "axis_deg").double(0.0)
    inertia, speed = 0.5 * (design / "mass_kg").double(0.0) * orbit * omega**2, orbit * omega
    torque, friction = turn.torque, (design / "friction_coefficient").double()

    def couple(angle: float) -> float:
        return torque.at(angle) / (2 * radius)

    def keys(angle: float) -> Sequence[float]:
        pull = inertia * cos(radians(angle - axis))
        return couple(angle) - pull, -couple(angle) - pull

    def loss(angle: float) -> float:
        own = radians(angle - axis)
        in_scroll = sum(map(abs, keys(angle))) * abs(cos(own))
        return friction * speed * (2 * abs(couple(angle)) * abs(sin(own)) + in_scroll)

    size = torque.most / (2 * radius) + abs(inertia)
    values = {
        "frame_key_N": (couple, size),
        "frame_speed_m_s": (lambda angle: speed * abs(sin(radians(angle - axis))), speed),
        "scroll_speed_m_s": (lambda angle: speed * abs(cos(radians(angle - axis))), speed),
    }
    for field, (curve, most) in values.items():
        samples = list(place / field)
        yield claim, place / field, ONE if len(samples) == len(turn.angles) else -ONE, ONE
        for sample, angle in zip(samples, turn.angles):
            yield within(claim, sample, curve(angle), curve(angle), EXACT * most)
    pairs = list(place / "scroll_keys_N")
    yield claim, place / "scroll_keys_N", ONE if len(pairs) == len(turn.angles) else -ONE, ONE
    for pair, angle in zip(pairs, turn.angles):
        ends = list(pair)
        yield claim, pair, ONE if len(ends) == len(keys(angle)) else -ONE, ONE
        for key, value in zip(ends, keys(angle)):
            yield within(claim, key, value, value, EXACT * size)
    steep = 2 * radius * inertia
    levels = list(_level(torque, axis, steep))
    largest = max(max(map(abs, keys(angle))) for angle in levels)
    yield within(claim, place / "peak_key_N", largest, largest, EXACT * size)
    yield within(claim, place / "peak_speed_m_s", speed, speed, EXACT * speed)
    # a kink that is near the end of a piece is between the places that an integral looks at
    kinks = [*_changes(torque.at, torque.angles), *(axis + 90 * n for n in range(4))]
    kinks += [*_changes(lambda angle: keys(angle)[0], levels), *_changes(lambda angle: keys(angle)[1], levels)]
    whole = _mean(loss, torque, kinks)
    yield within(claim, place / "loss_W", whole, whole, SMOOTH * whole)


def _level(torque: Torque, axis: float, steep: float) -> Iterator[float]:
    """Angles where a key may carry most [degrees]: entries of the torque, and where it rises as the inertia does."""
    entries = torque.angles
    yield from entries
    for start, end in zip(entries, [*entries[1:], entries[0] + 360]):
        slope = degrees(torque.at(end) - torque.at(start)) / (end - start)
        level = degrees(asin(slope / steep)) if 0 < abs(slope) < steep else 0.0
        for own in (level, 180 - level, -level, 180 + level):
            angle = start + (axis + own - start) % 360
            if angle < end:
                yield angle
