"""Whose a request is while it lasts, by the guard alone: no service, no sockets."""

import asyncio
from collections.abc import Callable
from typing import Any

import pytest
from starlette.types import Message, Receive, Scope, Send

from service.guard.access import Access
from service.guard.hosts import Hosts
from service.guard.keys import ANYONE, Caller, Keys
from service.guard.rates import RateLimits
from service.guard.refusals import BadHeader
from service.guard.users import user_of
from service.settings import Settings

ALICE = Caller("a", "alice", frozenset({"read"}))


class Ring(Keys):
    """Keys that come and go as a test says."""

    def __init__(self, callers: dict[str, Caller]) -> None:
        self.callers = callers

    def caller(self, key: str) -> Caller | None:
        return self.callers.get(key)


def admitted(keys: Ring | None, after: Callable[[Scope], None], **headers: str) -> bool:
    """Whether a request is still admitted after something has happened while it was answered."""
    values: list[bool] = []

    async def application(scope: Scope, receive: Receive, send: Send) -> None:
        after(scope)
        values.append(scope["state"]["still_admitted"]())

    def refused(error: Exception, path: str) -> Any:
        raise error

    async def nothing(*_: Any) -> Message:
        return {}

    limits = RateLimits(Settings(rate_limit="", refusal_limit=""))
    access = Access(application, keys, Hosts(["*"]), limits, {}, refused)
    entries = [(name.replace("_", "-").lower().encode(), value.encode()) for name, value in headers.items()]
    scope = {"type": "http", "path": "/v1/jobs", "headers": entries, "client": ("127.0.0.1", 9), "state": {}}
    asyncio.run(access(scope, nothing, nothing))  # type: ignore[arg-type]
    return values[0]


@pytest.mark.parametrize("header", [{"X_API_Key": "one"}, {"Authorization": "Bearer one"}])
def test_a_request_lasts_as_long_as_its_key(header: dict[str, str]) -> None:
    ring = Ring({"one": ALICE})
    assert admitted(ring, lambda _: None, **header)
    assert not admitted(ring, lambda _: ring.callers.clear(), **header)


def test_a_key_that_is_somebody_elses_by_now_is_no_key() -> None:
    ring = Ring({"one": ALICE})
    assert not admitted(ring, lambda _: ring.callers.update(one=Caller("b", "bob", ALICE.scopes)), X_API_Key="one")


def test_a_request_for_a_user_lasts_for_that_user_alone() -> None:
    ring = Ring({"one": ALICE})

    def named(name: str) -> Callable[[Scope], None]:
        return lambda scope: scope["state"].update(users=("X-User", [name]))

    # who asked is alice herself
    assert not admitted(ring, named("carol"), X_API_Key="one")


def test_where_nobody_needs_a_key_everybody_stays() -> None:
    assert ANYONE.key is None
    assert admitted(None, lambda _: None)


@pytest.mark.parametrize(
    ("names", "user"), [([], None), (["carol"], "carol"), (["c" * 128], "c" * 128), (["car!ol@x"], "car!ol@x")]
)
def test_one_name_is_a_user(names: list[str], user: str | None) -> None:
    assert user_of({"state": {"users": ("X-User", names)}}) == user


@pytest.mark.parametrize("names", [["carol", "dave"], ["carol", "carol"], [""], ["c" * 129], ["car ol"], ["çarol"]])
def test_what_is_no_name_or_several_is_refused(names: list[str]) -> None:
    with pytest.raises(BadHeader, match=r"^X-User must be one name"):
        user_of({"state": {"users": ("X-User", names)}})
