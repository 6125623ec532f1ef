"""Scroll pin loads over REST and on the command line; the mechanics are tested in tests/scroll."""

import json
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient
from typer.testing import CliRunner

from service.cli import app

PATH = "/v1/scroll/pin-loads"
EVEN: dict[str, Any] = {"pin_count": 3, "pin_circle_radius_m": 0.05, "rotation_torque_Nm": 12.5}
EXAMPLES = sorted((Path(__file__).parents[2] / "examples" / "pin-loads").glob("*.json"))


def test_the_formula(client: TestClient) -> None:
    answer = client.post(PATH, json=EVEN | {"angles": {"step_deg": 90}}).json()
    assert answer["angle_deg"] == [0, 90, 180, 270]
    most = 2 * 12.5 / (3 * 0.05)  # published: seed 003 eq (3)
    assert answer["pins"][0]["load_N"] == pytest.approx([0, most, 0, -most], abs=1e-10)
    assert answer["peak_N"] == pytest.approx(most)
    assert answer["half_turn_mechanism_peak_N"] == pytest.approx(2 * most)
    assert answer["equilibrium"]["holds"]
    assert answer["dead_points_deg"] == []


@pytest.mark.parametrize("count", [1, 2])
def test_too_few_pins_are_said(client: TestClient, count: int) -> None:
    answer = client.post(PATH, json=EVEN | {"pin_count": count}).json()
    assert not answer["equilibrium"]["holds"]
    assert answer["equilibrium"]["reason"]
    assert "too_few_pins" in [warning["code"] for warning in answer["warnings"]]
    assert answer["dead_points_deg"] == [0, 180]


@pytest.mark.parametrize(
    ("changes", "pointer"),
    [
        ({"pin_count": 0}, "/pin_count"),
        ({"pin_circle_radius_m": 0}, "/pin_circle_radius_m"),
        ({"rotation_torque_Nm": None}, "/rotation_torque_Nm"),
        ({"rotation_torque_Nm": {"angle_deg": [0, 90, 80], "torque_Nm": [1, 2, 3]}}, "/rotation_torque_Nm/angle_deg/2"),
        ({"rotation_torque_Nm": {"angle_deg": [0, 180], "torque_Nm": [1]}}, "/rotation_torque_Nm/torque_Nm"),
        ({"pins": [{"angle_deg": 0, "radius_m": 0.05}]}, "/pin_count"),
    ],
)
def test_bad_input_is_named(client: TestClient, changes: dict[str, Any], pointer: str) -> None:
    answer = client.post(PATH, json=EVEN | changes)
    assert answer.status_code == 422
    assert pointer in [error["pointer"] for error in answer.json()["errors"]]


@pytest.mark.parametrize(
    "pins",
    [
        [{"angle_deg": 0, "radius_m": 0.05}, {"angle_deg": 360, "radius_m": 0.05}, {"angle_deg": 90, "radius_m": 0.05}],
        [{"angle_deg": 0, "radius_m": 0.05, "stiffness_N_per_m": -1.0}],
    ],
)
def test_bad_pins_are_refused(client: TestClient, pins: list[dict[str, Any]]) -> None:
    answer = client.post(PATH, json={"pins": pins, "rotation_torque_Nm": 1.0})
    assert answer.status_code == 422
    assert all(error["pointer"].startswith("/pins/") for error in answer.json()["errors"])


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_examples_on_the_command_line(path: Path, client: TestClient) -> None:
    process = CliRunner().invoke(app, ["pin-loads", str(path)])
    assert process.exit_code == 0
    assert "largest load of any pin, N" in process.output
    exact = CliRunner().invoke(app, ["pin-loads", str(path), "--json"])
    assert json.loads(exact.output) == client.post(PATH, content=path.read_bytes(), headers=JSON).json()


JSON = {"content-type": "application/json"}


def test_output_of_a_scroll_machine(client: TestClient) -> None:
    body = client.get("/v1/examples/scroll-three-pins").json() | {"outputs": ["pin_loads"]}
    answer = client.post("/v1/optimize", json=body).json()
    assert answer["status"] == "optimal"
    assert answer["pin_loads"]["peak_N"] > 0
    example = Path(__file__).parents[2] / "examples" / "scroll-three-pins.json"
    process = CliRunner().invoke(app, ["analyze", str(example), "--output", "pin_loads"])
    assert "moment and net force are in balance at every angle" in process.output
