"""Weights: of crossheads on their guides, of all that turns on the bearings, and of the machine on its foundation.

Across its axis g a row lies on the guide that is below it; along it, on the crank. The side force of a rod points along
j e^{jg} times the sense of rotation, and lifts the crosshead where it is larger than the weight and opposed.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Iterator, Tuple

from verify_bearings import PEAK, SAMPLE, within
from verify_claims import Claims, same
from verify_curves import Turn
from verify_dynamics import RUBBED, alone, enclosed
from verify_machine import row_masses
from verify_numbers import ONE, NotCovered, Place, direction
from verify_pistons import Pistons
from verify_pressed import PressureCurve
from verify_rods import leaning

CLAIM = "loads"
GRAVITY = 9.80665  # m/s^2
WEIGHED = 1e-11  # of all weights: by which one may be off
#: of the weight: what is rounding of an upright row, which has no lower guide; and how sure that is
UPRIGHT, UNSURE = 1e-12, 0.5


def turning_mass(row: Place) -> float:
    """What turns with the crank pin of a row [kg]."""
    return row_masses(row)[1].middle().real


def guide(design: Place, pistons: Pistons, k: int, place: Place) -> Claims:
    """What a crosshead does to its guide; nothing is said of it where gravity has no direction."""
    if not design / "gravity_deg":
        yield same(CLAIM, place, None)
        return
    yield CLAIM, place, ONE if place else -ONE, ONE
    row = pistons.rows[k]
    down, axis = (_way(design / "gravity_deg")), _way(row.place / "axis_deg")
    mass = row_masses(row.place)[0].middle().real
    part = ((1j * axis).conjugate() * down).real
    if UPRIGHT * UNSURE < abs(part) < UPRIGHT / UNSURE:
        raise NotCovered(row.place / "axis_deg")
    weight = mass * GRAVITY * abs(part) if abs(part) > UPRIGHT else 0.0
    curve, towards = alone(pistons, k, "side"), pistons.sense
    # of the side force times a sign
    largest = {sign: enclosed(curve, place, sign) for sign in (1, -1)}
    if part < 0 or (not weight and _is_mirrored(place, largest[towards].low, largest[-towards].low)):
        towards = -towards
    off = (SAMPLE * (row.most + row.moving[0]) + RUBBED * row.friction) * leaning(row) + WEIGHED * mass * GRAVITY
    yield within(CLAIM, place / "weight_N", weight, weight, WEIGHED * mass * GRAVITY)
    for field, sign in (("largest_N", 1), ("smallest_N", -1)):
        peak = largest[sign * towards]
        ends = sorted((sign * (peak.low - PEAK * abs(peak.low)) + weight, sign * peak.high + weight))
        yield within(CLAIM, place / field, ends[0], ends[1], off)
    share = place / "lifted_share"
    if not weight:
        yield same(CLAIM, place / "lifts", None)
        yield same(CLAIM, share, 0)
        return
    lifted = PressureCurve(pistons, "side", [(k, complex(towards))], {}).share_below(-weight, off)
    if lifted is None:
        raise NotCovered(share)
    yield within(CLAIM, share, *lifted, SAMPLE)
    yield same(CLAIM, place / "lifts", (place / "smallest_N").double() < 0)


def _way(degrees: Place) -> complex:
    return direction(degrees.double()).middle()


def _is_mirrored(place: Place, largest: float, other: float) -> bool:
    """Whether an upright row counts the other side as the lower one, which rounding decides."""
    value = (place / "largest_N").double()
    return abs(value - other) < abs(value - largest)


def weights(request: Place, answer: Place, turn: Turn) -> Claims:
    """Of all that turns, and of rows along their axes where gravity has a direction: on bearings and foundation."""
    design, place = request / "machine", answer / "loads"
    entries, gravity = list(place / "bearing_weights"), design / "gravity_deg"
    down = _way(gravity) if gravity else 1 + 0j
    masses, rows = list(_masses(design, answer)), list(_rows(design))
    pulls = [(where, mass * GRAVITY * down) for where, mass in masses]
    if gravity:
        pulls += [(where, mass * GRAVITY * (axis.conjugate() * down).real * axis) for where, mass, axis in rows]
    names = [(entry / "name").text() for entry in design / "bearings"]
    yield CLAIM, place / "bearing_weights", ONE if len(entries) == len(names) else -ONE, ONE
    for name, entry in zip(names, entries):
        yield same(CLAIM, entry / "name", name)
        if turn.spans is None:
            yield CLAIM, entry / "weight_N", None, ONE
            continue
        shares = [float(turn.spans.shares(Fraction(where))[turn.bearings[name]]) for where, _ in pulls]
        value = sum(share * pull for share, (_, pull) in zip(shares, pulls))
        off = WEIGHED * sum(abs(share) * abs(pull) for share, (_, pull) in zip(shares, pulls))
        yield within(CLAIM, entry / "weight_N", abs(value), abs(value), off)
        for field, part in (("x_N", value.real), ("y_N", value.imag)):
            yield within(CLAIM, entry / field, part, part, off) if gravity else same(CLAIM, entry / field, None)
    yield from _foundation(design, answer, sum(mass for _, mass in masses) + sum(mass for _, mass, _ in rows))


def _foundation(design: Place, answer: Place, moving: float) -> Claims:
    """All together with what stands still, where that is given. ``moving``: without balance shafts [kg]."""
    place, still = answer / "loads" / "foundation_weight_N", design / "stationary_mass_kg"
    if not still:
        yield same(CLAIM, place, None)
        return
    fitted = [weight for shaft in answer / "balance_shafts" for weight in shaft / "counterweights"]
    shafts = sum((weight / "mass_kg").double() for weight in fitted)
    whole = (still.double() + moving + shafts) * GRAVITY
    yield within(CLAIM, place, whole, whole, WEIGHED * whole)


def _masses(design: Place, answer: Place) -> Iterator[Tuple[float, float]]:
    """All that turns with the shaft: where along it [m], and its mass."""
    for throw in design / "throws":
        yield (throw / "position_m").double(), (throw / "rotating_mass_kg").double(0.0)
        for row in throw / "rows":
            where = (throw / "position_m").double() + (row / "offset_m").double(0.0)
            yield where, turning_mass(row)
    for part in [*(design / "shaft_parts"), *(answer / "counterweights")]:
        yield (part / "position_m").double(), (part / "mass_kg").double()


def _rows(design: Place) -> Iterator[Tuple[float, float, complex]]:
    """What moves along the rows: where along the shaft [m], its mass, and its axis."""
    for throw in design / "throws":
        for row in throw / "rows":
            where = (throw / "position_m").double() + (row / "offset_m").double(0.0)
            yield where, row_masses(row)[0].middle().real, _way(row / "axis_deg")
