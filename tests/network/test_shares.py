"""Shares: what one client may hold, and what is said when it would hold more."""

import asyncio
import json
from collections.abc import Mapping, Sequence
from typing import Any

import pytest

from schemas.answer.problem import Problem
from service.fairness.faults import OverShare
from service.fairness.quotas import Holding, Quota, quotas
from service.fairness.scheduler import FairScheduler
from service.fairness.table import Resource
from service.fairness.table import shares as table
from service.settings import Settings
from service.wire.pacing import PIECE_BYTES, Pacing
from tests.network.load import start_sweep
from tests.network.serving import request, service

MB = 1_000_000


def shares(**option: int) -> Mapping[Resource, Quota]:
    return quotas(table(Settings(**option)))  # type: ignore[arg-type]


def test_a_client_has_its_share_and_all_have_theirs() -> None:
    actual_shares = shares(row_streams=3, row_streams_each=2)
    rows = actual_shares["rows"]
    assert [rows.take("a", 2), rows.take("a"), rows.take("b")] == [True, False, True]
    # one is assured to everybody, though all are taken
    assert [rows.take("c"), rows.take("b")] == [True, False]
    assert [rows.holding_of(who) for who in "abc"] == [2, 1, 1]
    with pytest.raises(OverShare, match="Too many streams of rows"):
        Holding(actual_shares, "a").take("rows")
    # of another kind there is as much as before
    assert actual_shares["events"].take("a", 5)
    rows.give("a", 2)
    assert rows.take("b")


def test_what_a_request_holds_ends_with_it() -> None:
    actual_shares = shares(held_mb_each=2)
    holding = Holding(actual_shares, "a")
    holding.take("answers", 2 * MB)
    with pytest.raises(OverShare):
        Holding(actual_shares, "a").take("answers", 1)
    holding.give("answers", MB)
    holding.take("rows")
    holding.end()
    assert (actual_shares["answers"].holding_of("a"), actual_shares["rows"].holding_of("a")) == (0, 0)


def answered(held: Holding, parts: Sequence[bytes]) -> list[dict[str, Any]]:
    """What is sent of an answer in some parts, by a client that takes everything."""
    values: list[dict[str, Any]] = []

    async def app(scope: Any, receive: Any, send: Any) -> None:
        await send({"type": "http.response.start", "status": 200, "headers": []})
        for number, part in enumerate(parts, 1):
            await send({"type": "http.response.body", "body": part, "more_body": number < len(parts)})

    async def send(message: Any) -> None:
        values.append(dict(message))

    async def receive() -> Any:
        raise AssertionError("nobody reads")

    asyncio.run(Pacing(app, FairScheduler())({"type": "http", "path": "/x", "state": {"holding": held}}, receive, send))
    return values


@pytest.mark.parametrize("size", [0, 1, PIECE_BYTES, PIECE_BYTES + 1, 5 * PIECE_BYTES])
def test_an_answer_is_whole_whatever_its_pieces(size: int) -> None:
    actual_shares = shares()
    body = bytes(k % 251 for k in range(size))
    start, *pieces = answered(Holding(actual_shares, "a"), [body])
    assert start["status"] == 200
    assert b"".join(piece["body"] for piece in pieces) == body
    assert max(len(piece["body"]) for piece in pieces) <= PIECE_BYTES
    assert [piece.get("more_body", False) for piece in pieces] == [True] * (len(pieces) - 1) + [False]
    assert actual_shares["answers"].holding_of("a") == 0


def test_an_answer_over_the_share_is_answered_429_in_its_place() -> None:
    actual_shares = shares(held_mb_each=2)
    holding = Holding(actual_shares, "a")
    holding.take("answers", 2 * MB)
    start, body = answered(Holding(actual_shares, "a"), [bytes(MB), b"more"])
    problem = Problem.model_validate_json(body["body"])
    assert (start["status"], problem.title, problem.instance) == (429, "Over share", "/x")
    assert (b"retry-after", b"1") in start["headers"]
    assert actual_shares["answers"].holding_of("a") == 2 * MB
    # a small one is not counted, and one that has begun is not broken off
    for parts in ([bytes(PIECE_BYTES)], [b"begun", bytes(MB)]):
        start, *pieces = answered(Holding(actual_shares, "a"), parts)
        assert start["status"] == 200
        assert b"".join(piece["body"] for piece in pieces) == b"".join(parts)
    # another client is not concerned
    assert answered(Holding(actual_shares, "b"), [bytes(MB)])[0]["status"] == 200


def test_streams_over_the_share_of_a_client_are_refused_until_one_has_ended() -> None:
    async def statuses() -> list[int]:
        path = f"{await start_sweep(target)}/events"
        actual_statuses = []
        async with target.connection() as (reader, writer):
            writer.write(request("GET", path))
            await reader.readuntil(b"\r\n\r\n")
            refused = await target.ask("GET", path)
            assert json.loads(refused.body)["title"] == "Over share"
            assert refused.headers["retry-after"] == "1"
            actual_statuses.append(refused.status)
        while True:
            async with asyncio.timeout(180), target.connection() as (reader, writer):
                writer.write(request("HEAD", path))
                head = await reader.readuntil(b"\r\n\r\n")
            actual_statuses.append(int(head.split()[1]))
            if actual_statuses[-1] == 200:
                return actual_statuses
            await asyncio.sleep(0.1)

    with service(event_streams_each=1) as target:
        assert asyncio.run(statuses())[:1] == [429]
