"""What the service needs besides its solver: a database that answers, a disk with room, and processes that go on."""

import os
import shutil
from collections.abc import Callable, Sequence
from pathlib import Path

from service.watch.metrics import SweepCounts
from service.watch.readiness import NotReady

_MB = 1_000_000


def database(counts: SweepCounts) -> None:
    """Go on only if the database of the jobs answers.

    Raises
    ------
    NotReady
    """
    if counts() is None:
        raise NotReady("The database of the jobs does not answer.", retry_after_s=5)


def disk(folder: Path, least_mb: int) -> None:
    """Go on only if a folder, or that in which it will be made, can be written to and has room.

    Raises
    ------
    NotReady
    """
    place = next(there for there in (folder, *folder.absolute().parents) if there.exists())
    if not os.access(place, os.W_OK):
        raise NotReady("The folder of the jobs cannot be written to.", retry_after_s=60)
    free_mb = shutil.disk_usage(place).free // _MB
    if free_mb < least_mb:
        raise NotReady(f"{free_mb} MB are free where the jobs are kept, of {least_mb} at least.", retry_after_s=60)


def workers(pids: Callable[[], Sequence[int]]) -> None:
    """Go on unless every process that computes has been stopped; before the first request there may be none.

    Raises
    ------
    NotReady
    """
    there = pids()
    if there and all(map(_stopped, there)):
        raise NotReady("All processes that compute have been stopped.", retry_after_s=5)


def _stopped(pid: int) -> bool:
    """Whether a process has been stopped, by a signal or by whoever traces it."""
    try:
        about = Path(f"/proc/{pid}/stat").read_bytes()
    except OSError:
        # one that has ended is replaced
        return False
    # its name comes before, in brackets, and may hold anything
    return about.rpartition(b")")[2].split()[0] in (b"T", b"t")
