"""Crash at every system call on the path of jobs from their order to their end.

A process is forked for each point, does all that services do to jobs, and is killed at the point. A point is before a
system call, or half way through one that writes. Then another one finds out what is there, and goes on with it. This is
the end of a process, not of the machine: what was written but not synchronised stays.

``python -m tests.jobs.crashes`` crashes at every point, with ``--points`` at so many, evenly spread; the tests crash at
a few.
"""

import argparse
import json
import mmap
import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future
from functools import partial
from pathlib import Path

from service.jobs.engines import Engine
from service.jobs.housekeeping import Housekeeping
from service.jobs.job import Computed
from service.jobs.leases import Leases
from service.jobs.pace import Pace
from service.jobs.piece import ChunkResult
from service.jobs.rows import UnknownJob
from tests.jobs import synthetic
from tests.jobs.house import House
from tests.jobs.system_calls import Missing, killed

TOTAL, CHUNK = 60, 10
#: nothing is done once more because time passes: every life comes to the same calls
_PACE = Pace(lease_s=600.0, tidy_s=600.0)
#: a disk in memory if there is one: it is not the machine that crashes, so nothing depends on the disk
_MEMORY = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None


class Journal:
    """What was said to be so, in memory that outlives the process that said so."""

    def __init__(self) -> None:
        self._memory = mmap.mmap(-1, 1 << 16)

    def say(self, fact: str, job: str, rows: int = 0) -> None:
        self._memory.write(f"{fact} {job} {rows}\n".encode())

    def __iter__(self) -> Iterator[tuple[str, str, int]]:
        for line in self._memory[:].split(b"\0", 1)[0].decode().splitlines():
            fact, job, rows = line.split()
            yield fact, job, int(rows)


class Here:
    """Computes chunks at once, in this process."""

    def submit(self, task: Callable[..., ChunkResult], *arguments: object) -> "Future[ChunkResult]":
        future: Future[ChunkResult] = Future()
        future.set_result(task(*arguments))
        return future

    def window(self) -> int:
        return 1

    def end(self) -> None:
        pass


class Telling(Leases):
    """Says when a chunk is finished."""

    def __init__(self, house: House, journal: Journal, clock: Callable[[], float]) -> None:
        super().__init__(house.database, clock=clock)
        self._journal = journal

    def finish(self, computed: Sequence[Computed]) -> list[bool]:
        counted = super().finish(computed)
        for chunk, counts in zip(computed, counted, strict=True):
            if counts:
                self._journal.say("finished", chunk.chunk.job, chunk.chunk.rows)
        return counted


def work(house: House, journal: Journal, least: int = TOTAL, clock: Callable[[], float] = time.time) -> None:
    """What a coordinator does, one step after the other, until no job is left that has fewer rows."""
    house.leases = Telling(house, journal, clock)
    coordinator = house.coordinator_on(Engine(Here), _PACE)
    while any(house.store.get(job).done < least for job in house.leases.active()):
        coordinator._step()


def live(root: Path, journal: Journal, url: str | None = None) -> None:
    """Jobs from their order to their end: one is repaired, one cancelled and resumed, one removed."""
    house = House(root, url)
    job = _submit(house, journal)
    work(house, journal)
    damaged = house.store.pieces(job)[2]
    journal.say("finished", job, -damaged.rows)
    house.leases.reopen(job, damaged)
    work(house, journal)

    job = _submit(house, journal, again=True)
    work(house, journal, least=20)
    house.store.cancel(job)
    house.files.stop(job)
    house.files.go(job)
    house.store.resume(job)
    work(house, journal)

    job = _submit(house, journal, gone=True)
    work(house, journal, least=10)
    house.store.cancel(job)
    house.files.stop(job)
    journal.say("leaving", job)
    house.retention.mark_removed(job)
    journal.say("removed", job)
    house.files.remove(job)
    house.retention.forget(job)
    Housekeeping(house.store, house.retention, house.files).tidy()


def _submit(house: House, journal: Journal, **options: bool) -> str:
    job = house.submit(TOTAL, CHUNK, **options)
    journal.say("accepted", job)
    return job


def check(root: Path, journal: Journal, url: str | None = None) -> tuple[int, int]:
    """Go on after a crash; rows that are lost or wrong, and files that belong to nobody."""
    house = House(root, url)
    lost = _forgotten(house, journal)
    later = time.time() + 3600
    work(house, Journal(), clock=lambda: later)
    Housekeeping(house.store, house.retention, house.files).tidy()
    orphans = 0
    jobs = house.retention.job_ids()
    for job in jobs:
        record = house.store.get(job)
        right = synthetic.rows(0, TOTAL)
        if record.state == "done":
            lost += 0 if house.rows(job).equals(right) and record.done == TOTAL else TOTAL
        else:
            # one that was about to be resumed or removed
            count = house.row_count(job)
            lost += TOTAL if record.state != "cancelled" or count != record.done else 0
        expected = {house.files.piece(job, piece).name for piece in house.store.pieces(job)} | {"stop"}
        orphans += len(set(house.files.names(job)) - expected)
    orphans += len({file.name for file in (root / "results").glob("*")} - jobs - {".database"})
    house.database.close()
    return lost, orphans


def _forgotten(house: House, journal: Journal) -> int:
    """Rows that were said to be on disk and are not; a job that is lost, or comes back, counts with all of its."""
    lost, record = 0, list(journal)
    for job in {job for _, job, _ in record}:
        facts = {fact for fact, identity, _ in record if identity == job}
        try:
            state = house.store.get(job)
        except UnknownJob:
            lost += 0 if "leaving" in facts else TOTAL
        else:
            finished = sum(rows for _, identity, rows in record if identity == job)
            lost += TOTAL if "removed" in facts else max(0, finished - state.done)
    return lost


def crashes(points: int) -> tuple[int, int, int, int]:
    """Crash at so many points, evenly spread: points, how many there are, rows lost, orphans."""
    with tempfile.TemporaryDirectory(dir=_MEMORY) as folder:
        # here first, so that what is imported at the first time is no call of theirs
        live(Path(folder, "here"), journal := Journal())
        assert check(Path(folder, "here"), journal) == (0, 0)
        calls = killed(partial(live, Path(folder, "there"), journal := Journal()))
        assert check(Path(folder, "there"), journal) == (0, 0)
    every = [(at, half) for at, halves in enumerate(calls) for half in ((False, True) if halves else (False,))]
    lost = orphans = tried = 0
    chosen = [every[number * len(every) // points] for number in range(points)] if points < len(every) else every
    for at, half in chosen:
        with tempfile.TemporaryDirectory(dir=_MEMORY) as folder:
            journal = Journal()
            passed = killed(partial(live, Path(folder), journal), at, half)
            # a life is not always one of as many calls: one of them may have ended before
            tried += len(passed) == at + 1
            more = check(Path(folder), journal)
            lost, orphans = lost + more[0], orphans + more[1]
    return tried, len(every), lost, orphans


#: points tried, points there are, rows lost and orphans, of so many points at most
Crash = Callable[[int], tuple[int, int, int, int]]


def report(description: str | None, crash: Crash, missing: type[Exception]) -> None:
    """Crash at as many points as are asked for, print as JSON what was lost, and exit by that.

    Parameters
    ----------
    missing : what is raised where the means to crash are not there.
    """
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--points", type=int, default=1_000_000)
    began, most = time.monotonic(), parser.parse_args().points
    synthetic.register()
    try:
        tried, of, lost, orphans = crash(most)
    except missing as error:
        print(error, file=sys.stderr)
        sys.exit(2)
    front = {"points": tried, "of": of, "rows_lost": lost, "orphans": orphans, "s": time.monotonic() - began}
    print(json.dumps(front))
    sys.exit(1 if lost or orphans else 0)


def _in_memory(points: int) -> tuple[int, int, int, int]:
    with tempfile.TemporaryDirectory(dir=_MEMORY) as folder:
        # messages that services left elsewhere are none of theirs, and looking for them takes more or fewer calls
        tempfile.tempdir = folder
        return crashes(points)


if __name__ == "__main__":
    report(__doc__, _in_memory, Missing)
