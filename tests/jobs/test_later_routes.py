"""Single requests that are answered later, as jobs."""

from collections.abc import Iterator
from typing import Any

import pytest
from starlette.testclient import TestClient

from tests.jobs.routes import ended, ready
from tests.jobs.sweeps import MACHINE


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    with ready(tmp_path_factory.mktemp("data")) as server:
        yield server


@pytest.mark.parametrize(("kind", "more"), [("optimize", {}), ("pareto", {"points": 3})])
def test_answered_later(client: TestClient, kind: str, more: dict[str, Any]) -> None:
    body = {"machine": MACHINE, **more}
    answer = client.post(f"/v1/{kind}", json=body, headers={"Prefer": "wait=5, respond-async"})
    assert (answer.status_code, answer.headers["preference-applied"]) == (202, "respond-async")
    path = answer.headers["location"]
    state = ended(client, path)
    assert (state["state"], state["message"], state["done"]) == ("done", None, 1)
    later, now = client.get(state["links"]["results"]).json(), client.post(f"/v1/{kind}", json=body).json()
    later.pop("timing"), now.pop("timing")
    later.pop("effects", None), now.pop("effects", None)
    assert later == now
    bad = client.post(f"/v1/{kind}", json={}, headers={"Prefer": "respond-async"})
    assert bad.status_code == 422


def test_other_computations_are_answered_now(client: TestClient) -> None:
    answer = client.post("/v1/analyze", json={"machine": MACHINE}, headers={"Prefer": "respond-async"})
    assert (answer.status_code, "preference-applied" in answer.headers) == (200, False)


def test_an_answer_that_cannot_be_given(client: TestClient) -> None:
    body = {"machine": MACHINE, "outputs": ["gas"]}
    path = client.post("/v1/optimize", json=body, headers={"Prefer": "respond-async"}).headers["location"]
    state = ended(client, path)
    assert state["state"] == "failed"
    assert "cylinder" in state["message"]
    answer = client.get(f"{path}/results")
    assert (answer.status_code, answer.json()["detail"]) == (409, state["message"])
