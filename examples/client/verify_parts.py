"""Loads as a designer of parts asks for them: of piston rods, pins, covers, frames and bearings.

Pressures of a chamber are between those of suction and discharge, or those of its table. All other largest values are
enclosed over the whole revolution.
"""

from __future__ import annotations

from math import pi
from typing import Sequence

from verify_bearings import PEAK, SAMPLE, within
from verify_claims import Claims, same
from verify_curves import Turn
from verify_dynamics import RUBBED, alone, enclosed, output, series
from verify_gas import force
from verify_gravity import guide, turning_mass, weights
from verify_machine import Machine, row_masses
from verify_numbers import ONE, Place
from verify_pistons import Piston, Pistons
from verify_pressed import ALL, Acting
from verify_rods import CASES, RANGE, fluctuation, leaning, of_shaft


def designer_loads(request: Place, machine: Machine, pistons: Pistons, answer: Place) -> Claims:
    """All of them."""
    place, design = answer / "loads", request / "machine"
    table = yield from output("loads", request, pistons, place)
    for row, k, entry in table.rows:
        yield from _row(pistons, row, k, entry)
        yield from guide(design, pistons, k, entry / "guide")
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


def _row(pistons: Pistons, row: Piston, k: int, place: Place) -> Claims:
    off = (SAMPLE * (row.most + row.moving[0]) + RUBBED * row.friction) * leaning(row)
    moving, turning = (mass.middle().real for mass in row_masses(row.place))
    rod = turning - sum(
        (part / "mass_kg").double() for part in row.place / "parts" if (part / "motion").value == "rotating"
    )
    stop = CASES["sudden_stop"]
    gas = {sign: enclosed(alone(pistons, k, "piston", stop), place, sign) for sign in (1, -1)}
    pin, stopped = (enclosed(alone(pistons, k, "rod", acting), place) for acting in (ALL, stop))
    three = {
        "gas": max(gas.values(), key=lambda peak: peak.low),
        "inertia": enclosed(alone(pistons, k, "piston", Acting(gas=False, friction=False)), place),
        "running": enclosed(alone(pistons, k, "piston"), place),
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
        ("largest_piston_force_N", three["running"][:2], off),
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
        yield same("loads", cover / "cylinder", n // 2)
        yield same("loads", cover / "side", "head" if chamber.head else "crank")
        for field, pressure in (("largest_N", max(chamber.pressures)), ("smallest_N", min(chamber.pressures))):
            yield within("loads", cover / field, *[abs(force(chamber, pressure))] * 2, off)
    # the frame holds against what the gas does to the piston
    pull, push = (max(peak.low, 0.0) for peak in (gas[-1], gas[1]))
    wide = off + PEAK * max(abs(peak.low) for peak in gas.values())
    frame = place / "frame"
    for field, value in (
        ("tension_N", pull),
        ("compression_N", -push),
        ("mean_N", (gas[-1].low - gas[1].low) / 2),
        ("amplitude_N", (gas[-1].low + gas[1].low) / 2),
    ):
        yield within("loads", frame / field, value, value, wide)


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
