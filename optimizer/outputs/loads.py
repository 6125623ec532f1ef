"""Loads as a designer of parts asks for them, from the forces over the turn."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from optimizer.effects.machine_kinds import reciprocating
from optimizer.effects.results import GasCycle
from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.angles import direction
from optimizer.mechanics.gas import forces_at_dead_centres, pressure_range
from optimizer.mechanics.layout import stacked, web_radii
from optimizer.mechanics.plates import Plates
from optimizer.mechanics.reading import Reading
from optimizer.mechanics.shaft import INFLUENCES, bearing_places
from optimizer.mechanics.shapes import plates
from optimizer.mechanics.weight import GRAVITY, Guides, along_axis, guides
from optimizer.mechanics.whole_turn import WholeTurn
from optimizer.numerics.arrays import Complex, Real, side_by_side, spread
from optimizer.outputs.output import Columns, Output
from optimizer.outputs.peaks import (
    Search,
    largest_of_rows,
    magnitudes_search,
    of_rows,
    of_torque,
    row_largest,
    row_magnitudes,
    row_peaks,
    rows_search,
    torque_peak,
    torque_search,
)
from schemas.answer.loads import Loads
from schemas.answer.outputs import labels
from schemas.base.variation import with_fields
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.throws import row_cylinders

#: forces whose largest magnitudes are loads of every row
_READINGS: tuple[Reading, ...] = ("piston", "rod", "rod_at_rest")


def _figure(scene: Prepared, fitted: Complex | None) -> Loads:
    machine = reciprocating(scene.machine)
    result, integrals = scene.results["torque"], scene.results["torque_integrals"]
    beyond = result.total - integrals.mean
    inertia = _inertia(scene, machine)
    return Loads.of_figures(
        {
            "angle_deg": scene.angles,
            "rows": tuple(_rows(scene, machine)),
            "throws": tuple(
                {"throw": t, "rotating_mass_kg": throw.rotating_mass_kg + sum(row.rotating_kg for row in throw.rows)}
                for t, throw in enumerate(machine.throws)
            ),
            "driver_Nm": float(integrals.mean),
            "shared_base_Nm": beyond,
            "own_base_peak_Nm": torque_peak(scene, result.rotating_friction).lower[0],
            "shared_base_peak_Nm": torque_peak(scene, result.rotating_friction - integrals.mean).lower[0],
            # J eps is what the constant torque of the driver leaves over
            "angular_acceleration_rad_s2": None if inertia is None else -beyond / inertia,
            "bearing_weights": tuple(_weights(scene, machine, fitted)),
            "foundation_weight_N": (
                None if machine.stationary_mass_kg is None else float(whole_weight(scene, machine, fitted))
            ),
            "gravity_deg": machine.gravity_deg,
        }
    )


def _inertia(scene: Prepared, machine: ReciprocatingMachine) -> float | None:
    """Polar moment of inertia of all that turns, kg m^2: of the request, or large enough for the irregularity."""
    wheel = machine.flywheel
    if wheel is None:
        return None
    if wheel.inertia_kg_m2 is not None:
        return wheel.inertia_kg_m2
    # delta = dE / (J omega^2)
    allowed = wheel.irregularity or np.nan
    return float(scene.results["torque_integrals"].fluctuation / (allowed * scene.omega_squared))


def _rows(scene: Prepared, machine: ReciprocatingMachine) -> Iterator[dict[str, Any]]:
    masses, gas = (
        scene.layout.reciprocating.mass.tolist(),
        list(zip(*(ends.tolist() for ends in gas_range(scene)), strict=True)),
    )
    inertia = row_largest(scene, "inertia")
    piston, rod, stopped = ([least for least, _ in row_magnitudes(scene, reading)] for reading in _READINGS)
    at_centres = at_dead_centres(scene).tolist()
    of_guides, frames, covers = _guides(scene, machine), [_frame(*ends) for ends in gas], _covers(scene)
    rows = [row for throw in machine.throws for row in throw.rows]
    for k, place in enumerate(scene.row_labels):
        three = {"gas": max(map(abs, gas[k])), "inertia": inertia[k], "running": piston[k]}
        link = rows[k].connecting_rod
        worst = max(three, key=lambda name: three[name])
        yield {
            **place,
            "reciprocating_mass_kg": masses[k],
            "rod_rotating_mass_kg": 0.0 if link is None else float(link.rotating_kg),
            "rotating_mass_kg": float(rows[k].rotating_kg),
            "largest_gas_N": three["gas"],
            "largest_inertia_N": three["inertia"],
            "largest_piston_force_N": three["running"],
            "piston_rod_N": three[worst],
            "piston_rod_governed_by": worst,
            "crosshead_pin_N": rod[k],
            "stop_at_outer_dead_centre_N": at_centres[k][0],
            "stop_at_inner_dead_centre_N": at_centres[k][1],
            "stop_over_the_turn_N": stopped[k],
            "covers": tuple(covers[k][: 2 * sum(1 for _ in row_cylinders(rows[k]))]) if covers else (),
            "frame": frames[k],
            "guide": None if of_guides is None else of_guides[k],
        }


def gas_range(scene: Prepared) -> tuple[Real, Real]:
    """Smallest and largest gas forces of the rows over the cycle, (..., rows) N.

    From one dead centre to the other the pressures of one side rise or stay, those of the other fall or stay. So a row
    without a table of pressures has both of them there.
    """
    cycle: GasCycle | None = scene.results.get("gas")
    if cycle is None or not cycle.traces:
        ends = at_dead_centres(scene)
        return np.minimum.reduce(ends, axis=-1), np.maximum.reduce(ends, axis=-1)
    peaks = of_rows(scene, "gas")
    return 0.0 - peaks.low.lower, peaks.high.lower


def at_dead_centres(scene: Prepared) -> Real:
    """Gas force of every row at its own outer and inner dead centre, (..., rows, 2) N."""
    cycle: GasCycle | None = scene.results.get("gas")
    masses = scene.layout.reciprocating.mass
    if cycle is None:
        return np.zeros((*masses.shape, 2))
    return spread(forces_at_dead_centres(cycle.chambers, cycle.traces), (*masses.shape, 2))


def on_covers(scene: Prepared) -> tuple[Real, Real] | None:
    """Smallest and largest loads on the ends of the cylinders of every row, pressure times area, (..., rows, C) N, of
    as many chambers as any row has; None without gas."""
    cycle: GasCycle | None = scene.results.get("gas")
    if cycle is None:
        return None
    area = cycle.chambers.area
    low, high = pressure_range(cycle.chambers, cycle.traces)
    return low * area, high * area


def _covers(scene: Prepared) -> list[list[dict[str, Any]]]:
    loads = on_covers(scene)
    if loads is None:
        return []
    return [
        [
            {
                "cylinder": chamber // 2,
                "side": "crank" if chamber % 2 else "head",
                "largest_N": high,
                "smallest_N": low,
            }
            for chamber, (low, high) in enumerate(zip(*of_row, strict=True))
        ]
        for of_row in zip(*(ends.tolist() for ends in loads), strict=True)
    ]


def _frame(smallest: float, largest: float) -> dict[str, float]:
    """The cylinders of a row pull at the frame against the gas force [N] on its pistons."""
    low, high = -largest, -smallest
    return {
        "tension_N": max(high, 0.0),
        "compression_N": min(low, 0.0) + 0.0,
        "mean_N": 0.5 * (low + high) + 0.0,
        "amplitude_N": 0.5 * (high - low),
    }


def guides_of(scene: Prepared, machine: ReciprocatingMachine) -> Guides:
    """Guides of the rows, of a machine that says where gravity pulls."""
    rows = scene.layout.reciprocating
    return guides(rows.mass, rows.axis, scene.layout.sense, np.asarray(direction(np.asarray(machine.gravity_deg))))


def lifted_shares(scene: Prepared, of_rows: Guides) -> Real:
    """Shares of the cycle over which crossheads are off their lower guides, (..., rows)."""
    whole: WholeTurn = scene.results["whole_turn"]
    return of_rows.lifted_share(whole.of_every_row("side"))


def _guides(scene: Prepared, machine: ReciprocatingMachine) -> list[dict[str, Any]] | None:
    if machine.gravity_deg is None:
        return None
    high, low = row_peaks(scene, "side")
    of_rows = guides_of(scene, machine)
    loads, shares = of_rows.load(np.array([high.lower, np.negative(low.lower)]).T), lifted_shares(scene, of_rows)
    return [
        {
            "weight_N": pull,
            "largest_N": max(ends),
            "smallest_N": min(ends),
            "lifts": None if pull == 0.0 else min(ends) < 0.0,
            "lifted_share": share,
        }
        for pull, ends, share in zip(of_rows.weight.tolist(), loads.tolist(), shares.tolist(), strict=True)
    ]


def _turning(scene: Prepared, machine: ReciprocatingMachine, fitted: Complex | None) -> tuple[Real, Real]:
    """Planes [m] and masses [kg] (..., P) of all that turns with the shaft, with counterweights (..., webs) kg m."""
    parts = [(throw.position_m, throw.rotating_mass_kg) for throw in machine.throws]
    parts += [(throw.position_m + row.offset_m, row.rotating_kg) for throw in machine.throws for row in throw.rows]
    parts += [(part.position_m, part.mass_kg) for part in machine.shaft_parts]
    places, masses = (stacked(column) for column in zip(*parts, strict=True))
    if fitted is None:
        return places, masses
    of_webs = _masses(web_radii(machine), plates(machine), fitted)
    return side_by_side(places, scene.layout.webs.position), side_by_side(masses, of_webs)


def _masses(radius: Real, cut: Plates | None, fitted: Complex) -> Real:
    """Masses (..., webs) kg of counterweights (..., webs) kg m; 0 where a design has none."""
    size = np.abs(fitted)
    size = np.where(np.isnan(size), 0.0, size)
    masses = size / radius
    if cut is not None:
        # of what a plate is opened for, many designs have no radius
        of_plates = masses[..., cut.webs]
        masses[..., cut.webs] = np.where(np.isnan(of_plates), cut.mass_of(size[..., cut.webs]), of_plates)
    return masses


def on_bearings(scene: Prepared, machine: ReciprocatingMachine, fitted: Complex | None) -> Complex:
    """Weights on the main bearings, (..., B) N, with counterweights (..., webs) kg m."""
    places, masses = _turning(scene, machine, fitted)
    # without a direction they have one all the same, whichever it is
    down = direction(np.asarray(0.0 if machine.gravity_deg is None else machine.gravity_deg))
    load = masses * GRAVITY * np.asarray(down)[..., None]
    if machine.gravity_deg is not None:
        rows = scene.layout.reciprocating
        places, load = side_by_side(places, rows.position), side_by_side(load, along_axis(rows.mass, rows.axis, down))
    influence = INFLUENCES[scene.request.fidelity.shaft](bearing_places(machine), places)
    result: Complex = (influence @ load[..., None])[..., 0]
    return result


def _weights(scene: Prepared, machine: ReciprocatingMachine, fitted: Complex | None) -> Iterator[dict[str, Any]]:
    if not machine.bearings:
        return
    for bearing, weight in zip(machine.bearings, on_bearings(scene, machine, fitted).tolist(), strict=True):
        yield {
            "name": bearing.name,
            "weight_N": abs(weight),
            "x_N": None if machine.gravity_deg is None else weight.real,
            "y_N": None if machine.gravity_deg is None else weight.imag,
        }


def whole_weight(scene: Prepared, machine: ReciprocatingMachine, fitted: Complex | None) -> Real:
    """Weight of a machine that says what stands still on its foundation, (...) N."""
    _, turning = _turning(scene, machine, fitted)
    shafts: Real | float = 0.0
    if scene.layout.balance is not None and scene.shafts is not None:
        webs = with_fields(machine, {("webs",): machine.every_web[len(machine.webs) :]})
        shafts = np.sum(_masses(web_radii(webs), plates(webs), scene.shafts), axis=-1)
    moving = np.sum(turning, axis=-1) + np.sum(scene.layout.reciprocating.mass, axis=-1) + shafts
    return np.asarray((machine.stationary_mass_kg + moving) * GRAVITY)


def _searches(scene: Prepared, _fitted: Complex | None) -> Iterator[Search]:
    yield from (rows_search(scene, reading) for reading in _READINGS)
    yield magnitudes_search(scene, "inertia")
    if "gas" in scene.results and scene.results["gas"].traces:
        yield rows_search(scene, "gas")
    if reciprocating(scene.machine).gravity_deg is not None:
        yield rows_search(scene, "side")
    friction, mean = scene.results["torque"].rotating_friction, scene.results["torque_integrals"].mean
    yield from (torque_search(scene, constant) for constant in (friction, friction - mean))


def _columns(scene: Prepared, fitted: Complex) -> dict[str, Real]:
    machine = reciprocating(scene.machine)
    friction, mean = scene.results.get("friction"), scene.results["torque_integrals"].mean
    constant = 0.0 if friction is None else friction.torque
    results = {
        "peak_crosshead_pin_N": largest_of_rows(scene, "rod").lower,
        "peak_sudden_stop_N": largest_of_rows(scene, "rod_at_rest").lower,
        "own_base_peak_Nm": of_torque(scene, constant),
        "shared_base_peak_Nm": of_torque(scene, constant - mean),
    }
    if machine.bearings:
        weights = np.abs(on_bearings(scene, machine, fitted))
        names = labels([bearing.name for bearing in machine.bearings])
        results |= {f"bearing_weight_N.{name}": weights[..., k] for k, name in enumerate(names)}
    return results


LOADS = Output(
    "loads",
    "loads on piston rod, pin, covers, frame, guides, base and bearings",
    ("gas", "torque", "torque_integrals", "whole_turn"),
    _figure,
    Columns(
        _columns,
        needs=("friction", "torque_integrals", "whole_turn"),
        readings=("rod", "rod_at_rest", "tangential"),
    ),
    _searches,
)
