"""Loads as a designer of parts asks for them: of piston rods, pins, covers, frames and bearings.

The largest of samples are taken over the angles of the output, those that an output brackets over all angles.
"""

from __future__ import annotations

from math import pi
from typing import Sequence

from verify_bearings import PEAK, SAMPLE, within
from verify_claims import Claims, same
from verify_curves import Turn
from verify_dynamics import RUBBED, alone, enclosed, of_row, output, series
from verify_gas import force
from verify_gravity import guide, turning_mass, weights
from verify_harmonics import Peak
from verify_machine import Machine, row_masses
from verify_numbers import ONE, Place
from verify_pistons import Instant, Piston, Pistons
from verify_rods import CASES, RANGE, fluctuation, leaning, of_shaft


def designer_loads(request: Place, machine: Machine, pistons: Pistons, answer: Place) -> Claims:
    """All of them."""
    place, design = answer / "loads", request / "machine"
    table = yield from output("loads", request, pistons, place)
    for row, k, entry in table.rows:
        there = of_row(pistons, table.angles, k)
        yield from _row(pistons, row, k, entry, there)
        yield from guide(design, row, entry / "guide", there)
    throws = list(design / "throws")
    yield same("loads", Place(len(list(place / "throws")), *(place / "throws").path), len(throws))
    for n, (throw, entry) in enumerate(zip(throws, place / "throws")):
        turning = (throw / "rotating_mass_kg").double(0.0) + sum(turning_mass(row) for row in throw / "rows")
        yield same("loads", entry / "throw", n)
        yield within("loads", entry / "rotating_mass_kg", turning, turning, SAMPLE * turning)
    yield from _base(design, pistons, place, table.angles)
    gravity = design / "gravity_deg"
    yield same("loads", place / "gravity_deg", gravity.double() if gravity else None)
    yield from weights(request, answer, Turn(request, machine, loads=False))


def _row(pistons: Pistons, row: Piston, k: int, place: Place, there: Sequence[Instant]) -> Claims:
    off = (SAMPLE * (row.most + row.moving[0]) + RUBBED * row.friction) * leaning(row)
    moving, turning = (mass.middle().real for mass in row_masses(row.place))
    rod = turning - sum(
        (part / "mass_kg").double() for part in row.place / "parts" if (part / "motion").value == "rotating"
    )
    gas = [instant.gas for instant in there]
    piston = enclosed(alone(pistons, k, "piston"), place)
    pin, stopped = (enclosed(alone(pistons, k, "rod", CASES[name]), place) for name in ("running", "sudden_stop"))
    three = {
        "gas": Peak(*[max(map(abs, gas), default=0.0)] * 2, 0.0),
        "inertia": Peak(*[max((abs(instant.inertia) for instant in there), default=0.0)] * 2, 0.0),
        "running": piston,
    }
    most = max(three.values(), key=lambda peak: peak.low)
    governing = (place / "piston_rod_governed_by").text(*three)
    near = three[governing].high + off >= most.low
    yield "loads", place / "piston_rod_governed_by", ONE if near else -ONE, ONE
    dead = [row.at(angle - row.ahead, angle - row.ahead).gas for angle in (0.0, pi)]
    for name, (low, high), wide in (
        ("reciprocating_mass_kg", (moving, moving), SAMPLE * moving),
        ("rod_rotating_mass_kg", (rod, rod), SAMPLE * (rod + turning)),
        ("rotating_mass_kg", (turning, turning), SAMPLE * turning),
        ("largest_gas_N", three["gas"][:2], off),
        ("largest_inertia_N", three["inertia"][:2], off),
        ("largest_piston_force_N", piston[:2], off),
        ("piston_rod_N", most[:2], off),
        ("crosshead_pin_N", pin[:2], off),
        ("stop_at_outer_dead_centre_N", (dead[0], dead[0]), off),
        ("stop_at_inner_dead_centre_N", (dead[1], dead[1]), off),
        ("stop_over_the_turn_N", stopped[:2], off),
    ):
        yield within("loads", place / name, low - PEAK * abs(low), high, wide)
    covers = list(place / "covers")
    yield "loads", place / "covers", ONE if len(covers) == len(row.chambers) else -ONE, ONE
    for n, (chamber, cover) in enumerate(zip(row.chambers, covers)):
        outward = [abs(force(chamber, instant.pressures[n])) for instant in there]
        yield same("loads", cover / "cylinder", n // 2)
        yield same("loads", cover / "side", "head" if chamber.head else "crank")
        for field, value in (("largest_N", max(outward)), ("smallest_N", min(outward))):
            yield within("loads", cover / field, value, value, off)
    low, high = -max(gas, default=0.0), -min(gas, default=0.0)
    for field, value in (
        ("tension_N", max(high, 0.0)),
        ("compression_N", min(low, 0.0)),
        ("mean_N", (low + high) / 2),
        ("amplitude_N", (high - low) / 2),
    ):
        yield within("loads", place / "frame" / field, value, value, off)


def _base(design: Place, pistons: Pistons, place: Place, angles: Sequence[float]) -> Claims:
    """What the torque of rows and shaft does to one base of machine and driver, to that of the machine alone, and
    to the speed."""
    every = of_shaft(pistons)
    whole, off = every.plus(complex(pistons.rubbing)), RUBBED * (every.size + abs(pistons.rubbing))
    mean = whole.mean.real
    beyond = [whole.value(angle).real - mean for angle in angles]
    yield within("loads", place / "driver_Nm", mean, mean, off)
    yield from series("loads", place / "shared_base_Nm", beyond, off)
    for field, curve in (("own_base_peak_Nm", whole), ("shared_base_peak_Nm", whole.plus(complex(-mean)))):
        peak = enclosed(curve, place / field)
        yield within("loads", place / field, peak.low * (1 - PEAK), peak.high, off)
    wheel = design / "flywheel"
    if not wheel:
        yield same("loads", place / "angular_acceleration_rad_s2", None)
        return
    inertia, share = (wheel / "inertia_kg_m2").double(0.0), 0.0
    if not wheel / "inertia_kg_m2":
        energy = fluctuation(pistons)
        inertia = energy / pistons.square / (wheel / "irregularity").double()
        share = RANGE * every.size / energy
    wide = off / inertia + share * max(map(abs, beyond), default=0.0) / inertia
    yield from series("loads", place / "angular_acceleration_rad_s2", [-torque / inertia for torque in beyond], wide)
