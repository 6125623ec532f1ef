"""A client of the routes of jobs, in this process."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pyarrow as pa
from starlette.testclient import TestClient

from optimizer.studies.sweep import run_chunk
from schemas.sweep.request import SweepRequest
from service.app import create_app
from service.settings import Settings
from tests.jobs.sweeps import analyses


@contextmanager
def ready(folder: Path) -> Iterator[TestClient]:
    """Of a service that is ready, on data in a folder."""
    with TestClient(create_app(Settings(data_dir=folder, sweep_workers=2), warm=False)) as client:
        deadline = time.monotonic() + 180
        while client.get("/readyz").status_code != 200:
            assert time.monotonic() < deadline
            time.sleep(0.05)
        yield client


def ended(client: TestClient, path: str) -> dict[str, Any]:
    deadline = time.monotonic() + 180
    while (state := client.get(path).json())["state"] in ("queued", "running"):
        assert time.monotonic() < deadline
        time.sleep(0.1)
    return dict(state)


def finished(client: TestClient) -> str:
    """A sweep that is done."""
    answer = client.post("/v1/sweeps", json=analyses())
    assert answer.status_code == 202
    path = answer.headers["location"]
    state = answer.json()
    assert set(state) >= {"id", "state", "total", "done", "failed", "links"}
    assert (state["state"], state["total"], state["links"]["self"]) == ("queued", 400, path)
    assert ended(client, path)["state"] == "done"
    return str(path)


def expected(body: dict[str, Any]) -> pa.Table:
    request = SweepRequest.model_validate(body)
    return run_chunk(request.model_dump_json().encode(), 0, request.total)
