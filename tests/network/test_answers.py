"""How answers go over the wire: at once, and in one piece with their head."""

import asyncio
import socket
from typing import Any

import pytest
from starlette.types import Receive, Scope, Send
from uvicorn import Config
from uvicorn.server import ServerState

from service.http.connections import Connection, connections
from service.http.joined import Joined
from service.http.rounds import Rounds
from service.http.server import listen
from service.settings import Settings
from tests.network.serving import read, request

SETTINGS = Settings(port=0)


async def app(_: Scope, receive: Receive, send: Send) -> None:
    await receive()
    await send({"type": "http.response.start", "status": 200, "headers": [(b"content-length", b"5")]})
    await send({"type": "http.response.body", "body": b"hello"})


def test_a_kept_connection_waits_for_no_acknowledgement(monkeypatch: pytest.MonkeyPatch) -> None:
    # independent of any clock: what makes an answer wait is a socket that gathers, or an answer in two parts
    written: list[int] = []
    write = Joined.flush

    def counted(self: Joined) -> None:
        written.append(len(self._held))
        write(self)

    monkeypatch.setattr(Joined, "flush", counted)

    async def ask() -> tuple[int, list[bytes]]:
        loop, state = asyncio.get_running_loop(), ServerState()
        config = Config(app, lifespan="off", log_config=None)
        protocol: type[Any] = connections(SETTINGS, Rounds())
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
