"""What a worker says arrives whole, in whatever pieces it comes, with the file that belongs to it."""

import asyncio
import os
import socket
from collections.abc import Iterator
from tempfile import TemporaryFile
from threading import Thread
from typing import Any, BinaryIO

import anyio
import pytest

from service.workers.messages import Listener, say


@pytest.fixture
def ends() -> Iterator[tuple[socket.socket, socket.socket]]:
    ours, theirs = socket.socketpair()
    with ours, theirs:
        yield ours, theirs


async def next_message(ours: socket.socket) -> tuple[Any, BinaryIO | None]:
    """What comes next."""
    return await Listener(ours).receive()


def whole(message: object) -> bytes:
    """The bytes of an object as they go over a socket."""
    ours, theirs = socket.socketpair()
    with ours, theirs:
        say(theirs, message)
        return ours.recv(1_000_000)


def test_objects_come_as_they_were_said(ends: tuple[socket.socket, socket.socket]) -> None:
    ours, theirs = ends
    # each in an event loop of its own
    listener = Listener(ours)
    for message in (None, "short", {"a": bytes(50_000)}):
        say(theirs, message)
        assert anyio.run(listener.receive) == (message, None)


def test_an_object_that_comes_in_pieces_is_waited_for(ends: tuple[socket.socket, socket.socket]) -> None:
    ours, theirs = ends
    message = whole("in pieces")

    async def piecemeal() -> Any:
        messages: list[Any] = []

        async def listen() -> None:
            messages.append(await next_message(ours))

        async with anyio.create_task_group() as tasks:
            tasks.start_soon(listen)
            for byte in message:
                assert not messages
                theirs.sendall(bytes([byte]))
                await anyio.lowlevel.checkpoint()
        return messages

    assert anyio.run(piecemeal) == [("in pieces", None)]


def test_an_object_larger_than_the_socket_holds_is_sent_whole(ends: tuple[socket.socket, socket.socket]) -> None:
    ours, theirs = ends
    large = os.urandom(2_000_000)
    worker = Thread(target=say, args=(theirs, large))
    worker.start()
    assert anyio.run(next_message, ours) == (large, None)
    worker.join()


def test_a_file_comes_with_its_object(ends: tuple[socket.socket, socket.socket]) -> None:
    ours, theirs = ends
    with TemporaryFile() as file:
        file.write(b"large")
        file.seek(0)
        say(theirs, "beside it", file)
    message, io = anyio.run(next_message, ours)
    assert message == "beside it"
    assert io is not None
    with io:
        assert io.read() == b"large"


@pytest.mark.parametrize("count", [0, 3, 12])
def test_one_that_ends_in_the_middle_is_gone(ends: tuple[socket.socket, socket.socket], count: int) -> None:
    ours, theirs = ends
    theirs.sendall(whole("never heard")[:count])
    theirs.close()
    with pytest.raises(EOFError):
        anyio.run(next_message, ours)


def test_who_stops_waiting_leaves_what_comes_to_the_next(ends: tuple[socket.socket, socket.socket]) -> None:
    ours, theirs = ends
    message = whole("for the next")

    async def two() -> Any:
        listener = Listener(ours)
        for piece in (b"", message[:5], message[5:12]):
            theirs.sendall(piece)
            with anyio.move_on_after(0.01):
                await listener.receive()
                raise AssertionError
        theirs.sendall(message[12:])
        return await listener.receive()

    assert anyio.run(two) == ("for the next", None)


def test_what_was_said_before_the_end_is_heard(ends: tuple[socket.socket, socket.socket]) -> None:
    ours, theirs = ends
    listener = Listener(ours)

    async def gone() -> bool:
        return listener.gone

    assert not anyio.run(gone)
    say(theirs, "farewell")
    theirs.close()
    assert anyio.run(listener.receive) == ("farewell", None)
    assert anyio.run(gone)
    with pytest.raises(EOFError):
        anyio.run(listener.receive)


def test_a_socket_is_closed_where_it_is_read(ends: tuple[socket.socket, socket.socket]) -> None:
    ours, theirs = ends

    async def ended_in_a_thread() -> None:
        listener = Listener(ours)
        say(theirs, 1)
        await listener.receive()
        await anyio.to_thread.run_sync(listener.end)
        await anyio.wait_all_tasks_blocked()
        assert ours.fileno() == -1
        # the number is free for another one
        again, actual_socket = socket.socketpair()
        with again, actual_socket:
            say(actual_socket, 2)
            assert await Listener(again).receive() == (2, None)

    anyio.run(ended_in_a_thread)


def test_what_a_loop_did_not_come_to_close_is_closed_with_the_next_one() -> None:
    """A loop may be over before it has done all that a thread asks of it."""
    loop, (ours, theirs), (actual_socket, far) = asyncio.new_event_loop(), socket.socketpair(), socket.socketpair()
    with theirs, far:
        listener = Listener(ours)
        say(theirs, "begun")
        assert loop.run_until_complete(listener.receive()) == ("begun", None)
        listener.end()
        loop.close()
        assert ours.fileno() != -1
        Listener(actual_socket).end()
        assert (ours.fileno(), actual_socket.fileno()) == (-1, -1)
