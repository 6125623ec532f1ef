"""Choices for the whole turn, as the service answers and reports them."""

from typing import Any

import pytest
from starlette.testclient import TestClient

from tests.optimize.choices import request_body, twin
from tests.optimize.test_choices_in_order import in_order

ALONG_AN_AXIS = {"orders": "all", "bearing_weight": 1, "force_ceiling_x_N": 11_000.0}


@pytest.mark.parametrize("goal", [in_order("external", "bearings", allowance=0.05), ALONG_AN_AXIS])
def test_answer_and_report(client: TestClient, goal: dict[str, Any]) -> None:
    body = request_body(twin(), 1e-3, **goal)
    answer = client.post("/v1/optimize", json=body)
    assert answer.status_code == 200
    document = answer.json()
    assert document["status"] == "optimal"
    assert [objective["goal"] for objective in document["certificate"]["goals"]] == (
        ["external"] if "priorities" in goal else []
    )
    report = client.post("/v1/report", json=body)
    assert report.status_code == 200
    assert "sets of counterweights" in report.text


def test_numbers(client: TestClient) -> None:
    body = request_body(twin(), bearing_weight=1, force_weight=0, moment_weight=0)
    answer = client.post("/v1/pareto", json=body | {"counts": {"of": "weights", "least": "objective"}})
    assert answer.status_code == 200
    (front,) = answer.json()["counts"]
    assert [point["weights"] for point in front["points"]] == [0, 1, 2, 3, 4]


def test_goals_in_their_order_are_no_front(client: TestClient) -> None:
    body = request_body(twin(), **in_order("external", "bearings")) | {"counts": {"of": "weights"}}
    answer = client.post("/v1/pareto", json=body)
    assert answer.status_code == 422
    assert "/objective/priorities" in [error["pointer"] for error in answer.json()["errors"]]
