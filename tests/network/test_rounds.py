"""Rounds: whose bytes are looked at next."""

import asyncio
from collections import deque
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager

import pytest
import uvicorn
from hypothesis import given
from hypothesis import strategies as st
from uvicorn.server import ServerState

from service.http.connections import Connection, connections
from service.http.rounds import Rounds
from service.settings import Settings
from tests.network.serving import read, request


class Loop:
    """Turns of an event loop, one after the other."""

    def __init__(self) -> None:
        self.soon: deque[Callable[[], None]] = deque()

    def turn(self) -> None:
        for _ in range(len(self.soon)):
            self.soon.popleft()()


def test_what_is_alone_is_done_at_once_and_one_piece_in_a_turn() -> None:
    loop, done = Loop(), list[int]()
    rounds = Rounds(loop.soon.append)
    assert rounds.ask("a", lambda: done.append(1))
    assert not rounds.ask("a", lambda: done.append(2))
    assert done == [1]
    loop.turn()
    assert done == [1, 2]
    loop.turn()
    assert rounds.ask("a", lambda: done.append(3))


def test_one_of_many_connections_delays_nobody() -> None:
    loop, done = Loop(), list[str]()
    rounds = Rounds(loop.soon.append)
    for k in range(300):
        rounds.ask("many", lambda k=k: done.append(f"many {k}"))  # type: ignore[misc]
    rounds.ask("few", lambda: done.append("few"))
    for _ in range(2):
        loop.turn()
    assert done == ["many 0", "many 1", "few"]


@given(st.lists(st.sampled_from("abc"), max_size=30), st.lists(st.integers(0, 3), max_size=30))
def test_all_is_done_once_and_in_the_order_of_its_client(clients: list[str], turns: list[int]) -> None:
    loop, done = Loop(), list[tuple[str, int]]()
    rounds = Rounds(loop.soon.append)
    for number, client in enumerate(clients):
        rounds.ask(client, lambda client=client, number=number: done.append((client, number)))  # type: ignore[misc]
        for _ in range(turns[number] if number < len(turns) else 0):
            loop.turn()
    for _ in range(len(clients) + 1):
        loop.turn()
    for client in "abc":
        asked = [(each, number) for number, each in enumerate(clients) if each == client]
        assert [one for one in done if one[0] == client] == asked
    assert not loop.soon


async def nobody(scope: object, receive: object, send: object) -> None:
    raise AssertionError("what came too late is answered")


@asynccontextmanager
async def waiting() -> AsyncIterator[tuple[Connection, asyncio.StreamReader, Loop]]:
    """A connection whose first bytes wait for their round, its client, and what gives them their round."""
    loop, made = Loop(), list[Connection]()

    class Waiting(connections(Settings())):  # type: ignore[misc]
        rounds = Rounds(loop.soon.append)

    def accepted() -> Connection:
        made.append(Waiting(config, ServerState(), {}))
        return made[0]

    config = uvicorn.Config(nobody, interface="asgi3", http=Waiting, log_config=None)
    config.load()
    assert Waiting.rounds.ask("other", lambda: None)
    listening = await asyncio.get_running_loop().create_server(accepted, "127.0.0.1", 0)
    async with listening, asyncio.timeout(180):
        reader, writer = await asyncio.open_connection(*listening.sockets[0].getsockname())
        writer.write(request("GET", "/healthz"))
        while not Waiting.rounds._waiting:
            await asyncio.sleep(0.01)
        yield made[0], reader, loop
        made[0].transport.abort()
        writer.close()
        await writer.wait_closed()


@pytest.mark.parametrize(
    ("ended", "status"),
    [(Connection.give_up, 503), (Connection.timeout_keep_alive_handler, 0), (Connection.shutdown, 0)],
)
def test_what_waits_on_a_connection_that_ends_is_not_looked_at(
    ended: Callable[[Connection], None], status: int
) -> None:
    """The place of a probe is given to another, or the service ends, while a request waits for its round."""

    async def answered() -> int:
        async with waiting() as (connection, reader, loop):
            ended(connection)
            loop.turn()
            assert not connection.rounds._waiting
            return (await read(reader)).status

    assert asyncio.run(answered()) == status


def test_a_connection_whose_bytes_wait_is_not_idle() -> None:
    async def counts() -> bool:
        async with waiting() as (connection, _, _):
            # an answer ends when the next request has come already
            connection.on_response_complete()
            return connection.timeout_keep_alive_task is not None

    assert not asyncio.run(counts())


def test_who_waits_for_a_turn_has_it_in_the_order_of_the_clients() -> None:
    async def told() -> list[str]:
        rounds, done = Rounds(asyncio.get_running_loop().call_soon), list[str]()

        async def pieces(client: str) -> None:
            for _ in range(3):
                await rounds.turn(client)
                done.append(client)

        async with asyncio.timeout(180), asyncio.TaskGroup() as group:
            many = [group.create_task(pieces("many")) for _ in range(50)]
            gone = many.pop()
            await asyncio.sleep(0)
            group.create_task(pieces("few"))
            gone.cancel()
        return done

    done = asyncio.run(told())
    assert done.count("many") >= 3 * 49
    # between two of its own at most one of somebody else's, and one or two turns to ask for the next
    assert [k for k, client in enumerate(done) if client == "few"][-1] < 20
