"""Checks over several fields, each with the path of the field that is wrong."""

from typing import Any

import pytest
from pydantic import BaseModel, ValidationError

from schemas.base.angles import Angles
from schemas.machine.cylinder import Cylinder
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.scroll_machine import ScrollMachine
from schemas.request.objective import DirectionWeights, Objective
from schemas.request.requests import AnalyzeRequest, OptimizeRequest

THROW: dict[str, Any] = {"position_m": 0, "crank_radius_m": 0.14, "crank_angle_deg": 0}
ROW: dict[str, Any] = {"axis_deg": 0, "reciprocating_mass_kg": 1}
WEB: dict[str, Any] = {"position_m": 0, "counterweight_radius_m": 0.2, "max_mass_kg": 1}


def piston(**changes: Any) -> dict[str, Any]:
    return {"kind": "reciprocating", "speed_rpm": 500, "throws": [THROW], **changes}


SCROLL: dict[str, Any] = {
    "kind": "scroll",
    "speed_rpm": 3000,
    "orbit_radius_m": 0.005,
    "orbiting_mass_kg": 1,
    "orbiting_position_m": 0,
    "anti_rotation": {"type": "oldham", "mass_kg": 0.1, "axis_deg": 0, "position_m": 0},
}


def problems(model: type[BaseModel], body: dict[str, Any]) -> list[tuple[tuple[str | int, ...], str]]:
    """Full path and message of every cross-field problem."""
    with pytest.raises(ValidationError) as caught:
        model.model_validate(body)
    errors = caught.value.errors()
    assert {e["type"] for e in errors} == {"cross_field"}
    return [(e["loc"] + tuple(p.path), p.message) for e in errors for p in e["ctx"]["problems"]]


def rod(length: float) -> dict[str, Any]:
    return {**ROW, "connecting_rod": {"length_m": length}}


named = [{**WEB, "name": name} for name in ("a", "b", "a", "a")]

CASES = [
    pytest.param(ReciprocatingMachine, piston(webs=named), [("webs", 2, "name"), ("webs", 3, "name")], id="webs"),
    pytest.param(ScrollMachine, {**SCROLL, "webs": named[:3]}, [("webs", 2, "name")], id="webs of a scroll"),
    pytest.param(
        ReciprocatingMachine,
        piston(throws=[{**THROW, "name": "1"}, {**THROW, "name": "1"}, THROW, THROW]),
        [("throws", 1, "name")],
        id="throws, and none of them need a name",
    ),
    pytest.param(
        ReciprocatingMachine,
        piston(throws=[{**THROW, "rows": [ROW, {**ROW, "name": "I"}, ROW, {**ROW, "name": "I"}]}]),
        [("throws", 0, "rows", 3, "name")],
        id="rows",
    ),
    pytest.param(
        ReciprocatingMachine,
        piston(throws=[THROW, {**THROW, "rows": [rod(0.15), rod(0.14), rod(0.1)]}]),
        [
            ("throws", 1, "rows", 1, "connecting_rod", "length_m"),
            ("throws", 1, "rows", 2, "connecting_rod", "length_m"),
        ],
        id="rods not longer than the crank",
    ),
    pytest.param(
        ReciprocatingMachine,
        piston(webs=named[1:], throws=[{**THROW, "rows": [rod(0.1)]}]),
        [("webs", 2, "name"), ("throws", 0, "rows", 0, "connecting_rod", "length_m")],
        id="several at once",
    ),
    pytest.param(DirectionWeights, {"x": 0, "y": 0}, [("y",)], id="direction weights"),
    pytest.param(Objective, {"force_weight": 0, "moment_weight": 0}, [("moment_weight",)], id="weights"),
    pytest.param(Angles, {"step_deg": 7}, [("step_deg",)], id="step"),
    pytest.param(
        Cylinder,
        {"suction_pressure_Pa": "3 bar", "discharge_pressure_Pa": "2 bar"},
        [("discharge_pressure_Pa",)],
        id="pressures",
    ),
    pytest.param(
        Cylinder,
        {
            "head": {"suction_pressure_Pa": 3, "discharge_pressure_Pa": 2},
            "crank": {"suction_pressure_Pa": 3, "discharge_pressure_Pa": 2},
        },
        [("head", "discharge_pressure_Pa"), ("crank", "discharge_pressure_Pa")],
        id="pressures of one side",
    ),
    pytest.param(
        Cylinder, {"bore_m": 0.1, "piston_rod_diameter_m": 0.1}, [("piston_rod_diameter_m",)], id="piston rod"
    ),
    pytest.param(
        Cylinder,
        {"bore_m": 0.1, "head_area_m2": 0.1, "crank_area_m2": 0.1},
        [("head_area_m2",), ("crank_area_m2",)],
        id="bore and areas",
    ),
    pytest.param(
        AnalyzeRequest,
        {
            "machine": piston(webs=named[:2]),
            "counterweights": [{"web": w, "mass_kg": 1, "angle_deg": 0} for w in ("a", "c", "b", "a")],
        },
        [("counterweights", 1, "web"), ("counterweights", 3, "web")],
        id="counterweights",
    ),
]


@pytest.mark.parametrize(("model", "body", "paths"), CASES)
def test_the_field_is_named(model: type[BaseModel], body: dict[str, Any], paths: list[tuple[str | int, ...]]) -> None:
    actual_problems = problems(model, body)
    assert [path for path, _ in actual_problems] == paths
    assert all(message for _, message in actual_problems)


def test_the_path_goes_on_from_the_model_that_found_it() -> None:
    actual_problems = problems(
        OptimizeRequest, {"machine": piston(webs=named[:3]), "objective": {"direction_weights": {"x": 0, "y": 0}}}
    )
    assert [path for path, _ in actual_problems] == [
        ("machine", "reciprocating", "webs", 2, "name"),
        ("objective", "direction_weights", "y"),
    ]


@pytest.mark.parametrize(
    ("model", "body"),
    [
        pytest.param(DirectionWeights, {"x": 0}, id="one direction weight may be 0"),
        pytest.param(Objective, {"force_weight": 0}, id="a moment weight of null is not 0"),
        pytest.param(Angles, {"step_deg": 0.1}, id="a step that is not exact in binary"),
        pytest.param(Cylinder, {"suction_pressure_Pa": 1, "discharge_pressure_Pa": 1}, id="equal pressures"),
        pytest.param(Cylinder, {"head_area_m2": 0.1, "crank_area_m2": 0.1}, id="areas alone"),
        pytest.param(
            ReciprocatingMachine, piston(throws=[{**THROW, "rows": [rod(0.1400001)]}]), id="a rod just long enough"
        ),
        pytest.param(
            ReciprocatingMachine,
            piston(throws=[{**THROW, "rows": [{**ROW, "connecting_rod": {"length_m": None}}]}]),
            id="an infinite rod",
        ),
        pytest.param(
            ReciprocatingMachine,
            piston(throws=[{**THROW, "rows": [{**ROW, "name": "I"}]}, {**THROW, "rows": [{**ROW, "name": "I"}]}]),
            id="rows of different throws",
        ),
        pytest.param(AnalyzeRequest, {"machine": piston(webs=named[:2])}, id="no counterweights"),
    ],
)
def test_what_is_allowed(model: type[BaseModel], body: dict[str, Any]) -> None:
    model.model_validate(body)


def test_the_number_of_samples() -> None:
    assert Angles().count == 360
    assert Angles(step_deg=0.1).count == 3600
    assert Angles(step_deg=120).count == 3
