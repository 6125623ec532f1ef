"""What one service can give out and take in: its own coordinator, database and files under workers that only sleep.

``python -m tests.benchmarks.sleeping_workers``; by hand. Workers that sleep cost no core, so two cores stand for a
thousand. What is measured is the service: how many pieces a second it hands out, takes in and has on disk, and what of
a core that takes. Pieces are of random bytes, as many as one likes.
"""

import argparse
import functools
import os
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.table import Table

from service.jobs.engines import Dask, Engine
from service.jobs.pace import Pace
from service.jobs.piece import ChunkResult
from tests.jobs.house import House

#: rows of a chunk of the sweep of `sweep_case`, and bytes of one in Parquet
ROWS, ROW_BYTES = 16_000, 150
#: chunks of a sweep at most
_MOST_PIECES = 10_000


def asleep(seconds: float, size: int, *_: object) -> ChunkResult:
    """Stands for a chunk: so many seconds, then so many bytes."""
    time.sleep(seconds)
    return ChunkResult(os.urandom(size), 0)


class Threads:
    """Threads of this process that sleep."""

    def __init__(self, workers: int) -> None:
        self._workers = workers
        self._executor: Executor = ThreadPoolExecutor(workers)

    def submit(self, task: Callable[..., ChunkResult], *arguments: object) -> "Future[ChunkResult]":
        return self._executor.submit(task, *arguments)

    def window(self) -> int:
        return 2 * self._workers

    def end(self) -> None:
        self._executor.shutdown(wait=True, cancel_futures=True)


@contextmanager
def engine(kind: str, workers: int) -> Iterator[Engine]:
    """Threads, or a cluster of dask whose two processes have half of the threads each."""
    if kind == "threads":
        yield Engine(lambda: Threads(workers))
        return
    from distributed import LocalCluster

    with LocalCluster(
        n_workers=2, threads_per_worker=workers // 2, host="127.0.0.1", dashboard_address=None, silence_logs=40
    ) as cluster:
        yield Engine(lambda: Dask(cluster.scheduler_address))


@dataclass(frozen=True)
class Measured:
    """Pieces that were taken in, seconds in which they were, and of these the CPU time of the thread of the jobs."""

    pieces: int
    seconds: float
    thread_s: float
    database_bytes: int

    @property
    def rate(self) -> float:
        return self.pieces / self.seconds


def measure(kind: str, workers: int, sleep_s: float, size: int, seconds: float) -> Measured:
    """What a service takes in while so many workers sleep for each of their pieces."""
    run = functools.partial(asleep, sleep_s, size)
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder, engine(kind, workers) as design:
        house = House(Path(folder))
        job = house.submit(_MOST_PIECES * ROWS, ROWS)
        coordinator = house.coordinator_on(design, Pace(), run)
        coordinator.start()
        try:
            # until the first have come back and every worker has one
            house.wait_for_rows(job, 2 * workers * ROWS)
            before, began, worked = house.store.get(job).done, time.perf_counter(), _worked()
            time.sleep(seconds)
            after, ended, working = house.store.get(job).done, time.perf_counter(), _worked()
        finally:
            house.store.cancel(job)
            coordinator.stop()
        size_now = sum(file.stat().st_size for file in Path(folder).glob("jobs.sqlite*"))
    return Measured((after - before) // ROWS, ended - began, working - worked, size_now)


def _worked() -> float:
    """CPU time of the thread of the jobs so far, s."""
    (thread,) = (thread for thread in threading.enumerate() if thread.name == "jobs")
    assert thread.ident is not None
    return time.clock_gettime(time.pthread_getcpuclockid(thread.ident))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--engine", choices=["threads", "dask"], default="threads")
    parser.add_argument("--workers", type=int, nargs="+", default=[10, 30, 100, 300, 1000])
    parser.add_argument("--sleep", type=float, default=1.0, help="seconds of a piece")
    parser.add_argument("--bytes", type=int, default=1000, help=f"of a piece; {ROWS * ROW_BYTES} are a chunk of 2D12")
    parser.add_argument("--seconds", type=float, default=10.0)
    arguments = parser.parse_args()
    table = Table(title=f"{arguments.engine} that sleep {arguments.sleep:g} s for pieces of {arguments.bytes:,} bytes")
    for heading in ("workers", "pieces/s", "of what they could", "CPU of the jobs' thread", "ms a piece", "MB/s"):
        table.add_column(heading, justify="right")
    for workers in arguments.workers:
        measurement = measure(arguments.engine, workers, arguments.sleep, arguments.bytes, arguments.seconds)
        table.add_row(
            f"{workers:,}",
            f"{measurement.rate:,.0f}",
            f"{measurement.rate * arguments.sleep / workers:.0%}",
            f"{measurement.thread_s / measurement.seconds:.0%}",
            f"{1e3 * measurement.thread_s / max(measurement.pieces, 1):.2f}",
            f"{measurement.rate * arguments.bytes / 1e6:,.1f}",
        )
    Console(width=120).print(table)


if __name__ == "__main__":
    main()
