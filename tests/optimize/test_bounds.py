"""Bounds where rounding, or the tolerance of ceilings, is worth more than the gap; all optima are analytic."""

from math import pi
from typing import Any

import pytest

from tests.optimize.machines import machine, throw, web
from tests.verification.checking import optimized

#: rad/s
OMEGA = 600.0 * pi / 30.0


def _of_a_throw(position: float, rotating: float, webs: list[dict[str, Any]], **objective: Any) -> dict[str, Any]:
    """A mass that turns at 0.1 m; moments are about 0."""
    throws = [{**throw(position, 0.0, [], rotating=rotating), "crank_radius_m": 0.1}]
    return {"machine": machine(throws, webs, reference_plane_m=0.0), "objective": objective}


@pytest.mark.parametrize("share", [0.5, 1e-2, 1e-4, 1e-6])
def test_no_bound_of_the_mass_is_above_what_counts_as_keeping_a_ceiling(share: float) -> None:
    """Analytic: the ceiling is a share below 1 kg m, and exceeding it by 1e-9 of that is kept: 0.2 m take the rest."""
    ceiling = OMEGA**2 * (1.0 - share)
    body = _of_a_throw(0.0, 10.0, [web("a", 0.0, 9.0, 0.2)], force_weight=0, force_ceiling_N=ceiling)
    answer = optimized(body)
    least = (share - 1e-9) / 0.2
    assert answer.status == "optimal"
    # 1 kg m is known to a few eps
    assert answer.certificate.mass_lower_bound_kg <= least + 1e-14
    assert answer.certificate.mass_lower_bound_kg >= least - 1e-4 * answer.certificate.mass_yardstick_kg
    assert answer.total_mass_kg >= least - 1e-14


@pytest.mark.parametrize("least_mass", [True, False])
@pytest.mark.parametrize("apart", [1e-15, 1e-12, 1e-9])
def test_bounds_of_webs_that_are_hardly_apart(apart: float, least_mass: bool) -> None:
    """Analytic: one web has no arm, the other takes apart times its reach off the moment; together they make no force.

    1 kg m turns at 2 mm, and the webs reach as far as takes a twentieth of that off.
    """
    most = 1e-4 / apart / 0.1
    webs = [web("a", 0.0, most, 0.1), web("b", apart, most, 0.1)]
    answer = optimized(_of_a_throw(2e-3, 10.0, webs, moment_weight=1.0, least_mass=least_mass))
    smallest = OMEGA**2 * (2e-3 - 1e-4)
    assert answer.certificate.lower_bound <= smallest * (1 + 1e-13)
    assert answer.certificate.objective >= smallest * (1 - 1e-13)
