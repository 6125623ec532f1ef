"""Loads as a designer of parts asks for them, from the forces over the turn."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from optimizer.effects.machine_kinds import reciprocating
from optimizer.effects.results import GasCycle
from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.angles import direction
from optimizer.mechanics.gas import forces_at_dead_centres
from optimizer.mechanics.layout import stacked, web_radii
from optimizer.mechanics.plates import Plates
from optimizer.mechanics.row_series import Reading
from optimizer.mechanics.shaft import INFLUENCES, bearing_places
from optimizer.mechanics.shapes import plates
from optimizer.mechanics.weight import GRAVITY, along_axis, on_guide
from optimizer.numerics.arrays import Complex, Real, side_by_side, spread
from optimizer.outputs.output import Columns, Output
from optimizer.outputs.peaks import (
    Search,
    largest_of_rows,
    of_torque,
    row_magnitudes,
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
    forces, masses = scene.results["piston_force"], scene.layout.reciprocating.mass.tolist()
    piston, rod, stopped = ([least for least, _ in row_magnitudes(scene, reading)] for reading in _READINGS)
    at_centres = at_dead_centres(scene).tolist()
    gas, inertia = (list(zip(*_ends(force), strict=True)) for force in (forces.gas, forces.inertia))
    guides, frames, covers = _guides(scene, machine), [_frame(*ends) for ends in gas], _covers(scene)
    rows = [row for throw in machine.throws for row in throw.rows]
    for k, place in enumerate(scene.row_labels):
        three = {"gas": _magnitude(*gas[k]), "inertia": _magnitude(*inertia[k]), "running": piston[k]}
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
            "guide": None if guides is None else guides[k],
        }


def at_dead_centres(scene: Prepared) -> Real:
    """Gas force of every row at its own outer and inner dead centre, (..., rows, 2) N."""
    cycle: GasCycle | None = scene.results.get("gas")
    masses = scene.layout.reciprocating.mass
    if cycle is None:
        return np.zeros((*masses.shape, 2))
    return spread(forces_at_dead_centres(cycle.chambers, cycle.traces), (*masses.shape, 2))


def _covers(scene: Prepared) -> list[list[dict[str, Any]]]:
    """Loads on the covers of every row, of as many chambers as any row has; none without gas."""
    cycle: GasCycle | None = scene.results.get("gas")
    if cycle is None:
        return []
    # pressure times area
    smallest, largest = _ends(cycle.forces.pressure)
    return [
        [
            {
                "cylinder": chamber // 2,
                "side": "crank" if chamber % 2 else "head",
                "largest_N": high * area,
                "smallest_N": low * area,
            }
            for chamber, (low, high, area) in enumerate(zip(*of_row, strict=True))
        ]
        for of_row in zip(smallest, largest, cycle.forces.area.tolist(), strict=True)
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


def _magnitude(smallest: float, largest: float) -> float:
    return max(abs(smallest), abs(largest))


def _ends(values: Real) -> tuple[list[Any], list[Any]]:
    """Smallest and largest over the last axis."""
    return np.minimum.reduce(values, axis=-1).tolist(), np.maximum.reduce(values, axis=-1).tolist()


def on_guides(scene: Prepared, machine: ReciprocatingMachine) -> tuple[Real, Real]:
    """Forces (..., rows, T) N on the guides, and weights (..., rows) N, of a machine that says where gravity pulls."""
    layout = scene.layout
    down = np.asarray(direction(np.asarray(machine.gravity_deg)))
    masses = layout.reciprocating.mass
    return on_guide(scene.results["rod_forces"].side, layout.reciprocating.axis, layout.sense, masses, down)


def _guides(scene: Prepared, machine: ReciprocatingMachine) -> list[dict[str, Any]] | None:
    if machine.gravity_deg is None:
        return None
    force, weight = on_guides(scene, machine)
    share = np.mean(force < 0.0, axis=-1)
    return [
        {
            "weight_N": pull,
            "largest_N": largest,
            "smallest_N": smallest,
            "lifts": None if pull == 0.0 else lifted > 0.0,
            "lifted_share": 0.0 if pull == 0.0 else lifted,
        }
        for pull, smallest, largest, lifted in zip(weight.tolist(), *_ends(force), share.tolist(), strict=True)
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
    ("gas", "piston_force", "rod_forces", "torque", "torque_integrals", "whole_turn"),
    _figure,
    Columns(
        _columns,
        needs=("friction", "torque_integrals", "whole_turn"),
        readings=("rod", "rod_at_rest", "tangential"),
    ),
    _searches,
)
