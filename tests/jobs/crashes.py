"""Crash at every call into the operating system and into SQLite on the path of a job from its order to its end.

A process is forked for each point and ends there without a word (``os._exit``), before or after the call: the profiler
of Python tells of each call into ``posix``, ``_io`` and ``sqlite3``. Then another one goes on with what is there. This
is the end of a process, not of the machine: what was written but not synchronised stays.

``python -m tests.jobs.crashes --points 2000`` crashes at so many points (of some thousand); the tests at a few.
"""

import argparse
import json
import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import FrameType
from typing import Any

from service.jobs.housekeeping import Housekeeping
from service.jobs.kinds import table_bytes
from service.jobs.leases import Leases
from tests.jobs import synthetic
from tests.jobs.house import House

TOTAL, CHUNK = 60, 10
#: a disk in memory if there is one: it is not the machine that crashes, so nothing depends on the disk
_MEMORY = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
_WATCHED = ("posix", "_io", "sqlite3", "_sqlite3", "fcntl")


def work(house: House, clock: Callable[[], float]) -> None:
    """What coordinators do, one step after the other, until nothing is left to do."""
    leases = Leases(house.database, clock=clock)
    while (chunk := leases.claim("crashes", 10.0)) is not None:
        record = house.files.keep(
            chunk.job, chunk.start, chunk.stop, table_bytes(synthetic.rows(chunk.start, chunk.stop))
        )
        leases.finish(chunk, 0, str(record.digest), record.bytes)


def live(root: Path) -> None:
    """A job from its order to its end, and one that is cancelled half way and removed."""
    house = House(root)
    house.submit(TOTAL, CHUNK)
    work(house, time.time)
    gone = house.submit(TOTAL, CHUNK, gone=True)
    chunk = house.leases.claim("crashes", 10.0)
    assert chunk is not None
    record = house.files.keep(chunk.job, chunk.start, chunk.stop, b"rows")
    house.leases.finish(chunk, 0, str(record.digest), record.bytes)
    house.store.cancel(gone)
    house.files.stop(gone)
    house.retention.mark_removed(gone)
    house.files.remove(gone)
    house.retention.forget(gone)


def crash(root: Path, at: int | None) -> int:
    """Live in a process of its own, to the end or to a point; how many points it passed (of one that crashed, 0)."""
    told, tell = os.pipe()
    child = os.fork()
    if child == 0:
        passed = 0

        def point(_: FrameType, event: str, called: Any) -> None:
            nonlocal passed
            if event in ("c_call", "c_return") and _module(called) in _WATCHED:
                passed += 1
                if passed == at:
                    os._exit(9)

        sys.setprofile(point)
        live(root)
        sys.setprofile(None)
        os.write(tell, str(passed).encode())
        os._exit(0)
    os.close(tell)
    with os.fdopen(told) as pipe:
        said = pipe.read()
    os.waitpid(child, 0)
    return int(said or 0)


def _module(called: Any) -> str:
    owner = getattr(called, "__self__", None)
    return getattr(called, "__module__", None) or type(owner).__module__


def check(root: Path) -> tuple[int, int]:
    """Go on after a crash; rows that are lost or wrong, and files that belong to nobody."""
    house = House(root)
    later = time.time() + 3600
    work(house, lambda: later)
    Housekeeping(house.store, house.retention, house.files).tidy()
    lost = orphans = 0
    known = house.retention.known()
    for job in known:
        found = house.store.get(job)
        right = synthetic.rows(0, TOTAL)
        if found.state == "done":
            lost += (not house.rows(job).equals(right)) or found.done != TOTAL
        else:
            # the one that was to be removed
            lost += found.state != "cancelled" or house.rows_told(job) != found.done
        expected = {house.files.piece(job, piece).name for piece in house.store.pieces(job)} | {"stop"}
        orphans += len(set(house.files.names(job)) - expected)
    orphans += len(set(house.files.folders()) - known)
    house.database.close()
    return lost, orphans


def crashes(points: int) -> tuple[int, int, int]:
    """Crash at so many points, evenly spread: points, rows lost, orphans."""
    with tempfile.TemporaryDirectory(dir=_MEMORY) as folder:
        passed = crash(Path(folder), None)
        assert passed > 0
        assert check(Path(folder)) == (0, 0)
    lost = orphans = tried = 0
    for at in _spread(passed, points):
        with tempfile.TemporaryDirectory(dir=_MEMORY) as folder:
            crash(Path(folder), at)
            more = check(Path(folder))
            lost, orphans, tried = lost + more[0], orphans + more[1], tried + 1
    return tried, lost, orphans


def _spread(passed: int, points: int) -> Iterator[int]:
    step = max(1.0, passed / points)
    yield from (1 + int(k * step) for k in range(min(points, passed)))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, default=2000)
    began, asked = time.monotonic(), parser.parse_args()
    tried, lost, orphans = crashes(asked.points)
    print(json.dumps({"points": tried, "rows_lost": lost, "orphans": orphans, "s": time.monotonic() - began}))
    sys.exit(1 if lost or orphans else 0)


if __name__ == "__main__":
    main()
