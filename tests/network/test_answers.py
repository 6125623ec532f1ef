"""How answers go over the wire: at once, and in one piece with their head."""

import asyncio
import json
import select
import socket
import struct
from typing import Any, cast

import pytest
from starlette.types import Receive, Scope, Send
from uvicorn import Config
from uvicorn.server import ServerState

from service.fairness.scheduler import FairScheduler
from service.settings import Settings
from service.wire.coalescing import CoalescingTransport
from service.wire.connections import Connection, connections
from service.wire.server import listen
from tests.network.serving import Service, read, request

SETTINGS = Settings(port=0)


async def app(_: Scope, receive: Receive, send: Send) -> None:
    await receive()
    await send({"type": "http.response.start", "status": 200, "headers": [(b"content-length", b"5")]})
    await send({"type": "http.response.body", "body": b"hello"})


def test_a_kept_connection_waits_for_no_acknowledgement(monkeypatch: pytest.MonkeyPatch) -> None:
    # independent of any clock: what makes an answer wait is a socket that gathers, or an answer in two parts
    written: list[int] = []
    write = CoalescingTransport.flush

    def counted(self: CoalescingTransport) -> None:
        written.append(len(self._buffer))
        write(self)

    monkeypatch.setattr(CoalescingTransport, "flush", counted)

    async def ask() -> tuple[int, list[bytes]]:
        loop, state = asyncio.get_running_loop(), ServerState()
        config = Config(app, lifespan="off", log_config=None)
        protocol: type[Any] = connections(SETTINGS, FairScheduler())
        listening = listen(SETTINGS)
        async with await loop.create_server(lambda: protocol(config, state, {}), sock=listening):
            reader, writer = await asyncio.open_connection(*listening.getsockname()[:2])
            answers = []
            for _ in range(3):
                writer.write(request("GET", "/", headers={"Connection": "keep-alive"}))
                answers.append((await read(reader)).body)
            [served] = state.connections
            assert isinstance(served, Connection)
            accepted = served.transport.get_extra_info("socket")
            gathers_not = accepted.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)
            writer.close()
            await writer.wait_closed()
            return gathers_not, answers

    gathers_not, answers = asyncio.run(ask())
    assert gathers_not != 0
    assert answers == [b"hello"] * 3
    assert len([size for size in written if size]) == 3


@pytest.mark.parametrize("coding", [{"Content-Length": "9" * 15}, {"Transfer-Encoding": "chunked"}])
def test_an_early_answer_is_not_taken_from_who_still_sends(target: Service, coding: dict[str, str]) -> None:
    block = b" " * 50_000
    piece = block if "Content-Length" in coding else f"{len(block):x}\r\n".encode() + block + b"\r\n"
    with socket.create_connection(("127.0.0.1", target.port), timeout=180) as asking:
        asking.sendall(request("POST", "/v1/optimize", headers=coding))
        selectable = select.poll()
        selectable.register(asking, select.POLLIN)
        while not selectable.poll(0):
            asking.sendall(piece)
        # it was answered, and closes: who goes on sending is read, not reset
        for _ in range(20):
            asking.sendall(piece)
            assert not any(event & select.POLLERR for _, event in selectable.poll(10))
        text = b""
        while content := asking.recv(65_536):
            text += content
    assert text.startswith(b"HTTP/1.1 413 ")
    assert text.count(b"\r\n\r\n") == 1
    assert json.loads(text.partition(b"\r\n\r\n")[2])["status"] == 413


def test_a_client_that_has_gone_leaves_no_fault_behind() -> None:
    """Unread bytes, and a reset before the answer is closed: the sockets' own error is no fault of the service."""

    async def close() -> bool:
        loop = asyncio.get_running_loop()
        future: asyncio.Future[asyncio.Transport] = loop.create_future()

        class Peer(asyncio.Protocol):
            def connection_made(self, transport: asyncio.BaseTransport) -> None:
                future.set_result(cast(asyncio.Transport, transport))

        listening = listen(SETTINGS)
        async with await loop.create_server(Peer, sock=listening):
            client = socket.create_connection(listening.getsockname()[:2])
            transport = await future
            joined = CoalescingTransport(transport, loop, lambda: True, 60.0)
            # nothing looks at the socket in between, so that only the closing itself can see it
            transport.pause_reading()
            client.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
            client.close()
            await asyncio.sleep(0.05)
            joined.close()
            joined.ended()
            return transport.is_closing()

    assert asyncio.run(close())
