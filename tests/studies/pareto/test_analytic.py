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
    found = front(single_row())
    assert (found.status, found.reason, found.knee) == ("optimal", "reached_together", None)
    (point,) = found.points
    assert point.force_peak_N == pytest.approx(0.5 * 100.0 * 0.1 * OMEGA_SQUARED, rel=2e-6)
    assert point.moment_peak_Nm == 0.0
    assert point.total_mass_kg == pytest.approx(50.0, rel=1e-5)
    assert point.counterweights[0].angle_deg == pytest.approx(180.0)


def test_straight_front_with_points_evenly_apart() -> None:
    found = front(straight(), points=6)
    assert (found.status, found.reason, found.knee, len(found.points)) == ("optimal", None, None, 6)
    share = np.linspace(0.0, 1.0, 6)
    peaks = np.array([traded(point) for point in found.points]) / OMEGA_SQUARED
    assert peaks[:, 0] == pytest.approx(share, abs=3e-6)
    assert peaks[:, 1] == pytest.approx(2.0 * (1.0 - share), abs=6e-6)
    assert [point.total_mass_kg for point in found.points] == pytest.approx((1.0 - share) / 0.2, abs=2e-5)


@pytest.mark.parametrize("points", part(2, [2, 3, 9, 30]))
def test_curved_front(points: int) -> None:
    found = front(circular(), points=points)
    assert (found.status, found.reason, len(found.points)) == ("optimal", None, points)
    unit = TARGET * OMEGA_SQUARED
    for point in found.points:
        phi = math.radians(point.counterweights[0].angle_deg)
        assert -1e-4 <= phi <= math.pi / 2 + 1e-4
        for peak, along in zip(traded(point), (math.cos(phi), math.sin(phi)), strict=True):
            on_the_arc = math.sqrt(TARGET**2 + RHO**2 - 2 * TARGET * RHO * along) * OMEGA_SQUARED
            assert peak == pytest.approx(on_the_arc, abs=5e-6 * unit)
        assert point.counterweights[0].active_limits == ("max_mass",)
    assert found.ends is not None
    near, far = (TARGET - RHO) * OMEGA_SQUARED, math.hypot(TARGET, RHO) * OMEGA_SQUARED
    # one of the peaks lies on a square root there: 1e-6 of the first moves the other by 1e-3
    assert found.ends.smallest_force_N == pytest.approx(near, rel=3e-6)
    assert found.ends.smallest_moment_Nm == pytest.approx(near, rel=3e-6)
    assert found.ends.moment_at_smallest_force_Nm == pytest.approx(far, rel=2e-3)
    assert found.ends.force_at_smallest_moment_N == pytest.approx(far, rel=2e-3)


def test_curved_front_is_even_and_its_knee_is_in_the_middle() -> None:
    found = front(circular(), points=21)
    peaks = np.array([traded(point) for point in found.points])
    apart = np.hypot(*(np.diff(peaks, axis=0) / np.ptp(peaks, axis=0)).T)
    assert np.max(apart) / np.min(apart) < 1.05
    assert found.knee == 10
    assert found.points[10].counterweights[0].angle_deg == pytest.approx(45.0, abs=0.1)


def test_nothing_to_choose() -> None:
    body = machine([throw(0.0, 0.0, [], rotating=10.0), throw(1.0, 90.0, [], rotating=10.0)], [])
    for webs in ([], [web("a", 0.3, 0.0)]):
        found = front({**body, "webs": webs})
        assert (found.status, found.reason) == ("optimal", "reached_together")
        (point,) = found.points
        assert point.force_peak_N == pytest.approx(2**0.5 * OMEGA_SQUARED)
        assert point.total_mass_kg == 0.0


def test_balanced_machine_has_one_point_without_counterweights() -> None:
    throws = [throw(z, angle, [], rotating=10.0) for z, angle in ((0.0, 0.0), (1.0, 180.0), (2.0, 180.0), (3.0, 0.0))]
    found = front(machine(throws, [web("a", 0.5), web("b", 2.5)]))
    (point,) = found.points
    assert traded(point) == (0.0, 0.0)
    assert point.total_mass_kg == 0.0
    assert (found.status, found.reason) == ("optimal", "reached_together")


def test_force_that_is_balanced_already_can_be_traded() -> None:
    # a couple and one web 1 m beside the plane of moments: F = x, M = 1 - x (analytic), where F is 0 at rest
    throws = [throw(0.5, 0.0, [], rotating=10.0), throw(-0.5, 180.0, [], rotating=10.0)]
    found = front(machine(throws, [web("a", 1.0)], reference_plane_m=0.0), points=5)
    assert (found.status, len(found.points)) == ("optimal", 5)
    share = np.linspace(0.0, 1.0, 5)
    peaks = np.array([traded(point) for point in found.points]) / OMEGA_SQUARED
    assert peaks[:, 0] == pytest.approx(share, abs=3e-6)
    assert peaks[:, 1] == pytest.approx(1.0 - share, abs=3e-6)


def test_ceiling_cuts_the_front_where_it_says() -> None:
    ceiling = 0.4 * OMEGA_SQUARED
    found = front(straight(), points=4, objective={"force_ceiling_N": ceiling})
    assert [point.force_peak_N for point in found.points] == pytest.approx(
        np.linspace(0.0, ceiling, 4), abs=3e-6 * OMEGA_SQUARED
    )
    assert found.points[-1].active_limits == ("force_ceiling",)
    assert all(point.force_peak_N <= ceiling * (1 + 1e-8) for point in found.points)


def test_budget_cuts_the_front_where_it_says() -> None:
    # analytic: 2 kg at 0.2 m are 0.4 kg m, so F >= 0.6
    found = front({**straight(), "max_total_mass_kg": 2.0}, points=3)
    assert found.max_total_mass_kg == 2.0
    assert found.points[0].force_peak_N == pytest.approx(0.6 * OMEGA_SQUARED, rel=3e-6)
    assert found.points[0].active_limits == ("max_total_mass",)


def test_infeasible_ceilings_say_why() -> None:
    found = front(single_row(), objective={"force_ceiling_N": 0.4 * 10.0 * OMEGA_SQUARED})
    assert (found.status, found.points, found.ends, found.knee) == ("infeasible", (), None, None)
    assert found.infeasibility is not None
    assert found.infeasibility.conflict == ("force_ceiling_N",)
    assert found.infeasibility.smallest_force_N == pytest.approx(0.5 * 10.0 * OMEGA_SQUARED, rel=1e-6)


def test_ceiling_on_the_very_boundary_is_never_infeasible() -> None:
    # analytic: the floor of the force, b = 5 kg m
    found = front(single_row(), objective={"force_ceiling_N": 0.5 * 10.0 * OMEGA_SQUARED})
    assert found.status in ("optimal", "inaccurate")
    (point,) = found.points
    assert point.force_peak_N == pytest.approx(0.5 * 10.0 * OMEGA_SQUARED, rel=1e-6)


def test_mirrored_machine_has_the_mirrored_front() -> None:
    body = four_webs()
    mirrored = {
        **body,
        "rotation": "cw",
        "throws": [
            {
                **one,
                "crank_angle_deg": -one["crank_angle_deg"],
                "rows": [{**each, "axis_deg": -each["axis_deg"]} for each in one["rows"]],
            }
            for one in body["throws"]
        ],
    }
    first, second = front(body), front(mirrored)
    assert len(first.points) == len(second.points) == 9
    for one, other in zip(first.points, second.points, strict=True):
        assert traded(other) == pytest.approx(traded(one), rel=3e-6)
        assert other.total_mass_kg == pytest.approx(one.total_mass_kg, rel=1e-4)
    assert second.knee == first.knee


def test_speed_scales_the_peaks_and_leaves_the_counterweights() -> None:
    slow, fast = front(four_webs()), front(four_webs(speed_rpm=1200.0))
    for one, other in zip(slow.points, fast.points, strict=True):
        assert traded(other) == pytest.approx(tuple(4.0 * peak for peak in traded(one)), rel=1e-9)
        assert other.total_mass_kg == pytest.approx(one.total_mass_kg, rel=1e-9)
