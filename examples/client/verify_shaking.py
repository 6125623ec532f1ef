"""What shakes the frame, as outputs show it: hodographs, phasors of orders 1, 2, 4 and 6, loads on the foundation.

A load along x or y is Re(C e^{jskt}) of order k: of force and moment C = co + conj(counter) along x, and -j times their
difference along y; s is the sense of rotation. From the outer dead centre d on it is |C| cos(k (t - d) - phase), so
that e^{j phase} = conj(C_s) e^{-jkd} / |C|, where C_s is C or, clockwise, its conjugate.
"""

from __future__ import annotations

from cmath import exp
from math import radians
from typing import Dict, Iterator, Optional, Tuple

from verify_answer import Fitted
from verify_bearings import sampled, within
from verify_claims import Claims, near, same
from verify_machine import NAMES, Machine, Mass, Responses, web_of
from verify_numbers import BLUR, ONE, ZERO, J, Number, Place, direction, real, total
from verify_orders import of_order, orders
from verify_plates import FIGURE, Plate
from verify_shafts import power

HIGHER = (2, 4, 6)  # those of a crank with a rod; odd ones above the first are none
#: share of the sum of all sizes below which a load on the foundation is called 0 (2^-47)
NEGLIGIBLE = 2.0**-47
SAMPLE = 1e-13  # of both phasors: by which a sample in doubles may be off
_ALONG = ("force_x", "force_y", "couple_of_x_forces", "couple_of_y_forces")


def shaking(request: Place, machine: Machine, answer: Place, there: Optional[Fitted]) -> Claims:
    """All that an answer holds of them."""
    if answer / "hodograph":
        yield from _hodographs(request, machine, answer / "hodograph", there)
    if answer / "orders":
        yield from _sides("orders", answer / "orders", there)
        for side, fitted in _states(there):
            own = by_order(request, machine, fitted)
            yield from orders("orders", answer / "orders" / side, own.items())
    if answer / "foundation_loads":
        yield from _foundation(request, machine, answer / "foundation_loads", there)


def by_order(request: Place, machine: Machine, there: Optional[Fitted]) -> Dict[int, Optional[Responses]]:
    """Force and moment of every order, without or with what is fitted."""
    first = machine.before if there is None else machine.responses(there.first)
    shafts = [] if there is None else there.on_shafts
    return {1: first, **{order: of_order(request, machine, order, shafts) for order in HIGHER}}


def _states(there: Optional[Fitted]) -> Iterator[Tuple[str, Optional[Fitted]]]:
    yield "before", None
    if there is not None:
        yield "after", there


def _sides(claim: str, place: Place, there: Optional[Fitted]) -> Claims:
    """Both sides where there are counterweights to show, else one."""
    after = place / "after"
    yield claim, after, ONE if bool(after) == (there is not None) else -ONE, ONE


def _hodographs(request: Place, machine: Machine, place: Place, there: Optional[Fitted]) -> Claims:
    angles = yield from sampled("hodograph", place / "angle_deg", request)
    yield from _sides("hodograph", place, there)
    sense = 1 if (request / "machine" / "rotation").text(default="ccw") == "ccw" else -1
    units = [exp(1j * sense * radians(item)) for item in angles]
    for side, fitted in _states(there):
        responses = machine.before if fitted is None else machine.responses(fitted.first)
        for name, unit in NAMES.items():
            co, counter = (item.middle() for item in responses[name])
            off = total(_wide(item) for item in responses[name])
            least = float(off) + SAMPLE * (abs(co) + abs(counter))
            vectors = [co * item + counter * item.conjugate() for item in units]
            for axis, values in (("x", [item.real for item in vectors]), ("y", [item.imag for item in vectors])):
                samples = list(place / side / f"{name}_{axis}_{unit}")
                yield "hodograph", place / side, ONE if len(samples) == len(values) else -ONE, ONE
                yield from (within("hodograph", item, is_, is_, least) for item, is_ in zip(samples, values))


def _wide(number: Number) -> Number:
    """Half of the sides of the rectangle in which a number lies, together."""
    wide = number.high - number.low + number.y[1] - number.y[0]
    return Number(wide, wide) * real(0.5)


def _foundation(request: Place, machine: Machine, place: Place, there: Optional[Fitted]) -> Claims:
    """By order: amplitudes and phases."""
    numbers = [entry.whole() for entry in request / "foundation_orders"] or [1, 2, 3, 4, 5, 6]
    entries = list(place)
    yield "foundation", place, ONE if len(entries) == len(numbers) else -ONE, ONE
    sides = dict(_states(there))
    if list(request / "fitted"):
        sides["as_built"] = as_built(request, machine)
    loads = {side: by_order(request, machine, fitted) for side, fitted in sides.items()}
    sizes = {side: _size(machine, fitted) for side, fitted in sides.items()}
    rows = [row for throw in list(request / "machine" / "throws")[:1] for row in list(throw / "rows")[:1]]
    for order, entry in zip(sorted(numbers), entries):
        yield same("foundation", entry / "order", order)
        centre = entry / "dead_centre_deg"
        degrees = centre.double()
        way = _direction(request, rows[0]) if rows else ONE
        off = abs(direction(degrees) + BLUR - way)
        yield "foundation", centre, real(FIGURE) - off if 0 <= degrees < 360 else -ONE, ONE
        for side in ("before", "after", "as_built"):
            if side not in sides:
                yield same("foundation", entry / side, None)
                continue
            responses = loads[side].get(order, dict.fromkeys(NAMES, (ZERO, ZERO)))
            if responses is None:
                yield "foundation", entry / side, None, ONE
                continue
            yield from _load(request, entry / side, responses, order, way, sizes[side])


def _direction(request: Place, row: Place) -> Number:
    """Where the crank of the first row points along its axis, as a unit vector of the shaft angle."""
    throw = next(iter(request / "machine" / "throws"))
    unit = direction((row / "axis_deg").double()) * direction((throw / "crank_angle_deg").double()).conjugate()
    return unit if (request / "machine" / "rotation").text(default="ccw") == "ccw" else unit.conjugate()


def _load(
    request: Place, place: Place, responses: Responses, order: int, way: Number, sizes: Dict[str, Number]
) -> Claims:
    sense = (request / "machine" / "rotation").text(default="ccw") == "ccw"
    vectors = []
    for name in NAMES:
        co, mirrored = responses[name][0], responses[name][1].conjugate()
        vectors += [(name, co + mirrored), (name, -J * (co - mirrored))]
    for field, (name, vector) in zip(_ALONG, vectors):
        amplitude, phase = place / field / f"amplitude_{NAMES[name]}", place / field / "phase_deg"
        least = sizes[name] * real(NEGLIGIBLE)
        if amplitude.double() == 0:
            # nothing but rounding is left
            yield "foundation", amplitude, least * real(1 + FIGURE) - abs(vector), sizes[name]
            yield same("foundation", phase, 0)
            continue
        yield near("foundation", amplitude, abs(vector))
        yield "foundation", amplitude, abs(vector) - least * real(1 - FIGURE), sizes[name]
        degrees = phase.double()
        right = (vector.conjugate() if sense else vector) * power(way, order).conjugate()
        off = abs(right - (direction(degrees) + BLUR) * abs(vector)) - abs(vector) * real(FIGURE)
        yield "foundation", phase, -off if 0 <= degrees < 360 else -ONE, abs(vector)


def _size(machine: Machine, there: Optional[Fitted]) -> Dict[str, Number]:
    """What is added up to force and couple: the sizes of all, with arms of no less than the plane's distance from 0."""
    masses = [(mass.product * real(1 if mass.counter is ZERO else 2), mass.position) for mass in machine.masses]
    masses += [] if there is None else [(mass.product, mass.position) for mass in there.turning]
    far = abs(machine.plane)
    arms = (abs(size) * (abs(position - machine.plane) + far) for size, position in masses)
    return {
        "force": total(abs(size) for size, _ in masses) * machine.square,
        "moment": total(arms) * machine.square,
    }


def as_built(request: Place, machine: Machine) -> Fitted:
    """What the request says is on the machine, and what is fixed."""
    entries = {(entry / "web").text(): entry for entry in request / "fitted"}
    turning = []
    for web in machine.webs:
        entry = entries.get(web.name)
        mass, angle = ((entry / "mass_kg").number(), (entry / "angle_deg").double()) if entry else (ZERO, 0.0)
        if web.fixed is not None:
            mass, angle = web.fixed
        radius = web.radius if web.plate is None else _radius(web.plate, float(mass))
        turning.append(Mass(mass * radius, direction(angle), ZERO, web.position))
    on_shafts = []
    for shaft in request / "machine" / "balance_shafts":
        ratio = (shaft / "speed_ratio").whole()
        for place in shaft / "webs":
            web, entry = web_of(place, machine.fastest * real(ratio * ratio)), entries.get((place / "name").text())
            product = (entry / "mass_kg").number() * web.radius if entry else ZERO
            unit = direction((entry / "angle_deg").double()) if entry else ONE
            ways = (unit, ZERO) if ratio > 0 else (ZERO, unit)
            on_shafts.append((abs(ratio), Mass(product, *ways, web.position)))
    return Fitted(turning, on_shafts, ZERO, ZERO)


def _radius(of: Plate, mass: float) -> Number:
    """Of a mass that is cut from a plate, in doubles."""
    opening = of.up_to(mass)
    there = of.mass(opening)
    radius = of.unbalance(opening) / there if there > 0 else of.lever(0.0)
    return Number(real(radius * (1 - FIGURE)).low, real(radius * (1 + FIGURE)).high)
