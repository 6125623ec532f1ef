"""A service as users start it, on a free port, in a process of its own."""

import os
import re
import subprocess
import time
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from tests.commands import Command

_READY_WITHIN_S = 300.0
_URL = re.compile(r"http://127\.0\.0\.1:\d+")


@contextmanager
def serving(folder: Path, **settings: str) -> Iterator[str]:
    """Address of a service that is ready; its data and its log are in the folder."""
    variables = {f"COUNTERWEIGHT_{name.upper()}": value for name, value in settings.items()}
    environment = {**os.environ, "COUNTERWEIGHT_DATA_DIR": str(folder), **variables}
    command = ("service", "serve", "--port", "0")
    with (
        (folder / "log").open("w") as log,
        Command(*command, environment=environment, stdout=subprocess.PIPE, stderr=log, text=True) as process,
    ):
        try:
            assert process.stdout is not None
            match = _URL.search(process.stdout.readline())
            assert match, (folder / "log").read_text()
            _wait(match[0])
            yield match[0]
        finally:
            process.terminate()
            process.wait(180)


def _wait(url: str) -> None:
    deadline = time.monotonic() + _READY_WITHIN_S
    while time.monotonic() < deadline:
        try:
            with urllib.request.urlopen(f"{url}/readyz", timeout=60):
                return
        except OSError:
            time.sleep(0.1)
    raise TimeoutError(f"the service was not ready within {_READY_WITHIN_S} s")
