"""Mechanics against the published tables of a compressor over the turn, step by step.

The printed figures are those that stand; the corrected ones are recomputed where the source errs.
"""

import numpy as np
import pytest

from optimizer.analyze import analyze
from optimizer.arrays import Real
from optimizer.mechanics.friction import reciprocating_friction, share_of_losses
from optimizer.mechanics.gas import gas_forces
from optimizer.mechanics.kinematics import Motion, motion
from optimizer.mechanics.rod import rod_forces
from schemas.requests import AnalyzeRequest
from tests.reference import compressor

PRINTED, CORRECTED = compressor.table("printed"), compressor.table("corrected")
ANGLE = np.deg2rad(CORRECTED["angle_deg"])
# friction is 0 here where the piston stands still; the tables give it a sign there
MOVING = CORRECTED["angle_deg"] % 180.0 != 0.0


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
    found = {
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
            found[f"{row}_{chamber}_MPa"] = gas.pressure[k, side] * 1e-6
            found[f"{row}_{chamber}_kN"] = gas.force[k, side] * 1e-3
        found[f"{row}_gas_kN"] = gas.total[k] * 1e-3
        found[f"{row}_inertia_kN"] = inertia[k] * 1e-3
        found[f"{row}_inertia_exact_kN"] = compressor.MASS[k] * exact.acceleration[k] * 1e-3
        found[f"{row}_friction_kN"] = friction[k] * 1e-3
        found[f"{row}_sum_kN"] = (gas.total + inertia + friction)[k] * 1e-3
        for name in ("tangential", "side", "rod", "radial"):
            found[f"{row}_{name}_kN"] = getattr(forces, name)[k] * 1e-3
    return found


# kN: losses turning with the shaft, 0.3 of them with pi = 3.14; and the figure that the last table is printed with
_ROTATING = 0.3 * 1.1913e3 * (1.0 / 0.94 - 1.0) * 60.0 / (3.14 * 0.28 * 500.0)
_ROUNDED = 3.10
_WITH_FRICTION = {
    f"{row}_{name}_kN" for row in compressor.ROWS for name in ("friction", "sum", "side", "rod", "radial")
}
_BY_ANALYZE = {name for name in CORRECTED if name.endswith("bored_kN") or "tangential_exact" in name}


def _where(name: str) -> Real:
    return MOVING if name in _WITH_FRICTION else np.ones_like(MOVING)


@pytest.mark.parametrize("name", [n for n in CORRECTED if n not in {"angle_deg", *_BY_ANALYZE}])
def test_corrected_column(name: str) -> None:
    """Analytic: recomputed independently, to the four to six figures it was written down with."""
    got = figures(_ROTATING)[name]
    places = {"_MPa": 6, "factor": 6, "_series": 4, "_exact": 4}
    digits = next((n for end, n in places.items() if name.endswith(end)), 4)
    digits = 3 if name.startswith("a_") else digits
    where = _where(name)
    np.testing.assert_allclose(got[where], CORRECTED[name][where], rtol=0.0, atol=0.51 * 10.0**-digits)


# kN, as printed; the first table of gas totals cuts digits off, and sums add roundings up
_ROUNDING = {"x_mm": 0.0051, "x_crank_mm": 0.0051, "c_series": 0.0051, "a_series": 0.0051, "factor": 0.00051}
_CUT_OFF = {"II_crank_MPa": 5.1e-5, "II_head_MPa": 5.1e-5}


@pytest.mark.parametrize("name", [n for n in PRINTED if n != "angle_deg"])
def test_printed_column(name: str) -> None:
    """Published: every figure that the source has right, to its rounding."""
    got, where = figures(_ROUNDED)[name], _where(name) & np.isfinite(PRINTED[name])
    rounding = {**_ROUNDING, **_CUT_OFF}.get(name, 0.00051 if name.endswith("MPa") else 0.0051)
    np.testing.assert_allclose(got[where], PRINTED[name][where], rtol=0.0, atol=rounding)


_ENTIRELY = ["x_mm", "x_crank_mm", "c_series", "a_series"] + [
    f"{row}_{name}" for row in compressor.ROWS for name in ("crank_MPa", "crank_kN", "inertia_kN")
]


@pytest.mark.parametrize("name", _ENTIRELY)
def test_tables_that_are_right_are_there_to_the_last_figure(name: str) -> None:
    assert np.all(np.isfinite(PRINTED[name]))


@pytest.mark.parametrize(("bored", "end"), [(False, "exact_kN"), (True, "exact_bored_kN")])
def test_posted_machine(bored: bool, end: str) -> None:
    """Analytic: the exact columns, from the machine as it is posted."""
    request = {
        "machine": compressor.machine(bored),
        "outputs": ["torque", "rod_loads", "gas"],
        "angles": {"step_deg": 10.0},
    }
    found = analyze(AnalyzeRequest.model_validate(request))
    near = {"rtol": 0.0, "atol": 0.051}
    np.testing.assert_allclose(found.torque.tangential_N, 1e3 * CORRECTED[f"tangential_{end}"][:36], **near)
    for k, row in enumerate(compressor.ROWS):
        tangential = found.rod_loads.rows[k].tangential_N
        np.testing.assert_allclose(tangential, 1e3 * CORRECTED[f"{row}_tangential_{end}"][:36], **near)
        for side, chamber in enumerate(("head", "crank")):
            name = f"{row}_{chamber}_bored_kN" if bored else f"{row}_{chamber}_kN"
            np.testing.assert_allclose(found.gas.rows[k].chambers[side].force_N, 1e3 * CORRECTED[name][:36], **near)
