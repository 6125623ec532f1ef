"""Outputs over the turn through the door: what they hold, what they need, what is refused and where."""

import copy
import json
from collections.abc import Callable
from typing import Any

import pytest
from starlette.testclient import TestClient

from schemas.answer.answers import AnalyzeAnswer, OptimizeAnswer

Post = Callable[..., Any]
OVER_THE_TURN = [
    "kinematics",
    "gas",
    "piston_force",
    "rod_loads",
    "torque",
    "flywheel",
    "overturning",
    "main_bearings",
]
PATHS = ["/v1/optimize", "/v1/analyze"]
ROW = "/machine/throws/0/rows/0"
MISSING = object()


def change(body: dict[str, Any], path: str, value: object) -> None:
    """Set what stands at a pointer, or take it away."""
    *way, last = [int(key) if key.isdecimal() else key for key in path.split("/")[1:]]
    node: Any = body
    for key in way:
        node = node[key]
    if value is MISSING:
        del node[last]
    else:
        node[last] = value


def pointers(answer: Any, kind: str) -> list[str]:
    assert answer.status_code == 422
    assert answer.headers["content-type"] == "application/problem+json"
    assert answer.json()["type"] == f"/problems/{kind}"
    return [error["pointer"] for error in answer.json()["errors"]]


@pytest.mark.parametrize("path", PATHS)
def test_every_output_over_the_turn(post: Post, body: dict[str, Any], path: str) -> None:
    answer = post(path, json.dumps(body | {"outputs": OVER_THE_TURN, "angles": {"step_deg": 30}}))
    assert answer.status_code == 200
    model = OptimizeAnswer if path == "/v1/optimize" else AnalyzeAnswer
    optimum = model.model_validate_json(answer.content)
    for name in OVER_THE_TURN:
        assert getattr(optimum, name) is not None
    assert optimum.torque is not None
    assert optimum.torque.angle_deg == tuple(range(0, 360, 30))
    # power is torque times angular speed, and what is not put into the gas is friction
    omega = 500 * 3.141592653589793 / 30
    assert optimum.torque.shaft_power_W == pytest.approx(optimum.torque.mean_torque_Nm * omega, rel=1e-12)
    powers = optimum.torque.indicated_power_W + optimum.torque.friction_power_W
    assert optimum.torque.shaft_power_W == pytest.approx(powers, rel=1e-9)
    assert optimum.flywheel is not None
    assert optimum.flywheel.inertia_MD2_kg_m2 == pytest.approx(4 * optimum.flywheel.inertia_J_kg_m2)


@pytest.mark.parametrize("output", OVER_THE_TURN)
def test_one_output_is_alone(post: Post, body: dict[str, Any], output: str) -> None:
    document = post("/v1/analyze", json.dumps(body | {"outputs": [output]})).json()
    assert [name for name in (*OVER_THE_TURN, "residual", "orders") if document[name] is not None] == [output]
    simulated = {name for name, use in document["effects"].items() if use["simulated"]}
    assert {name for name in simulated if document["effects"][name]["needed_by"] != [output]} == set()


def test_friction_is_left_out_where_the_machine_gives_none(post: Post, body: dict[str, Any]) -> None:
    del body["machine"]["friction"]
    document = post("/v1/analyze", json.dumps(body | {"outputs": ["torque"]})).json()
    assert document["torque"]["friction_power_W"] == 0
    assert not document["effects"]["friction"]["simulated"]


def test_a_continuous_shaft(post: Post, body: dict[str, Any]) -> None:
    payload = body | {"outputs": ["main_bearings"]}
    spans = post("/v1/analyze", json.dumps(payload)).json()["main_bearings"]
    shaft = post("/v1/analyze", json.dumps(payload | {"fidelity": {"shaft": "continuous"}})).json()["main_bearings"]
    assert (spans["shaft"], shaft["shaft"]) == ("simple_spans", "continuous")
    assert spans["bearings"][1]["before"]["peak_N"] != shaft["bearings"][1]["before"]["peak_N"]


@pytest.mark.parametrize("path", PATHS)
@pytest.mark.parametrize(
    ("output", "taken", "pointed"),
    [
        ("gas", f"{ROW}/cylinder", f"{ROW}/cylinder"),
        ("gas", f"{ROW}/cylinder/piston_rod_diameter_m", f"{ROW}/cylinder/piston_rod_diameter_m"),
        ("gas", f"{ROW}/cylinder/relative_clearance", f"{ROW}/cylinder/relative_clearance"),
        ("flywheel", "/machine/flywheel", "/machine/flywheel"),
        ("main_bearings", "/machine/bearings", "/machine/bearings"),
        ("kinematics", f"{ROW}/connecting_rod", f"{ROW}/connecting_rod"),
        ("overturning", f"{ROW}/connecting_rod", f"{ROW}/connecting_rod"),
    ],
)
def test_a_missing_input_is_named(
    post: Post, body: dict[str, Any], path: str, output: str, taken: str, pointed: str
) -> None:
    change(body, taken, MISSING)
    assert post(path, json.dumps(body)).status_code == 200
    answer = post(path, json.dumps(body | {"outputs": [output]}))
    assert pointers(answer, "missing-input") == [pointed]
    assert f"'{output}'" in answer.json()["errors"][0]["message"]


def test_inertia_needs_no_gas_data(post: Post, body: dict[str, Any]) -> None:
    # analytic: inertia does no work over a turn; loads without gas are those of "no load"
    friction = body["machine"].pop("friction")
    for throw in body["machine"]["throws"]:
        for row in throw["rows"]:
            row["cylinder"] = None
    payload = body | {"outputs": ["main_bearings", "rod_loads", "overturning", "torque", "piston_force"]}
    answer = post("/v1/analyze", json.dumps(payload))
    assert answer.status_code == 200
    document = answer.json()
    assert not document["effects"]["gas"]["simulated"]
    assert document["torque"]["indicated_power_W"] == 0
    assert abs(document["torque"]["mean_torque_Nm"]) < 1e-9 * max(document["torque"]["torque_Nm"])
    for row in document["rod_loads"]["rows"]:
        running, no_load, sudden_stop = row["cases"]
        assert running["tension_N"] == no_load["tension_N"] > 0
        assert sudden_stop["tension_N"] == sudden_stop["compression_N"] == 0
    # friction by the efficiency needs a power
    body["machine"]["friction"] = {**friction, "indicated_power_W": None}
    refused = post("/v1/analyze", json.dumps(body | {"outputs": ["torque"]}))
    assert pointers(refused, "missing-input") == ["/machine/friction/indicated_power_W"]


@pytest.mark.parametrize("output", OVER_THE_TURN)
def test_a_scroll_has_no_rows(client: TestClient, post: Post, output: str) -> None:
    body = client.get("/v1/examples/scroll-oldham").json() | {"outputs": [output]}
    assert pointers(post("/v1/analyze", json.dumps(body)), "missing-input") == ["/machine/kind"]


@pytest.mark.parametrize(
    ("path", "value", "pointed"),
    [
        (f"{ROW}/cylinder/discharge_pressure_Pa", 285999, None),
        (f"{ROW}/cylinder/head", {"suction_pressure_Pa": 852001}, f"{ROW}/cylinder/head/suction_pressure_Pa"),
        (f"{ROW}/cylinder/suction_pressure_Pa", 0, None),
        (f"{ROW}/cylinder/relative_clearance", 0, None),
        (f"{ROW}/cylinder/relative_clearance", -0.1, None),
        (f"{ROW}/cylinder/piston_rod_diameter_m", 0.73, None),
        (f"{ROW}/cylinder/head_area_m2", 0.4, None),
        (f"{ROW}/cylinder/expansion_exponent", 1, None),
        (f"{ROW}/cylinder/compression_exponent", 0.9, None),
        ("/machine/friction/mechanical_efficiency", 1.001, None),
        ("/machine/friction/mechanical_efficiency", 0, None),
        ("/machine/friction/rotating_torque_Nm", 400, "/machine/friction/mechanical_efficiency"),
        ("/machine/friction/indicated_power_W", [608300], None),
        ("/machine/friction", {"reciprocating_force_N": [1, 2, 3]}, "/machine/friction/reciprocating_force_N"),
        ("/machine/friction", {}, "/machine/friction/mechanical_efficiency"),
        ("/machine/flywheel", {}, "/machine/flywheel/irregularity"),
        ("/machine/flywheel/irregularity", 0, None),
        ("/machine/flywheel/inertia_kg_m2", 1000, "/machine/flywheel/irregularity"),
        ("/machine/bearings", [{"name": "A", "position_m": 0}], None),
        ("/machine/bearings/1/position_m", -0.4, None),
        ("/machine/bearings/1/name", "A", None),
        ("/machine/bearings", None, None),
        ("/angles", {"step_deg": 7}, "/angles/step_deg"),
        ("/angles", {"step_deg": 0.001}, "/angles/step_deg"),
        ("/fidelity", {"shaft": "stiff"}, "/fidelity/shaft"),
    ],
)
def test_bad_input_names_its_field(
    post: Post, body: dict[str, Any], path: str, value: object, pointed: str | None
) -> None:
    change(body, path, value)
    for route in PATHS:
        assert pointers(post(route, json.dumps(body | {"outputs": ["torque"]})), "invalid-request") == [pointed or path]


def test_a_clearance_that_lets_nothing_through(post: Post, body: dict[str, Any]) -> None:
    change(body, f"{ROW}/cylinder/relative_clearance", 5)
    answer = post("/v1/analyze", json.dumps(body | {"outputs": ["gas"]}))
    assert pointers(answer, "missing-input")[0] == f"{ROW}/cylinder/relative_clearance"


def test_an_infeasible_machine_has_its_dynamics_too(post: Post, body: dict[str, Any]) -> None:
    variant = copy.deepcopy(body) | {"outputs": OVER_THE_TURN, "objective": {"force_ceiling_N": 1}}
    answer = OptimizeAnswer.model_validate_json(post("/v1/optimize", json.dumps(variant)).content)
    assert answer.status == "infeasible"
    assert answer.main_bearings is not None
    assert [bearing.after for bearing in answer.main_bearings.bearings] == [None] * 3
    assert answer.torque is not None
