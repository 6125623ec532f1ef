"""The command line: tables over the turn, ratings, effects."""

import json
import re
from typing import Any

import pytest

from schemas.answer.effects import EffectCatalogue
from schemas.rating.answer import RatingAnswer
from service.common.examples import directory
from service.documents.examples import bodies, names
from tests.service.test_cli import refused, run
from tests.service.test_dynamics import OVER_THE_TURN

SHOWN = {
    "kinematics": ("Motion", "I: velocity, m/s", "7.47575", "460.582"),
    "gas": ("suction opens, deg", "36.873", "286.5", "indicated power, W", "machine", "gas force over the cycle, N"),
    "piston_force": ("I: gas", "II: inertia", "I: sum", "piston force over the cycle, N"),
    "rod_loads": ("sudden stop", "(governs)", "tangential", "largest rod force of the machine"),
    "torque": (
        "Mean torque of the rows",
        "shaft power, W",
        "ΔE, J",
        "of its error, J",
        "tangential force, N",
        " 330 │",
    ),
    "flywheel": ("irregularity", "moment of inertia J", "MD2 = 4 J, kg m2"),
    "overturning": ("Overturning couple", "machine", "largest couple over the cycle, N m"),
    "main_bearings": ("every span simply supported", "peak without", "peak with", "Largest bending moment"),
}


def output_options(outputs: list[str]) -> list[str]:
    return [argument for output in outputs for argument in ("--output", output)]


def example(name: str = "2d12") -> str:
    return str(directory() / f"{name}.json")


@pytest.mark.parametrize("command", ["analyze", "optimize"])
@pytest.mark.parametrize("output", OVER_THE_TURN)
def test_tables(command: str, output: str) -> None:
    result = run(command, example(), "--output", output)
    assert result.exit_code == 0
    for text in SHOWN[output]:
        assert text in result.stdout
    # samples are summed up, not dumped
    assert len(result.stdout.splitlines()) < 160


def test_all_tables_together() -> None:
    result = run("analyze", example(), *output_options(OVER_THE_TURN))
    assert all(text in result.stdout for texts in SHOWN.values() for text in texts)


def test_an_infeasible_machine_has_loads_before_alone(body: dict[str, Any]) -> None:
    body["objective"] = {"force_ceiling_N": 1}
    result = run("optimize", "-", "--output", "main_bearings", stdin=json.dumps(body).encode())
    assert result.exit_code == 1
    assert "│ without counterweights " in result.stdout
    assert "│ with counterweights " not in result.stdout


@pytest.mark.parametrize("step_deg", [0.5, 7.2, 30, 72, 120])
def test_whatever_the_samples(body: dict[str, Any], step_deg: float) -> None:
    text = json.dumps(body | {"angles": {"step_deg": step_deg}}).encode()
    result = run("analyze", "-", *output_options(OVER_THE_TURN), stdin=text)
    assert result.exit_code == 0
    # regression: twelve angles at the most, or a few more where 30 degrees are no whole number of steps
    assert sum(line.startswith("│ ") for line in result.stdout.splitlines()) < 120


def test_rows_are_told_apart(body: dict[str, Any]) -> None:
    for throw in body["machine"]["throws"]:
        throw["rows"][0]["name"] = "[b]R"
    stdout = run("analyze", "-", "--output", "kinematics", stdin=json.dumps(body).encode()).stdout
    assert "│ 1-[b]R: velocity" in stdout
    assert "│ 2-[b]R: velocity" in stdout
    for throw in body["machine"]["throws"]:
        del throw["rows"][0]["name"]
    stdout = run("analyze", "-", "--output", "kinematics", stdin=json.dumps(body).encode()).stdout
    assert "│ 2-1: velocity" in stdout


def test_a_machine_without_rows(body: dict[str, Any]) -> None:
    for throw in body["machine"]["throws"]:
        del throw["rows"]
    del body["machine"]["friction"]
    result = run("analyze", "-", *output_options(OVER_THE_TURN), stdin=json.dumps(body).encode())
    assert result.exit_code == 0


def test_many_rows_stand_below_each_other() -> None:
    body = json.loads((directory() / "inline-six.json").read_bytes())
    first = bodies()["2d12"]["machine"]["throws"][0]["rows"][0]
    for throw in body["machine"]["throws"]:
        for row in throw["rows"]:
            row |= {"cylinder": first["cylinder"], "connecting_rod": {"length_m": 10}}
    result = run("analyze", "-", "--output", "torque", stdin=json.dumps(body).encode())
    assert result.exit_code == 0
    # the heading of a table, not the largest of all
    assert len(re.findall(r"^torque over the cycle, N m", result.stdout, re.MULTILINE)) == 2


def test_rating() -> None:
    result = run("rating", str(directory() / "rating" / "2d12.json"))
    assert result.exit_code == 0
    for text in (
        "2D12-90/2-20",
        " I ┃",
        " II ┃",
        "in cylinder",
        "discharge temperature, K",
        "delivery coefficient",
        "swept volume, m3",
        "bore, m",
        "0.73 ",
        "gas load at inner dead centre, N",
        "motor power, W",
        "stage I: the gas leaves the cylinder at",
    ):
        assert text in result.stdout


@pytest.mark.parametrize("name", bodies("rating"))
def test_json_of_a_rating_is_the_answer_of_the_service(client: Any, name: str) -> None:
    body = json.dumps(bodies("rating")[name]).encode()
    result = run("rating", "-", "--json", stdin=body)
    assert result.exit_code == 0
    RatingAnswer.model_validate_json(result.stdout)
    answer = client.post("/v1/rating", content=body, headers={"Content-Type": "application/json"})
    assert result.stdout == answer.text + "\n"


def test_bad_input_of_a_rating() -> None:
    body = bodies("rating")["2d12"]
    assert refused(run("rating", "-", stdin=b"{")) != []
    body["stages"][0]["relative_clearance"] = 5
    (line,) = refused(run("rating", "-", stdin=json.dumps(body).encode()))
    assert line.startswith("/stages/0/relative_clearance: too large")
    body["stages"][0]["relative_clearance"] = 0
    (line,) = refused(run("rating", "-", stdin=json.dumps(body).encode()))
    assert line.startswith("/stages/0/relative_clearance: must be ")


def test_effects(client: Any) -> None:
    result = run("effects")
    assert result.exit_code == 0
    for text in ("Outputs", "Effects", "torque_integrals", "machine.flywheel", "machine.bearings"):
        assert text in result.stdout
    assert run("effects", "--json").stdout == client.get("/v1/effects").text + "\n"
    EffectCatalogue.model_validate_json(run("effects", "--json").stdout)


def test_examples_of_ratings_are_no_machines() -> None:
    assert "2d12" in bodies("rating")
    assert "air-single-stage" not in names()


@pytest.mark.parametrize(
    ("name", "title"),
    [("rating", "Rating request"), ("rating-answer", "Rating answer"), ("effects", "Effect catalogue")],
)
def test_schemas(name: str, title: str) -> None:
    assert name in run("schema").stdout
    assert json.loads(run("schema", name).stdout)["title"] == title
