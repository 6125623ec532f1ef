"""Chunks without machines: rows that follow from their index, and the misfortunes that a request asks for."""

import json
import os
import signal
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pyarrow as pa

from service.jobs.kinds import KINDS, Kind, table_bytes
from service.jobs.piece import ChunkResult, Stopped

SCHEMA = pa.schema(
    [pa.field("index", pa.int64(), False), pa.field("value", pa.float64()), pa.field("status", pa.string())],
    {b"counterweight.request": b"{}", b"counterweight.versions": b"{}", b"counterweight.seed": b"0"},
)


def rows(start: int, stop: int, failed: tuple[int, ...] = ()) -> pa.Table:
    """Analytic: the value of row i is i / 7."""
    index = range(start, stop)
    status = ["failed" if i in failed else "optimal" for i in index]
    peak = [None if i in failed else i / 7 for i in index]
    return pa.table([pa.array(index, pa.int64()), pa.array(peak, pa.float64()), status], schema=SCHEMA)


def run(kind: str, request: bytes, start: int, stop: int, flag: str) -> ChunkResult:
    """What a request may ask for: sleep_s, kill_at and raise_at a row, kill_once and raise_once (paths); held_from a
    row on, until there is a file at held_until."""
    document: dict[str, Any] = json.loads(request)
    until, held = time.monotonic() + document.get("sleep_s", 0), start >= document.get("held_from", stop)
    while time.monotonic() < until or (held and not Path(document["held_until"]).exists()):
        if Path(flag).exists():
            raise Stopped
        time.sleep(0.01)
    for name, happen in (("kill", _die), ("raise", _raise)):
        at = document.get(f"{name}_at")
        once = document.get(f"{name}_once")
        if at is not None and start <= at < stop and (once is None or not Path(once).exists()):
            if once is not None:
                Path(once).touch()
            happen()
    return ChunkResult(table_bytes(rows(start, stop)), 0)


def _die() -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def _raise() -> None:
    raise ArithmeticError("asked for")


def _failed(request: bytes, start: int, stop: int, reason: str) -> ChunkResult:
    return ChunkResult(table_bytes(rows(start, stop, tuple(range(start, stop)))), stop - start)


def _never(request: bytes, start: int, stop: int, proceed: Callable[[], None]) -> ChunkResult:
    raise AssertionError("chunks are computed by run")


KIND = Kind(_never, _failed)


def register() -> None:
    """For commands; tests do it by a fixture."""
    KINDS.setdefault("synthetic", KIND)  # type: ignore[attr-defined]
