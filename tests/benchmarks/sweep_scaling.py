"""Designs a second of the service's own machinery with one worker and with two: store, leases, files and all.

``python -m tests.benchmarks.sweep_scaling``; part of `make bench`; ``--engine dask`` for a cluster of one worker and of
two. The clock starts when the workers have computed a sweep before, so that their start and the loading of compiled
code do not count. Beside them stand as many processes that compute the same chunks and hand them to nobody. They show
what the cores of the machine gain by themselves, which is less than two where they share a physical core.
"""

import argparse
import multiprocessing
import statistics
import tempfile
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from pathlib import Path

from rich.console import Console
from rich.table import Table

from optimizer.studies.sweep.plan import plan
from schemas.sweep.request import SweepRequest
from service.jobs import worker
from service.jobs.desk import JobService
from service.jobs.engines import NICENESS
from service.settings import Settings
from tests.benchmarks.sweep_case import sweep

WORKERS = (1, 2)
_ASK_S = 0.25
#: nobody tells these to stop
_NO_FLAG = "no flag"


def through_the_service(kind: str, request: SweepRequest, workers: int) -> float:
    """From handing the sweep in to its last row on disk, with workers that are warm, s."""
    with tempfile.TemporaryDirectory() as folder, _engine(kind, workers) as engine:
        desk = JobService(Settings(data_dir=Path(folder), database_url=None, engine=engine, sweep_workers=workers))
        try:
            _run(desk, sweep(2000 * workers, seed=1))
            return _run(desk, request)
        finally:
            desk.close()


@contextmanager
def _engine(kind: str, workers: int) -> Iterator[str]:
    if kind == "processes":
        yield kind
        return
    from distributed import LocalCluster

    with LocalCluster(
        n_workers=workers, threads_per_worker=1, host="127.0.0.1", dashboard_address=None, silence_logs=50
    ) as cluster:
        yield f"dask:{cluster.scheduler_address}"


def _run(desk: JobService, request: SweepRequest) -> float:
    """By the clock of the job, s: who asks often whether it is done takes time from those who do it."""
    jobs = desk.of()
    job, _ = jobs.sweep(request)
    while job.active:
        time.sleep(_ASK_S)
        job = jobs.get(job.id)
    if (job.state, job.done) != ("done", request.total) or job.ended is None:
        raise RuntimeError(f"the sweep {job.state}: {job.error}")
    return job.ended - job.created


def without_a_service(request: SweepRequest, workers: int) -> float:
    """The same chunks computed by as many processes and dropped, s."""
    about, body = plan(request), request.model_dump_json().encode()
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(workers, context, initializer=worker.prepare, initargs=(NICENESS,)) as pool:
        list(pool.map(_computed, [(body, 2000 * k, 2000 * (k + 1)) for k in range(workers)]))
        began = time.perf_counter()
        list(pool.map(_computed, [(body, *about.chunk(number)) for number in range(about.chunks)]))
        return time.perf_counter() - began


def _computed(chunk: tuple[bytes, int, int]) -> int:
    return len(worker.run("sweep", *chunk, _NO_FLAG).content)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--designs", type=int, default=300_000)
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--engine", choices=["processes", "dask"], default="processes")
    arguments = parser.parse_args()
    request = sweep(arguments.designs)
    ways: dict[str, Callable[[SweepRequest, int], float]] = {
        f"service, {arguments.engine}": lambda request, workers: through_the_service(
            arguments.engine, request, workers
        ),
        "processes alone": without_a_service,
    }
    taken: dict[tuple[str, int], list[float]] = {(way, workers): [] for way in ways for workers in WORKERS}
    for _ in range(arguments.turns):
        for (way, workers), values in taken.items():
            values.append(ways[way](request, workers))
    table = Table(title=f"{request.total:,} designs of the 2D12 with 8 webs, median of {arguments.turns} turns")
    for heading in ("way", "workers", "s", "designs/s", "times one worker"):
        table.add_column(heading, justify="left" if heading == "way" else "right")
    for (way, workers), entries in taken.items():
        middle = statistics.median(entries)
        gain = statistics.median(single / many for single, many in zip(taken[way, 1], entries, strict=True))
        table.add_row(way, str(workers), f"{middle:.1f}", f"{request.total / middle:,.0f}", f"{gain:.2f}")
    Console(width=120).print(table)


if __name__ == "__main__":
    main()
