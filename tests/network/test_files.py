"""A service that may open few files: connections wait or are refused, and the log does not fill."""

import asyncio
import os
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from service.wire import server
from tests.commands import Command
from tests.network.serving import Reply, read, request
from tests.night import but


async def _many(port: int, count: int) -> tuple[int, Reply]:
    """How many of so many connections are open at once, and an answer when they are closed again."""
    held = []
    for _ in range(count):
        try:
            held.append(await asyncio.wait_for(asyncio.open_connection("127.0.0.1", port), 30))
        except OSError:
            break
    await asyncio.sleep(3)
    for _, writer in held:
        writer.transport.abort()
    async with asyncio.timeout(180):
        # when it has seen that they are closed
        while (reply := await _ask(port)).status != 200:
            await asyncio.sleep(0.1)
    return len(held), reply


async def _probed(port: int, count: int) -> list[Reply]:
    """Beside so many connections that stay: probes, and something else; then the same something when all are closed.

    A client that stays longer than the test lasts has every file; nothing but a spare one answers the others.
    """
    held = [await asyncio.open_connection("127.0.0.1", port) for _ in range(count)]
    async with asyncio.timeout(60):
        replies = [await _ask(port, path, "keep-alive") for path in ("/healthz", "/readyz", "/v1/examples", "/healthz")]
    for _, writer in held:
        writer.transport.abort()
    async with asyncio.timeout(180):
        while (reply := await _ask(port)).status != 200:
            await asyncio.sleep(0.1)
    return [*replies, reply]


async def _ask(port: int, path: str = "/v1/examples", connection: str = "close") -> Reply:
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    writer.write(request("GET", path, headers={"Connection": connection}))
    try:
        return await read(reader)
    finally:
        writer.close()


@contextmanager
def _limited(files: int, rivals: int = server._OTHER_FILES, **settings: str) -> Iterator[tuple[int, Path]]:
    """The port and the log of a service that may open so many files, so many of them for others than connections."""
    with tempfile.TemporaryDirectory() as folder, open(f"{folder}/log", "w") as log:
        actual_settings = {"DATA_DIR": f"{folder}/data", "LOG_LEVEL": "warning", **settings}
        environment = {**os.environ, **{f"COUNTERWEIGHT_{name}": value for name, value in actual_settings.items()}}
        command = ("tests.network.limited", str(files), str(rivals), "serve", "--port", "0")
        with Command(*command, environment=environment, stdout=subprocess.PIPE, stderr=log, text=True) as process:
            try:
                assert process.stdout is not None
                yield int(process.stdout.readline().split(" (")[0].rpartition(":")[2]), Path(log.name)
            finally:
                process.terminate()
                process.wait(180)


# few: connections are refused before files run out; very few: files run out
@pytest.mark.parametrize("files", but([60], [160, 60]))
def test_a_service_without_files_says_so_once_and_goes_on(files: int) -> None:
    with _limited(files) as (port, log):
        opened, reply = asyncio.run(_many(port, 250))
        assert opened > files
        assert reply.status == 200
        lines = log.read_text().splitlines()
    assert len(lines) < 40
    assert sum("no file can be opened" in line for line in lines) <= 1


def test_a_service_without_files_answers_for_its_health() -> None:
    # every file may be a connection, whatever else is open: as where large answers wait in files.
    # whoever says nothing is closed long after the test
    with _limited(100, rivals=0, HEADERS_TIMEOUT_S="600") as (port, log):
        alive, ready, refused, again, after = asyncio.run(_probed(port, 250))
        text = log.read_text()
    assert (alive.status, again.status, after.status) == (200, 200, 200)
    # whether it is ready yet is not what matters here
    assert ready.status in (200, 503)
    assert ready.headers["connection"] == "close"
    assert refused.status == 503
    assert "no file can be opened" in text
