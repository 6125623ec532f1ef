"""Everything that the published tables of the compressor hold, by the mechanics, under the names of their columns."""

import numpy as np

from optimizer.mechanics.friction import reciprocating_friction, share_of_losses
from optimizer.mechanics.gas import gas_forces
from optimizer.mechanics.kinematics import Motion, motion
from optimizer.mechanics.rod import rod_forces
from optimizer.numerics.arrays import Real
from tests.reference import compressor

ANGLE = np.deg2rad(np.arange(0.0, 361.0, 10.0))

# kN: losses turning with the shaft, 0.3 of them with pi = 3.14; and the figure that the last table is printed with
ROTATING = 0.3 * 1.1913e3 * (1.0 / 0.94 - 1.0) * 60.0 / (3.14 * 0.28 * 500.0)
ROUNDED = 3.10
# kN, as printed; the first table of gas totals cuts digits off, and sums add roundings up
_ROUNDING = {"x_mm": 0.0051, "x_crank_mm": 0.0051, "c_series": 0.0051, "a_series": 0.0051, "factor": 0.00051}
_CUT_OFF = {"II_crank_MPa": 5.1e-5, "II_head_MPa": 5.1e-5}


def rounding(name: str) -> float:
    """What the printed figures of a column may differ by, in its unit."""
    return {**_ROUNDING, **_CUT_OFF}.get(name, 0.00051 if name.endswith("MPa") else 0.0051)


def table_motion() -> Motion:
    """Motion as in the tables: exact displacement, series for velocity and acceleration, rounded speed."""
    exact, series = (motion(compressor.arrays(), ANGLE, exact) for exact in (True, False))
    return Motion(
        exact.crank_angle,
        exact.displacement,
        series.velocity,
        series.acceleration,
        exact.rod_angle_sine,
        exact.rod_angle_cosine,
        exact.remaining,
        exact.sine,
        exact.cosine,
    )


def figures(shaft_kN: float) -> dict[str, Real]:
    """Everything that the tables hold, under their names.

    Parameters
    ----------
    shaft_kN : rotating friction, at the crank radius.
    """
    layout, moving = compressor.arrays(), table_motion()
    exact = motion(compressor.arrays(compressor.OMEGA), ANGLE)
    gas = gas_forces(compressor.chambers(), moving, layout)
    inertia = compressor.MASS[:, None] * moving.acceleration
    stroke = np.full(2, 2.0 * compressor.RADIUS)
    losses = (compressor.INDICATED, np.asarray(compressor.EFFICIENCY), np.asarray(compressor.SHARE), stroke)
    magnitude, _ = share_of_losses(*losses, np.asarray(compressor.OMEGA))
    friction = reciprocating_friction(moving, magnitude)
    forces = rod_forces(gas.total + inertia + friction, moving, layout)
    pressures = {
        "x_mm": moving.displacement[0] * 1e3,
        "x_crank_mm": (0.28 - moving.displacement[0]) * 1e3,
        "c_series": moving.velocity[0],
        "a_series": moving.acceleration[0],
        "c_exact": exact.velocity[0],
        "a_exact": exact.acceleration[0],
        "beta_deg": np.rad2deg(np.arcsin(moving.rod_angle_sine[0])),
        "factor": moving.tangential_factor[0],
        "tangential_kN": np.sum(forces.tangential, axis=0) * 1e-3 + shaft_kN,
    }
    for k, row in enumerate(compressor.ROWS):
        for side, chamber in enumerate(("head", "crank")):
            pressures[f"{row}_{chamber}_MPa"] = gas.pressure[k, side] * 1e-6
            pressures[f"{row}_{chamber}_kN"] = gas.force[k, side] * 1e-3
        pressures[f"{row}_gas_kN"] = gas.total[k] * 1e-3
        pressures[f"{row}_inertia_kN"] = inertia[k] * 1e-3
        pressures[f"{row}_inertia_exact_kN"] = compressor.MASS[k] * exact.acceleration[k] * 1e-3
        pressures[f"{row}_friction_kN"] = friction[k] * 1e-3
        pressures[f"{row}_sum_kN"] = (gas.total + inertia + friction)[k] * 1e-3
        for name in ("tangential", "side", "rod", "radial"):
            pressures[f"{row}_{name}_kN"] = getattr(forces, name)[k] * 1e-3
    return pressures
