"""Mechanics against the published tables of a compressor over the turn, step by step.

The printed figures are those that stand; the corrected ones are recomputed where the source errs.
"""

import numpy as np
import pytest

from optimizer.analyze import analyze
from optimizer.numerics.arrays import Real
from schemas.request.requests import AnalyzeRequest
from tests.reference import compressor
from tests.reference.columns import ROTATING, ROUNDED, figures, rounding

PRINTED, CORRECTED = compressor.table("printed"), compressor.table("corrected")
# friction is 0 here where the piston stands still; the tables give it a sign there
MOVING = CORRECTED["angle_deg"] % 180.0 != 0.0


_WITH_FRICTION = {
    f"{row}_{name}_kN" for row in compressor.ROWS for name in ("friction", "sum", "side", "rod", "radial")
}
_BY_ANALYZE = {name for name in CORRECTED if name.endswith("bored_kN") or "tangential_exact" in name}


def _where(name: str) -> Real:
    return MOVING if name in _WITH_FRICTION else np.ones_like(MOVING)


@pytest.mark.parametrize("name", [n for n in CORRECTED if n not in {"angle_deg", *_BY_ANALYZE}])
def test_corrected_column(name: str) -> None:
    """Analytic: recomputed independently, to the four to six figures it was written down with."""
    got = figures(ROTATING)[name]
    places = {"_MPa": 6, "factor": 6, "_series": 4, "_exact": 4}
    digits = next((n for end, n in places.items() if name.endswith(end)), 4)
    digits = 3 if name.startswith("a_") else digits
    where = _where(name)
    np.testing.assert_allclose(got[where], CORRECTED[name][where], rtol=0.0, atol=0.51 * 10.0**-digits)


@pytest.mark.parametrize("name", [n for n in PRINTED if n != "angle_deg"])
def test_printed_column(name: str) -> None:
    """Published: every figure that the source has right, to its rounding."""
    got, where = figures(ROUNDED)[name], _where(name) & np.isfinite(PRINTED[name])
    np.testing.assert_allclose(got[where], PRINTED[name][where], rtol=0.0, atol=rounding(name))


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
    answer = analyze(AnalyzeRequest.model_validate(request))
    near = {"rtol": 0.0, "atol": 0.051}
    np.testing.assert_allclose(answer.torque.tangential_N, 1e3 * CORRECTED[f"tangential_{end}"][:36], **near)
    for k, row in enumerate(compressor.ROWS):
        tangential = answer.rod_loads.rows[k].tangential_N
        np.testing.assert_allclose(tangential, 1e3 * CORRECTED[f"{row}_tangential_{end}"][:36], **near)
        for side, chamber in enumerate(("head", "crank")):
            name = f"{row}_{chamber}_bored_kN" if bored else f"{row}_{chamber}_kN"
            np.testing.assert_allclose(answer.gas.rows[k].chambers[side].force_N, 1e3 * CORRECTED[name][:36], **near)
