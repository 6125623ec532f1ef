"""One idempotency key before and after an upgrade."""

import hashlib
import json
import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import BaseModel
from starlette.testclient import TestClient

from schemas.front.pareto import ParetoRequest
from schemas.sweep.request import SweepRequest
from service.jobs.fingerprints import fingerprint
from service.jobs.job import Order
from service.jobs.store import KeyReused
from tests.jobs.house import House
from tests.jobs.routes import ready
from tests.jobs.sweeps import MACHINE, optimisations

_SWEEP = ("/v1/sweeps", SweepRequest, optimisations())
_FRONT = ("/v1/pareto", ParetoRequest, {"machine": MACHINE, "points": 3})
_VALUES = st.recursive(
    st.none() | st.booleans() | st.integers(-(2**63), 2**63) | st.floats(allow_nan=False) | st.text(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
    max_leaves=8,
)


@pytest.fixture
def client(tmp_path: Path) -> Iterator[TestClient]:
    with ready(tmp_path) as server:
        yield server


def post(client: TestClient, path: str, body: object) -> Any:
    """The answer to a body; white space and the order of its fields are no part of it."""
    content = json.dumps(body, indent=1, sort_keys=True)
    headers = {"Content-Type": "application/json", "Prefer": "respond-async", "Idempotency-Key": "k"}
    return client.post(path, content=content, headers=headers)


def fewer_defaults(request: BaseModel) -> str:
    """A request as a version writes it that has no defaults yet."""
    return BaseModel.model_dump_json(request, exclude_unset=True)


@pytest.mark.parametrize(("path", "model", "body"), [_SWEEP, _FRONT])
def test_a_version_with_new_defaults_knows_the_same_request(
    client: TestClient, monkeypatch: pytest.MonkeyPatch, path: str, model: type[BaseModel], body: dict[str, Any]
) -> None:
    with monkeypatch.context() as older:
        older.setattr(model, "model_dump_json", fewer_defaults)
        first = post(client, path, body)
    again = post(client, path, body)
    assert (first.status_code, again.status_code) == (202, 202)
    assert first.headers["location"] == again.headers["location"]
    assert again.headers["idempotency-replayed"] == "true"
    response = post(client, path, changed(body))
    assert (response.status_code, response.json()["title"]) == (409, "Key reused")


@pytest.mark.parametrize(("path", "model", "body"), [_SWEEP, _FRONT])
def test_a_fingerprint_of_an_earlier_version_is_no_other_request(
    client: TestClient,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    path: str,
    model: type[BaseModel],
    body: dict[str, Any],
) -> None:
    """Regression: fingerprints as they were, of the model with all of its defaults."""
    with monkeypatch.context() as older:
        older.setattr(model, "model_dump_json", fewer_defaults)
        first = post(client, path, body)
    with closing(sqlite3.connect(tmp_path / "jobs.sqlite")) as database, database:
        ((kind, request),) = database.execute("SELECT kind, request FROM jobs").fetchall()
        text = json.dumps([kind, json.loads(request)], sort_keys=True, separators=(",", ":"))
        database.execute("UPDATE jobs SET digest = ?", (hashlib.sha256(text.encode()).hexdigest(),))
    again, response = post(client, path, body), post(client, path, changed(body))
    assert (again.status_code, again.headers["location"]) == (202, first.headers["location"])
    assert (response.status_code, response.json()["title"]) == (409, "Key reused")


def test_a_key_of_an_earlier_version_is_that_of_its_kind(house: House) -> None:
    body = json.dumps({"machine": MACHINE}).encode()
    house.store.submit(Order("optimize", body, "0" * 64, key="k"))
    text = ParetoRequest.model_validate_json(body).model_dump_json().encode()
    with pytest.raises(KeyReused):
        house.store.submit(Order("pareto", text, fingerprint("pareto", body), key="k"))


def changed(body: dict[str, Any]) -> dict[str, Any]:
    """A request that says one thing more."""
    name = "points" if "points" in body else "seed"
    return {**body, name: body.get(name, 0) + 1}


@given(_VALUES, st.integers(0, 4))
def test_a_fingerprint_is_that_of_the_json(document: Any, indent: int) -> None:
    first = fingerprint("k", json.dumps(document, sort_keys=True).encode())
    assert first == fingerprint("k", b"\xef\xbb\xbf" + json.dumps(document, indent=indent, ensure_ascii=False).encode())
    assert first != fingerprint("j", json.dumps(document).encode())
    assert first != fingerprint("k", json.dumps([document]).encode())
    # the column of the database
    assert len(first) == 64


def test_a_number_is_the_same_however_it_is_written() -> None:
    assert len({fingerprint("k", text) for text in (b"[300]", b"[300.0]", b"[3e2]", b"[3E+2]")}) == 1
    large = {fingerprint("k", b"%d" % number) for number in (2**53, 2**53 + 1)}
    assert len(large) == 2
    assert fingerprint("k", b"[1]") != fingerprint("k", b'["1"]')
