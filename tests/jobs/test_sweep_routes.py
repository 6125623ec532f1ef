"""Sweeps over REST: states, results, events, and jobs that are answered later."""

import io
import json
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import anyio.to_thread
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from openpyxl import load_workbook
from starlette.testclient import TestClient

from optimizer.sweep import run_chunk
from schemas.sweep import SweepRequest
from service.app import create_app
from service.computations import XLSX
from service.jobs import worksheet
from service.settings import Settings
from tests.jobs.sweeps import MACHINE, MASS, analyses, optimisations


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    folder: Path = tmp_path_factory.mktemp("data")
    with TestClient(create_app(Settings(data_dir=folder, sweep_workers=2), warm=False)) as client:
        deadline = time.monotonic() + 180
        while client.get("/readyz").status_code != 200:
            assert time.monotonic() < deadline
        yield client


def ended(client: TestClient, path: str) -> dict[str, Any]:
    deadline = time.monotonic() + 180
    while (state := client.get(path).json())["state"] in ("queued", "running"):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    return dict(state)


@pytest.fixture(scope="module")
def sweep(client: TestClient) -> str:
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


def test_every_format_holds_the_rows(client: TestClient, sweep: str) -> None:
    rows = expected(analyses())
    got = {name: client.get(f"{sweep}/results?format={name}") for name in ("parquet", "arrow", "ndjson", "csv")}
    assert pq.read_table(io.BytesIO(got["parquet"].content)).equals(rows)
    assert pa.ipc.open_stream(got["arrow"].content).read_all().equals(rows)
    assert [json.loads(line) for line in got["ndjson"].text.splitlines()] == rows.to_pylist()
    assert len(got["csv"].text.splitlines()) == 401
    for answer in got.values():
        assert (answer.headers["sweep-complete"], answer.headers["sweep-state"]) == ("true", "done")
    kinds = [answer.headers["content-type"].split(";")[0] for answer in got.values()]
    asked = [client.get(f"{sweep}/results", headers={"Accept": kind}).headers["content-type"] for kind in kinds]
    assert [kind.split(";")[0] for kind in asked] == kinds
    # who likes none of them gets the first
    neither = client.get(f"{sweep}/results", headers={"Accept": "image/png"})
    assert neither.headers["content-type"] == got["ndjson"].headers["content-type"]


def test_the_file_says_what_made_it(client: TestClient, sweep: str) -> None:
    schema = pq.read_schema(io.BytesIO(client.get(f"{sweep}/results?format=parquet").content))
    assert json.loads(schema.metadata[b"counterweight.request"])["axes"][0]["path"] == MASS
    assert schema.field("force_peak_N").metadata[b"unit"] == b"N"
    about = client.get(f"{sweep}/metadata").json()
    assert about["request"]["axes"][0]["path"] == MASS
    assert about["seed"] == 0
    assert about["versions"]["pyarrow"] == pa.__version__
    assert {"name": "force_peak_N", "unit": "N"}.items() <= next(
        column for column in about["columns"] if column["name"] == "force_peak_N"
    ).items()
    assert f'<{sweep}/metadata>; rel="describedby"' in client.get(f"{sweep}/results").headers["link"]


def test_pages_and_columns(client: TestClient, sweep: str) -> None:
    following: str | None = f"{sweep}/results?limit=150&columns=status,index"
    seen: list[dict[str, Any]] = []
    pages = 0
    while following:
        answer = client.get(following)
        seen += [json.loads(line) for line in answer.text.splitlines()]
        links = [link for link in answer.headers["link"].split(", ") if link.endswith('rel="next"')]
        following = links[0][1:].split(">")[0] if links else None
        pages += 1
    assert (pages, [row["index"] for row in seen]) == (3, list(range(400)))
    assert all(set(row) == {"index", "status"} for row in seen)
    assert client.get(f"{sweep}/results?offset=400").text == ""
    assert client.get(f"{sweep}/results?offset=4000000000000").text == ""
    for wrong in (
        "columns=nothing",
        "format=xml",
        "offset=-1",
        "limit=0",
        "limit=x",
        "select=best",
        "columns=" + "x" * 500,
    ):
        answer = client.get(f"{sweep}/results?{wrong}")
        assert (answer.status_code, answer.headers["content-type"]) == (422, "application/problem+json")


def test_a_workbook_within_the_limits_of_a_worksheet(
    client: TestClient, sweep: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    got = client.get(f"{sweep}/results", headers={"Accept": XLSX})
    assert got.headers["content-type"] == XLSX
    sheet = load_workbook(io.BytesIO(got.content))["rows"]
    assert (sheet.max_row, sheet.cell(1, 1).value) == (401, "index")
    monkeypatch.setattr(worksheet, "MOST_ROWS", 100)
    refused = client.get(f"{sweep}/results?format=xlsx")
    assert (refused.status_code, refused.json()["title"]) == (422, "Too large for a worksheet")
    assert client.get(f"{sweep}/results?format=xlsx&offset=300").status_code == 200


def test_invalid_designs_are_rows(client: TestClient, sweep: str) -> None:
    rows = [json.loads(line) for line in client.get(f"{sweep}/results").text.splitlines()]
    invalid = [row for row in rows if row["status"] == "invalid"]
    # one speed in twenty is negative (analytic)
    assert len(invalid) == 20
    assert "/machine/speed_rpm" in invalid[0]["message"]
    state = client.get(sweep).json()
    assert (state["invalid"], state["failed"]) == (20, 0)


def test_top_and_pareto(client: TestClient) -> None:
    rows = [row for row in expected(analyses()).to_pylist() if row["force_peak_N"] is not None]
    best = sorted(rows, key=lambda row: (row["force_peak_N"], row["index"]))[:3]
    path = client.post("/v1/sweeps", json=analyses(top={"by": "force_peak_N", "count": 3})).headers["location"]
    assert ended(client, path)["rows"] == 3
    for _ in range(2):
        assert [json.loads(line) for line in client.get(f"{path}/results").text.splitlines()] == best
    assert len(client.get(f"{path}/results?select=all").text.splitlines()) == 400
    assert json.loads(client.get(f"{path}/results?offset=1&limit=1").text) == best[1]
    path = client.post("/v1/sweeps", json=analyses(pareto=["force_peak_N", "moment_peak_Nm"])).headers["location"]
    state = ended(client, path)
    kept = [json.loads(line) for line in client.get(f"{path}/results").text.splitlines()]
    assert state["rows"] == len(kept) > 0
    for row in kept:
        assert not any(
            other["force_peak_N"] <= row["force_peak_N"]
            and other["moment_peak_Nm"] <= row["moment_peak_Nm"]
            and (other["force_peak_N"], other["moment_peak_Nm"]) != (row["force_peak_N"], row["moment_peak_Nm"])
            for other in rows
        )


def test_a_dry_run_starts_nothing(client: TestClient) -> None:
    before = client.get("/v1/sweeps").json()
    answer = client.post("/v1/sweeps", json=analyses(dry_run=True))
    assert (answer.status_code, answer.json()["total"]) == (200, 400)
    # as the service is set
    assert answer.json()["workers"] == 2
    assert 0 < answer.json()["wall_s"] <= answer.json()["cpu_s"]
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
    other = post(optimisations(7), "k-1")
    assert (other.status_code, other.json()["title"]) == (409, "Key reused")
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
    done = cancelled.json()["done"]
    rows = pa.ipc.open_stream(client.get(f"{path}/results?columns=index&format=arrow").content).read_all()
    index = rows["index"].to_pylist()
    assert (len(index), index) == (done, sorted(set(index)))
    assert 0 < done < 9_000_000
    assert client.get(path).json()["done"] == done
    assert client.delete(path).status_code == 204
    for answer in (client.get(path), client.delete(path), client.get(f"{path}/results"), client.get(f"{path}/events")):
        assert (answer.status_code, answer.json()["title"]) == (404, "Unknown sweep")


def test_a_cancelled_sweep_can_go_on(client: TestClient) -> None:
    path = client.post("/v1/sweeps", json=analyses(100, 100)).headers["location"]
    client.delete(path)
    assert client.post(f"{path}/resume").status_code == 202
    assert ended(client, path)["done"] == 10_000
    rows = pq.read_table(io.BytesIO(client.get(f"{path}/results?format=parquet").content))
    assert rows.equals(expected(analyses(100, 100)))


@pytest.mark.parametrize("id", ["x", "..%2f..%2fetc%2fpasswd", "%2e%2e", "a%00b", "%ff", "0" * 32, "0" * 5000])
def test_paths_that_lead_nowhere(client: TestClient, id: str) -> None:  # noqa: A002
    for method, tail in (("GET", ""), ("GET", "/results"), ("GET", "/events"), ("GET", "/metadata"), ("DELETE", "")):
        answer = client.request(method, f"/v1/sweeps/{id}{tail}")
        assert (answer.status_code, answer.headers["content-type"]) == (404, "application/problem+json")


def told(text: str) -> list[tuple[int, str, dict[str, Any]]]:
    found = []
    for block in text.split("\n\n"):
        fields = dict(line.split(": ", 1) for line in block.splitlines() if not line.startswith(":"))
        if "data" in fields:
            found.append((int(fields["id"]), fields["event"], json.loads(fields["data"])))
    return found


def test_events(client: TestClient, sweep: str) -> None:
    path = client.post("/v1/sweeps", json=analyses(200, 100)).headers["location"]
    with client.stream("GET", f"{path}/events") as stream:
        assert stream.headers["content-type"].startswith("text/event-stream")
        events = told("".join(stream.iter_text()))
    ids = [one[0] for one in events]
    assert ids == sorted(set(ids))
    assert [one[1] for one in events] == ["progress"] * (len(events) - 1) + ["end"]
    assert (events[-1][2]["state"], events[-1][2]["done"], events[-1][2]["eta_s"]) == ("done", 20_000, 0)
    # who comes late gets the last state, who has seen it is told not to come back
    late = client.get(f"{path}/events")
    assert told(late.text) == [events[-1]]
    assert client.get(f"{path}/events", headers={"Last-Event-ID": str(ids[-1])}).status_code == 204
    for odd in ("0", "-1", "x", "9" * 50, "²"):
        assert told(client.get(f"{path}/events", headers={"Last-Event-ID": odd.encode()}).text) == [events[-1]]


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
    created = [one["created_at"] for one in listed]
    assert created == sorted(created, reverse=True)
    assert sweep in [one["links"]["self"] for one in listed]
    assert client.get("/v1/sweeps?before=x").status_code == 404
    assert client.get("/v1/sweeps?limit=0").status_code == 422


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


def test_single_requests_are_answered_while_a_sweep_runs(client: TestClient) -> None:
    path = client.post("/v1/sweeps", json=analyses(3000, 3000)).headers["location"]
    deadline = time.monotonic() + 180
    while client.get(path).json()["done"] == 0:
        assert time.monotonic() < deadline
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

    async def watched(work: Any, *given: Any, limiter: Any = None, **more: Any) -> Any:
        if limiter is None:
            shared.append(work)
        return await own(work, *given, limiter=limiter, **more)

    done = client.post("/v1/optimize", json=optimisations()["base"], headers={"Prefer": "respond-async"})
    ended(client, done.headers["location"])
    monkeypatch.setattr(anyio.to_thread, "run_sync", watched)
    document = client.get("/openapi.json").json()["paths"]
    asked = {
        (method, path.replace("{id}", sweep.rpartition("/")[2]).replace("{name}", "2d12"))
        for path, operations in document.items()
        for method in operations
        if method != "delete"
    }
    assert len(asked) > 15
    pages = ("/", "/docs", "/docs/assets/swagger-ui.css", "/docs/assets/nothing", "/portal/x/main.js", "/nowhere")
    asked |= {("get", path) for path in (*pages, f"{done.headers['location']}/results", f"{sweep}/results?select=all")}
    for method, path in sorted(asked):
        body = (
            {"json": optimisations() if path == "/v1/sweeps" else optimisations()["base"]} if method == "post" else {}
        )
        answer = client.request(method, path, headers={"Prefer": "respond-async"}, **body)  # type: ignore[arg-type]
        assert answer.status_code < 500, (method, path, answer.text)
    client.delete(sweep)
    assert shared == []
