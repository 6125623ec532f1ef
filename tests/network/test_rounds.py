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

from service.fairness.scheduler import _APART, FairScheduler
from service.settings import Settings
from service.wire.connections import Connection, connections
from tests.network.serving import read, request


class Loop:
    """Turns of an event loop, one after the other."""

    def __init__(self) -> None:
        self.soon: deque[Callable[[], None]] = deque()

    def turn(self) -> None:
        for _ in range(len(self.soon)):
            self.soon.popleft()()


def test_what_is_alone_is_done_at_once_and_one_piece_in_a_turn() -> None:
    loop, values = Loop(), list[int]()
    rounds = FairScheduler(loop.soon.append)
    assert rounds.ask("a", lambda: values.append(1))
    assert not rounds.ask("a", lambda: values.append(2))
    assert values == [1]
    loop.turn()
    assert values == [1, 2]
    loop.turn()
    assert rounds.ask("a", lambda: values.append(3))


def test_one_of_many_connections_delays_nobody() -> None:
    loop, texts = Loop(), list[str]()
    rounds = FairScheduler(loop.soon.append)
    for k in range(300):
        rounds.ask("many", lambda k=k: texts.append(f"many {k}"))  # type: ignore[misc]
    for _ in range(3):
        rounds.ask("few", lambda: texts.append("few"))
        loop.turn()
    # between two of its own there is nothing of the other's, however much of that waits
    assert texts == ["many 0", "few", "few", "few"]


def test_of_whom_much_waits_something_is_done_however_much_others_ask() -> None:
    loop, texts = Loop(), list[str]()
    rounds = FairScheduler(loop.soon.append)
    for k in range(300):
        rounds.ask(f"client {k % 3}", lambda k=k: texts.append(f"client {k % 3}"))  # type: ignore[misc]
    count = 0
    for _ in range(30 * _APART):
        # always one, as soon as the one before is done
        if texts.count("few") == count:
            count += 1
            rounds.ask("few", lambda: texts.append("few"))
        loop.turn()
    assert [text for text in texts if text != "few"] == [f"client {k % 3}" for k in range(31)]
    assert texts.count("few") == 30 * (_APART - 1)


def test_no_turn_goes_by_without_anything() -> None:
    """Beside other work pieces of one client are turns apart; where nothing else is done they follow one another."""
    pieces, turns, counts = 40, 0, list[int]()

    async def story() -> None:
        rounds, loop, end = FairScheduler(), asyncio.get_running_loop(), asyncio.Event()

        def count() -> None:
            nonlocal turns
            turns += 1
            if len(counts) < pieces // 2:
                # something else in each turn
                loop.call_soon(count)

        def piece() -> None:
            counts.append(turns)
            if len(counts) == pieces // 2:
                select = loop._selector.select  # type: ignore[attr-defined]

                def counted(timeout: float | None) -> object:
                    # each turn looks once for what has come
                    count()
                    return select(timeout)

                loop._selector.select = counted  # type: ignore[attr-defined]
            if len(counts) == pieces:
                end.set()

        loop.call_soon(count)
        for _ in range(pieces):
            rounds.ask("many", piece)
        async with asyncio.timeout(180):
            await end.wait()

    asyncio.run(story())
    half = pieces // 2
    assert counts[half - 1] - counts[1] == (half - 2) * _APART
    assert counts[-1] - counts[half] == half - 1


def test_what_waited_in_a_loop_that_has_ended_is_gone_with_it() -> None:
    rounds, values = FairScheduler(), list[int]()

    async def ask() -> None:
        for k in range(3):
            rounds.ask("a", lambda k=k: values.append(k))  # type: ignore[misc]

    for _ in range(2):
        asyncio.run(ask())
    assert values.count(0) == 2


@given(st.lists(st.sampled_from("abc"), max_size=30), st.lists(st.integers(0, 3), max_size=30))
def test_all_is_done_once_and_in_the_order_of_its_client(clients: list[str], turns: list[int]) -> None:
    loop, values = Loop(), list[tuple[str, int]]()
    rounds = FairScheduler(loop.soon.append)
    for number, client in enumerate(clients):
        rounds.ask(client, lambda client=client, number=number: values.append((client, number)))  # type: ignore[misc]
        for _ in range(turns[number] if number < len(turns) else 0):
            loop.turn()
    for _ in range(_APART * len(clients) + 1):
        loop.turn()
    for client in "abc":
        entries = [(browser, number) for number, browser in enumerate(clients) if browser == client]
        assert [pair for pair in values if pair[0] == client] == entries
    assert not loop.soon


async def nobody(scope: object, receive: object, send: object) -> None:
    raise AssertionError("what came too late is answered")


@asynccontextmanager
async def waiting() -> AsyncIterator[tuple[Connection, asyncio.StreamReader, Loop]]:
    """A connection whose first bytes wait for their round, its client, and what gives them their round."""
    loop, protocols = Loop(), list[Connection]()

    protocol = connections(Settings(), FairScheduler(loop.soon.append))

    def accepted() -> Connection:
        protocols.append(protocol(config, ServerState(), {}))
        return protocols[0]

    config = uvicorn.Config(nobody, interface="asgi3", http=protocol, log_config=None)
    config.load()
    assert protocol.rounds.ask("other", lambda: None)
    listening = await asyncio.get_running_loop().create_server(accepted, "127.0.0.1", 0)
    async with listening, asyncio.timeout(180):
        reader, writer = await asyncio.open_connection(*listening.sockets[0].getsockname())
        writer.write(request("GET", "/healthz"))
        while not protocol.rounds.waiting:
            await asyncio.sleep(0.01)
        yield protocols[0], reader, loop
        protocols[0].transport.abort()
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
            assert not connection.rounds.waiting
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
    async def story() -> list[str]:
        rounds, clients = FairScheduler(), list[str]()

        async def pieces(client: str) -> None:
            for _ in range(3):
                await rounds.turn(client)
                clients.append(client)

        async with asyncio.timeout(180), asyncio.TaskGroup() as group:
            many = [group.create_task(pieces("many")) for _ in range(50)]
            gone = many.pop()
            await asyncio.sleep(0)
            group.create_task(pieces("few"))
            gone.cancel()
        return clients

    text = asyncio.run(story())
    assert text.count("many") >= 3 * 49
    # between two of its own at most one of somebody else's, and one or two turns to ask for the next
    assert [k for k, client in enumerate(text) if client == "few"][-1] < 20
