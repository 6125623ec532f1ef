"""The real service as a process, the memory of its processes, and raw requests to it."""

import asyncio
import os
import re
import subprocess
import tempfile
import time
from collections.abc import AsyncIterable, Iterator, Mapping
from contextlib import asynccontextmanager, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO

import psutil

from tests.commands import Command
from tests.processes import all_children, fork_servers

_MB = 1e6


@dataclass(frozen=True)
class Reply:
    """An answer; status 0 if the connection was closed without one."""

    status: int
    headers: Mapping[str, str]
    body: bytes


class Service:
    """A service that runs."""

    def __init__(self, process: "subprocess.Popen[str]", port: int, log: IO[str]) -> None:
        self.process = process
        self.port = port
        self.url = f"http://127.0.0.1:{port}"
        self._log = log

    def log(self) -> str:
        """Everything that it has said on standard error."""
        self._log.flush()
        return Path(self._log.name).read_text()

    def faults(self) -> list[str]:
        """What it has logged as an error, line by line."""
        return [line for line in self.log().splitlines() if '"ERROR"' in line]

    def workers(self) -> list[psutil.Process]:
        """The processes that compute answers: children of the one that they are forked from."""
        return [worker for server in fork_servers(self.process.pid) for worker in all_children(server.pid)]

    def memory_mb(self) -> tuple[float, float]:
        """Resident memory of the service, and of its largest worker [MB]."""
        own = psutil.Process(self.process.pid).memory_info().rss
        largest = 0
        for worker in self.workers():
            with suppress(psutil.NoSuchProcess):
                largest = max(largest, worker.memory_info().rss)
        return own / _MB, largest / _MB

    async def computing(self, count: int) -> None:
        """Until so many answers are being computed."""
        text = f"counterweight_computations_running {count:.1f}\n".encode()
        async with asyncio.timeout(180):
            while text not in (await self.ask("GET", "/metrics")).body:
                await asyncio.sleep(0.02)

    async def ask(
        self, method: str, path: str, body: bytes = b"", headers: Mapping[str, str] | None = None, timeout: float = 180
    ) -> Reply:
        return await self.send(request(method, path, body, headers), timeout)

    async def send(self, raw: bytes | AsyncIterable[bytes], timeout: float = 180) -> Reply:
        """The answer to some bytes, on a connection of their own."""
        async with asyncio.timeout(timeout), self.connection() as (reader, writer):
            sending = asyncio.create_task(_write(writer, raw))
            try:
                return await read(reader)
            finally:
                sending.cancel()
                with suppress(asyncio.CancelledError, OSError):
                    await sending

    @asynccontextmanager
    async def connection(self):  # type: ignore[no-untyped-def]
        reader, writer = await asyncio.open_connection("127.0.0.1", self.port)
        try:
            yield reader, writer
        finally:
            writer.close()
            with suppress(OSError):
                await writer.wait_closed()


def request(method: str, path: str, body: bytes = b"", headers: Mapping[str, str] | None = None) -> bytes:
    """A request as it goes over the wire; the connection is closed after it unless the headers say otherwise."""
    actual_headers = {"Host": "localhost", "Connection": "close", "Content-Type": "application/json", **(headers or {})}
    if body and "Transfer-Encoding" not in actual_headers:
        actual_headers.setdefault("Content-Length", str(len(body)))
    lines = "".join(f"{name}: {value}\r\n" for name, value in actual_headers.items())
    return f"{method} {path} HTTP/1.1\r\n{lines}\r\n".encode("utf-8", "surrogateescape") + body


async def _write(writer: asyncio.StreamWriter, raw: bytes | AsyncIterable[bytes]) -> None:
    with suppress(ConnectionError):
        if isinstance(raw, bytes):
            writer.write(raw)
        else:
            async for piece in raw:
                writer.write(piece)
                await writer.drain()
        await writer.drain()


async def read(reader: asyncio.StreamReader) -> Reply:
    """The next answer on a connection."""
    try:
        head = await reader.readuntil(b"\r\n\r\n")
    except (asyncio.IncompleteReadError, ConnectionError):
        return Reply(0, {}, b"")
    first, *lines = head.decode("latin-1").split("\r\n")
    headers = {name.lower(): value.strip() for name, _, value in (line.partition(":") for line in lines if line)}
    body = b""
    with suppress(ConnectionError, asyncio.IncompleteReadError):
        if headers.get("transfer-encoding") == "chunked":
            while size := int(await reader.readline(), 16):
                body += (await reader.readexactly(size + 2))[:-2]
            await reader.readline()
        else:
            body = await reader.readexactly(int(headers.get("content-length", "0")))
    return Reply(int(first.split()[1]), headers, body)


@contextmanager
def service(fresh: bool = False, **settings: str | int) -> Iterator[Service]:
    """A service with some ``COUNTERWEIGHT_*`` settings, ready to compute; ended, and known to have ended, after it.

    Parameters
    ----------
    fresh : started from nothing, see :class:`tests.commands.Command`.
    """
    with tempfile.TemporaryDirectory(prefix="counterweight-") as folder, open(f"{folder}/log", "w") as log:
        fields = {"DATA_DIR": f"{folder}/data", **{name.upper(): str(value) for name, value in settings.items()}}
        environment = {**os.environ, **{f"COUNTERWEIGHT_{name}": value for name, value in fields.items()}}
        command = ("service", "serve", "--port", "0")
        process = Command(*command, environment=environment, fresh=fresh, stdout=subprocess.PIPE, stderr=log, text=True)
        try:
            assert process.stdout is not None
            match = re.search(r"http://\S+:(\d+) ", process.stdout.readline())
            assert match is not None, Path(log.name).read_text()
            server = Service(process, int(match[1]), log)
            _wait(server)
            yield server
        finally:
            process.terminate()
            try:
                process.wait(180)
            finally:
                process.kill()
                process.wait()
                if process.stdout is not None:
                    process.stdout.close()


def _wait(server: Service) -> None:
    deadline = time.monotonic() + 300
    while asyncio.run(server.ask("GET", "/readyz")).status != 200:
        assert time.monotonic() < deadline, server.log()
        time.sleep(0.02)
