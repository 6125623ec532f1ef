"""Refusals are counted by route and kind, also those before a route is looked for."""

import re
from pathlib import Path

import pytest
from starlette.testclient import TestClient

from service.app import create_app
from service.guard.keys import make, write
from service.settings import Settings


@pytest.fixture
def keyed(tmp_path: Path) -> tuple[TestClient, str]:
    key, record = make("portal", ("metrics", "read"))
    write(tmp_path / "keys.jsonl", [record])
    return TestClient(create_app(Settings(keys_file=tmp_path / "keys.jsonl"), warm=False)), key


def test_refusals_are_counted_by_route_and_kind(keyed: tuple[TestClient, str]) -> None:
    client, key = keyed
    with client:
        client.get("/v1/sweeps/5f0c")
        client.get("/v1/sweeps/5f0d")
        client.get("/v1/nothing")
        client.post("/v1/optimize", json={}, headers={"X-API-Key": key})
        client.get("/v1/effects?x=1", headers={"X-API-Key": key})
        client.get("/v1/effects", headers={"X-API-Key": key})
        text = client.get("/metrics", headers={"X-API-Key": key}).text
    line = re.compile(r'^counterweight_refusals_total\{kind="(.+?)",route="(.+?)"\} (\S+)$', re.MULTILINE)
    assert {(kind, route): float(count) for kind, route, count in line.findall(text)} == {
        ("unauthorized", "/v1/sweeps/{id}"): 2.0,
        ("unauthorized", "unmatched"): 1.0,
        ("forbidden", "/v1/optimize"): 1.0,
        ("invalid-parameter", "/v1/effects"): 1.0,
    }
