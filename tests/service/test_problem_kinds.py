"""Every kind of problem has a page with its cause and remedy, in the form that a client accepts."""

import re

import pytest
from starlette.testclient import TestClient

from service.documents.problem_kinds import KINDS
from tests.docs.reading import ROOT
from tests.service.faults import emitted

#: what the connection itself says, and where, beside the tables of faults
_WIRE = re.compile(r'(?:Fault\(\s*[\w.]+, |_TOO_LARGE, |400, )"([A-Z][^"]+)"')
#: not read by anybody
_UNREAD = "client-gone"


def on_the_wire() -> set[str]:
    """Kinds that are said before there is a request, read from the source."""
    files = (ROOT / "service/wire").glob("*.py")
    titles = {title for file in files for title in _WIRE.findall(file.read_text())}
    return {problem_slug(title) for title in titles}


def problem_slug(title: str) -> str:
    return title.lower().replace(" ", "-")


def test_every_kind_that_is_emitted_has_a_page() -> None:
    in_tables = {(status, kind) for status, kind in emitted() if kind != _UNREAD}
    assert len(in_tables) > 30
    assert {(kind.status, name) for name, kind in KINDS.items()} >= in_tables
    wire = on_the_wire() - {_UNREAD}
    assert {"headers-too-slow", "headers-too-large", "unreadable-request", "not-allowed-across-origins"} <= wire
    # and there are no pages of what nobody says
    assert set(KINDS) == {kind for _, kind in in_tables} | wire | {"method-not-allowed", "no-file-left"}


@pytest.mark.parametrize("name", KINDS)
def test_a_page_says_cause_and_remedy(client: TestClient, name: str) -> None:
    kind = KINDS[name]
    json = client.get(kind.type)
    assert json.headers["content-type"] == "application/json"
    assert json.json() == kind.model_dump()
    html = client.get(kind.type, headers={"Accept": "text/html,application/xhtml+xml,*/*;q=0.8"})
    assert html.headers["content-type"].startswith("text/html")
    assert f"<h1>{kind.title.replace('&', '&amp;')} ({kind.status})</h1>" in html.text
    assert "`" not in html.text
    plain = client.get(kind.type, headers={"Accept": "text/plain"})
    assert plain.text == f"{kind.title} ({kind.status})\n\nCause: {kind.cause}\nRemedy: {kind.remedy}\n"
    assert {response.headers["vary"] for response in (json, html, plain)} == {"Accept, Accept-Encoding, Origin"}
    # forms are different documents
    assert len({response.headers["etag"] for response in (json, html, plain)}) == 3


def test_the_address_in_a_problem_leads_to_its_page(client: TestClient) -> None:
    refused = client.post("/v1/optimize", json={"machine": 1}).json()
    assert client.get(refused["type"]).json()["title"] == refused["title"]


def test_a_kind_that_is_none(client: TestClient) -> None:
    assert client.get("/problems/nothing").json()["type"] == "/problems/not-found"


@pytest.mark.parametrize(
    ("method", "path", "wrong"),
    [
        ("GET", "/v1/sweeps?limit=0", [("/query/limit", "must be at least 1")]),
        ("GET", "/v1/sweeps?limit=201", [("/query/limit", "must be at most 200")]),
        ("GET", "/v1/sweeps?limit=x", [("/query/limit", "must be a whole number")]),
        ("GET", "/v1/sweeps?offset=3", [("/query/offset", "unknown parameter")]),
        ("GET", "/v1/effects?x=1&y&x=2", [("/query/x", "unknown parameter"), ("/query/y", "unknown parameter")]),
        ("GET", "/v1/sweeps/5f0c/results?select=some", [("/query/select", "must be 'kept' or 'all'")]),
        ("POST", "/v1/optimize?points=3", [("/query/points", "unknown parameter")]),
        ("POST", "/v1/sweeps?dry_run=true", [("/query/dry_run", "unknown parameter")]),
        ("DELETE", "/v1/sweeps/5f0c?force", [("/query/force", "unknown parameter")]),
        ("GET", f"/v1/effects?{'x' * 100}=1", [(f"/query/{'x' * 64}", "unknown parameter")]),
    ],
)
def test_parameters_are_refused_by_name(
    client: TestClient, method: str, path: str, wrong: list[tuple[str, str]]
) -> None:
    answer = client.request(method, path, json={} if method == "POST" else None)
    document = answer.json()
    assert (answer.status_code, document["title"]) == (422, "Invalid parameter")
    assert [(error["pointer"], error["message"]) for error in document["errors"]] == wrong


@pytest.mark.parametrize("path", ["/healthz?probe=1", "/readyz?x", "/?machine=2d12", "/docs?x=1", "/v1/sweeps?limit=3"])
def test_probes_and_pages_take_any_parameter(client: TestClient, path: str) -> None:
    assert client.get(path).status_code == 200
