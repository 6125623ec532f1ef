"""What rows do over a revolution, as an answer prints it: their motion, gas, and the forces on their pistons."""

from __future__ import annotations

from math import degrees, inf, radians, sqrt
from typing import Iterable, List, NamedTuple, Optional, Sequence, Tuple

from verify_bearings import PEAK, SAMPLE, rising, sampled, within
from verify_claims import Claim, Claims, same
from verify_gas import TURN, Cycle, force
from verify_harmonics import Peak
from verify_numbers import ONE, NotCovered, Place
from verify_pistons import Instant, Piston, Pistons
from verify_pressed import ALL, Acting, PressureCurve

SLACK_DEG = 1e-9  # degrees by which a crank angle may be off
OPENS = 1e-7  # degrees by which an angle at which a valve opens may be off
RUBBED = 1e-9  # of the friction: by which it may be off
WORK = 1e-9  # of the largest force over the stroke: by which a work may be off


class Output(NamedTuple):
    """Rows of an output with the angles of its samples [rad]."""

    claim: str
    angles: List[float]
    rows: List[Tuple[Piston, int, Place]]


def output(claim: str, request: Place, pistons: Pistons, place: Place) -> Claims:
    """Angles and labels of the rows; returns them."""
    angles = yield from sampled(claim, place / "angle_deg", request, pistons.turns)
    rows = list(place / "rows")
    labels = [(t, i, row) for t, throw in enumerate(request / "machine" / "throws")
              for i, row in enumerate(throw / "rows")]  # fmt: skip
    yield claim, place / "rows", ONE if len(rows) == len(labels) == len(pistons.rows) else -ONE, ONE
    for item, (throw, number, row) in zip(rows, labels):
        yield same(claim, item / "throw", throw)
        yield same(claim, item / "row", number)
        yield same(claim, item / "name", (row / "name").value)
    shaft_angles = [radians(item) for item in angles]
    return Output(claim, shaft_angles, [(item, k, place) for k, (item, place) in enumerate(zip(pistons.rows, rows))])


def series(claim: str, place: Place, values: Sequence[float], off: float) -> Claims:
    """Samples."""
    samples = list(place)
    yield claim, place, ONE if len(samples) == len(values) else -ONE, ONE
    for sample, value in zip(samples, values):
        yield within(claim, sample, value, value, off)


def of_row(pistons: Pistons, angles: Iterable[float], k: int) -> List[Instant]:
    """One row at the angles of the samples."""
    return [pistons.at(k, angle) for angle in angles]


def alone(pistons: Pistons, k: int, reading: str, acting: Acting = ALL) -> PressureCurve:
    """A force of one row."""
    return PressureCurve(pistons, reading, [(k, 1.0)], {}, acting)


def enclosed(curve: PressureCurve, place: Place, sign: int = 0) -> Peak:
    """The largest value of a curve, where it can be enclosed."""
    peak = curve.peak(sign=sign)
    if peak is None:
        raise NotCovered(place)
    return peak


def kinematics(request: Place, pistons: Pistons, place: Place) -> Claims:
    """Motion of every row."""
    motion = yield from output("kinematics", request, pistons, place)
    omega = sqrt(pistons.square)
    for row, k, entry in motion.rows:
        there = of_row(pistons, motion.angles, k)
        # a whole revolution from its own angle, each may be printed as 0 or as 360
        own = list(entry / "crank_angle_deg")
        aside = [(angle.double() - degrees(instant.piston.own) + 180) % 360 - 180 for angle, instant in zip(own, there)]
        yield from series(
            "kinematics", entry / "crank_angle_deg", [a.double() - b for a, b in zip(own, aside)], SLACK_DEG
        )
        yield from (("kinematics", angle, ONE if 0 <= angle.double() <= 360 else -ONE, ONE) for angle in own)
        for name, factor, reads in (
            ("displacement_m", row.radius, lambda instant: instant.piston.travel),
            ("velocity_m_s", row.radius * omega, lambda instant: instant.piston.turning),
            ("acceleration_m_s2", row.radius * omega**2, lambda instant: instant.piston.outward),
        ):
            values = [factor * reads(instant) for instant in there]
            yield from series("kinematics", entry / name, values, 2 * SAMPLE * factor * row.fastest)


def _cylinders(row: Place) -> List[Optional[str]]:
    """Names of the cylinders of a row."""
    return [(cylinder / "name").value for cylinder in ([row / "cylinder"] if row / "cylinder" else row / "cylinders")]


def gas(request: Place, pistons: Pistons, place: Place) -> Claims:
    """Pressures, and what they come to."""
    table = yield from output("gas", request, pistons, place)
    omega = sqrt(pistons.square)
    power = 0.0
    for row, k, entry in table.rows:
        there, places = of_row(pistons, table.angles, k), list(entry / "chambers")
        yield "gas", entry / "chambers", ONE if len(places) == len(row.chambers) else -ONE, ONE
        names = _cylinders(row.place)
        works = [row.work(chamber) for chamber in row.chambers]
        for n, (chamber, item) in enumerate(zip(row.chambers, places)):
            yield same("gas", item / "side", "head" if chamber.head else "crank")
            yield same("gas", item / "cylinder", n // 2)
            yield same("gas", item / "name", names[n // 2])
            pressures = [instant.pressures[n] for instant in there]
            yield from series("gas", item / "pressure_Pa", pressures, SAMPLE * chamber.most)
            size = SAMPLE * chamber.most * chamber.area
            yield from series("gas", item / "force_N", [force(chamber, value) for value in pressures], size)
            opens = chamber.breaks(row.ratio) if isinstance(chamber, Cycle) else (None, None)
            for field, angle in zip(("suction_opens_deg", "discharge_opens_deg"), opens):
                if angle is None:
                    yield same("gas", item / field, None)
                else:
                    yield within("gas", item / field, degrees(angle), degrees(angle), OPENS)
            off = WORK * chamber.most * chamber.area * row.radius
            yield within("gas", item / "indicated_work_J", works[n], works[n], off)
        off = SAMPLE * row.most
        travels = [row.radius * item.piston.travel for item in there]
        yield from series("gas", entry / "displacement_m", travels, 2 * SAMPLE * row.radius)
        yield from series("gas", entry / "force_N", [item.gas for item in there], off)
        put_in, wide = sum(works) * omega / TURN, WORK * row.most * row.radius * omega
        yield within("gas", entry / "indicated_power_W", put_in, put_in, wide)
        power += put_in
    most = sum(row.most * row.radius for row in pistons.rows)
    yield within("gas", place / "indicated_power_W", power, power, WORK * most * omega)


def piston_force(request: Place, pistons: Pistons, place: Place) -> Claims:
    """Gas, inertia and friction on every piston, and what they come to at most either way."""
    claim = "piston_force"
    table = yield from output(claim, request, pistons, place)
    for row, k, entry in table.rows:
        there, off = of_row(pistons, table.angles, k), SAMPLE * (row.most + row.moving[0] + row.friction)
        yield from series(claim, entry / "gas_N", [state.gas for state in there], off)
        yield from series(claim, entry / "inertia_N", [state.inertia for state in there], off)
        # of the efficiency by the work of the gas, which a quadrature tells
        yield from series(claim, entry / "friction_N", [state.friction for state in there], off + RUBBED * row.friction)
        yield from series(claim, entry / "total_N", [ALL.of(state) for state in there], off + RUBBED * row.friction)
        curve = alone(pistons, k, "piston")
        off += RUBBED * row.friction
        pull, push = enclosed(curve, entry, 1), enclosed(curve, entry, -1)
        yield from signed(claim, entry, "peak_tension", pull, off)
        yield from signed(claim, entry, "peak_compression", push, off, -1)


def signed(claim: str, place: Place, name: str, peak: Peak, off: float, sign: int = 1, least: float = -inf) -> Claims:
    """A largest value times a sign, with its bracket; none below ``least``."""
    low, high = max(peak.low, least), max(peak.high, least)
    wide = PEAK * abs(low) + off
    yield _between(claim, place / f"{name}_N", low - wide, high + off, sign)
    ends = list(place / f"{name}_bracket_N")
    yield rising(claim, place / f"{name}_bracket_N")
    if len(ends) == 2:
        first, last = ends[::sign]
        yield _between(claim, first, low - wide, high + off, sign)
        yield _between(claim, last, low - off, high + wide, sign)


def _between(claim: str, place: Place, low: float, high: float, sign: int) -> Claim:
    return within(claim, place, *sorted((sign * low, sign * high)), 0.0)
