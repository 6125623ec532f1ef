"""Masses from lists of parts, and weights on bearings and foundation."""

import copy
import json
from typing import Any

import pytest

from optimizer.analyze import analyze
from optimizer.mechanics.weight import GRAVITY
from schemas.answer.loads import Loads
from schemas.request.requests import AnalyzeRequest
from service.common.validation import InvalidRequest, check
from service.documents.examples import load
from tests.verification.checking import optimized

MACHINE = json.loads(load("2d12"))["machine"]
#: the 2D12 prints 277.79 kg in one sum: these parts have that sum
PARTS = [
    {"name": "piston", "mass_kg": 120.0},
    {"name": "piston rod", "mass_kg": 47.79},
    {"name": "crosshead with its pin", "mass_kg": 110.0},
    {"name": "shells of the big end", "mass_kg": 4.0, "motion": "rotating"},
]


def in_parts() -> dict[str, Any]:
    machine = copy.deepcopy(MACHINE)
    row = machine["throws"][0]["rows"][0]
    del row["reciprocating_mass_kg"], row["connecting_rod"]["reciprocating_share"]
    row["parts"] = PARTS
    # 0.3 of the rod, as the 2D12 shares it
    row["connecting_rod"]["centre_of_mass_m"] = 0.3 * row["connecting_rod"]["length_m"]
    return machine


def loads(machine: dict[str, Any], **more: Any) -> Loads:
    request = {"machine": machine, "outputs": ["loads"], "angles": {"step_deg": 10}, **more}
    forces = analyze(AnalyzeRequest.model_validate(request)).loads
    assert forces is not None
    return forces


def test_masses_of_a_row_from_its_parts_published() -> None:
    """303.60 kg reciprocate; 0.7 of 86.025 kg and the shells turn."""
    row = loads(in_parts()).rows[0]
    assert row.reciprocating_mass_kg == pytest.approx(303.60, abs=5e-3)
    assert row.rod_rotating_mass_kg == pytest.approx(0.7 * 86.025)
    assert row.rotating_mass_kg == pytest.approx(0.7 * 86.025 + 4.0)
    assert loads(in_parts()).throws[0].rotating_mass_kg == pytest.approx(12.0 + 0.7 * 86.025 + 4.0)


def test_parts_are_optimised_as_their_sums_analytic() -> None:
    """The checker, which adds them up by itself, goes through both answers."""
    whole = copy.deepcopy(MACHINE)
    whole["throws"][0]["rotating_mass_kg"] += 4.0
    ours, answer = optimized({"machine": in_parts()}), optimized({"machine": whole})
    assert ours.certificate is not None
    assert answer.certificate is not None
    rest, same = (optimum.certificate.objective_without_counterweights for optimum in (ours, answer))
    assert rest == pytest.approx(same, rel=1e-12)
    assert ours.certificate.objective == pytest.approx(answer.certificate.objective, abs=1e-5 * rest)
    assert ours.total_mass_kg == pytest.approx(answer.total_mass_kg, rel=1e-4)


def test_weights_on_the_bearings_analytic() -> None:
    """Lever rule by hand: an upright row at 0.1 m between bearings at 0 and 0.4 m, a flywheel beyond at 0.6 m."""
    machine = {
        "kind": "reciprocating",
        "speed_rpm": 300,
        "gravity_deg": 270,
        "stationary_mass_kg": 1000,
        "throws": [
            {
                "position_m": 0.1,
                "crank_radius_m": 0.05,
                "crank_angle_deg": 0,
                "rotating_mass_kg": 8,
                "rows": [
                    {"axis_deg": 90, "reciprocating_mass_kg": 6, "connecting_rod": {"length_m": 0.2, "mass_kg": 3}}
                ],
            }
        ],
        "webs": [{"name": "w", "position_m": 0.2, "counterweight_radius_m": 0.1, "max_mass_kg": 10}],
        "shaft_parts": [{"name": "flywheel", "mass_kg": 20, "position_m": 0.6}],
        "bearings": [{"name": "A", "position_m": 0}, {"name": "B", "position_m": 0.4}],
    }
    fitted = [{"web": "w", "mass_kg": 5, "angle_deg": 180}]
    document = loads(machine, counterweights=fitted)
    at_b = [(8 + 6 + 3) * 0.1 / 0.4 + 5 * 0.2 / 0.4 + 20 * 0.6 / 0.4]
    at_a = [(8 + 6 + 3 + 5 + 20) - at_b[0]]
    assert [bearing_weight.y_N for bearing_weight in document.bearing_weights] == pytest.approx(
        [-GRAVITY * at_a[0], -GRAVITY * at_b[0]]
    )
    assert [bearing_weight.x_N for bearing_weight in document.bearing_weights] == pytest.approx([0.0, 0.0], abs=1e-9)
    # at A the flywheel lifts more than all the rest presses
    assert [bearing_weight.weight_N for bearing_weight in document.bearing_weights] == pytest.approx(
        [GRAVITY * abs(at_a[0]), GRAVITY * at_b[0]]
    )
    assert document.foundation_weight_N == pytest.approx(GRAVITY * (1000 + 8 + 6 + 3 + 5 + 20))
    # a level row leans on its guide instead, and without a direction nothing is said of it
    lying = loads({**machine, "gravity_deg": 0.0}, counterweights=fitted)
    assert sum(bearing_weight.x_N or 0.0 for bearing_weight in lying.bearing_weights) == pytest.approx(
        GRAVITY * (8 + 2 + 5 + 20)
    )
    unsaid = loads({**machine, "gravity_deg": None, "stationary_mass_kg": None}, counterweights=fitted)
    assert [(bearing_weight.x_N, bearing_weight.y_N) for bearing_weight in unsaid.bearing_weights] == [(None, None)] * 2
    assert unsaid.foundation_weight_N is None


ROW = ("machine", "throws", 0, "rows", 0)


@pytest.mark.parametrize(
    ("change", "path"),
    [
        ({"parts": [{"name": "piston"}]}, (*ROW, "parts", 0, "mass_kg")),
        ({"parts": [{"name": "piston", "mass_kg": -1}]}, (*ROW, "parts", 0, "mass_kg")),
        ({"parts": [*PARTS, PARTS[0]]}, (*ROW, "parts", 4, "name")),
        ({"parts": []}, (*ROW, "reciprocating_mass_kg")),
        ({"connecting_rod": {"length_m": None, "centre_of_mass_m": 0.2}}, (*ROW, "connecting_rod", "centre_of_mass_m")),
        ({"connecting_rod": {"length_m": 0.7, "centre_of_mass_m": 0.8}}, (*ROW, "connecting_rod", "centre_of_mass_m")),
        (
            {"connecting_rod": {"length_m": 0.7, "centre_of_mass_m": 0.2, "reciprocating_share": 0.3}},
            (*ROW, "connecting_rod", "centre_of_mass_m"),
        ),
    ],
)
def test_parts_that_are_wrong(change: dict[str, Any], path: tuple[str | int, ...]) -> None:
    machine = in_parts()
    machine["throws"][0]["rows"][0] |= change
    with pytest.raises(InvalidRequest) as caught:
        check(AnalyzeRequest, {"machine": machine, "outputs": ["loads"]})
    assert [problem.path for problem in caught.value.problems] == [path]
