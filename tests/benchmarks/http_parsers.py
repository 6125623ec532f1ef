"""What reading and answering HTTP costs, by the protocol of the server: ``python -m tests.benchmarks.http_parsers``.

Each protocol serves the same bare application in a process of its own, and they take turns on kept connections of
loopback. The figure is CPU time of the process for a request, the least of all turns, as others load the machine.
Our connections, with their timers, limits and fair turns, are measured with three readers of heads: the expression that
they have, h11 for everything, and httptools. Where httptools is not installed, as the service does not need it, the
output says so.
"""

import argparse
import asyncio
import multiprocessing
import socket
from collections.abc import Sequence
from importlib import import_module
from multiprocessing.context import SpawnProcess
from pathlib import Path
from typing import Any

import uvicorn
from starlette.types import Receive, Scope, Send
from uvicorn.protocols.http.h11_impl import H11Protocol

from service.fairness.scheduler import FairScheduler
from service.settings import Settings
from service.wire.connections import Connection, connections
from service.wire.plain_requests import Head
from tests.network.serving import read, request

NAMES = ("uvicorn, h11", "uvicorn, httptools", "ours", "ours, h11 alone", "ours, httptools")
#: of question and answer of the 2D12 [bytes]
_QUESTION, _ANSWER = bytes(3_000), bytes(8_000)
_HEADERS = [(b"content-length", b"8000"), (b"content-type", b"application/json"), (b"vary", b"Accept-Encoding")]
_WITHIN_S = 60.0


async def app(scope: Scope, receive: Receive, send: Send) -> None:
    while (await receive()).get("more_body"):
        pass
    await send({"type": "http.response.start", "status": 200, "headers": _HEADERS})
    await send({"type": "http.response.body", "body": _ANSWER})


def protocol(name: str) -> type[asyncio.Protocol]:
    """The class of a connection.

    Raises
    ------
    ImportError
        for httptools, where it is not installed.
    """
    if name == "uvicorn, h11":
        return H11Protocol
    if name == "uvicorn, httptools":
        http_tools_protocol: type[asyncio.Protocol] = import_module(
            "uvicorn.protocols.http.httptools_impl"
        ).HttpToolsProtocol
        return http_tools_protocol
    ours = connections(Settings(), FairScheduler())
    if name == "ours":
        return ours
    parser = None if name == "ours, h11 alone" else import_module("httptools").HttpRequestParser

    class Other(ours):  # type: ignore[misc, valid-type]
        def _plain_head(self, data: bytes) -> tuple[Head, int] | None:
            return None if parser is None else head_by(parser, data)

    assert issubclass(Other, Connection)
    return Other


class Reader:
    """What httptools says of a head."""

    def __init__(self) -> None:
        self.target = b""
        self.headers: list[tuple[bytes, bytes]] = []

    def on_url(self, url: bytes) -> None:
        self.target += url

    def on_header(self, name: bytes, value: bytes) -> None:
        self.headers.append((name.lower(), value))


def head_by(parser: Any, data: bytes) -> tuple[Head, int] | None:
    """A head of a request with a length, read by httptools, which sees nothing after it."""
    end = data.find(b"\r\n\r\n") + 4
    reader = Reader()
    reading = parser(reader)
    reading.feed_data(data[:end])
    length = int(dict(reader.headers).get(b"content-length", b"0"))
    head = Head(reading.get_method().decode(), reader.target, reader.headers, length, reading.should_keep_alive())
    return head, end


def serve(name: str, listening: socket.socket) -> None:
    """Serve until the process is ended."""
    config = uvicorn.Config(
        app, loop="asyncio", http=protocol(name), ws="none", lifespan="off", log_config=None, access_log=False
    )
    uvicorn.Server(config).run(sockets=[listening])


async def ask(port: int, clients: int, count: int) -> None:
    """So many requests, by clients that each keep a connection."""
    raw = request("POST", "/v1/optimize", _QUESTION, {"Connection": "keep-alive"})

    async def client() -> None:
        reader, writer = await asyncio.open_connection("127.0.0.1", port)
        for _ in range(count // clients):
            writer.write(raw)
            reply = await read(reader)
            assert (reply.status, reply.body) == (200, _ANSWER)
        writer.close()

    async with asyncio.timeout(_WITHIN_S):
        await asyncio.gather(*(client() for _ in range(clients)))


def cpu_us(process: SpawnProcess) -> float:
    """What the only thread of a process has computed so far (Linux)."""
    return int(Path(f"/proc/{process.pid}/schedstat").read_text().split()[0]) / 1e3


def measure(names: Sequence[str], clients: int, count: int, turns: int) -> dict[str, float]:
    """CPU time of a request [us], least of all turns, by the name of a protocol."""
    context = multiprocessing.get_context("spawn")
    servers: dict[str, tuple[SpawnProcess, int]] = {}
    try:
        for name in names:
            listening = socket.create_server(("127.0.0.1", 0))
            listening.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            process = context.Process(target=serve, args=(name, listening), daemon=True)
            process.start()
            servers[name] = process, listening.getsockname()[1]
            listening.close()
        minima = dict.fromkeys(names, float("inf"))
        for turn in range(turns + 1):
            for name, (process, port) in servers.items():
                before = cpu_us(process)
                asyncio.run(ask(port, clients, count))
                spent_us = (cpu_us(process) - before) / count
                # of the first turn much is the start
                minima[name] = min(minima[name], spent_us) if turn else minima[name]
    finally:
        for process, _ in servers.values():
            process.terminate()
            process.join(10)
    return minima


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--requests", type=int, default=3000, help="in a turn")
    parser.add_argument("--turns", type=int, default=7)
    arguments = parser.parse_args()
    names = list(NAMES)
    try:
        import_module("httptools")
    except ImportError:
        names = [name for name in NAMES if "httptools" not in name]
        print("httptools is not installed: NOT MEASURED")
    for clients in (1, 16):
        measurement = measure(names, clients, arguments.requests, arguments.turns)
        print(f"{clients} clients [us]:", "; ".join(f"{name} {time_us:.0f}" for name, time_us in measurement.items()))


if __name__ == "__main__":
    main()
