"""Keys: who may do what, and what those learn who may not."""

import asyncio
import json
import re
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from service.app import create_app
from service.computations.computation import Computation
from service.computations.table import COMPUTATIONS
from service.documents.examples import bodies
from service.guard import keys
from service.guard.keys import Scope
from service.settings import Settings
from tests.network.serving import Service, request, service

KEYS: dict[str, tuple[str, tuple[Scope, ...], dict[str, Any]]] = {
    "alice": ("alice", ("compute", "sweeps", "read"), {}),
    "alice's new one": ("alice", ("sweeps", "read"), {}),
    "bob": ("bob", ("compute", "sweeps", "read"), {}),
    "reader": ("bob", ("read",), {}),
    "meter": ("prometheus", ("metrics",), {}),
    "admin": ("root", ("admin",), {}),
    "slow": ("slow", ("read",), {"rate_limit": "3/hour"}),
    "expired": ("alice", ("admin",), {"expires": 1.0}),
}
SWEEP = next(iter(bodies("sweeps").values()))
#: takes longer than any test
LONG = {"path": "/machine/speed_rpm", "start": 300, "stop": 900, "count": 10_000_000}
NOBODYS = ("0" * 32, "f" * 32, "x", "..%2f")


@pytest.fixture(scope="module")
def keyring(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, str]]:
    """The file of the keys, and the keys by name."""
    fields = {name: keys.make(owner, scopes, **more) for name, (owner, scopes, more) in KEYS.items()}
    file = tmp_path_factory.mktemp("keys") / "keys"
    keys.write(file, [record for _, record in fields.values()])
    return file, {name: key for name, (key, _) in fields.items()}


@pytest.fixture(scope="module")
def client(keyring: tuple[Path, dict[str, str]], tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    settings = Settings(
        host="0.0.0.0",
        keys_file=keyring[0],
        data_dir=tmp_path_factory.mktemp("data"),
        refusal_limit="2000/minute",
        cors_origins=("https://portal.example",),
        hsts_s=600,
    )
    with TestClient(create_app(settings, warm=False)) as client:
        yield client


@pytest.fixture
def ask(client: TestClient, keyring: tuple[Path, dict[str, str]]) -> Any:
    def send(name: str | None, method: str, path: str, **options: Any) -> Any:
        headers = {} if name is None else {"Authorization": f"Bearer {keyring[1].get(name, name)}"}
        return client.request(method, path, headers={**headers, **options.pop("headers", {})}, **options)

    return send


@pytest.fixture
def job(ask: Any) -> str:
    """A sweep of alice; its path."""
    started = ask("alice", "POST", "/v1/sweeps", json=SWEEP)
    assert started.status_code == 202
    return str(started.headers["location"])


PLACES = ["", "/results", "/events", "/metadata"]


@pytest.mark.parametrize("name", [None, "nonsense", "cw_0123456789ab_" + "x" * 43, "expired", "ü", ""])
def test_without_a_right_key_everything_looks_the_same(
    ask: Any, keyring: tuple[Path, dict[str, str]], job: str, name: str | None
) -> None:
    # the key itself where there is one of this name: one that has expired is as wrong as any other
    key = None if name is None else keyring[1].get(name, name).encode()

    def reply_to(path: str, method: str = "GET") -> tuple[Any, ...]:
        answer = ask(None, method, path, headers={} if key is None else {"X-API-Key": key})
        body = answer.json()
        assert body.pop("instance") in (path, path.replace("%2f", "/"))
        headers = {k: v for k, v in answer.headers.items() if k not in ("x-request-id", "content-length")}
        return answer.status_code, body, headers

    for place in PLACES:
        real = reply_to(job + place)
        assert real[0] == 401
        assert all(reply_to(f"/v1/sweeps/{text}{place}") == real for text in NOBODYS)
        assert reply_to("/nothing") == real
    assert reply_to(job, "DELETE") == reply_to(f"/v1/sweeps/{NOBODYS[0]}", "DELETE")
    assert ask("alice", "GET", job).status_code == 200


def test_a_key_is_right_until_it_expires(monkeypatch: pytest.MonkeyPatch, keyring: tuple[Path, dict[str, str]]) -> None:
    key_file, key = keys.Keys(keyring[0]), keyring[1]["expired"]
    monkeypatch.setattr("service.guard.keys.time.time", lambda: 0.5)
    caller = key_file.caller(key)
    assert caller is not None
    assert caller.owner == "alice"
    monkeypatch.setattr("service.guard.keys.time.time", lambda: 1.5)
    assert key_file.caller(key) is None


@pytest.mark.parametrize("name", ["bob", "reader"])
def test_the_job_of_another_is_as_unknown_as_one_that_is_none(ask: Any, job: str, name: str) -> None:
    def reply_to(path: str) -> tuple[Any, ...]:
        answer = ask(name, "GET", path)
        return answer.status_code, {**answer.json(), "instance": ""}

    for place in PLACES:
        assert reply_to(job + place) == reply_to(f"/v1/sweeps/{NOBODYS[0]}{place}")
        assert reply_to(job + place)[0] == 404
    identity = job.rpartition("/")[2]
    assert reply_to(f"/v1/sweeps?before={identity}") == reply_to(f"/v1/sweeps?before={NOBODYS[0]}")
    assert ask(name, "GET", "/v1/sweeps").json()["sweeps"] == []
    assert ask("bob", "DELETE", job).status_code == 404
    assert ask("bob", "POST", f"{job}/resume").status_code == 404
    assert ask("alice", "GET", job).status_code == 200


def test_jobs_belong_to_the_owner_of_the_key_and_admins_see_all(ask: Any, job: str) -> None:
    identity = job.rpartition("/")[2]
    for name in ("alice", "alice's new one", "admin"):
        assert ask(name, "GET", job).status_code == 200
        assert identity in [sweep["id"] for sweep in ask(name, "GET", "/v1/sweeps").json()["sweeps"]]
    assert ask("alice's new one", "DELETE", job).status_code in (200, 204)


def test_the_same_idempotency_key_of_two_owners_is_two_jobs(ask: Any) -> None:
    options = {"json": SWEEP, "headers": {"Idempotency-Key": "same"}}
    first_id, again, second_id = (
        ask(name, "POST", "/v1/sweeps", **options).json()["id"] for name in ("alice", "alice", "bob")
    )
    assert first_id == again != second_id


@pytest.mark.parametrize(
    ("name", "method", "path", "status"),
    [
        ("reader", "POST", "/v1/optimize", 403),
        ("reader", "POST", "/v1/sweeps", 403),
        ("reader", "DELETE", "/v1/sweeps/x", 403),
        ("reader", "GET", "/metrics", 403),
        ("reader", "GET", "/v1/examples", 200),
        ("reader", "HEAD", "/v1/examples", 200),
        ("reader", "HEAD", "/metrics", 403),
        ("meter", "GET", "/metrics", 200),
        ("meter", "GET", "/v1/sweeps", 403),
        ("meter", "POST", "/v1/optimize", 403),
        ("admin", "GET", "/metrics", 200),
        ("alice", "POST", "/v1/optimize", 422),
        ("alice", "GET", "/metrics", 403),
        (None, "GET", "/healthz", 200),
        (None, "GET", "/docs", 200),
        (None, "GET", "/openapi.json", 200),
        (None, "GET", "/metrics", 401),
        (None, "GET", "/v1/examples", 401),
    ],
)
def test_scopes(ask: Any, name: str | None, method: str, path: str, status: int) -> None:
    more = {"json": {}} if method == "POST" else {}
    assert ask(name, method, path, **more).status_code == status


@pytest.mark.parametrize("computation", COMPUTATIONS.values(), ids=lambda subject: subject.name)
def test_every_computing_route_asks_for_its_scope(ask: Any, computation: Computation) -> None:
    for name in ("reader", "meter"):
        refused = ask(name, "POST", computation.path, json={})
        assert refused.status_code == 403
        assert refused.json()["detail"] == f"This needs a key with the scope {computation.scope}."
    assert ask("alice", "POST", computation.path, json={}).status_code == 422


def test_a_key_has_a_rate_of_its_own(ask: Any) -> None:
    statuses = [ask("slow", "GET", "/v1/examples").status_code for _ in range(5)]
    assert statuses == [200] * 3 + [429] * 2
    answer = ask("slow", "GET", "/v1/examples")
    assert 0 < int(answer.headers["retry-after"]) <= 3600
    assert answer.headers["content-type"] == "application/problem+json"
    assert (answer.headers["ratelimit-policy"], answer.headers["ratelimit"][:11]) == ('"key";q=3;w=3600', '"key";r=0;t')
    # another key has all of its own
    assert ask("alice", "GET", "/v1/examples").status_code == 200


def test_an_answer_says_what_is_left_of_the_rate(keyring: tuple[Path, dict[str, str]]) -> None:
    with TestClient(create_app(Settings(keys_file=keyring[0], rate_limit="5/minute"), warm=False)) as client:
        responses = [client.get("/v1/nothing", headers={"X-API-Key": keyring[1]["alice"]}) for _ in range(3)]
        assert [response.status_code for response in responses] == [404] * 3
        assert {response.headers["ratelimit-policy"] for response in responses} == {'"key";q=5;w=60'}
        matches = [re.fullmatch(r'"key";r=(\d+);t=(\d+)', response.headers["ratelimit"]) for response in responses]
        assert [match[1] for match in matches if match] == ["4", "3", "2"]
        assert all(0 < int(match[2]) <= 60 for match in matches if match)
        # another key has as much of its own
        reply = client.get("/v1/nothing", headers={"X-API-Key": keyring[1]["bob"]})
        assert reply.headers["ratelimit"].startswith('"key";r=4;')
        # nobody has a rate on a page for everybody, nor without a limit
        assert "ratelimit" not in client.get("/healthz").headers
        assert "ratelimit" not in client.get("/v1/nothing").headers
    with TestClient(create_app(Settings(keys_file=keyring[0], rate_limit=""), warm=False)) as client:
        assert "ratelimit" not in client.get("/v1/nothing", headers={"X-API-Key": keyring[1]["alice"]}).headers


def test_those_who_guess_are_slowed_down(keyring: tuple[Path, dict[str, str]]) -> None:
    app = create_app(Settings(keys_file=keyring[0], refusal_limit="3/hour"), warm=False)
    with TestClient(app) as client:
        statuses = [client.get("/v1/examples", headers={"X-API-Key": "x"}).status_code for _ in range(5)]
        assert statuses == [401] * 3 + [429] * 2
        # who has a key is not locked out by a neighbour who guesses
        assert client.get("/v1/examples", headers={"X-API-Key": keyring[1]["alice"]}).status_code == 200


async def _guess(target: Service, forwarded: str) -> int:
    headers = {"X-API-Key": "x", "X-Forwarded-For": forwarded}
    return (await target.ask("GET", "/v1/examples", headers=headers)).status


def test_nobody_avoids_that_by_saying_that_he_is_another_one(keyring: tuple[Path, dict[str, str]]) -> None:
    with service(keys_file=str(keyring[0]), refusal_limit="3/hour") as target:
        statuses = [asyncio.run(_guess(target, f"10.0.0.{k}")) for k in range(5)]
    assert statuses == [401] * 3 + [429] * 2


def test_a_proxy_is_believed_if_it_is_named(keyring: tuple[Path, dict[str, str]]) -> None:
    with service(keys_file=str(keyring[0]), refusal_limit="1/hour", trusted_proxies="127.0.0.0/8") as target:
        addresses = ("10.0.0.1", "10.0.0.2", "10.0.0.1", "2001:db8::1", "2001:db8::2", "2001:db8:0:1::1")
        statuses = [asyncio.run(_guess(target, address)) for address in addresses]
    # a network of IPv6 is one client
    assert statuses == [401, 401, 429, 401, 429, 401]


def test_a_stream_ends_when_its_key_is_revoked(tmp_path: Path) -> None:
    key, record = keys.make("alice", ("sweeps",))
    key_record = keys.make("bob", ("read",))[1]
    file = tmp_path / "keys"
    keys.write(file, [record, key_record])

    async def watch(target: Service) -> bytes:
        sweep = {**SWEEP, "base": bodies()["2d12"], "axes": [LONG], "design": "grid"}
        headers = {"X-API-Key": key}
        job = (await target.ask("POST", "/v1/sweeps", json.dumps(sweep).encode(), headers)).headers["location"]
        async with target.connection() as (reader, writer):
            writer.write(request("GET", f"{job}/events", headers=headers))
            await reader.readuntil(b"event: progress")
            keys.write(file, [key_record])
            return await asyncio.wait_for(reader.read(), 180)

    with service(keys_file=str(file), sweep_workers=1) as target:
        actual_watch = asyncio.run(watch(target))
    assert actual_watch.endswith(b"0\r\n\r\n")
    assert b"event: end" not in actual_watch


def test_no_key_is_in_the_file_and_nobody_else_can_read_it(keyring: tuple[Path, dict[str, str]]) -> None:
    text = keyring[0].read_text()
    assert not any(key in text or key.split("_", 2)[2] in text for key in keyring[1].values())
    assert keyring[0].stat().st_mode & 0o777 == 0o600


def test_a_wrong_key_takes_as_long_as_a_right_one(keyring: tuple[Path, dict[str, str]]) -> None:
    key_file = keys.Keys(keyring[0])

    def seconds(key: str) -> float:
        begun = time.perf_counter()
        key_file.caller(key)
        return time.perf_counter() - begun

    right = keyring[1]["alice"]
    texts = (right, right[:-1] + "~", right[:-4] + "AAAA", "cw_0123456789ab_" + "x" * 43)
    # the best of each, in turns: what else the machine does slows all of them
    best = [min(times) for times in zip(*([seconds(key) for key in texts] for _ in range(500)), strict=True)]
    assert max(best) < 3 * min(best)


# ---- what browsers are told


def test_only_pages_of_the_listed_origins_may_ask(client: TestClient) -> None:
    fields = {"Access-Control-Request-Method": "POST", "Access-Control-Request-Headers": "authorization,content-type"}
    allowed = client.options("/v1/optimize", headers={"Origin": "https://portal.example", **fields})
    assert allowed.status_code == 200
    assert allowed.headers["access-control-allow-origin"] == "https://portal.example"
    refused = client.options("/v1/optimize", headers={"Origin": "https://evil.example", **fields})
    assert "access-control-allow-origin" not in refused.headers
    assert (refused.status_code, refused.headers["content-type"]) == (400, "application/problem+json")
    assert refused.json()["detail"] == "Disallowed CORS origin."
    assert "origin" in refused.headers["vary"].lower()
    # an error can be read by the page too
    answer = client.get("/v1/examples", headers={"Origin": "https://portal.example"})
    assert (answer.status_code, answer.headers["access-control-allow-origin"]) == (401, "https://portal.example")
    assert (
        "access-control-allow-origin" not in client.get("/healthz", headers={"Origin": "https://evil.example"}).headers
    )


@pytest.mark.parametrize("path", ["/healthz", "/v1/examples", "/nothing", "/docs", "/"])
def test_security_headers_are_on_every_answer(client: TestClient, path: str) -> None:
    headers = client.get(path).headers
    assert headers["x-content-type-options"] == "nosniff"
    assert headers["x-frame-options"] == "DENY"
    assert headers["referrer-policy"] == "no-referrer"
    assert "default-src" in headers["content-security-policy"]
    assert "strict-transport-security" not in headers


def test_https_is_insisted_on_where_it_is_used(client: TestClient) -> None:
    answer = client.get("https://testserver/healthz")
    assert answer.headers["strict-transport-security"] == "max-age=600; includeSubDomains"


def test_a_prefix_changes_nothing_about_who_may_what(keyring: tuple[Path, dict[str, str]], tmp_path: Path) -> None:
    app = create_app(Settings(keys_file=keyring[0], data_dir=tmp_path), warm=False)
    with TestClient(app, root_path="/cw") as client:
        for prefix in ("", "/cw"):
            assert client.get(f"{prefix}/healthz").status_code == 200
            assert client.get(f"{prefix}/v1/examples").status_code == 401
            assert client.get(f"{prefix}/metrics", headers={"X-API-Key": keyring[1]["alice"]}).status_code == 403
            assert client.get(f"{prefix}/healthz/../v1/examples").status_code == 401
        assert client.get("/cwhealthz").status_code == 401
