"""Pins with clearance: the loads that are printed are those of one turn of the scroll, and of one shift.

The scroll turns by p and shifts by t along the eccentric. A pin with lever a, clearance c and error e is strained by
d = a p + t - e; it bears beyond its clearance and pushes with k times what d is beyond. Loads in balance that are those
of one p and one t are the only ones: the strain energy is convex.
"""

from __future__ import annotations

from math import inf, radians
from typing import List, Sequence, Tuple

from verify_bearings import within
from verify_claims import Claims, same
from verify_numbers import ONE, Place, real
from verify_pins import Pins, Turn

#: of strains and clearances: by which doubles are off; of the largest load: what is certified as a rule
STRAINED, CERTIFIED = 1e-10, 1e-6
EXACT = 1e-9
#: of the radius: by which the sine of a lever that vanishes is off
LEVER = 1e-15


def contact(claim: str, turn: Turn, place: Place, loads: List[List[float]]) -> Claims:
    """Which pins bear, and how far the scroll turns. ``loads``: as they are printed, by pin and sample."""
    pins, entry = turn.pins, place / "contact"
    rotations, counts = list(entry / "scroll_rotation_deg"), []
    yield claim, entry / "scroll_rotation_deg", ONE if len(rotations) == len(turn.angles) else -ONE, ONE
    largest = max((abs(load) for samples in loads for load in samples), default=0.0)
    bound = (entry / "load_error_bound_N").double()
    rooms = []
    for n, (angle, rotation) in enumerate(zip(turn.angles, rotations)):
        if turn.is_stuck(angle):
            yield same(claim, rotation, None)
            rooms.append((ONE, ONE))
            continue
        samples = [of_pin[n] for of_pin in loads]
        counts.append(sum(load != 0 for load in samples[: pins.count]))
        room, size = _shift(pins, samples, angle, radians(rotation.double()), bound)
        rooms.append((real(room), real(size)))
        yield claim, rotation, *rooms[-1]
    carriers = [*(place / "pins"), *([place / "drive_bearing"] if place / "drive_bearing" else [])]
    for k, carrier in enumerate(carriers):
        for sample, (room, size) in zip(carrier / "load_N", rooms):
            if sample:
                yield claim, sample, room, size
        if k < pins.count:
            yield from _bears(claim, carrier / "carries_load", loads[k])
    yield same(claim, entry / "fewest_pins", min([pins.count, *counts]))
    yield same(claim, entry / "most_pins", max([0, *counts]))
    if bound > CERTIFIED * largest + pins.noise:
        # it says itself that it certifies no more
        yield claim, entry / "load_error_bound_N", None, ONE
    else:
        yield claim, entry / "load_error_bound_N", real(bound), real(largest)
    # |Q - Q*| is at most sqrt(2 k gap)
    stiffest = max([*pins.stiffness, *([] if pins.is_rigid else [pins.drive])])
    yield within(claim, entry / "gap_J", 0.0, bound**2 / (2 * stiffest), EXACT * bound**2 / stiffest)


def _bears(claim: str, place: Place, samples: Sequence[float]) -> Claims:
    """Whether a pin bears, sample by sample."""
    flags = list(place)
    yield claim, place, ONE if len(flags) == len(samples) else -ONE, ONE
    for flag, load in zip(flags, samples):
        yield same(claim, flag, load != 0)


def _shift(pins: Pins, samples: Sequence[float], angle: float, rotation: float, bound: float) -> Tuple[float, float]:
    """How much room there is for one shift that all loads have, and the size of what it is made of [m]."""
    low, high, whole = (0.0, 0.0, 0.0) if pins.is_rigid else (-inf, inf, 0.0)
    members = [
        (pins.stiffness[k], pins.clearances[k], pins.errors[k], pins.lever(k, angle), LEVER * pins.radii[k])
        for k in range(pins.count)
    ]
    members += [] if pins.is_rigid or not pins.drive else [(pins.drive, 0.0, 0.0, 0.0, 0.0)]
    for (stiffness, clearance, error, lever, blur), load in zip(members, samples):
        strain, twist = load / stiffness, lever * rotation
        size = abs(strain) + clearance + abs(error) + abs(twist)
        off = STRAINED * size + bound / stiffness + abs(rotation) * blur
        start = error - twist + strain
        ends = (start + clearance, start + clearance) if load > 0 else (start - clearance, start - clearance)
        ends = ends if load else (start - clearance, start + clearance)
        low, high, whole = max(low, ends[0] - off), min(high, ends[1] + off), max(whole, size)
    return high - low if high - low < inf else whole, whole
