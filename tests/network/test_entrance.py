"""The entrance: for whom there is no room, nothing is made."""

import asyncio
import json
from collections.abc import AsyncIterator, Callable, Coroutine
from contextlib import asynccontextmanager
from typing import Any

import pytest
from starlette.types import Receive, Scope, Send
from uvicorn import Config
from uvicorn.server import ServerState

from service.fairness.connection_limits import ConnectionLimits
from service.fairness.scheduler import FairScheduler
from service.fairness.table import PROBES
from service.fairness.table import connections as share
from service.settings import Settings
from service.wire.connections import Connection, connections
from service.wire.entrance import Entrance
from service.wire.server import listen
from tests.network.serving import Reply, read, request

SETTINGS = Settings(port=0)


async def app(_: Scope, receive: Receive, send: Send) -> None:
    await receive()
    await send({"type": "http.response.start", "status": 200, "headers": [(b"content-length", b"5")]})
    await send({"type": "http.response.body", "body": b"hello"})


class House:
    """A server with room for so many connections, whose clients count what is made for them."""

    def __init__(self, room: int, patience_s: float) -> None:
        self.made = 0
        self.state = ServerState()
        self.doors = ConnectionLimits(share(room, room), ())
        protocol = connections(SETTINGS, FairScheduler())
        config = Config(app, lifespan="off", log_config=None)
        config.load()

        def connection() -> Connection:
            self.made += 1
            return protocol(config, self.state, {})

        self.listening = listen(SETTINGS)
        self.entrance = Entrance(self.listening, self.doors, protocol.rounds, connection, patience_s)

    @asynccontextmanager
    async def connected(self) -> AsyncIterator[tuple[asyncio.StreamReader, asyncio.StreamWriter]]:
        reader, writer = await asyncio.open_connection(*self.listening.getsockname()[:2])
        try:
            yield reader, writer
        finally:
            writer.transport.abort()

    async def ask(self, path: str, body: bytes = b"") -> Reply:
        async with self.connected() as (reader, writer):
            writer.write(request("POST" if body else "GET", path, body))
            return await read(reader)

    async def empty(self) -> None:
        """Until it has seen that nobody is left."""
        while self.doors._open._total or self.doors._probing or self.state.connections or self.entrance.refused:
            await asyncio.sleep(0.01)


def within(room: int, work: Callable[[House], Coroutine[Any, Any, Any]], patience_s: float = 600) -> Any:
    async def outcome() -> Any:
        house = House(room, patience_s)
        house.entrance.open()
        try:
            async with asyncio.timeout(180):
                actual_work = await work(house)
                await house.empty()
            return actual_work
        finally:
            house.entrance.close()
            house.listening.close()

    return asyncio.run(outcome())


@pytest.mark.parametrize("body", [b"", b" " * 3_000_000], ids=["", "with a body that is sent on"])
def test_without_room_nothing_is_made_but_for_who_asks_for_health(body: bytes) -> None:
    async def story(house: House) -> None:
        refused = await house.ask("/v1/sweeps", body)
        assert refused.status == 503
        assert refused.headers["retry-after"] == "1"
        assert refused.headers["connection"] == "close"
        assert json.loads(refused.body)["title"] == "Too many connections"
        assert house.made == 0
        assert (await house.ask("/healthz")).status == 200
        assert house.made == 1
        # nothing else begins so, though the protocol is needed to tell
        assert (await house.ask("/healthzz")).status == 503

    within(0, story)


def test_with_room_there_is_an_answer_and_then_room_again() -> None:
    async def story(house: House) -> list[int]:
        statuses = []
        for _ in range(3):
            statuses.append((await house.ask("/v1/sweeps")).status)
            await house.empty()
        return statuses

    assert within(1, story) == [200] * 3


def test_of_those_without_room_who_came_first_makes_place() -> None:
    async def silent(house: House) -> None:
        held = [
            await asyncio.open_connection(*house.listening.getsockname()[:2]) for _ in range(int(PROBES.per_client) + 2)
        ]
        # the first two are told, the others may still ask
        assert [(await read(reader)).status for reader, _ in held[:2]] == [503, 503]
        held[2][1].write(request("GET", "/readyz"))
        assert (await read(held[2][0])).status == 200
        for _, writer in held:
            writer.transport.abort()

    within(0, silent)


def test_who_is_about_to_ask_for_health_may_lose_the_place() -> None:
    async def many(house: House) -> set[int]:
        # more than there are places, all at once: whatever becomes of each, it ends
        return set(await asyncio.gather(*((_status(house)) for _ in range(60))))

    assert within(0, many) <= {200, 503, 0}


async def _status(house: House) -> int:
    return (await house.ask("/healthz")).status


def test_without_room_one_may_not_be_silent_for_ever() -> None:
    async def silent(house: House) -> int:
        async with house.connected() as (reader, _):
            return (await read(reader)).status

    assert within(0, silent, patience_s=0.1) == 503


def test_who_leaves_is_forgotten() -> None:
    async def leave(house: House) -> int:
        for _ in range(20):
            async with house.connected():
                pass
        await house.empty()
        return house.made

    assert within(0, leave) == 0


def test_a_closed_entrance_takes_nobody() -> None:
    async def closed(house: House) -> int:
        async with house.connected() as (reader, _):
            while not house.entrance.refused:
                await asyncio.sleep(0.01)
            house.entrance.close()
            assert await reader.read() == b""
        return house.made

    assert within(0, closed) == 0
