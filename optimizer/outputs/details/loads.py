"""Loads of parts in detail: piston rods and pins, covers, frame, guides, weights."""

from typing import Any

import numpy as np

from optimizer.effects.machine_kinds import reciprocating
from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.layout import stacked
from optimizer.numerics.arrays import Complex, Real
from optimizer.outputs.details.rows import by_part, of_chambers
from optimizer.outputs.loads import at_dead_centres, on_bearings, on_guides, whole_weight
from optimizer.outputs.output import Columns
from optimizer.outputs.peaks import of_rows
from schemas.machine.reciprocating import ReciprocatingMachine


def _over_the_turn(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    """Peaks of every row, whatever the samples."""
    piston, rod, stopped = (of_rows(scene, reading).magnitude for reading in ("piston", "rod", "rod_at_rest"))
    return {
        **by_part(scene, "largest_piston_force_N", "rows", piston.lower),
        **by_part(scene, "crosshead_pin_N", "rows", rod.lower),
        **by_part(scene, "stop_over_the_turn_N", "rows", stopped.lower),
    }


def _sampled(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    """What a single answer reads off the samples of the turn, off the same ones."""
    forces, piston = scene.results["piston_force"], of_rows(scene, "piston").magnitude.lower
    gas, inertia = (np.max(np.abs(series), axis=-1) for series in (forces.gas, forces.inertia))
    low, high = np.min(-forces.gas, axis=-1), np.max(-forces.gas, axis=-1)
    rows = {
        "largest_gas_N": gas,
        "largest_inertia_N": inertia,
        "piston_rod_N": np.maximum(np.maximum(gas, inertia), piston),
        "frame_tension_N": np.maximum(high, 0.0),
        "frame_compression_N": np.minimum(low, 0.0) + 0.0,
        "frame_mean_N": 0.5 * (low + high) + 0.0,
        "frame_amplitude_N": 0.5 * (high - low),
    }
    results: dict[str, Real] = {}
    for name, values in rows.items():
        results |= by_part(scene, name, "rows", values)
    if "gas" in scene.results:
        outward = np.abs(scene.results["gas"].forces.force)
        results |= by_part(scene, "cover_largest_N", "chambers", of_chambers(scene, np.max(outward, axis=-1)))
        results |= by_part(scene, "cover_smallest_N", "chambers", of_chambers(scene, np.min(outward, axis=-1)))
    return results


def _guides(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    machine = _machine(scene)
    if machine.gravity_deg is None:
        return {}
    force, weight = on_guides(scene, machine)
    lifted = np.where(weight == 0.0, 0.0, np.mean(force < 0.0, axis=-1))
    return {
        **by_part(scene, "guide_weight_N", "rows", weight),
        **by_part(scene, "guide_largest_N", "rows", np.max(force, axis=-1)),
        **by_part(scene, "guide_smallest_N", "rows", np.min(force, axis=-1)),
        **by_part(scene, "guide_lifted_share", "rows", lifted),
    }


def _stops(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    result = at_dead_centres(scene)
    return {
        **by_part(scene, "stop_at_outer_dead_centre_N", "rows", result[..., 0]),
        **by_part(scene, "stop_at_inner_dead_centre_N", "rows", result[..., 1]),
    }


def _weights(scene: Prepared, fitted: Complex) -> dict[str, Real]:
    machine, results = _machine(scene), dict[str, Real]()
    if machine.stationary_mass_kg is not None:
        results["foundation_weight_N"] = whole_weight(scene, machine, fitted)
    if machine.bearings and machine.gravity_deg is not None:
        weights = on_bearings(scene, machine, fitted)
        results |= by_part(scene, "bearing_weight_x_N", "bearings", weights.real)
        results |= by_part(scene, "bearing_weight_y_N", "bearings", weights.imag)
    return results


def _masses(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    throws, leading = _machine(scene).throws, scene.layout.omega.shape
    rows = [row for throw in throws for row in throw.rows]
    rods = [0.0 if row.connecting_rod is None else row.connecting_rod.rotating_kg for row in rows]
    turning = [throw.rotating_mass_kg + sum(row.rotating_kg for row in throw.rows) for throw in throws]

    def columns(values: list[Any]) -> Real:
        return np.broadcast_to(stacked(values), (*leading, len(values)))

    return {
        **by_part(scene, "reciprocating_mass_kg", "rows", scene.layout.reciprocating.mass),
        **by_part(scene, "rod_rotating_mass_kg", "rows", columns(rods)),
        **by_part(scene, "rotating_mass_kg", "rows", columns([row.rotating_kg for row in rows])),
        **by_part(scene, "throw_rotating_mass_kg", "throws", columns(turning)),
    }


def _driver(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    return {"driver_Nm": scene.results["torque_integrals"].mean}


def _machine(scene: Prepared) -> ReciprocatingMachine:
    return reciprocating(scene.machine)


_OF_ROWS = ("largest_gas_N.", "largest_inertia_N.", "piston_rod_N.")
_OF_FRAMES = ("frame_tension_N.", "frame_compression_N.", "frame_mean_N.", "frame_amplitude_N.")
LOADS = (
    Columns(
        _over_the_turn,
        needs=("whole_turn",),
        keys=("largest_piston_force_N.", "crosshead_pin_N.", "stop_over_the_turn_N."),
        readings=("piston", "rod", "rod_at_rest"),
    ),
    Columns(
        _sampled,
        sampled=True,
        needs=("gas", "piston_force", "whole_turn"),
        keys=(*_OF_ROWS, *_OF_FRAMES, "cover_largest_N.", "cover_smallest_N."),
        readings=("piston",),
    ),
    Columns(
        _guides,
        sampled=True,
        needs=("rod_forces",),
        keys=("guide_weight_N.", "guide_largest_N.", "guide_smallest_N.", "guide_lifted_share."),
    ),
    Columns(_stops, needs=("gas",), keys=("stop_at_outer_dead_centre_N.", "stop_at_inner_dead_centre_N.")),
    Columns(
        _weights, needs=("kinematics",), keys=("foundation_weight_N", "bearing_weight_x_N.", "bearing_weight_y_N.")
    ),
    Columns(_driver, needs=("torque_integrals",), keys=("driver_Nm",)),
    Columns(
        _masses,
        needs=("kinematics",),
        keys=("reciprocating_mass_kg.", "rod_rotating_mass_kg.", "rotating_mass_kg.", "throw_rotating_mass_kg."),
    ),
)
