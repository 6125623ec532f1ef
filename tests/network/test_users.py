"""A portal's users: one key, a proxy that names them, and jobs that are kept apart."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from service.app import create_app
from service.documents.examples import bodies
from service.guard import keys
from service.settings import Settings

PROXY, STRANGER = "10.0.0.7", "192.0.2.1"
SWEEP = next(iter(bodies("sweeps").values()))
Ask = Callable[..., Any]


@pytest.fixture(scope="module")
def asks(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[[str], Ask]]:
    """How an address asks, with a key of the portal and for a user."""
    folder = tmp_path_factory.mktemp("portal")
    fields = {name: keys.make(name, scopes) for name, scopes in (("portal", ("sweeps", "read")), ("root", ("admin",)))}
    keys.write(folder / "keys", [record for _, record in fields.values()])
    settings = Settings(
        keys_file=folder / "keys",
        data_dir=folder / "data",
        owner_header="X-Portal-User",
        trusted_proxies=("10.0.0.0/8",),
    )
    app = create_app(settings, warm=False)

    def of(address: str) -> Ask:
        client = TestClient(app, client=(address, 40_000))

        def ask(user: str | None, method: str, path: str, key: str = "portal", **options: Any) -> Any:
            headers = {"X-API-Key": fields[key][0], **options.pop("headers", {})}
            named = {} if user is None else {"X-Portal-User": user}
            return client.request(method, path, headers={**headers, **named}, **options)

        return ask

    with TestClient(app):
        yield of


@pytest.fixture(scope="module")
def job(asks: Callable[[str], Ask]) -> str:
    """A sweep of the user alice; its path."""
    started = asks(PROXY)("alice", "POST", "/v1/sweeps", json=SWEEP)
    assert started.status_code == 202
    return str(started.headers["location"])


def visibility(ask: Ask, user: str | None, job: str, key: str = "portal") -> tuple[bool, bool]:
    """Whether a user is answered about a job, and has it in the list."""
    listed = [sweep["links"]["self"] for sweep in ask(user, "GET", "/v1/sweeps", key).json()["sweeps"]]
    return ask(user, "GET", job, key).status_code == 200, job in listed


def test_a_user_sees_their_jobs_and_no_others(asks: Callable[[str], Ask], job: str) -> None:
    ask = asks(PROXY)
    assert visibility(ask, "alice", job) == (True, True)
    assert visibility(ask, "bob", job) == (False, False)
    assert ask("bob", "DELETE", job).status_code == 404
    # the portal itself, for none of its users
    assert visibility(ask, None, job) == (False, False)
    assert visibility(ask, None, job, "root") == (True, True)
    # of another owner, and what the key of an administrator may see is not what a user may
    assert visibility(ask, "alice", job, "root") == (False, False)


def test_nobody_but_a_trusted_proxy_names_users(asks: Callable[[str], Ask], job: str) -> None:
    assert visibility(asks(STRANGER), "alice", job) == (False, False)
    # it is the connection that counts, not what is said of whom it was forwarded for
    statuses = [
        asks(address)("alice", "GET", job, headers={"X-Forwarded-For": of}).status_code
        for address, of in ((STRANGER, PROXY), (PROXY, STRANGER))
    ]
    assert statuses == [404, 200]


@pytest.mark.parametrize("user", ["", "a b", "ü".encode(), "x" * 129, "a\x7f"])
def test_a_name_that_is_none_is_refused(asks: Callable[[str], Ask], user: Any) -> None:
    response = asks(PROXY)(user, "GET", "/v1/sweeps")
    assert (response.status_code, response.json()["type"]) == (422, "/problems/invalid-header")
    assert "X-Portal-User" in response.json()["detail"]


def test_without_the_setting_the_header_is_nothing(tmp_path: Path) -> None:
    with TestClient(create_app(Settings(data_dir=tmp_path), warm=False)) as client:
        started = client.post("/v1/sweeps", json=SWEEP, headers={"X-Portal-User": "alice"})
        assert client.get(started.headers["location"], headers={"X-Portal-User": "bob"}).status_code == 200


def test_whom_a_key_acts_for() -> None:
    """Analytic: nobody named leaves the caller as it is; a user has a name of its own and administers nothing."""
    portal = keys.Caller("1", "portal", frozenset(("read", "sweeps", "admin")))
    assert portal.acting_for(None) is portal
    user = portal.acting_for("ann")
    assert (user.owner, user.key) == ("portal/ann", "1")
    assert user.may("read")
    assert not user.may("admin")
    assert keys.Caller("1", None, frozenset(("read",))).acting_for("ann").owner == "/ann"
