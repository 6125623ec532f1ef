"""Fronts that are known in closed form; expected numbers are analytic."""

import math

import numpy as np
import pytest

from tests.night import part
from tests.optimize.machines import machine, throw, web
from tests.studies.pareto.cases import (
    OMEGA_SQUARED,
    RHO,
    TARGET,
    circular,
    four_webs,
    front,
    single_row,
    straight,
    traded,
)


def test_single_row_is_one_point_with_half_the_mass() -> None:
    pareto_front = front(single_row())
    assert (pareto_front.status, pareto_front.reason, pareto_front.knee) == ("optimal", "reached_together", None)
    (point,) = pareto_front.points
    assert point.force_peak_N == pytest.approx(0.5 * 100.0 * 0.1 * OMEGA_SQUARED, rel=2e-6)
    assert point.moment_peak_Nm == 0.0
    assert point.total_mass_kg == pytest.approx(50.0, rel=1e-5)
    assert point.counterweights[0].angle_deg == pytest.approx(180.0)


def test_straight_front_with_points_evenly_apart() -> None:
    pareto_front = front(straight(), points=6)
    assert (pareto_front.status, pareto_front.reason, pareto_front.knee, len(pareto_front.points)) == (
        "optimal",
        None,
        None,
        6,
    )
    share = np.linspace(0.0, 1.0, 6)
    peaks = np.array([traded(point) for point in pareto_front.points]) / OMEGA_SQUARED
    assert peaks[:, 0] == pytest.approx(share, abs=3e-6)
    assert peaks[:, 1] == pytest.approx(2.0 * (1.0 - share), abs=6e-6)
    assert [point.total_mass_kg for point in pareto_front.points] == pytest.approx((1.0 - share) / 0.2, abs=2e-5)


@pytest.mark.parametrize("points", part(2, [2, 3, 9, 30]))
def test_curved_front(points: int) -> None:
    pareto_front = front(circular(), points=points)
    assert (pareto_front.status, pareto_front.reason, len(pareto_front.points)) == ("optimal", None, points)
    unit = TARGET * OMEGA_SQUARED
    for point in pareto_front.points:
        phi = math.radians(point.counterweights[0].angle_deg)
        assert -1e-4 <= phi <= math.pi / 2 + 1e-4
        for peak, along in zip(traded(point), (math.cos(phi), math.sin(phi)), strict=True):
            on_the_arc = math.sqrt(TARGET**2 + RHO**2 - 2 * TARGET * RHO * along) * OMEGA_SQUARED
            assert peak == pytest.approx(on_the_arc, abs=5e-6 * unit)
        assert point.counterweights[0].active_limits == ("max_mass",)
    assert pareto_front.ends is not None
    near, far = (TARGET - RHO) * OMEGA_SQUARED, math.hypot(TARGET, RHO) * OMEGA_SQUARED
    # one of the peaks lies on a square root there: 1e-6 of the first moves the other by 1e-3
    assert pareto_front.ends.smallest_force_N == pytest.approx(near, rel=3e-6)
    assert pareto_front.ends.smallest_moment_Nm == pytest.approx(near, rel=3e-6)
    assert pareto_front.ends.moment_at_smallest_force_Nm == pytest.approx(far, rel=2e-3)
    assert pareto_front.ends.force_at_smallest_moment_N == pytest.approx(far, rel=2e-3)


def test_curved_front_is_even_and_its_knee_is_in_the_middle() -> None:
    pareto_front = front(circular(), points=21)
    peaks = np.array([traded(point) for point in pareto_front.points])
    apart = np.hypot(*(np.diff(peaks, axis=0) / np.ptp(peaks, axis=0)).T)
    assert np.max(apart) / np.min(apart) < 1.05
    assert pareto_front.knee == 10
    assert pareto_front.points[10].counterweights[0].angle_deg == pytest.approx(45.0, abs=0.1)


def test_nothing_to_choose() -> None:
    body = machine([throw(0.0, 0.0, [], rotating=10.0), throw(1.0, 90.0, [], rotating=10.0)], [])
    for webs in ([], [web("a", 0.3, 0.0)]):
        pareto_front = front({**body, "webs": webs})
        assert (pareto_front.status, pareto_front.reason) == ("optimal", "reached_together")
        (point,) = pareto_front.points
        assert point.force_peak_N == pytest.approx(2**0.5 * OMEGA_SQUARED)
        assert point.total_mass_kg == 0.0


def test_balanced_machine_has_one_point_without_counterweights() -> None:
    throws = [throw(z, angle, [], rotating=10.0) for z, angle in ((0.0, 0.0), (1.0, 180.0), (2.0, 180.0), (3.0, 0.0))]
    pareto_front = front(machine(throws, [web("a", 0.5), web("b", 2.5)]))
    (point,) = pareto_front.points
    assert traded(point) == (0.0, 0.0)
    assert point.total_mass_kg == 0.0
    assert (pareto_front.status, pareto_front.reason) == ("optimal", "reached_together")


def test_force_that_is_balanced_already_can_be_traded() -> None:
    # a couple and one web 1 m beside the plane of moments: F = x, M = 1 - x (analytic), where F is 0 at rest
    throws = [throw(0.5, 0.0, [], rotating=10.0), throw(-0.5, 180.0, [], rotating=10.0)]
    pareto_front = front(machine(throws, [web("a", 1.0)], reference_plane_m=0.0), points=5)
    assert (pareto_front.status, len(pareto_front.points)) == ("optimal", 5)
    share = np.linspace(0.0, 1.0, 5)
    peaks = np.array([traded(point) for point in pareto_front.points]) / OMEGA_SQUARED
    assert peaks[:, 0] == pytest.approx(share, abs=3e-6)
    assert peaks[:, 1] == pytest.approx(1.0 - share, abs=3e-6)


def test_ceiling_cuts_the_front_where_it_says() -> None:
    ceiling = 0.4 * OMEGA_SQUARED
    pareto_front = front(straight(), points=4, objective={"force_ceiling_N": ceiling})
    assert [point.force_peak_N for point in pareto_front.points] == pytest.approx(
        np.linspace(0.0, ceiling, 4), abs=3e-6 * OMEGA_SQUARED
    )
    assert pareto_front.points[-1].active_limits == ("force_ceiling",)
    assert all(point.force_peak_N <= ceiling * (1 + 1e-8) for point in pareto_front.points)


def test_budget_cuts_the_front_where_it_says() -> None:
    # analytic: 2 kg at 0.2 m are 0.4 kg m, so F >= 0.6
    pareto_front = front({**straight(), "max_total_mass_kg": 2.0}, points=3)
    assert pareto_front.max_total_mass_kg == 2.0
    assert pareto_front.points[0].force_peak_N == pytest.approx(0.6 * OMEGA_SQUARED, rel=3e-6)
    assert pareto_front.points[0].active_limits == ("max_total_mass",)


def test_infeasible_ceilings_say_why() -> None:
    pareto_front = front(single_row(), objective={"force_ceiling_N": 0.4 * 10.0 * OMEGA_SQUARED})
    assert (pareto_front.status, pareto_front.points, pareto_front.ends, pareto_front.knee) == (
        "infeasible",
        (),
        None,
        None,
    )
    assert pareto_front.infeasibility is not None
    assert pareto_front.infeasibility.conflict == ("force_ceiling_N",)
    assert pareto_front.infeasibility.smallest_force_N == pytest.approx(0.5 * 10.0 * OMEGA_SQUARED, rel=1e-6)


def test_ceiling_on_the_very_boundary_is_never_infeasible() -> None:
    # analytic: the floor of the force, b = 5 kg m
    pareto_front = front(single_row(), objective={"force_ceiling_N": 0.5 * 10.0 * OMEGA_SQUARED})
    assert pareto_front.status in ("optimal", "inaccurate")
    (point,) = pareto_front.points
    assert point.force_peak_N == pytest.approx(0.5 * 10.0 * OMEGA_SQUARED, rel=1e-6)


def test_mirrored_machine_has_the_mirrored_front() -> None:
    body = four_webs()
    mirrored = {
        **body,
        "rotation": "cw",
        "throws": [
            {
                **crank,
                "crank_angle_deg": -crank["crank_angle_deg"],
                "rows": [{**row, "axis_deg": -row["axis_deg"]} for row in crank["rows"]],
            }
            for crank in body["throws"]
        ],
    }
    first, second = front(body), front(mirrored)
    assert len(first.points) == len(second.points) == 9
    for point, second_point in zip(first.points, second.points, strict=True):
        assert traded(second_point) == pytest.approx(traded(point), rel=3e-6)
        assert second_point.total_mass_kg == pytest.approx(point.total_mass_kg, rel=1e-4)
    assert second.knee == first.knee


def test_speed_scales_the_peaks_and_leaves_the_counterweights() -> None:
    slow, fast = front(four_webs()), front(four_webs(speed_rpm=1200.0))
    for point, second_point in zip(slow.points, fast.points, strict=True):
        assert traded(second_point) == pytest.approx(tuple(4.0 * peak for peak in traded(point)), rel=1e-9)
        assert second_point.total_mass_kg == pytest.approx(point.total_mass_kg, rel=1e-9)
