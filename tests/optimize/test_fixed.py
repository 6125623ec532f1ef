"""Weights that are on the crank already: part of the machine for the program, shown beside what is chosen."""

import copy
import json
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from optimizer.analyze import analyze
from optimizer.studies.pareto.pareto import pareto
from optimizer.studies.sweep import run_chunk
from schemas.front.pareto import ParetoRequest
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from schemas.sweep.request import SweepRequest
from tests.optimize.test_unbalances import BODY
from tests.verification.checking import broken, optimized

KG, AT, RADIUS, PLANE = 4.0, 200.0, 0.15, 0.1


def with_fixed(body: dict[str, Any] = BODY, **more: Any) -> dict[str, Any]:
    """A third web, which carries a weight already."""
    body = copy.deepcopy(body)
    weight = {"mass_kg": KG, "angle_deg": AT, "radius_m": RADIUS}
    body["machine"]["webs"].append({"name": "old", "position_m": PLANE, "fixed": {**weight, **more}})
    return body


def as_unbalance(body: dict[str, Any] = BODY, mass_kg: float = KG) -> dict[str, Any]:
    body, size = copy.deepcopy(body), mass_kg * RADIUS
    body["machine"]["unbalances"] = [
        {
            "name": "old",
            "position_m": PLANE,
            "x_kg_m": size * float(np.cos(np.radians(AT))),
            "y_kg_m": size * float(np.sin(np.radians(AT))),
        }
    ]
    return body


@pytest.mark.parametrize(
    "objective",
    [
        {},
        {"combine": "max"},
        {"force_ceiling_N": 14500.0},
        {"bearing_weight": 1.0},
        {"orders": "all", "least_mass": False},
    ],
)
def test_nothing_else_is_chosen_than_with_an_unbalance_of_the_shaft(objective: dict[str, Any]) -> None:
    """Independent: for the program it is an unbalance of the shaft."""
    fixed, shaft = (optimized({**body, "objective": objective}) for body in (with_fixed(), as_unbalance()))
    assert fixed.status == shaft.status == "optimal"
    *chosen, old = fixed.counterweights
    assert [counterweight.mass_kg for counterweight in chosen] == pytest.approx(
        [counterweight.mass_kg for counterweight in shaft.counterweights], rel=1e-4
    )
    assert (old.mass_kg, old.angle_deg, old.radius_m, old.fixed, old.active_limits) == (KG, AT, RADIUS, True, ())
    assert fixed.total_mass_kg == pytest.approx(KG + sum(counterweight.mass_kg for counterweight in chosen), rel=1e-12)
    before, after = fixed.residual.before, fixed.residual.after
    assert after is not None
    assert shaft.residual.after is not None
    assert after.force.peak_N == pytest.approx(shaft.residual.after.force.peak_N, rel=1e-4)
    assert before.force.peak_N == pytest.approx(optimized(BODY).residual.before.force.peak_N, rel=1e-12)
    certificate, second_certificate = fixed.certificate, shaft.certificate
    assert certificate is not None
    assert second_certificate is not None
    assert certificate.lower_bound == pytest.approx(second_certificate.lower_bound, rel=1e-6)
    assert certificate.yardstick == pytest.approx(second_certificate.yardstick, rel=1e-12)
    assert (certificate.mass_lower_bound_kg or 0.0) == pytest.approx(
        (second_certificate.mass_lower_bound_kg or -KG) + KG, rel=1e-4
    )


@pytest.mark.parametrize(("angle", "number"), [(-30.0, 330.0), (390.0, 30.0), (360.0, 0.0)])
def test_its_angle_is_told_within_one_turn(angle: float, number: float) -> None:
    counterweights = {
        counterweight.web: counterweight for counterweight in optimized(with_fixed(angle_deg=angle)).counterweights
    }
    assert counterweights["old"].angle_deg == pytest.approx(number, abs=1e-9)


def test_its_mass_counts_in_the_budget() -> None:
    body, payload = with_fixed(), as_unbalance()
    body["machine"]["max_total_mass_kg"], payload["machine"]["max_total_mass_kg"] = 8.0, 8.0 - KG
    fixed, shaft = optimized(body), optimized(payload)
    assert fixed.total_mass_kg == pytest.approx(8.0, rel=1e-5)
    assert fixed.active_limits == shaft.active_limits == ("max_total_mass",)
    assert fixed.certificate is not None
    assert shaft.certificate is not None
    assert fixed.certificate.objective == pytest.approx(shaft.certificate.objective, rel=1e-6)


def test_scenarios_have_it() -> None:
    changes = [{"path": "/machine/throws/0/rotating_mass_kg", "value": 6}]
    scenarios = {"scenarios": [{"name": "as given", "changes": []}, {"name": "heavy", "changes": changes}]}
    fixed, shaft = (optimized({**body, **scenarios}) for body in (with_fixed(), as_unbalance()))
    assert fixed.worst_case is not None
    assert shaft.worst_case is not None
    assert fixed.worst_case.force_peak_N == pytest.approx(shaft.worst_case.force_peak_N, rel=1e-4)


def test_it_is_analyzed_though_nobody_names_it() -> None:
    answer = analyze(AnalyzeRequest.model_validate({"machine": with_fixed()["machine"]}))
    shaft = analyze(AnalyzeRequest.model_validate({"machine": as_unbalance()["machine"]}))
    assert answer.total_mass_kg == KG
    assert answer.residual is not None
    assert answer.residual.after is not None
    assert shaft.residual is not None
    assert answer.residual.after.moment.peak_Nm == pytest.approx(shaft.residual.before.moment.peak_Nm, rel=1e-12)


def test_rows_of_a_sweep_are_single_answers() -> None:
    axes = [{"path": "/machine/webs/2/fixed/mass_kg", "values": [0.0, KG, 50.0]}]
    base = with_fixed()
    base["machine"]["max_total_mass_kg"] = 20
    request = SweepRequest.model_validate({"base": base, "axes": axes})
    table = run_chunk(request.model_dump_json().encode(), 0, 3).to_pylist()
    assert table[2]["status"] == "invalid"
    assert table[2]["message"].startswith("/machine/max_total_mass_kg: ")
    for row, mass in zip(table[:2], (0.0, KG), strict=True):
        body = copy.deepcopy(base)
        body["machine"]["webs"][2]["fixed"]["mass_kg"] = mass
        alone = optimized(body)
        assert row["mass_kg.old"] == mass
        assert row["total_mass_kg"] == pytest.approx(alone.total_mass_kg, rel=1e-12)
        assert alone.residual.after is not None
        assert row["force_peak_N"] == pytest.approx(alone.residual.after.force.peak_N, rel=1e-12)
        assert alone.certificate is not None
        assert row["lower_bound"] == pytest.approx(alone.certificate.lower_bound, rel=1e-12)


def test_points_of_a_front_have_it() -> None:
    fixed, shaft = (
        pareto(ParetoRequest.model_validate({**body, "points": 3})).fronts[0] for body in (with_fixed(), as_unbalance())
    )
    for point, second_point in zip(fixed.points, shaft.points, strict=True):
        assert point.force_peak_N == pytest.approx(second_point.force_peak_N, rel=1e-4)
        assert point.total_mass_kg == pytest.approx(second_point.total_mass_kg + KG, rel=1e-3)


def test_the_checker_finds_a_fixed_weight_that_moved() -> None:
    body = with_fixed()
    answer = optimized(body).model_dump(mode="json")
    assert not broken(body, answer)
    answer["counterweights"][2]["mass_kg"] *= 1.01
    assert any("fixed" in claim for claim in broken(body, answer))


@pytest.mark.parametrize(
    ("change", "pointer"),
    [
        ({"fixed": {"mass_kg": -1, "angle_deg": 0, "radius_m": 0.1}}, ("fixed", "mass_kg")),
        ({"fixed": {"mass_kg": 1, "angle_deg": 0, "radius_m": 0}}, ("fixed", "radius_m")),
        ({"fixed": {"mass_kg": 1, "angle_deg": 0}}, ("fixed", "radius_m")),
        ({"max_mass_kg": 1}, ("fixed", "mass_kg")),
        ({"sector": {"centre_deg": 0, "half_angle_deg": 10}}, ("sector",)),
        ({"hole_angles_deg": [0]}, ("hole_angles_deg",)),
    ],
)
def test_bad_input_names_the_field(change: dict[str, Any], pointer: tuple[str, ...]) -> None:
    body = with_fixed()
    body["machine"]["webs"][2] |= change
    with pytest.raises(ValidationError) as refused:
        OptimizeRequest.model_validate(body)
    (problem, *_) = refused.value.errors()
    problems = problem.get("ctx", {}).get("problems", [])
    path = problems[0].path if problems else problem["loc"][-len(pointer) :]
    assert tuple(path) == pointer


def test_heavier_than_all_that_is_allowed() -> None:
    body = with_fixed()
    body["machine"]["max_total_mass_kg"] = KG - 1
    with pytest.raises(ValidationError, match="the fixed counterweights are heavier"):
        OptimizeRequest.model_validate(body)


def test_no_other_counterweight_in_its_place() -> None:
    counterweights = [{"web": "old", "mass_kg": 1, "angle_deg": 0}]
    with pytest.raises(ValidationError, match="fixed in the machine, as another one"):
        AnalyzeRequest.model_validate_json(
            json.dumps({"machine": with_fixed()["machine"], "counterweights": counterweights})
        )
