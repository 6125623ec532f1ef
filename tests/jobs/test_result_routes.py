"""Rows of sweeps over REST: formats, pages, selections."""

import io
import json
from collections.abc import Iterator
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from openpyxl import load_workbook
from starlette.testclient import TestClient

from service.computations.computation import XLSX
from service.jobs import worksheet
from tests.jobs.routes import ended, expected, finished, ready
from tests.jobs.sweeps import MACHINE, MASS, analyses


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    with ready(tmp_path_factory.mktemp("data")) as server:
        yield server


@pytest.fixture(scope="module")
def sweep(client: TestClient) -> str:
    return finished(client)


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
    texts = [client.get(f"{sweep}/results", headers={"Accept": kind}).headers["content-type"] for kind in kinds]
    assert [kind.split(";")[0] for kind in texts] == kinds
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
    documents: list[dict[str, Any]] = []
    pages = 0
    while following:
        answer = client.get(following)
        documents += [json.loads(line) for line in answer.text.splitlines()]
        links = [link for link in answer.headers["link"].split(", ") if link.endswith('rel="next"')]
        following = links[0][1:].split(">")[0] if links else None
        pages += 1
    assert (pages, [row["index"] for row in documents]) == (3, list(range(400)))
    assert all(set(row) == {"index", "status"} for row in documents)
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


def test_proven_infeasibility_is_counted_by_itself(client: TestClient) -> None:
    # analytic: half of 20 kg at 0.1 m and 500 rpm turns backwards, and no counterweight lowers these 2742 N
    ceilings = [{"path": "/objective/force_ceiling_N", "values": [1000.0, 2700.0, 20000.0]}]
    base = {"machine": MACHINE}
    path = client.post("/v1/sweeps", json={"base": base, "axes": ceilings}).headers["location"]
    state = ended(client, path)
    rows = [json.loads(line) for line in client.get(f"{path}/results").text.splitlines()]
    assert [row["status"] for row in rows] == ["infeasible", "infeasible", "optimal"]
    assert (state["failed"], state["infeasible"], state["invalid"]) == (2, 2, 0)


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
    documents = [json.loads(line) for line in client.get(f"{path}/results").text.splitlines()]
    assert state["rows"] == len(documents) > 0
    for row in documents:
        assert not any(
            line["force_peak_N"] <= row["force_peak_N"]
            and line["moment_peak_Nm"] <= row["moment_peak_Nm"]
            and (line["force_peak_N"], line["moment_peak_Nm"]) != (row["force_peak_N"], row["moment_peak_Nm"])
            for line in rows
        )
