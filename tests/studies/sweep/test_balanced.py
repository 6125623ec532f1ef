"""Machines whose moment is balanced at rest, with ceilings down to 0: rows and single answers say the same."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from tests.night import part
from tests.studies.sweep.single import assert_row_is_the_single_answer, sweep, table

_STATUSES = {"optimal", "inaccurate", "infeasible"}


def balanced(seed: int) -> dict[str, Any]:
    """Two equal throws at one angle, mirrored about the middle, and webs that are not."""
    rng = np.random.default_rng(seed)
    place, mass, radius = rng.uniform(0.1, 2.0), 10.0 ** rng.uniform(-1.0, 3.0), rng.uniform(0.02, 0.4)
    throws = [
        {
            "position_m": side * place,
            "crank_radius_m": radius,
            "crank_angle_deg": 0.0,
            "rotating_mass_kg": float(rng.uniform(0.0, 2.0)) * mass if seed % 3 == 0 else 0.0,
            "rows": [{"axis_deg": 90.0, "reciprocating_mass_kg": mass}],
        }
        for side in (-1.0, 1.0)
    ]
    throws[1] |= {"rotating_mass_kg": throws[0]["rotating_mass_kg"]}
    webs = [
        {
            "name": str(k),
            "position_m": float(rng.uniform(-1.5, 1.5)) * place,
            "counterweight_radius_m": float(rng.uniform(0.5, 2.0)) * radius,
            "max_mass_kg": float(rng.uniform(0.1, 2.0)) * mass,
        }
        for k in range(int(rng.integers(1, 6)))
    ]
    machine = {"kind": "reciprocating", "speed_rpm": float(rng.uniform(10, 6000)), "throws": throws, "webs": webs}
    return {"machine": machine, "objective": {"combine": "max" if seed % 2 else "sum", "moment_ceiling_Nm": 0.0}}


@pytest.mark.parametrize(
    "seed", part(2, [*range(18), *(pytest.param(n, marks=pytest.mark.nightly) for n in range(18, 60))])
)
def test_rows_agree_with_single_answers_in_status_and_figures(seed: int) -> None:
    """Independent: the single answer goes through the schema and the figures of one machine."""
    base = balanced(seed)
    machine = base["machine"]
    speed = machine["speed_rpm"] * np.pi / 30.0
    size = sum(t["crank_radius_m"] * t["rows"][0]["reciprocating_mass_kg"] for t in machine["throws"]) * speed**2
    ceilings = [0.0, *(float(size * 10.0**power) for power in (-12, -6, -1))]
    request = sweep(base, {"path": "/objective/moment_ceiling_Nm", "values": ceilings})
    rows = table(request).to_pylist()
    texts = [assert_row_is_the_single_answer(request, row) for row in rows]
    assert set(texts) <= _STATUSES
    # no counterweights at all keep every ceiling of a moment that is balanced
    assert "infeasible" not in texts
    # the objective does not rise with the ceiling, beyond what is certified
    for lower, higher in pairwise(rows):
        assert higher["objective"] <= lower["objective"] + 2e-6 * lower["yardstick"]
