"""For whom a service answers where nobody needs a key: a web page that takes its address (DNS rebinding) is no one."""

from pathlib import Path

import pytest
from starlette.testclient import TestClient

from service.app import create_app
from service.guard import keys
from service.settings import Settings

FOREIGN = (
    "evil.example", "evil.example:8000", "127.0.0.1.evil.example", "localhost.evil.example", "xlocalhost",
    "127.0.0.1@evil", "10.0.0.9", "[2001:db8::1]:80", "a b", "[::1", "", ":80", "127.0.0.1:80:80", "0x7f000001",
)  # fmt: skip
OWN = (
    "localhost", "LOCALHOST:8000", "localhost.", "portal.localhost", "127.0.0.1", "127.8.8.8:1", "[::1]", "[::1]:80",
    "service.example", "Service.Example:8443", "testserver",
)  # fmt: skip


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> TestClient:
    settings = Settings(data_dir=tmp_path_factory.mktemp("data"), allowed_hosts=("service.example",))
    return TestClient(create_app(settings, warm=False))


@pytest.mark.parametrize("host", FOREIGN)
def test_a_foreign_host_learns_and_does_nothing(client: TestClient, host: str) -> None:
    for method, path in (("GET", "/v1/sweeps"), ("DELETE", "/v1/sweeps/x"), ("GET", "/"), ("GET", "/nothing")):
        answer = client.request(method, path, headers={"Host": host})
        assert (answer.status_code, answer.headers["content-type"]) == (421, "application/problem+json")
        assert host not in answer.json()["detail"] or not host


@pytest.mark.parametrize("host", OWN)
def test_this_machine_the_address_that_is_asked_and_those_of_the_list_are_answered(
    client: TestClient, host: str
) -> None:
    assert client.get("/v1/examples", headers={"Host": host}).status_code == 200


def test_probes_are_answered_by_whatever_name(client: TestClient) -> None:
    assert client.get("/healthz", headers={"Host": "10.1.2.3:8000"}).status_code == 200


def test_any_host_where_that_is_said(tmp_path: Path) -> None:
    app = create_app(Settings(data_dir=tmp_path, allowed_hosts=("*",)), warm=False)
    assert TestClient(app).get("/v1/examples", headers={"Host": "evil.example"}).status_code == 200


def test_with_keys_the_host_does_not_matter(tmp_path: Path) -> None:
    key, record = keys.make("alice", ("read",))
    keys.write(tmp_path / "keys", [record])
    app = create_app(Settings(data_dir=tmp_path, keys_file=tmp_path / "keys"), warm=False)
    fields = {"Host": "service.example", "X-API-Key": key}
    assert TestClient(app).get("/v1/examples", headers=fields).status_code == 200
