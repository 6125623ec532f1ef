"""The event loop of the server, beside packages that offer another one."""

import asyncio
import os
from pathlib import Path

import pytest

from tests.network.serving import service

#: what uvicorn takes by itself where it sees it
_OTHER_LOOP = """
def new_event_loop():
    raise RuntimeError("the server is to name its loop")


Loop = EventLoopPolicy = install = run = new_event_loop
"""


def test_another_loop_on_the_path_is_not_taken(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "uvloop.py").write_text(_OTHER_LOOP)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=os.pathsep)
    with service() as server:
        reply = asyncio.run(server.ask("GET", "/healthz"))
        assert reply.status == 200
        assert "uvloop" not in server.log()
