"""Whether pins hold the scroll at every instant: moment and force of their loads, their work, and the mechanism.

Equation (1) of Liu, Zhao and Li for one pin and two gives the moment 2 T sin^2, which is T on the average alone.
"""

from __future__ import annotations

from math import cos, pi, radians, sin
from typing import List

from verify_bearings import within
from verify_claims import Claims, same
from verify_numbers import ONE, Place, real
from verify_pins import Pins, Torque, Turn
from verify_pistons import integral

#: of a torque or a force: by which doubles are off
EXACT = 1e-12
#: of all loads together: what leaves no more than this is in balance
BALANCED = 1e-9
#: of the torque: what is left beside a dead point, where loads have no bound
BESIDE = 1e-3
#: degrees between the angles that are watched beside the samples and the entries of the torque
_STEP = 45.0


def equilibrium(claim: str, turn: Turn, place: Place, loads: List[List[float]]) -> Claims:
    """Balances of the loads. ``loads``: as they are printed, by pin and sample."""
    pins, torque, entry = turn.pins, turn.torque, place / "equilibrium"
    if pins.formula and pins.count < 3:
        yield from _on_average(claim, turn, entry)
        return
    dead = max((abs(torque.at(angle)) for angle in pins.dead), default=0.0)
    holds = (entry / "holds").read((bool,), "true or false")
    moment, net = entry / "max_moment_error_Nm", entry / "max_net_force_N"
    if dead > 0:
        yield same(claim, entry / "holds", False)
        yield within(claim, moment, dead, dead * (1 + BESIDE), EXACT * dead)
        yield within(claim, net, 0.0, BESIDE * dead / min(pins.radii), 0.0)
        return
    if not holds and not pins.steady:
        # rounding leaves too much, which is no contradiction
        for leaf in (entry / "holds", moment, net):
            yield claim, leaf, None, ONE
        return
    yield same(claim, entry / "holds", True)
    for n, angle in enumerate(turn.angles):
        samples = [load[n] for load in loads]
        size, span = sum(map(abs, samples)), max(pins.radii)
        pin_moment = sum(load * pins.lever(k, angle) for k, load in enumerate(samples[: pins.count]))
        slack = 2 * BALANCED * size
        yield claim, entry / "holds", real(slack * span + EXACT * torque.most - abs(pin_moment - torque.at(angle))), ONE
        yield claim, entry / "holds", real(slack - abs(sum(samples))), ONE
    carriers = [*(place / "pins"), *([place / "drive_bearing"] if place / "drive_bearing" else [])]
    # the peaks together are above all loads of any instant
    most = sum((carrier / "peak_N").double(0.0) for carrier in carriers) * (1 + BESIDE)
    yield within(claim, moment, 0.0, BALANCED * most * max(pins.radii), 0.0)
    yield within(claim, net, 0.0, BALANCED * most, 0.0)


def _on_average(claim: str, turn: Turn, entry: Place) -> Claims:
    """Of one pin and two the formula leaves T cos 2t, and of one the load itself."""
    pins, torque = turn.pins, turn.torque
    angles = [*turn.angles, *torque.angles, *(_STEP * n + pins.phases[0] for n in range(8))]
    pin_moment = max(abs(torque.at(angle) * cos(2 * radians(angle - pins.phases[0]))) for angle in angles)
    net = max(abs(pins.load(0, torque.at(angle), angle)[0]) for angle in angles) if pins.count == 1 else 0.0
    yield within(claim, entry / "max_moment_error_Nm", pin_moment, pin_moment, EXACT * torque.most)
    yield within(claim, entry / "max_net_force_N", net, net, EXACT * torque.most / pins.radii[0])
    yield same(claim, entry / "holds", torque.most == 0)


def mechanism(claim: str, pins: Pins, place: Place) -> Claims:
    """Shaft, scroll and cranks turn in pairs; in parallelograms all cranks but one repeat a constraint."""
    links, pairs, repeated = pins.count + 2, 2 * pins.count + 2, pins.count - 1
    for field, count in (
        ("moving_links", links),
        ("lower_pairs", pairs),
        ("higher_pairs", 0),
        ("virtual_constraints", repeated),
        ("local_freedoms", 0),
        ("degrees_of_freedom", 3 * links - (2 * pairs - repeated)),
    ):
        yield same(claim, place / field, count)


def energy(claim: str, pins: Pins, torque: Torque, place: Place) -> Claims:
    """Work over one pitch: of the torque, and of the pins against it."""
    pitch = 360.0 / pins.count
    work = torque.work(0.0, pitch)
    against = _work(pins, torque, pitch) if pins.formula and pins.count < 3 else work
    off = (BALANCED * torque.most + pins.noise * sum(pins.radii)) * radians(pitch)
    yield within(claim, place / "pitch_deg", pitch, pitch, EXACT * pitch)
    yield within(claim, place / "torque_work_J", work, work, EXACT * torque.most * 2 * pi)
    yield within(claim, place / "pins_work_J", -against, -against, off)
    yield within(claim, place / "sum_J", work - against, work - against, off)


def _work(pins: Pins, torque: Torque, pitch: float) -> float:
    """Of 2 T sin^2, by a quadrature between the entries of the torque."""
    edges = [0.0, *(angle for angle in torque.angles if 0 < angle < pitch), pitch]

    def moment(angle: float) -> float:
        return radians(1) * 2 * torque.at(angle) * sin(radians(angle - pins.phases[0])) ** 2

    inside = [(a + (b - a) * 1e-12, b - (b - a) * 1e-12) for a, b in zip(edges, edges[1:])]
    return sum(integral(moment, a, b, torque.most) for a, b in inside)
