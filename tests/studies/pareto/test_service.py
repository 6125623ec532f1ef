"""Fronts over REST and on the command line, and what is refused."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient
from typer.testing import CliRunner

from service.app import create_app
from service.cli import app
from service.settings import Settings
from tests.studies.pareto.cases import four_webs, single_row, straight

runner = CliRunner()


@pytest.fixture(scope="module")
def client() -> Any:
    # ready at once: programs are compiled when they are first needed
    with TestClient(create_app(Settings(), warm=False)) as client:
        while client.get("/readyz").status_code != 200:
            pass
        yield client


@pytest.fixture
def write(tmp_path: Path) -> Callable[..., str]:
    def write(body: object) -> str:
        path = tmp_path / "request.json"
        path.write_text(json.dumps(body))
        return str(path)

    return write


def without_times(answer: dict[str, Any]) -> dict[str, Any]:
    effects = {name: {**use, "time_ms": 0} for name, use in answer["effects"].items()}
    return {**answer, "timing": None, "effects": effects}


def test_route_answers_with_fronts(client: TestClient) -> None:
    response = client.post(
        "/v1/pareto", json={"machine": four_webs(), "points": 3, "total_mass_budgets_kg": ["20 lb", 40]}
    )
    assert response.status_code == 200
    assert response.headers["cache-control"] == "no-store"
    answer = response.json()
    assert answer["status"] == "optimal"
    assert [front["max_total_mass_kg"] for front in answer["fronts"]] == [9.0718474, 40]
    for frontier in answer["fronts"]:
        assert len(frontier["points"]) == 3
        for point in frontier["points"]:
            assert [counterweight["web"] for counterweight in point["counterweights"]] == ["a", "b", "c", "d"]


def test_default_is_one_front_of_21_points(client: TestClient) -> None:
    answer = client.post("/v1/pareto", json={"machine": straight()}).json()
    assert [len(front["points"]) for front in answer["fronts"]] == [21]


def test_infeasible_is_answered_with_200(client: TestClient) -> None:
    response = client.post("/v1/pareto", json={"machine": single_row(), "objective": {"force_ceiling_N": 1}})
    assert response.status_code == 200
    assert response.json()["status"] == "infeasible"
    assert response.json()["fronts"][0]["infeasibility"]["conflict"] == ["force_ceiling_N"]


@pytest.mark.parametrize(
    ("fields", "pointer"),
    [
        ({"points": 1}, "/points"),
        ({"points": 202}, "/points"),
        ({"points": 2.5}, "/points"),
        ({"points": "21"}, "/points"),
        ({"points": True}, "/points"),
        ({"points": None}, "/points"),
        ({"total_mass_budgets_kg": []}, "/total_mass_budgets_kg"),
        ({"total_mass_budgets_kg": 5}, "/total_mass_budgets_kg"),
        ({"total_mass_budgets_kg": list(range(11))}, "/total_mass_budgets_kg"),
        ({"total_mass_budgets_kg": [5, -1]}, "/total_mass_budgets_kg/1"),
        ({"total_mass_budgets_kg": [5, "5 m"]}, "/total_mass_budgets_kg/1"),
        ({"total_mass_budgets_kg": [5, None]}, "/total_mass_budgets_kg/1"),
        ({"total_mass_budgets_kg": [5, 6, 5.0]}, "/total_mass_budgets_kg/2"),
        ({"points": 201, "total_mass_budgets_kg": [1, 2, 3]}, "/points"),
        ({"front": 1}, "/front"),
        ({"objective": {"force_ceiling_N": "1 kg"}}, "/objective/force_ceiling_N"),
        ({"outputs": ["front"]}, "/outputs/0"),
    ],
)
def test_refusals_name_the_field(client: TestClient, fields: dict[str, Any], pointer: str) -> None:
    response = client.post("/v1/pareto", json={"machine": straight(), **fields})
    assert response.status_code == 422
    assert response.headers["content-type"] == "application/problem+json"
    assert [error["pointer"] for error in response.json()["errors"]] == [pointer]


def test_too_large_together_is_refused(client: TestClient) -> None:
    webs = [{**four_webs()["webs"][0], "name": str(k)} for k in range(200)]
    response = client.post("/v1/pareto", json={"machine": {**four_webs(), "webs": webs}, "points": 201})
    assert response.status_code == 422
    assert [error["pointer"] for error in response.json()["errors"]] == ["/points"]


def test_command_line_prints_a_table(write: Callable[..., str]) -> None:
    result = runner.invoke(app, ["pareto", write({"machine": straight()}), "--points", "5"])
    assert result.exit_code == 0
    assert "Front, no limit of the total mass: optimal" in result.stdout
    rows = [line for line in result.stdout.splitlines() if line.startswith("│")]
    assert len([line for line in rows if line.split("│")[1].strip().isdigit()]) == 5
    assert "Proven: no counterweights reach below" in result.stdout


def test_command_line_shows_weighted_peaks_knee_and_budgets(write: Callable[..., str]) -> None:
    body = {"machine": four_webs(), "points": 5, "objective": {"direction_weights": {"x": 1, "y": 0.5}}}
    result = runner.invoke(app, ["pareto", write(body), "--budget", "30", "--budget", "90 lb"])
    assert result.exit_code == 0
    for text in ("weighted force,", "total mass up to 30 kg", "total mass up to 40.8233 kg", "largest mass", "knee"):
        assert text in result.stdout


def test_command_line_prints_the_rest_answer(client: TestClient, write: Callable[..., str]) -> None:
    body = {"machine": four_webs(), "points": 3}
    result = runner.invoke(app, ["pareto", write(body), "--json"])
    assert result.exit_code == 0
    assert without_times(json.loads(result.stdout)) == without_times(client.post("/v1/pareto", json=body).json())


def test_command_line_reads_standard_input_and_options_replace_fields() -> None:
    body = json.dumps({"machine": straight(), "points": 7, "total_mass_budgets_kg": [1]})
    result = runner.invoke(
        app, ["pareto", "-", "--points", "4", "--budget", "2", "--budget", "3", "--json"], input=body
    )
    assert result.exit_code == 0
    fronts = json.loads(result.stdout)["fronts"]
    assert [(front["max_total_mass_kg"], len(front["points"])) for front in fronts] == [(2, 4), (3, 4)]


def test_command_line_says_infeasible_with_code_1(write: Callable[..., str]) -> None:
    body = {"machine": single_row(), "objective": {"force_ceiling_N": 1}}
    result = runner.invoke(app, ["pareto", write(body)])
    assert result.exit_code == 1
    assert "the ceiling of the force cannot be met" in result.stdout


def test_command_line_says_that_nothing_is_traded(write: Callable[..., str]) -> None:
    result = runner.invoke(app, ["pareto", write({"machine": single_row()})])
    assert result.exit_code == 0
    assert "nothing has to be traded" in result.stdout


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--points", "1"], "/points: must be at least 2"),
        (["--points", "2.5"], "Invalid value"),
        (["--budget", "3 m"], "/total_mass_budgets_kg/0: unit must be one of kg, g, t, lb"),
        (["--budget", "nan"], "/total_mass_budgets_kg/0: "),
        (["--budget", "3", "--budget", "3.0"], "/total_mass_budgets_kg/1: this budget is in the list already"),
    ],
)
def test_command_line_refuses_with_code_2(write: Callable[..., str], arguments: list[str], message: str) -> None:
    result = runner.invoke(app, ["pareto", write({"machine": straight()}), *arguments])
    assert result.exit_code == 2
    assert message in result.stderr
    assert not result.stdout
