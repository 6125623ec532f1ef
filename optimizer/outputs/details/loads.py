"""Loads of parts in detail: piston rods and pins, covers, frame, guides, weights."""

from typing import Any

import numpy as np

from optimizer.effects.machine_kinds import reciprocating
from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.layout import stacked
from optimizer.numerics.arrays import Complex, Real
from optimizer.outputs.details.rows import by_part, of_chambers
from optimizer.outputs.loads import (
    at_dead_centres,
    gas_range,
    guides_of,
    lifted_shares,
    on_bearings,
    on_covers,
    whole_weight,
)
from optimizer.outputs.output import Columns
from optimizer.outputs.peaks import of_row_magnitudes, of_rows
from schemas.machine.reciprocating import ReciprocatingMachine


def _pins(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    rod, stopped = (of_row_magnitudes(scene, reading).lower for reading in ("rod", "rod_at_rest"))
    return {
        **by_part(scene, "crosshead_pin_N", "rows", rod),
        **by_part(scene, "stop_over_the_turn_N", "rows", stopped),
    }


def _rods(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    gas = np.maximum(*np.abs(gas_range(scene)))
    inertia, piston = (of_row_magnitudes(scene, reading).lower for reading in ("inertia", "piston"))
    return {
        **by_part(scene, "largest_gas_N", "rows", gas),
        **by_part(scene, "largest_inertia_N", "rows", inertia),
        **by_part(scene, "largest_piston_force_N", "rows", piston),
        **by_part(scene, "piston_rod_N", "rows", np.maximum(np.maximum(gas, inertia), piston)),
    }


def _frames(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    smallest, largest = gas_range(scene)
    low, high = 0.0 - largest, 0.0 - smallest
    return {
        **by_part(scene, "frame_tension_N", "rows", np.maximum(high, 0.0)),
        **by_part(scene, "frame_compression_N", "rows", np.minimum(low, 0.0) + 0.0),
        **by_part(scene, "frame_mean_N", "rows", 0.5 * (low + high) + 0.0),
        **by_part(scene, "frame_amplitude_N", "rows", 0.5 * (high - low)),
    }


def _covers(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    loads = on_covers(scene)
    if loads is None:
        return {}
    shape = (*scene.layout.reciprocating.mass.shape, loads[0].shape[-1])
    low, high = (of_chambers(scene, np.broadcast_to(ends, shape)) for ends in loads)
    return {
        **by_part(scene, "cover_largest_N", "chambers", high),
        **by_part(scene, "cover_smallest_N", "chambers", low),
    }


def _guides(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    machine = _machine(scene)
    if machine.gravity_deg is None:
        return {}
    ends, guides = of_rows(scene, "side"), guides_of(scene, machine)
    load = guides.load(np.stack([ends.high.lower, -ends.low.lower], axis=-1))
    return {
        **by_part(scene, "guide_weight_N", "rows", guides.weight),
        **by_part(scene, "guide_largest_N", "rows", np.max(load, axis=-1)),
        **by_part(scene, "guide_smallest_N", "rows", np.min(load, axis=-1)),
    }


def _lifts(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    machine = _machine(scene)
    if machine.gravity_deg is None:
        return {}
    return by_part(scene, "guide_lifted_share", "rows", lifted_shares(scene, guides_of(scene, machine)))


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


LOADS = (
    Columns(
        _pins,
        needs=("whole_turn",),
        keys=("crosshead_pin_N.", "stop_over_the_turn_N."),
        readings=("rod", "rod_at_rest"),
    ),
    Columns(
        _rods,
        needs=("gas", "whole_turn"),
        keys=("largest_gas_N.", "largest_inertia_N.", "largest_piston_force_N.", "piston_rod_N."),
        readings=("inertia", "piston"),
    ),
    Columns(
        _frames,
        needs=("gas", "whole_turn"),
        keys=("frame_tension_N.", "frame_compression_N.", "frame_mean_N.", "frame_amplitude_N."),
    ),
    Columns(_covers, needs=("gas",), keys=("cover_largest_N.", "cover_smallest_N.")),
    Columns(
        _guides,
        needs=("whole_turn",),
        keys=("guide_weight_N.", "guide_largest_N.", "guide_smallest_N."),
        readings=("side",),
    ),
    Columns(_lifts, needs=("whole_turn",), keys=("guide_lifted_share.",), readings=("side",)),
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
