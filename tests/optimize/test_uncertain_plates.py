"""Plates all but full in the worst case: the minimum mass is proven as it is with nothing off."""

from typing import Any

import pytest

from optimizer.optimize import optimize
from tests.night import part
from tests.optimize.robust import scenario
from tests.studies.accuracy.test_choices import ALIKE, cut, twin

TOLERANCES: list[dict[str, float] | None] = [
    {"mass_relative": 0.02},
    {"angle_deg": 2.0},
    {"unbalance_kg_m": 0.001},
    {"reciprocating_mass_relative": 0.02},
    {"mass_relative": 0.02, "angle_deg": 2.0, "reciprocating_mass_relative": 0.02},
    None,
]


@pytest.mark.parametrize("tolerances", part(3, TOLERANCES))
@pytest.mark.parametrize("machine", part(1, [{}, ALIKE]))
@pytest.mark.parametrize("several", [False, True])
def test_the_mass_of_plates_is_proven_where_something_is_off(
    tolerances: dict[str, float] | None, machine: dict[str, Any], several: bool
) -> None:
    """Property: their lever vanishes towards the half disc, and tangents of before are not forgotten."""
    plain = cut(twin(**machine))
    cases = [scenario("as it is"), scenario("fast", speed_rpm=1.1 * plain["speed_rpm"])] if several else []
    best = optimize({"machine": plain, "tolerances": tolerances, "scenarios": cases})
    assert best.status == "optimal", best.status_reason
    assert best.certificate is not None
    assert best.certificate.mass_relative_gap is not None
    assert best.certificate.mass_relative_gap <= 1e-4
    heavy = optimize(
        {"machine": plain, "tolerances": tolerances, "scenarios": cases, "objective": {"least_mass": False}}
    )
    assert heavy.total_mass_kg is not None
    assert best.certificate.mass_lower_bound_kg is not None
    assert heavy.total_mass_kg >= best.certificate.mass_lower_bound_kg * (1.0 - 1e-12)
