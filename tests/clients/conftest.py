"""A real service on loopback, and the client of the examples."""

import importlib.util
import subprocess
import time
from collections.abc import Iterator
from http.client import HTTPConnection
from pathlib import Path
from types import ModuleType
from urllib.parse import urlsplit

import pytest

from tests.commands import Command

ROOT = Path(__file__).parents[2]
CLIENT = ROOT / "examples" / "client" / "counterweight.py"
_READY_S = 300.0


@pytest.fixture(scope="session")
def counterweight() -> ModuleType:
    """The client, read from its file as those who copy it read it."""
    spec = importlib.util.spec_from_file_location("counterweight_client", CLIENT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="session")
def url() -> Iterator[str]:
    """Where a service listens that is ready."""
    command = ("service", "serve", "--port", "0")
    with Command(*command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as process:
        try:
            assert process.stdout is not None
            where = process.stdout.readline().split()[3]
            _wait_until_ready(where)
            yield where
        finally:
            process.terminate()
            process.stdout.close()


def _wait_until_ready(where: str) -> None:
    deadline = time.monotonic() + _READY_S
    address = urlsplit(where)
    while True:
        connection = HTTPConnection(address.hostname or "", address.port, timeout=180)
        connection.request("GET", "/readyz")
        status = connection.getresponse().status
        connection.close()
        if status == 200:
            return
        assert time.monotonic() < deadline
        time.sleep(0.05)
