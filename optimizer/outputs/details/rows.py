"""Rows in detail: gas, forces on pistons and rods in every load case, torque."""

import numpy as np

from optimizer.formulation.simulation import Prepared
from optimizer.numerics.arrays import Complex, Real
from optimizer.outputs.dynamics import CASES
from optimizer.outputs.output import Columns
from optimizer.outputs.peaks import of_rows
from schemas.sweep.details import Of, keys_of, parts_of


def by_part(scene: Prepared, name: str, of: Of, values: Real) -> dict[str, Real]:
    """Columns of values (n, parts) by the names of the parts."""
    return {f"{name}.{part.label}": values[..., k] for k, part in enumerate(parts_of(scene.machine, of))}


def _gas(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    cycle = scene.results["gas"]
    suction, discharge = (np.rad2deg(angles) for angles in cycle.opens)
    return {
        **by_part(scene, "indicated_power_W", "rows", cycle.power),
        **by_part(scene, "indicated_work_J", "chambers", of_chambers(scene, scene.results["indicated_work"])),
        **by_part(scene, "suction_opens_deg", "chambers", of_chambers(scene, suction)),
        **by_part(scene, "discharge_opens_deg", "chambers", of_chambers(scene, discharge)),
    }


def of_chambers(scene: Prepared, values: Real) -> Real:
    """Those of the chambers that there are (n, chambers), of values (n, rows, C)."""
    rows = [part.path for part in parts_of(scene.machine, "rows")]
    there = [rows.index(part.path[:4]) for part in parts_of(scene.machine, "chambers")]
    # of each row the first so many
    number = [there[:k].count(row) for k, row in enumerate(there)]
    return values[..., there, number]


def _pistons(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    peaks = of_rows(scene, "piston")
    return {
        **by_part(scene, "piston_tension_N", "rows", peaks.high.lower),
        **by_part(scene, "piston_compression_N", "rows", -peaks.low.lower),
    }


def _guides(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    return by_part(scene, "peak_side_N", "rows", of_rows(scene, "side").magnitude.lower)


def _rods(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    """Load cases of the rods, and the largest force of all of them."""
    cases = [of_rows(scene, reading) for reading in CASES.values()]
    tension = np.maximum(np.stack([peaks.high.lower for peaks in cases], axis=-1), 0.0)
    compression = np.maximum(np.stack([peaks.low.lower for peaks in cases], axis=-1), 0.0)
    flat = (len(tension), -1)
    return {
        **by_part(scene, "rod_load_N", "rows", np.max(np.maximum(tension, compression), axis=-1)),
        **by_part(scene, "rod_tension_N", "cases", tension.reshape(flat)),
        **by_part(scene, "rod_compression_N", "cases", 0.0 - compression.reshape(flat)),
    }


def _torque(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    friction = scene.results.get("friction")
    return {
        **by_part(scene, "mean_torque_Nm", "rows", scene.results["torque_integrals"].row_mean),
        "rotating_friction_Nm": np.zeros(scene.layout.omega.shape) if friction is None else friction.torque,
    }


def _flywheel(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    return {
        "fluctuation_energy_J": scene.results["torque_integrals"].fluctuation,
        "inertia_MD2_kg_m2": 4.0 * scene.results["flywheel"].inertia,
    }


GAS = (Columns(_gas, needs=("gas", "indicated_work"), keys=keys_of("gas")),)
PISTONS = (Columns(_pistons, needs=("whole_turn",), keys=keys_of("piston_force"), readings=("piston",)),)
RODS = (
    Columns(_guides, needs=("whole_turn",), keys=("peak_side_N.",), readings=("side",)),
    Columns(
        _rods,
        needs=("whole_turn",),
        keys=("rod_load_N.", "rod_tension_N.", "rod_compression_N."),
        readings=tuple(CASES.values()),
    ),
)
TORQUE = (Columns(_torque, needs=("friction", "torque_integrals"), keys=keys_of("torque")),)
FLYWHEEL = (Columns(_flywheel, needs=("torque_integrals", "flywheel"), keys=keys_of("flywheel")),)
