"""A service as a process, and a client."""

import http.client
import io
import json
import os
import subprocess
import time
from collections.abc import Iterator, Mapping
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import psutil
import pyarrow as pa
import pyarrow.parquet as pq

from tests.commands import Command
from tests.jobs.serving import DELAY
from tests.processes import all_children, fork_servers


class Service:
    """A service that was started; it may be killed at any moment.

    Parameters
    ----------
    more : of its environment, besides its settings.
    """

    def __init__(
        self, folder: Path, delay_s: float = 0.05, more: Mapping[str, str] | None = None, **settings: str
    ) -> None:
        environment = {f"COUNTERWEIGHT_{name.upper()}": value for name, value in settings.items()}
        base = {"COUNTERWEIGHT_DATA_DIR": str(folder), "COUNTERWEIGHT_LEASE_S": "1", "COUNTERWEIGHT_SWEEP_WORKERS": "2"}
        self.process = Command(
            "tests.jobs.serving",
            environment={**os.environ, **base, **environment, DELAY: str(delay_s), **(more or {})},
            stdout=subprocess.PIPE,
            text=True,
        )

    def wait(self) -> "Service":
        """Until it listens."""
        assert self.process.stdout is not None
        parts = urlsplit(self.process.stdout.readline().strip())
        assert parts.hostname is not None, f"it ended with {self.process.wait()}"
        assert parts.port is not None
        self.where = (parts.hostname, parts.port)
        # it has started all that it starts when it answers
        assert self.send("GET", "/healthz")[0] == 200
        return self

    def workers(self) -> list[psutil.Process]:
        """The processes that compute chunks, as no answer is asked for."""
        return [worker for server in fork_servers(self.process.pid) for worker in all_children(server.pid)]

    def send(self, method: str, path: str, body: object = None, **headers: str) -> tuple[int, dict[str, str], bytes]:
        return send(self.where, method, path, body, **headers)

    def read(self, path: str) -> Any:
        return json.loads(self.send("GET", path)[2])

    def ended(self, path: str, timeout: float = 300) -> Any:
        """The state of a sweep that has ended."""
        deadline = time.monotonic() + timeout
        while (state := self.read(path))["state"] in ("queued", "running"):
            assert time.monotonic() < deadline, state
            time.sleep(0.1)
        return state

    def rows(self, path: str) -> pa.Table:
        # no threads of Arrow: see House.rows
        return pq.ParquetFile(io.BytesIO(self.send("GET", f"{path}/results?format=parquet")[2])).read(use_threads=False)

    def kill(self) -> None:
        self.process.kill()
        self.close()

    def close(self) -> None:
        self.process.wait(180)
        if self.process.stdout is not None:
            self.process.stdout.close()


def send(
    where: tuple[str, int], method: str, path: str, body: object = None, **headers: str
) -> tuple[int, dict[str, str], bytes]:
    """Status, headers and body of the answer to a request on a connection of its own."""
    with closing(http.client.HTTPConnection(*where, timeout=300)) as connection:
        content = None if body is None else json.dumps(body)
        connection.request(method, path, content, {"Content-Type": "application/json", **headers})
        answer = connection.getresponse()
        return answer.status, {key.lower(): value for key, value in answer.headers.items()}, answer.read()


@contextmanager
def service(folder: Path, **settings: Any) -> Iterator[Service]:
    server = Service(folder, **settings)
    try:
        yield server.wait()
    finally:
        if server.process.poll() is None:
            server.process.terminate()
        server.close()
