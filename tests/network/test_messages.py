"""What a worker says arrives whole, in whatever pieces it comes, with the file that belongs to it."""

import os
import socket
from collections.abc import Iterator
from tempfile import TemporaryFile
from threading import Thread
from typing import Any

import anyio
import pytest

from service.workers.messages import heard, say


@pytest.fixture
def ends() -> Iterator[tuple[socket.socket, socket.socket]]:
    ours, theirs = socket.socketpair()
    with ours, theirs:
        yield ours, theirs


def whole(said: object) -> bytes:
    """The bytes of an object as they go over a socket."""
    ours, theirs = socket.socketpair()
    with ours, theirs:
        say(theirs, said)
        return ours.recv(1_000_000)


def test_objects_come_as_they_were_said(ends: tuple[socket.socket, socket.socket]) -> None:
    ours, theirs = ends
    for said in (None, "short", {"a": bytes(50_000)}):
        say(theirs, said)
        assert anyio.run(heard, ours) == (said, None)


def test_an_object_that_comes_in_pieces_is_waited_for(ends: tuple[socket.socket, socket.socket]) -> None:
    ours, theirs = ends
    message = whole("in pieces")

    async def piecemeal() -> Any:
        found: list[Any] = []

        async def listen() -> None:
            found.append(await heard(ours))

        async with anyio.create_task_group() as tasks:
            tasks.start_soon(listen)
            for byte in message:
                assert not found
                theirs.sendall(bytes([byte]))
                await anyio.lowlevel.checkpoint()
        return found

    assert anyio.run(piecemeal) == [("in pieces", None)]


def test_an_object_larger_than_the_socket_holds_is_sent_whole(ends: tuple[socket.socket, socket.socket]) -> None:
    ours, theirs = ends
    large = os.urandom(2_000_000)
    worker = Thread(target=say, args=(theirs, large))
    worker.start()
    assert anyio.run(heard, ours) == (large, None)
    worker.join()


def test_a_file_comes_with_its_object(ends: tuple[socket.socket, socket.socket]) -> None:
    ours, theirs = ends
    with TemporaryFile() as file:
        file.write(b"large")
        file.seek(0)
        say(theirs, "beside it", file)
    said, found = anyio.run(heard, ours)
    assert said == "beside it"
    assert found is not None
    with found:
        assert found.read() == b"large"


@pytest.mark.parametrize("count", [0, 3, 12])
def test_one_that_ends_in_the_middle_is_gone(ends: tuple[socket.socket, socket.socket], count: int) -> None:
    ours, theirs = ends
    theirs.sendall(whole("never heard")[:count])
    theirs.close()
    with pytest.raises(EOFError):
        anyio.run(heard, ours)
