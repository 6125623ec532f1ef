"""Loads of the main bearings, bending of the shaft, and peaks of all orders, as an answer prints them."""

from __future__ import annotations

from math import cos, radians, sin
from typing import List, Optional, Sequence

from verify_answer import Fitted
from verify_circle import Circle, smallest
from verify_claims import Claim, Claims, same
from verify_curves import Turn
from verify_harmonics import Peak
from verify_loads import Loads, Periodic
from verify_machine import NAMES, Machine
from verify_numbers import ONE, NotCovered, Place, real

SAMPLE = 1e-11  # of all harmonics together: by which doubles are off
PEAK = 2e-9  # of a peak: by which a printed one may be below the largest value, and its bracket wide
FLOOR = 2e-7  # of a radius likewise


def within(claim: str, place: Place, low: float, high: float, off: float) -> Claim:
    """A figure in doubles is between two others."""
    if not place:
        return claim, place, -ONE, ONE
    value = place.double()
    return claim, place, real(min(value - low, high - value) + off), real(max(abs(low), abs(high)) + off)


def peak_of(curve: Periodic, place: Place, enough: float = 0.0) -> Peak:
    """The largest length of a curve, where it can be enclosed."""
    peak = curve.peak(enough)
    if peak is None:
        raise NotCovered(place)
    return peak


def largest(claim: str, place: Place, curve: Periodic, unit: str, size: float = 0.0) -> Claims:
    """A peak and its bracket; returns the enclosure of the peak.

    ``size``: of what is added up to the curve, where that may cancel.
    """
    peak = peak_of(curve, place)
    off = SAMPLE * max(curve.size, size)
    yield from magnitude(claim, place, "peak", unit, peak, off)
    return peak


def magnitude(claim: str, place: Place, name: str, unit: str, peak: Peak, off: float) -> Claims:
    """A largest length with its bracket."""
    value, bracket = place / f"{name}_{unit}", place / f"{name}_bracket_{unit}"
    yield within(claim, value, peak.low * (1 - PEAK), peak.high, off)
    ends = list(bracket)
    yield rising(claim, bracket)
    if len(ends) == 2:
        yield within(claim, ends[0], peak.low * (1 - PEAK), peak.high, off)
        yield within(claim, ends[1], peak.low, peak.high * (1 + PEAK), off)


def rising(claim: str, bracket: Place) -> Claim:
    """A bracket has a lower end and then an upper one."""
    ends = [end.double() for end in bracket]
    return claim, bracket, ONE if len(ends) == 2 and ends[0] <= ends[1] else -ONE, ONE


def where(claim: str, place: Place, loads: Loads, curve: Periodic, peak: Peak) -> Claim:
    """The shaft angle of a peak: the curve has it there."""
    degrees = place.double()
    there = curve.length(shaft_angle(loads, degrees)) if 0 <= degrees <= 360 * loads.turns else 0.0
    return within(claim, place, degrees, degrees, there - peak.low * (1 - PEAK) + SAMPLE * curve.size)


def shaft_angle(loads: Loads, degrees: float) -> float:
    """The angle of the harmonics [rad] at a shaft angle."""
    return radians(degrees) if loads.turn.sense is ONE else -radians(degrees)


def sampled(claim: str, angles: Place, request: Place, turns: int = 1) -> Claims:
    """Shaft angles of the samples, over one revolution or as many as gas takes; returns them [degrees]."""
    step = (request / "angles" / "step_deg").double(1.0, least=1e-3)
    places = list(angles)
    count = round(360 / step)
    yield claim, angles, ONE if len(places) in (count, count * turns) else -ONE, ONE
    for n, place in enumerate(places):
        yield within(claim, place, n * step, n * step, 1e-9 * (n + 1) * step)
    return [place.double() for place in places]


def curves(request: Place, machine: Machine, answer: Place, fitted: Optional[Fitted]) -> Claims:
    """All that an answer holds of them."""
    turn = answer / "residual" / "turn"
    if turn:
        frame = Loads(request / "machine", machine, Turn(request, machine, loads=False))
        yield from all_orders(frame, answer, fitted)
    if answer / "main_bearings":
        shaft = Loads(request / "machine", machine, Turn(request, machine, loads=True))
        yield from main_bearings(request, shaft, answer, fitted)
    if answer / "roll":
        rows = Loads(request / "machine", machine, Turn(request, machine, loads=True))
        yield from roll(request, rows, answer / "roll", fitted)


def roll(request: Place, loads: Loads, figures: Place, fitted: Optional[Fitted]) -> Claims:
    """The moment about the crankshaft, which balance shafts alone change."""
    angles = yield from sampled("roll", figures / "angle_deg", request, loads.turns)
    sides = [("before", loads.curve("roll"))]
    if fitted is None:
        yield "roll", figures / "after", -ONE if figures / "after" else ONE, ONE
    else:
        sides.append(("after", loads.with_weights("roll", [], fitted.on_shafts)))
    for side, curve in sides:
        samples = list(figures / side / "moment_Nm")
        yield "roll", figures / side, ONE if len(samples) == len(angles) else -ONE, ONE
        off = SAMPLE * (curve.size + loads.curve("roll").size)
        for degrees, sample in zip(angles, samples):
            value = curve.at(shaft_angle(loads, degrees)).real
            yield within("roll", sample, value, value, off)
        peak = yield from largest("roll", figures / side, curve, "Nm")
        yield where("roll", figures / side / "peak_angle_deg", loads, curve, peak)


def main_bearings(request: Place, loads: Loads, answer: Place, fitted: Optional[Fitted]) -> Claims:
    """Without and with counterweights."""
    figures = answer / "main_bearings"
    seats = {(item / "name").text(): item for item in request / "machine" / "bearings"}
    angles = yield from sampled("main_bearings", figures / "angle_deg", request, loads.turns)
    shaft = (request / "fidelity" / "shaft").text(default="simple_spans")
    yield same("main_bearings", figures / "shaft", shaft)
    rows = list(figures / "bearings")
    names = [(item / "name").text() for item in rows]
    if names != [*seats]:
        yield "main_bearings", figures / "bearings", -ONE, ONE
        return
    for name, item in zip(names, rows):
        own = seats[name]
        yield "main_bearings", item / "name", ONE, ONE
        yield within(
            "main_bearings", item / "position_m", (own / "position_m").double(), (own / "position_m").double(), 0.0
        )
        before = loads.curve(f"bearing:{name}")
        circle = circle_of(before, item)
        size = max(before.size, loads.size_of("bearing"))
        yield from _load(loads, own, before, item / "before", circle, angles, size)
        if fitted is None:
            yield "main_bearings", item / "after", -ONE if item / "after" else ONE, ONE
            continue
        by = loads.vector(f"bearing:{name}", fitted.turning)
        circle_after = circle._replace(middle=circle.middle + by)
        # what weights add may cancel what is there
        size += loads.of_weights("force", fitted.turning, [])
        yield from _load(loads, own, before.plus(by), item / "after", circle_after, angles, size)
    yield from _bending(loads, figures / "bending", fitted)


def circle_of(curve: Periodic, place: Place, enough: float = 0.0) -> Circle:
    """The smallest circle around a curve, where it can be enclosed."""
    circle = smallest(curve, enough)
    if circle is None:
        raise NotCovered(place)
    return circle


def _load(
    loads: Loads, own: Place, curve: Periodic, place: Place, circle: Circle, angles: Sequence[float], size: float
) -> Claims:
    """Of one bearing. ``size``: of all that adds up to its load [N]."""
    off = SAMPLE * size
    x, y = list(place / "force_x_N"), list(place / "force_y_N")
    yield "main_bearings", place, ONE if len(x) == len(y) == len(angles) else -ONE, ONE
    for degrees, component, other in zip(angles, x, y):
        angle = shaft_angle(loads, degrees)
        value = curve.at(angle) * complex(cos(angle), sin(angle))
        yield within("main_bearings", component, value.real, value.real, off)
        yield within("main_bearings", other, value.imag, value.imag, off)
    peak = yield from largest("main_bearings", place, curve, "N", size)
    yield where("main_bearings", place / "peak_angle_deg", loads, curve, peak)
    if own / "diameter_m" and own / "length_m":
        area = (own / "diameter_m").double() * (own / "length_m").double()
        low, high = peak.low * (1 - PEAK) / area, peak.high / area
        yield within("main_bearings", place / "specific_load_Pa", low, high, off / area)
    else:
        yield same("main_bearings", place / "specific_load_Pa", None)
    yield within("main_bearings", place / "rms_N", curve.rms, curve.rms, 10 * off)
    yield within("main_bearings", place / "floor_N", circle.low * (1 - FLOOR), circle.high, off)
    # around the middle that is printed the curve is no longer than that; of two points that hold a circle, it is theirs
    middle = complex((place / "circle_x_N").double(), (place / "circle_y_N").double())
    around = peak_of(curve.plus(-middle), place, circle.low)
    for name in ("circle_x_N", "circle_y_N"):
        yield within(
            "main_bearings",
            place / name,
            (place / name).double(),
            (place / name).double(),
            circle.high * (1 + 2 * FLOOR) - around.high + off,
        )


def _bending(loads: Loads, place: Place, fitted: Optional[Fitted]) -> Claims:
    """Of all planes."""
    planes = loads.planes
    places = list(place / "position_m")
    if [item.double() for item in places] != planes:
        yield "main_bearings", place / "position_m", -ONE, ONE
        return
    yield from (("main_bearings", item, ONE, ONE) for item in places)
    curves = [loads.curve(f"bending:{plane!r}") for plane in planes]
    after = [] if fitted is None else [loads.with_weights(f"bending:{plane!r}", fitted.turning) for plane in planes]
    yield same("main_bearings", Place(len(list(place / "after_Nm")), *(place / "after_Nm").path), len(after))
    # what weights add may cancel what is there
    weight_size = 0.0 if fitted is None else loads.of_weights("force", fitted.turning, []) * (planes[-1] - planes[0])
    off = SAMPLE * (loads.size_of("bending") + weight_size)
    peaks: List[Peak] = []
    for of_planes, samples in ((curves, place / "before_Nm"), (after, place / "after_Nm")):
        peaks = [peak_of(curve, samples) for curve in of_planes] or peaks
        yield "main_bearings", samples, ONE if len(list(samples)) == len(of_planes) else -ONE, ONE
        for peak, item in zip(peaks, samples):
            yield within("main_bearings", item, peak.low * (1 - PEAK), peak.high, off)
    low, high = max(item.low for item in peaks), max(item.high for item in peaks)
    yield within("main_bearings", place / "peak_Nm", low * (1 - PEAK), high, off)
    ends = list(place / "peak_bracket_Nm")
    yield rising("main_bearings", place / "peak_bracket_Nm")
    if len(ends) == 2:
        yield within("main_bearings", ends[0], low * (1 - PEAK), high, off)
        yield within("main_bearings", ends[1], low, high * (1 + PEAK), off)
    worst = dict(zip(planes, peaks)).get((place / "peak_position_m").double())
    yield (
        "main_bearings",
        place / "peak_position_m",
        real(-1.0 if worst is None else worst.high * (1 + PEAK) + off - low),
        ONE,
    )
    low = high = 0.0
    for curve in curves:
        circle = circle_of(curve, place, high)
        low, high = max(low, circle.low), max(high, circle.high)
    yield within("main_bearings", place / "floor_Nm", low * (1 - FLOOR), high, off)


def columns(request: Place, machine: Machine, place: Place, fitted: Fitted) -> Claims:
    """Largest loads and moments in the shaft, nothing off, of which a row of a sweep has no curves."""
    turn = Turn(request, machine, loads=True)
    loads = Loads(request / "machine", machine, turn)
    weight_size = loads.of_weights("force", fitted.turning, [])

    def claim(name: str, responses: Sequence[str], off: float) -> Claims:
        if place / name:
            peaks = [peak_of(loads.with_weights(response, fitted.turning), place / name) for response in responses]
            low, high = max(peak.low for peak in peaks), max(peak.high for peak in peaks)
            yield within("main_bearings", place / name, low * (1 - PEAK), high * (1 + PEAK), off)

    every, off = [f"bearing:{name}" for name in turn.bearings], SAMPLE * (loads.size_of("bearing") + weight_size)
    for name, response in zip(turn.bearings, every):
        yield from claim(f"bearing_peak_N.{name}", [response], off)
    yield from claim("peak_bearing_load_N", every, off)
    off = SAMPLE * (loads.size_of("bending") + weight_size * (loads.planes[-1] - loads.planes[0]))
    yield from claim("peak_bending_Nm", [f"bending:{plane!r}" for plane in loads.planes], off)


def all_orders(loads: Loads, answer: Place, fitted: Optional[Fitted]) -> Claims:
    """Peaks of force and moment on the frame."""
    figures = answer / "residual" / "turn"
    for name, unit in NAMES.items():
        sides, sizes = [("before", loads.curve(name))], {"before": 0.0}
        if fitted is None:
            yield "turn", figures / "after", -ONE if figures / "after" else ONE, ONE
        else:
            sides.append(("after", loads.with_weights(name, fitted.turning, fitted.on_shafts)))
            sizes["after"] = loads.of_weights(name, fitted.turning, fitted.on_shafts)
        for side, curve in sides:
            peak = peak_of(curve, figures)
            # what weights add may be all that there is, and may cancel
            off = SAMPLE * (loads.size_of(name) + peak.high + (sizes[side]))
            yield within("turn", figures / side / f"{name}_peak_{unit}", peak.low * (1 - 2e-8), peak.high, off)
