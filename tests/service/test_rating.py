"""POST /v1/rating: the thermal design through the door."""

import json
from collections.abc import Callable
from typing import Any

import pytest

from optimizer.rating.rate import rate
from schemas.rating.answer import RatingAnswer
from schemas.rating.request import RatingRequest
from service.documents.examples import bodies
from tests.rating.design import SEED
from tests.service.test_dynamics import MISSING, change, pointers

Post = Callable[..., Any]


@pytest.fixture
def design() -> dict[str, Any]:
    fields: dict[str, Any] = bodies("rating")["2d12"]
    return fields


def test_the_example_is_the_design_of_the_seed(design: dict[str, Any]) -> None:
    assert design == SEED


@pytest.mark.parametrize("name", bodies("rating"))
def test_every_example_can_be_posted(post: Post, name: str) -> None:
    body = json.dumps(bodies("rating")[name])
    answer = post("/v1/rating", body)
    assert answer.status_code == 200
    assert answer.headers["content-type"] == "application/json"
    assert answer.headers["cache-control"] == "no-store"
    assert RatingAnswer.model_validate_json(answer.content) == rate(RatingRequest.model_validate_json(body))


def test_the_cylinders_fit_a_machine(post: Post, design: dict[str, Any], body: dict[str, Any]) -> None:
    stages = post("/v1/rating", json.dumps(design)).json()["stages"]
    for throw, stage in zip(body["machine"]["throws"], stages, strict=True):
        throw["rows"][0]["cylinder"] = stage["cylinder"]
    answer = post("/v1/analyze", json.dumps(body | {"outputs": ["gas"]}))
    assert answer.status_code == 200
    for row, stage in zip(answer.json()["gas"]["rows"], stages, strict=True):
        assert min(row["force_N"]) == pytest.approx(stage["actual_loads"]["outer"]["gas_force_N"], rel=1e-9)


def test_a_warning_is_no_error(post: Post, design: dict[str, Any]) -> None:
    answer = post("/v1/rating", json.dumps(design | {"installed_motor_power_W": 1000}))
    assert answer.status_code == 200
    assert "motor_power" in {warning["code"] for warning in answer.json()["warnings"]}


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("/discharge_pressure_Pa", 300000),
        ("/discharge_pressure_Pa", 100000),
        ("/suction_pressure_Pa", "3 bars"),
        ("/capacity_m3_per_min", 0),
        ("/capacity_m3_per_min", MISSING),
        ("/isentropic_exponent", 1),
        ("/mechanical_efficiency", 1.01),
        ("/drive_efficiency", 2),
        ("/relative_humidity", 1.1),
        ("/stages", []),
        ("/stages", MISSING),
        ("/stages/0/relative_clearance", 0),
        ("/stages/0/relative_clearance", -0.1),
        ("/stages/1/expansion_exponent", 1),
        ("/stages/1/suction_temperature_K", 200),
        ("/stages/0/suction_pressure_loss", 1),
        ("/stages/0/leakage_coefficient", 0.9),
        ("/stages/1/name", "I"),
        ("/stages/1/colour", "blue"),
        ("/interstage_pressures_Pa", [400000, 500000]),
        ("/machine", {}),
    ],
)
def test_bad_input_names_its_field(post: Post, design: dict[str, Any], path: str, value: object) -> None:
    change(design, path, value)
    assert pointers(post("/v1/rating", json.dumps(design)), "invalid-request") == [path]


def test_a_rod_wider_than_the_bore(post: Post, design: dict[str, Any]) -> None:
    pointed = "/stages/0/piston_rod_diameter_m"
    change(design, "/stages/0/bore_m", 0.1)
    assert pointers(post("/v1/rating", json.dumps(design)), "invalid-request") == [pointed]


@pytest.mark.parametrize(
    ("path", "value"), [("/stages/0/relative_clearance", 5), ("/stages/0/piston_rod_diameter_m", 5)]
)
def test_what_no_cylinder_can_do(post: Post, design: dict[str, Any], path: str, value: object) -> None:
    change(design, path, value)
    assert pointers(post("/v1/rating", json.dumps(design)), "out-of-range") == [path]


@pytest.mark.parametrize(("content", "status"), [(b"", 400), (b"{", 400), (b"[]", 422), (b"null", 422), (b"{}", 422)])
def test_bodies_that_are_none(post: Post, content: bytes, status: int) -> None:
    answer = post("/v1/rating", content)
    assert (answer.status_code, answer.headers["content-type"]) == (status, "application/problem+json")
