"""What the pins of a scroll carry, as an answer prints it: loads over the revolution, peaks, and dead points."""

from __future__ import annotations

from math import degrees
from typing import Any, Dict, List, NamedTuple, Optional, Sequence

from verify_bearings import PEAK, rising, sampled, within
from verify_claims import Claim, Claims, same
from verify_contact import CERTIFIED, contact
from verify_harmonics import Peak
from verify_numbers import ONE, NotCovered, Place, Unreadable, real
from verify_oldham import comparison
from verify_pin_balance import energy, equilibrium, mechanism
from verify_pin_peaks import peak
from verify_pin_play import CLOSE, Play
from verify_pins import LINE, Pins, Turn, causes

CLAIM = "pin_loads"
#: of a torque: by which doubles are off
EXACT = 1e-12
#: entries of a torque times pins, beyond which peaks take too long
MANY = 50_000
#: degrees of a direction, of pins that are not all but where the scroll turns
SLACK_DEG = 1e-9
FIELDS = {
    "pin_count", "pin_circle_radius_m", "pins", "rotation_torque_Nm", "tangential_gas_force_N", "orbit_radius_m",
    "drive_bearing", "comparison", "angles",
}  # fmt: skip
_OF_SCROLL = ("rotation_torque_Nm", "tangential_gas_force_N", "orbit_radius_m", "drive_bearing")


def pin_loads(request: Place, answer: Place) -> Claims:
    """The answer to a question about pins alone."""
    for name in request.value:
        if name not in FIELDS:
            raise NotCovered(request / name)
    yield from _turn(request, request, answer)


def of_scroll(request: Place, answer: Place) -> Claims:
    """The output of a scroll with crank pins."""
    design, place = request / "machine", answer / "pin_loads"
    if not place:
        return
    guide = design / "anti_rotation"
    if (guide / "type").value != "crank_pins":
        # there are none
        yield CLAIM, place, -ONE, ONE
        return
    pattern: Dict[str, Any] = {name: (design / name).value for name in _OF_SCROLL}
    pattern["pin_count"] = (guide / "count").value
    pattern["pin_circle_radius_m"] = (guide / "pin_circle_radius_m").value
    yield from _turn(request, Place(pattern, "request", "machine"), place)


def _turn(request: Place, pattern: Place, place: Place) -> Claims:
    """All of it. ``pattern``: the pins and what acts on them."""
    pins, torques = Pins(pattern), causes(pattern)
    angles = yield from sampled(CLAIM, place / "angle_deg", request)
    # where they have to be, not where they are said to be
    angles = [360.0 / len(angles) * n for n in range(len(angles))]
    turn = Turn(pins, torques["rotation"], angles)
    for name, field in (("rotation", "rotation_torque_Nm"), ("resistance", "orbiting_resistance_torque_Nm")):
        if name in torques:
            values = [torques[name].at(angle) for angle in angles]
            yield from _samples(place / field, values, [EXACT * torques[name].most] * len(values))
        else:
            yield same(CLAIM, place / field, None)
    loads = yield from _carried(turn, place)
    yield from _dead(pins, place / "dead_points_deg")
    half = 4 * turn.torque.most / sum(pins.radii)
    yield within(CLAIM, place / "half_turn_mechanism_peak_N", half, half, EXACT * half)
    yield from equilibrium(CLAIM, turn, place, loads)
    yield from mechanism(CLAIM, pins, place / "mechanism")
    yield from energy(CLAIM, pins, turn.torque, place / "energy")
    yield from _presence(pins.loose, place / "contact")
    if pins.loose and place / "contact":
        yield from contact(CLAIM, turn, place, loads)
    yield from _presence(bool(pattern / "comparison"), place / "comparison")
    if pattern / "comparison" and place / "comparison":
        yield from comparison(CLAIM, pattern, turn, place / "comparison")


def _presence(due: bool, place: Place) -> Claims:
    """A part is there, or it is not."""
    yield CLAIM, place, ONE if bool(place) == due else -ONE, ONE


def _samples(place: Place, values: Sequence[float], offs: Sequence[float]) -> Claims:
    samples = list(place)
    yield CLAIM, place, ONE if len(samples) == len(values) else -ONE, ONE
    for sample, value, off in zip(samples, values, offs):
        yield within(CLAIM, sample, value, value, off)


def _carried(turn: Turn, place: Place) -> Claims:
    """What each pin and the drive's bearing carry; returns the loads that are printed, 0 at dead points."""
    pins, entries = turn.pins, list(place / "pins")
    if len(entries) != pins.count:
        raise Unreadable((*place.path, "pins"), f"must hold {pins.count} pins")
    loads, peaks, brackets, play = [], [], [], _play(turn, place)
    for k, entry in enumerate(entries):
        yield same(CLAIM, entry / "index", k + 1)
        yield within(CLAIM, entry / "phase_deg", pins.phases[k], pins.phases[k], EXACT * 360)
        loads.append((yield from _load(turn, entry, k, play)))
        peaks.append((entry / "peak_N").value)
        brackets.append([end.double() for end in entry / "peak_bracket_N"])
        yield from _halves(turn, entry, k)
        if not pins.loose:
            yield same(CLAIM, entry / "carries_load", None)
    yield same(CLAIM, place / "peak_N", None if turn.is_unbounded else max(peaks))
    yield from _largest(place / "peak_bracket_N", brackets)
    yield from _presence(pins.drive > 0, place / "drive_bearing")
    if pins.drive and place / "drive_bearing":
        loads.append((yield from _load(turn, place / "drive_bearing", pins.count, play)))
    return loads


class _Peaks(NamedTuple):
    """Of pins with clearance: their loads, peaks, and by how much loads may be off [N]."""

    play: Play
    peaks: List[Peak]
    off: float
    largest: float
    has_warning: bool


def _play(turn: Turn, place: Place) -> Optional[_Peaks]:
    """None where there is no clearance, or where loads jump at dead points."""
    if not turn.pins.loose or turn.pins.dead or len(turn.torque.angles) * turn.pins.count > MANY:
        return None
    play = Play(turn.pins, turn.torque)
    peaks = play.peaks()
    largest, error = max(peak.low for peak in peaks), (place / "contact" / "load_error_bound_N").double(0.0)
    codes = [(warning / "code").value for warning in place / "warnings"]
    return _Peaks(
        play,
        peaks,
        max(PEAK * largest, error) + turn.pins.noise,
        largest,
        "peaks_not_certified" in codes,
    )


def _load(turn: Turn, entry: Place, k: int, play: Optional[_Peaks]) -> Claims:
    """Samples and the peak of one pin, or of the bearing; returns the samples."""
    pins, torque, samples, loads = turn.pins, turn.torque, list(entry / "load_N"), []
    yield CLAIM, entry / "load_N", ONE if len(samples) == len(turn.angles) else -ONE, ONE
    for sample, angle in zip(samples, turn.angles):
        stuck = turn.is_stuck(angle)
        if stuck:
            yield same(CLAIM, sample, None)
        elif not pins.loose:
            value, off = pins.load(k, torque.at(angle), angle, torque.most)
            yield within(CLAIM, sample, value, value, off)
        loads.append(0.0 if stuck else sample.double())
    loads = [*loads, *[0.0] * len(turn.angles)][: len(turn.angles)]
    if turn.is_unbounded:
        for name in ("peak_N", "peak_bracket_N", "peak_angle_deg"):
            yield same(CLAIM, entry / name, None)
        return loads
    yield from _presence(not pins.dead or pins.formula, entry / "peak_bracket_N")
    largest: Optional[Peak] = None
    if play is not None:
        yield from _with_play(entry, k, play)
        return loads
    if not (pins.loose or (pins.dead and not pins.formula) or len(torque.angles) * pins.count > MANY):
        largest = peak(pins, k, torque)
    if largest is None:
        yield from _unclear(entry, max(map(abs, loads), default=0.0))
    else:
        yield from _peak(turn, entry, k, largest)
    return loads


def _with_play(entry: Place, k: int, play: _Peaks) -> Claims:
    """The largest load of a pin with clearance, its bracket, and where it is."""
    low, high, _ = play.peaks[k]
    size, bracket, place = entry / "peak_N", entry / "peak_bracket_N", entry / "peak_angle_deg"
    # of what is enclosed no closer nothing is told but what a value contradicts
    is_close, is_low = high - low <= 2 * CLOSE * play.largest, size.double() < low - play.off
    # one that is not certified is the largest that a search has seen
    if (is_close and not is_low) or (is_low and not play.has_warning):
        yield within(CLAIM, size, low, high, play.off)
    else:
        yield CLAIM, size, None, ONE
    angle = place.double()
    there = abs(play.play.loads(angle)[k]) if 0 <= angle < 360 else -1.0
    yield _no_less(place, there, size.double() - play.off)
    if not bracket:
        return
    yield rising(CLAIM, bracket)
    ends = list(bracket)
    if len(ends) != 2:
        return
    upper = ends[1].double()
    yield within(CLAIM, ends[0], size.double(), size.double(), 0.0)
    if upper < low - play.off or (is_close and upper <= high + play.off):
        yield CLAIM, ends[1], real(upper - low + play.off), real(low + play.off)
    else:
        # true, and wider than it could be: the answer says so where it is wider than what is certified
        has_notice = play.has_warning or upper - size.double() <= CERTIFIED * play.largest
        yield CLAIM, ends[1], None if has_notice else -ONE, ONE


def _largest(place: Place, brackets: List[List[float]]) -> Claims:
    """The bracket of the largest load of any pin."""
    ends = [max(of_pins) for of_pins in zip(*brackets)]
    if not ends:
        yield same(CLAIM, place, None)
        return
    yield rising(CLAIM, place)
    for end, value in zip(place, ends):
        yield within(CLAIM, end, value, value, 0.0)


def _bracket(entry: Place, low: float, high: Optional[float], off: float) -> Claims:
    """Ends around the largest load, which is between two figures or, where nothing encloses it, above the first."""
    place, ends = entry / "peak_bracket_N", list(entry / "peak_bracket_N")
    if not place:
        return
    yield rising(CLAIM, place)
    if len(ends) != 2:
        return
    lower, upper, size = *(end.double() for end in ends), (entry / "peak_N").double()
    yield within(CLAIM, ends[0], size, size, 0.0)
    if high is None:
        yield CLAIM, ends[1], -ONE if upper < low else None, ONE
    else:
        yield CLAIM, ends[0], real(high - lower + off), real(high + off)
        yield within(CLAIM, ends[1], low, high * (1 + PEAK), off)


def _unclear(entry: Place, least: float) -> Claims:
    """Between the samples these loads are not enclosed."""
    place, angle = entry / "peak_N", (entry / "peak_angle_deg").double()
    below = place.double() < least * (1 - PEAK)
    yield CLAIM, place, -ONE if below else None, ONE
    yield CLAIM, entry / "peak_angle_deg", None if 0 <= angle < 360 else -ONE, ONE
    yield from _bracket(entry, least, None, 0.0)


def _peak(turn: Turn, entry: Place, k: int, largest: Peak) -> Claims:
    """The largest load, and where it is."""
    pins, place, angle = turn.pins, entry / "peak_angle_deg", (entry / "peak_angle_deg").double()
    off = pins.load(k, turn.torque.at(largest.angle), largest.angle)[1]
    yield within(CLAIM, entry / "peak_N", largest.low * (1 - PEAK), largest.high, off)
    yield from _bracket(entry, largest.low * (1 - PEAK), largest.high, off)
    there = abs(pins.load(k, turn.torque.at(angle), angle)[0]) if 0 <= angle < 360 else -1.0
    yield _no_less(place, there, largest.low * (1 - PEAK) - off)


def _no_less(place: Place, value: float, least: float) -> Claim:
    return CLAIM, place, real(value - least), real(abs(value) + abs(least))


def _halves(turn: Turn, entry: Place, k: int) -> Claims:
    """Where compression and tension begin and end: half a revolution each where the torque keeps its sign."""
    pins, sign = turn.pins, turn.torque.sign
    fields = ("compression_from_deg", "compression_to_deg", "tension_from_deg", "tension_to_deg")
    start = degrees(pins.shapes[k].phase) + (0 if sign > 0 else 180)
    for field, angle in zip(fields, (start, start + 180, start + 180, start)):
        if pins.loose or not sign:
            yield same(CLAIM, entry / field, None)
            continue
        value = (entry / field).double()
        reach = pins.shapes[k].factor / pins.shapes[k].most
        off = abs((value - angle + 180) % 360 - 180) * reach
        yield CLAIM, entry / field, real(SLACK_DEG - off) if 0 <= value < 360 else -ONE, real(360.0)


def _dead(pins: Pins, place: Place) -> Claims:
    points = [point.double() for point in place]
    yield CLAIM, place, ONE if len(points) == len(pins.dead) else -ONE, ONE
    opposite = all(0 <= point < 360 for point in points) and (
        not points or abs(points[-1] - points[0] - 180) < SLACK_DEG
    )
    for point, value, dead in zip(place, points, pins.dead):
        # pins that are all but on a line have one of some width
        off = abs((value - dead + 90) % 180 - 90)
        yield CLAIM, point, real(SLACK_DEG + degrees(LINE) * LINE - off) if opposite else -ONE, real(360.0)
