"""Sweeps over REST: states, events, cancelling, and what is refused."""

import io
import json
import re
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import anyio.to_thread
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from starlette.testclient import TestClient

from service.app import create_app
from service.settings import Settings
from tests.jobs.routes import ended, expected, finished, ready
from tests.jobs.sweeps import MACHINE, analyses, optimisations


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    with ready(tmp_path_factory.mktemp("data")) as server:
        yield server


@pytest.fixture(scope="module")
def sweep(client: TestClient) -> str:
    return finished(client)


def test_a_dry_run_starts_nothing(client: TestClient) -> None:
    before = client.get("/v1/sweeps").json()
    answer = client.post("/v1/sweeps", json=analyses(dry_run=True))
    assert (answer.status_code, answer.json()["total"]) == (200, 400)
    # as the service is set
    assert answer.json()["workers"] == 2
    assert 0 < answer.json()["wall_s"] <= answer.json()["cpu_s"]
    assert re.match(r"\d+ worker\(s\) with a core each", answer.json()["assumption"])
    assert client.get("/v1/sweeps").json() == before


@pytest.mark.parametrize(
    ("content", "status"),
    [(b"{", 400), (b"{}", 422), (json.dumps(analyses(axes=[{"path": "/x", "values": [1]}])).encode(), 422)],
)
def test_what_is_refused(client: TestClient, content: bytes, status: int) -> None:
    answer = client.post("/v1/sweeps", content=content, headers={"Content-Type": "application/json"})
    assert (answer.status_code, answer.headers["content-type"]) == (status, "application/problem+json")
    assert client.post("/v1/sweeps", content=b"x").status_code == 415


def test_idempotency(client: TestClient) -> None:
    def post(body: dict[str, Any], key: str) -> Any:
        return client.post("/v1/sweeps", json=body, headers={"Idempotency-Key": key})

    first, again = post(optimisations(), "k-1"), post(optimisations(), "k-1")
    assert first.headers["location"] == again.headers["location"]
    assert (first.status_code, again.status_code) == (202, 202)
    assert ("idempotency-replayed" in first.headers, again.headers["idempotency-replayed"]) == (False, "true")
    response = post(optimisations(7), "k-1")
    assert (response.status_code, response.json()["title"]) == (409, "Key reused")
    for bad in ("", "x" * 256, "a b"):
        assert post(optimisations(), bad).status_code == 422


def test_cancel_then_remove(client: TestClient) -> None:
    path = client.post("/v1/sweeps", json=analyses(3000, 3000)).headers["location"]
    deadline = time.monotonic() + 180
    while client.get(path).json()["done"] == 0:
        assert time.monotonic() < deadline
        time.sleep(0.02)
    running = client.get(f"{path}/results?columns=index&format=arrow")
    cancelled = client.delete(path)
    assert (cancelled.status_code, cancelled.json()["state"]) == (200, "cancelled")
    if running.headers["sweep-state"] == "running":
        assert running.headers["sweep-complete"] == "false"
    count = cancelled.json()["done"]
    rows = pa.ipc.open_stream(client.get(f"{path}/results?columns=index&format=arrow").content).read_all()
    index = rows["index"].to_pylist()
    assert (len(index), index) == (count, sorted(set(index)))
    assert 0 < count < 9_000_000
    assert client.get(path).json()["done"] == count
    assert client.delete(path).status_code == 204
    for answer in (client.get(path), client.delete(path), client.get(f"{path}/results"), client.get(f"{path}/events")):
        assert (answer.status_code, answer.json()["title"]) == (404, "Unknown sweep")


def test_a_cancelled_sweep_that_selects_says_where_its_rows_are(client: TestClient) -> None:
    actual_analyses = analyses(3000, 1000, pareto=["force_peak_N", "moment_peak_Nm"])
    path = client.post("/v1/sweeps", json=actual_analyses).headers["location"]
    assert client.get(path).json()["message"] is None
    cancelled = client.delete(path).json()
    assert (cancelled["state"], cancelled["eta_s"]) == ("cancelled", None)
    assert "read the finished rows with select=all" in cancelled["message"]
    assert client.get(f"{path}/results?select=all").status_code == 200


def test_a_cancelled_sweep_can_go_on(client: TestClient) -> None:
    path = client.post("/v1/sweeps", json=analyses(100, 100)).headers["location"]
    # 204: it was done before it could be cancelled, and is removed
    while client.delete(path).status_code == 204:
        path = client.post("/v1/sweeps", json=analyses(100, 100)).headers["location"]
    assert client.post(f"{path}/resume").status_code == 202
    assert ended(client, path)["done"] == 10_000
    rows = pq.read_table(io.BytesIO(client.get(f"{path}/results?format=parquet").content))
    assert rows.equals(expected(analyses(100, 100)))


@pytest.mark.parametrize("id", ["x", "..%2f..%2fetc%2fpasswd", "%2e%2e", "a%00b", "%ff", "0" * 32, "0" * 5000])
def test_paths_that_lead_nowhere(client: TestClient, id: str) -> None:  # noqa: A002
    for method, tail in (("GET", ""), ("GET", "/results"), ("GET", "/events"), ("GET", "/metadata"), ("DELETE", "")):
        answer = client.request(method, f"/v1/sweeps/{id}{tail}")
        assert (answer.status_code, answer.headers["content-type"]) == (404, "application/problem+json")


def events_of(text: str) -> list[tuple[int, str, dict[str, Any]]]:
    values = []
    for block in text.split("\n\n"):
        fields = dict(line.split(": ", 1) for line in block.splitlines() if not line.startswith(":"))
        if "data" in fields:
            values.append((int(fields["id"]), fields["event"], json.loads(fields["data"])))
    return values


def test_events(client: TestClient, sweep: str) -> None:
    path = client.post("/v1/sweeps", json=analyses(200, 100)).headers["location"]
    with client.stream("GET", f"{path}/events") as stream:
        assert stream.headers["content-type"].startswith("text/event-stream")
        events = events_of("".join(stream.iter_text()))
    ids = [event[0] for event in events]
    assert ids == sorted(set(ids))
    assert [event[1] for event in events] == ["progress"] * (len(events) - 1) + ["end"]
    assert (events[-1][2]["state"], events[-1][2]["done"], events[-1][2]["eta_s"]) == ("done", 20_000, None)
    # who comes late gets the last state, who has seen it is told not to come back
    late = client.get(f"{path}/events")
    assert events_of(late.text) == [events[-1]]
    assert client.get(f"{path}/events", headers={"Last-Event-ID": str(ids[-1])}).status_code == 204
    for odd in ("0", "-1", "x", "9" * 50, "²"):
        assert events_of(client.get(f"{path}/events", headers={"Last-Event-ID": odd.encode()}).text) == [events[-1]]


def test_head_of_streams(client: TestClient, sweep: str) -> None:
    for tail in ("/results", "/events"):
        answer = client.head(f"{sweep}{tail}")
        assert (answer.status_code, answer.content) == (200, b"")
        assert "content-length" not in answer.headers
        assert answer.headers["content-type"] == client.get(f"{sweep}{tail}").headers["content-type"]


def test_the_list(client: TestClient, sweep: str) -> None:
    listed, following = [], "/v1/sweeps?limit=2"
    while following:
        page = client.get(following).json()
        listed += page["sweeps"]
        following = page["next"]
    created = [state["created_at"] for state in listed]
    assert created == sorted(created, reverse=True)
    assert sweep in [state["links"]["self"] for state in listed]
    assert client.get("/v1/sweeps?before=x").status_code == 404
    assert client.get("/v1/sweeps?limit=0").status_code == 422


def test_single_requests_are_answered_while_a_sweep_runs(client: TestClient) -> None:
    path = client.post("/v1/sweeps", json=analyses(3000, 3000)).headers["location"]
    deadline = time.monotonic() + 180
    while client.get(path).json()["done"] == 0:
        assert time.monotonic() < deadline
        time.sleep(0.02)
    assert client.post("/v1/optimize", json={"machine": MACHINE}).json()["status"] == "optimal"
    assert client.get(path).json()["state"] == "running"
    client.delete(path)


def test_a_database_that_cannot_be_reached(tmp_path: Path) -> None:
    settings = Settings(data_dir=tmp_path, database_url="postgresql://nobody@127.0.0.1:1/x")
    with TestClient(create_app(settings, warm=False)) as client:
        # warm, though not ready: that the database is needed is known to readiness too
        deadline = time.monotonic() + 180
        while "database of the jobs" not in client.get("/readyz").json().get("detail", ""):
            assert time.monotonic() < deadline
            time.sleep(0.01)
        for answer in (
            client.post("/v1/sweeps", json=analyses()),
            client.get("/v1/sweeps"),
            client.get(f"/v1/sweeps/{'0' * 32}"),
        ):
            assert (answer.status_code, answer.json()["title"]) == (503, "Database unavailable")
            # where the database is, and as whom it is asked, is nobody's business
            assert answer.json()["detail"] == "The job database is locked, or does not answer; try again later."
            assert "retry-after" in answer.headers


def test_no_route_waits_for_the_threads_that_all_libraries_share(
    client: TestClient, sweep: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    # what fills them, in a library or by accident, must not reach those who ask for health
    own, shared = anyio.to_thread.run_sync, list[object]()

    async def watched(work: Any, *arguments: Any, limiter: Any = None, **more: Any) -> Any:
        if limiter is None:
            shared.append(work)
        return await own(work, *arguments, limiter=limiter, **more)

    response = client.post("/v1/optimize", json=optimisations()["base"], headers={"Prefer": "respond-async"})
    ended(client, response.headers["location"])
    monkeypatch.setattr(anyio.to_thread, "run_sync", watched)
    document = client.get("/openapi.json").json()["paths"]
    names = {
        (method, path.replace("{id}", sweep.rpartition("/")[2]).replace("{name}", "2d12"))
        for path, operations in document.items()
        for method in operations
        if method != "delete"
    }
    assert len(names) > 15
    pages = ("/", "/docs", "/docs/assets/swagger-ui.css", "/docs/assets/nothing", "/portal/x/main.js", "/nowhere")
    names |= {
        ("get", path) for path in (*pages, f"{response.headers['location']}/results", f"{sweep}/results?select=all")
    }
    for method, path in sorted(names):
        body = (
            {"json": optimisations() if path == "/v1/sweeps" else optimisations()["base"]} if method == "post" else {}
        )
        answer = client.request(method, path, headers={"Prefer": "respond-async"}, **body)  # type: ignore[arg-type]
        assert answer.status_code < 500, (method, path, answer.text)
    client.delete(sweep)
    assert shared == []
