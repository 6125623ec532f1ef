"""The balance quality of a shaft: closed forms, and what counterweights make of it."""

from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from optimizer.analyze import analyze
from optimizer.mechanics.balance_quality import in_planes, permissible_unbalance, plane_shares
from optimizer.optimize import optimize
from schemas.machine.balance_quality import BalanceQuality
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from service.report.chapters.answers import analyzed

QUALITY = {"grade_mm_s": 6.3, "mass_kg": 200.0, "centre_of_mass_m": 0.1, "plane_a_m": -0.3, "plane_b_m": 0.5}
OMEGA = 100.0


def machine(**rest: Any) -> dict[str, Any]:
    """One throw at 0.1 m with 3 kg turning and 4 kg swinging at 0.1 m, and a web on each side."""
    return {
        "kind": "reciprocating",
        "speed_rpm": OMEGA * 30 / np.pi,
        "throws": [
            {
                "position_m": 0.1,
                "crank_radius_m": 0.1,
                "crank_angle_deg": 30,
                "rotating_mass_kg": 3,
                "rows": [{"axis_deg": 90, "reciprocating_mass_kg": 4}],
            }
        ],
        "webs": [
            {"name": name, "position_m": place, "counterweight_radius_m": 0.1, "max_mass_kg": 9}
            for name, place in (("a", 0.0), ("b", 0.2))
        ],
        "balance_quality": QUALITY,
        **rest,
    }


def test_permissible_unbalance() -> None:
    """Published: 9549 G m / n in g mm (ISO 21940-11); G 6.3, 200 kg, 3000 rpm."""
    unbalance = permissible_unbalance(6.3e-3, 200.0, 3000.0 * np.pi / 30)
    assert unbalance * 1e6 == pytest.approx(9549.3 * 6.3 * 200.0 / 3000.0, rel=1e-5)


@pytest.mark.parametrize(("centre", "share"), [(0.0, 0.5), (0.2, 0.3), (-0.1, 0.625), (0.39, 0.3), (-0.39, 0.7)])
def test_planes_share_it_by_their_distances(centre: float, share: float) -> None:
    """Analytic; far off the middle the standard's 0.3 and 0.7 hold."""
    shares = plane_shares(centre, -0.4, 0.4)
    assert shares == (pytest.approx(share), pytest.approx(1.0 - share))
    assert plane_shares(-centre, 0.4, -0.4) == (pytest.approx(share), pytest.approx(1.0 - share))


def test_two_planes_come_to_the_same() -> None:
    """Analytic: force and couple of what the planes have."""
    force, couple = np.array(3.0 - 1.0j), np.array(-0.2 + 0.7j)
    first, second = in_planes(force, couple, -0.3, 0.5)
    assert first + second == pytest.approx(force)
    assert -0.3 * first + 0.5 * second == pytest.approx(couple)


def test_a_crank_without_counterweights_deviates_by_all_of_it() -> None:
    """Analytic: (3 + 4/2) kg at 0.1 m in the plane of the centre of mass, half of it in each plane, 0.25 kg m."""
    balance_quality = analyze(AnalyzeRequest.model_validate({"machine": machine()})).balance_quality
    assert balance_quality is not None
    assert balance_quality.permissible_kg_m == pytest.approx(6.3e-3 * 200.0 / OMEGA)
    for plane in (balance_quality.before.plane_a, balance_quality.before.plane_b):
        assert plane.unbalance_kg_m == pytest.approx(0.25)
        assert plane.permissible_kg_m == pytest.approx(0.5 * balance_quality.permissible_kg_m)
        assert plane.angle_deg == pytest.approx(30.0)
    assert balance_quality.before.grade_mm_s == pytest.approx(1e3 * 0.25 * OMEGA / (0.5 * 200.0))


def test_a_counterweight_that_is_off() -> None:
    """Analytic: 2.5 kg at each web is the design; 20 g more on one, 0.002 kg m at 0 m: 5/8 of it in plane A."""
    weights = [{"web": "a", "mass_kg": 2.52, "angle_deg": 210}, {"web": "b", "mass_kg": 2.5, "angle_deg": 210}]
    request = AnalyzeRequest.model_validate({"machine": machine(), "counterweights": weights})
    answer = analyze(request)
    balance_quality = answer.balance_quality
    assert balance_quality is not None
    assert balance_quality.after is not None
    assert balance_quality.after.plane_a.unbalance_kg_m == pytest.approx(0.00125, rel=1e-6)
    assert balance_quality.after.plane_b.unbalance_kg_m == pytest.approx(0.00075, rel=1e-6)
    # the larger plane counts: 1.25, where both together would say 1
    assert balance_quality.after.grade_mm_s == pytest.approx(1e3 * 0.00125 * OMEGA / 100.0, rel=1e-6)
    assert "Balance quality" in [chapter.title for chapter in analyzed(request, answer)]


def test_an_optimum_that_cancels_what_turns_has_the_design_unbalance() -> None:
    answer = optimize(OptimizeRequest.model_validate({"machine": machine()}))
    assert answer.balance_quality is not None
    assert answer.balance_quality.after is not None
    assert answer.balance_quality.after.grade_mm_s < 1e-3 * answer.balance_quality.before.grade_mm_s


def test_none_is_asked_for() -> None:
    body = machine()
    del body["balance_quality"]
    assert analyze(AnalyzeRequest.model_validate({"machine": body})).balance_quality is None


@pytest.mark.parametrize("centre", [-0.3, 0.5, 0.6])
def test_planes_stand_on_both_sides(centre: float) -> None:
    with pytest.raises(ValidationError) as caught:
        BalanceQuality.model_validate({**QUALITY, "centre_of_mass_m": centre})
    assert caught.value.errors()[0]["ctx"]["problems"][0].path == ("centre_of_mass_m",)


def test_the_reference_plane_is_no_matter() -> None:
    """Metamorphic: moments about another plane are of the same unbalances."""
    balance_quality, second_balance_quality = (
        analyze(AnalyzeRequest.model_validate({"machine": machine(reference_plane_m=plane)})).balance_quality
        for plane in (0.1, -3.0)
    )
    assert balance_quality is not None
    assert second_balance_quality is not None
    assert balance_quality.before.plane_a.unbalance_kg_m == pytest.approx(
        second_balance_quality.before.plane_a.unbalance_kg_m, rel=1e-9
    )
