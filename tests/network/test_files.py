"""A service that may open few files: connections wait or are refused, and the log does not fill."""

import asyncio
import os
import subprocess
import sys
import tempfile

import pytest

from tests.network.serving import ROOT, Reply, read, request

_LIMITED = "import resource, runpy, sys; resource.setrlimit(resource.RLIMIT_NOFILE, ({n}, {n})); sys.argv[1:] = "
_SERVE = "['serve', '--port', '0']; runpy.run_module('service', run_name='__main__')"


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


async def _ask(port: int) -> Reply:
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    writer.write(request("GET", "/v1/examples"))
    try:
        return await read(reader)
    finally:
        writer.close()


# few: connections are refused before files run out; very few: files run out
@pytest.mark.parametrize("files", [160, 60])
def test_a_service_without_files_says_so_once_and_goes_on(files: int) -> None:
    with tempfile.TemporaryDirectory() as folder, open(f"{folder}/log", "w+") as log:
        environment = {**os.environ, "COUNTERWEIGHT_DATA_DIR": f"{folder}/data", "COUNTERWEIGHT_LOG_LEVEL": "warning"}
        command = [sys.executable, "-c", _LIMITED.format(n=files) + _SERVE]
        with subprocess.Popen(
            command, cwd=ROOT, env=environment, stdout=subprocess.PIPE, stderr=log, text=True
        ) as process:
            try:
                assert process.stdout is not None
                port = int(process.stdout.readline().split(" (")[0].rpartition(":")[2])
                opened, reply = asyncio.run(_many(port, 250))
                assert opened > files
                assert reply.status == 200
            finally:
                process.terminate()
                process.wait(180)
        log.seek(0)
        said = log.read().splitlines()
        assert len(said) < 40
        assert sum("no file can be opened" in line for line in said) <= 1
