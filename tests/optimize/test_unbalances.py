"""Unbalances of the shaft itself: counted in every response, in no plane; analytic by an equal throw."""

import copy
import json
from typing import Any

import pytest
from pydantic import ValidationError

from optimizer.analyze import analyze
from optimizer.studies.sweep import run_chunk
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from tests.studies.sweep.single import sweep
from tests.verification.checking import broken, optimized

BODY: dict[str, Any] = {
    "machine": {
        "kind": "reciprocating",
        "speed_rpm": 600,
        "throws": [
            {
                "position_m": z, "crank_radius_m": 0.1, "crank_angle_deg": a, "rotating_mass_kg": 3,
                "rows": [{"axis_deg": 0, "reciprocating_mass_kg": 10, "connecting_rod": {"length_m": 0.5}}],
            }
            for z, a in ((-0.2, 0), (0.2, 90))
        ],
        "webs": [
            {"name": name, "position_m": z, "counterweight_radius_m": 0.2, "max_mass_kg": 8}
            for name, z in (("left", -0.3), ("right", 0.3))
        ],
        "bearings": [{"name": "A", "position_m": -0.5}, {"name": "B", "position_m": 0.5}],
    }
}  # fmt: skip
#: 20 kg at 0.1 m and 30 degrees
X, Y = 3.0**0.5, 1.0


def with_own(*own: tuple[float, float, float]) -> dict[str, Any]:
    body = copy.deepcopy(BODY)
    body["machine"]["unbalances"] = [
        {"name": str(n), "position_m": z, "x_kg_m": x, "y_kg_m": y} for n, (z, x, y) in enumerate(own)
    ]
    return body


def as_a_throw(z: float) -> dict[str, Any]:
    body = copy.deepcopy(BODY)
    body["machine"]["throws"].append(
        {"position_m": z, "crank_radius_m": 0.1, "crank_angle_deg": 30, "rotating_mass_kg": 20}
    )
    return body


def test_it_counts_as_a_throw_of_the_same_unbalance() -> None:
    own, throw = optimized(with_own((0.1, X, Y))), optimized(as_a_throw(0.1))
    assert own.status == throw.status == "optimal"
    for order, second_order in (
        (own.residual.before, throw.residual.before),
        (own.residual.after, throw.residual.after),
    ):
        assert order is not None
        assert second_order is not None
        assert order.force.peak_N == pytest.approx(second_order.force.peak_N, rel=1e-5)
        assert order.moment.peak_Nm == pytest.approx(second_order.moment.peak_Nm, rel=1e-5)
    assert own.certificate is not None
    assert throw.certificate is not None
    assert own.certificate.lower_bound == pytest.approx(throw.certificate.lower_bound, rel=1e-9)


@pytest.mark.parametrize("output", ["main_bearings", "stages"])
def test_bearings_and_stages_know_it(output: str) -> None:
    own, throw = (
        analyze(AnalyzeRequest.model_validate({"machine": body["machine"], "outputs": [output]})).model_dump()[output]
        for body in (with_own((0.1, X, Y)), as_a_throw(0.1))
    )
    if output == "stages":
        assert [multiplier["value"] for multiplier in own] == pytest.approx(
            [multiplier["value"] for multiplier in throw], rel=1e-9, abs=1e-6
        )
    else:
        for bearing, second_bearing in zip(own["bearings"], throw["bearings"], strict=True):
            assert bearing["before"]["peak_N"] == pytest.approx(second_bearing["before"]["peak_N"], rel=1e-7)


def test_one_that_opposes_all_that_rotates_leaves_nothing_to_do() -> None:
    body = with_own((-0.2, -0.3, 0.0), (0.2, 0.0, -0.3))
    for throw in body["machine"]["throws"]:
        throw["rows"] = []
    answer = optimized(body)
    assert answer.residual.before.force.peak_N == 0.0
    assert answer.residual.before.moment.peak_Nm == 0.0
    assert answer.total_mass_kg == 0.0


def test_it_moves_neither_reference_plane_nor_span() -> None:
    far, none = optimized(with_own((50.0, 1e-9, 0.0))), optimized(BODY)
    assert far.reference_plane_m == none.reference_plane_m == 0.0
    assert far.certificate is not None
    assert none.certificate is not None
    # the weight of the moment is 1/L, so that a span of 50 m would change the objective by far more
    assert far.certificate.objective == pytest.approx(none.certificate.objective, rel=2e-6)


def test_a_scroll_has_them_too(scroll: dict[str, Any]) -> None:
    assert optimized(scroll).residual.before.force.peak_N == pytest.approx(0.0, abs=1e-9)


@pytest.fixture
def scroll() -> dict[str, Any]:
    """1.2 kg on an orbit of 5 mm at angle 0, and what opposes it in the same plane."""
    pins = {"type": "crank_pins", "count": 3, "pin_circle_radius_m": 0.05, "position_m": 0.03}
    machine = {
        "kind": "scroll", "speed_rpm": 3000, "orbit_radius_m": 0.005, "orbiting_mass_kg": 1.2,
        "orbiting_position_m": 0.05, "anti_rotation": pins,
        "unbalances": [{"name": "cast", "position_m": 0.05, "x_kg_m": -0.006}],
    }  # fmt: skip
    return {"machine": machine}


def test_the_checker_counts_it() -> None:
    body = with_own((0.1, X, Y))
    answer = json.loads(optimized(body).model_dump_json())
    body["machine"]["unbalances"][0]["x_kg_m"] *= 1 + 1e-6
    assert broken(body, answer)


def test_sweeps_vary_it() -> None:
    body = with_own((0.1, X, Y))
    request = sweep(body, {"path": "/machine/unbalances/0/x_kg_m", "values": [-1.0, 0.0, 2.0]})
    rows = run_chunk(request.model_dump_json().encode(), 0, 3).to_pylist()
    for row, offset in zip(rows, (-1.0, 0.0, 2.0), strict=True):
        body["machine"]["unbalances"][0]["x_kg_m"] = offset
        alone = optimized(body)
        assert row["total_mass_kg"] == alone.total_mass_kg
        assert row["force_peak_N"] == alone.residual.after.force.peak_N


@pytest.mark.parametrize("wrong", [{"x_kg_m": float("nan")}, {"x_kg_m": 1e16}, {"mass_kg": 1}, {"position_m": None}])
def test_what_it_cannot_be(wrong: dict[str, Any]) -> None:
    body = with_own((0.1, X, Y))
    body["machine"]["unbalances"][0] |= wrong
    with pytest.raises(ValidationError, match=next(iter(wrong))):
        OptimizeRequest.model_validate(body)


def test_names_are_unique() -> None:
    body = with_own((0.1, X, Y))
    body["machine"]["unbalances"] *= 2
    with pytest.raises(ValidationError, match="unique"):
        OptimizeRequest.model_validate(body)
