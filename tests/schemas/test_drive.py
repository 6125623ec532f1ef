"""Friction, flywheel and bearings: what is refused, and where the refusal points."""

import copy
from typing import Any

import pytest
from pydantic import ValidationError

from schemas.machine.reciprocating import ReciprocatingMachine

ROW = {"axis_deg": 0.0, "reciprocating_mass_kg": 1.0}
BODY: dict[str, Any] = {
    "kind": "reciprocating",
    "speed_rpm": 500.0,
    "throws": [
        {"position_m": 0.0, "crank_radius_m": 0.1, "crank_angle_deg": 0.0, "rows": [ROW]},
        {"position_m": 1.0, "crank_radius_m": 0.1, "crank_angle_deg": 90.0, "rows": [ROW, ROW | {"axis_deg": 90.0}]},
    ],
}


def refused(**more: Any) -> list[str]:
    """Paths of what is wrong, joined by slashes."""
    with pytest.raises(ValidationError) as caught:
        ReciprocatingMachine.model_validate(copy.deepcopy(BODY) | more)
    texts = []
    for detail in caught.value.errors():
        problems = detail.get("ctx", {}).get("problems")
        inner = [problem.path for problem in problems] if problems else [()]
        texts += ["/".join(map(str, (*detail["loc"], *path))) for path in inner]
    return texts


def bearings(*positions: float) -> list[dict[str, Any]]:
    return [{"name": f"B{k}", "position_m": position} for k, position in enumerate(positions)]


@pytest.mark.parametrize(
    ("more", "where"),
    [
        ({"friction": {}}, "friction/mechanical_efficiency"),
        ({"friction": {"mechanical_efficiency": 1.01}}, "friction/mechanical_efficiency"),
        ({"friction": {"mechanical_efficiency": 0.0}}, "friction/mechanical_efficiency"),
        (
            {"friction": {"mechanical_efficiency": 0.9, "rotating_torque_Nm": 1.0}},
            "friction/mechanical_efficiency",
        ),
        (
            {"friction": {"rotating_torque_Nm": 1.0, "indicated_power_W": [1.0, 1.0, 1.0]}},
            "friction/indicated_power_W",
        ),
        (
            {"friction": {"mechanical_efficiency": 0.9, "indicated_power_W": [1.0]}},
            "friction/indicated_power_W",
        ),
        ({"friction": {"reciprocating_force_N": [1.0, 1.0]}}, "friction/reciprocating_force_N"),
        ({"friction": {"mechanical_efficiency": 0.9, "reciprocating_share": 1.1}}, "friction/reciprocating_share"),
        ({"flywheel": {}}, "flywheel/irregularity"),
        ({"flywheel": {"irregularity": 0.01, "inertia_kg_m2": 10.0}}, "flywheel/irregularity"),
        ({"flywheel": {"irregularity": 0.0}}, "flywheel/irregularity"),
        ({"flywheel": {"inertia_kg_m2": -1.0}}, "flywheel/inertia_kg_m2"),
        ({"bearings": bearings(0.0)}, "bearings"),
        ({"bearings": bearings(0.0, 1.0, 1.0)}, "bearings/2/position_m"),
        ({"bearings": bearings(0.0, 1.0, 1.0 + 1e-9)}, "bearings/2/position_m"),
        ({"bearings": [{"name": "A", "position_m": 0.0}, {"name": "A", "position_m": 1.0}]}, "bearings/1/name"),
    ],
)
def test_refused(more: dict[str, Any], where: str) -> None:
    assert refused(**more) == [where]


@pytest.mark.parametrize(
    "more",
    [
        {"friction": {"mechanical_efficiency": 1.0}},
        {"friction": {"mechanical_efficiency": 0.94, "indicated_power_W": [1.0, 0.0, 2.0]}},
        {"friction": {"reciprocating_force_N": [1.0, 2.0, 3.0], "rotating_torque_Nm": "3 N m"}},
        {"friction": {"rotating_torque_Nm": 3.0}},
        {"flywheel": {"inertia_kg_m2": 12.0}},
        {"bearings": bearings(-1.0, 2.0, 0.5)},
    ],
)
def test_accepted(more: dict[str, Any]) -> None:
    ReciprocatingMachine.model_validate(copy.deepcopy(BODY) | more)


def test_more_rows_than_a_machine_may_hold_are_refused() -> None:
    throw = BODY["throws"][0] | {"rows": [ROW] * 60}
    assert refused(throws=[throw] * 9) == ["throws"]
    ReciprocatingMachine.model_validate(BODY | {"throws": [throw] * 8})
