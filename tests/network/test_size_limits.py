"""Sizes that an operator allows: what is larger is refused, field by field, now and later."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError
from starlette.testclient import TestClient

from service.app import create_app
from service.documents.examples import load
from service.settings import Settings

BODY: dict[str, Any] = json.loads(load("2d12"))
SCENE = {"machine": BODY["machine"]}
SPEEDS = {"path": "/machine/speed_rpm", "start": 300, "stop": 900}
LIMITS: dict[str, Any] = {
    "max_throws": 1,
    "max_rows": 1,
    "max_webs": 3,
    "max_angles": 400,
    "max_sweep_designs": 5,
    "max_body_bytes": 20_000,
    "concurrent_solves": 1,
}


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    settings = Settings(data_dir=tmp_path_factory.mktemp("data"), **LIMITS)
    with TestClient(create_app(settings, warm=False)) as client:
        yield client


def pointers(answer: Any, status: int = 422) -> set[str]:
    assert answer.status_code == status
    assert answer.headers["content-type"] == "application/problem+json"
    return {error["pointer"] for error in answer.json()["errors"]}


MACHINE = {"/machine/throws", "/machine/webs"}


@pytest.mark.parametrize(
    ("path", "body", "expected"),
    [
        ("/v1/optimize", BODY, MACHINE),
        ("/v1/analyze", {**SCENE, "outputs": ["hodograph"], "angles": {"step_deg": 0.5}}, {
            *MACHINE, "/angles/step_deg",
        }),
        ("/v1/pareto", SCENE, MACHINE),
        ("/v1/accuracy", SCENE, MACHINE),
        ("/v1/report", SCENE, MACHINE),
        ("/v1/report", {**SCENE, "versions": [{"name": "as built", "machine": BODY["machine"]}]}, {
            *MACHINE, "/versions/0/machine/throws", "/versions/0/machine/webs",
        }),
        ("/v1/scroll/pin-loads", {
            "pin_count": 3, "pin_circle_radius_m": 0.05, "rotation_torque_Nm": 12.5, "angles": {"step_deg": 0.5},
        }, {"/angles/step_deg"}),
        ("/v1/sweeps", {"base": SCENE, "axes": [{**SPEEDS, "count": 6}]}, {
            "/base/machine/throws", "/base/machine/webs", "/axes",
        }),
    ],
)  # fmt: skip
def test_what_is_too_large_is_named(client: TestClient, path: str, body: dict[str, Any], expected: set[str]) -> None:
    assert pointers(client.post(path, json=body)) == expected


@pytest.mark.parametrize("path", ["/v1/optimize", "/v1/pareto", "/v1/accuracy"])
def test_what_is_answered_later_is_no_larger(client: TestClient, path: str) -> None:
    assert pointers(client.post(path, json=SCENE, headers={"Prefer": "respond-async"})) == MACHINE


def test_what_is_as_large_as_allowed_is_computed(tmp_path: Path) -> None:
    exactly = {**LIMITS, "max_throws": 2, "max_rows": 2, "max_webs": 4}
    with TestClient(create_app(Settings(data_dir=tmp_path, **exactly), warm=False)) as client:
        scene = {**SCENE, "outputs": ["hodograph"], "angles": {"step_deg": 0.9}}
        assert client.post("/v1/analyze", json=scene).status_code == 200
        sweep = {"base": SCENE, "axes": [{**SPEEDS, "count": 5}], "dry_run": True}
        assert client.post("/v1/sweeps", json=sweep).status_code == 200
        assert client.post("/v1/analyze", content=b" " * 20_001, headers=JSON).status_code == 413


JSON = {"Content-Type": "application/json"}


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("max_throws", 501), ("max_webs", 10**6), ("max_angles", 36_001), ("max_angles", 359), ("root_path", "/a/"),
        ("root_path", "a"), ("solve_memory_mb", 1), ("log_level", "loud"),
    ],
)  # fmt: skip
def test_settings_beyond_what_the_schemas_allow_are_refused(name: str, value: Any) -> None:
    with pytest.raises(ValidationError):
        Settings(**{name: value})


@pytest.mark.parametrize("name", ["rate_limit", "refusal_limit"])
def test_a_rate_that_is_none_is_refused_at_the_start(name: str) -> None:
    with pytest.raises(ValueError, match="'often' is no rate"):
        create_app(Settings(**{name: "often"}))


def test_lists_in_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COUNTERWEIGHT_CORS_ORIGINS", "https://a.example, https://b.example,")
    assert Settings().cors_origins == ("https://a.example", "https://b.example")
