"""Designs a second of the service's own machinery with one worker process and with two: store, leases, files and all.

``python -m tests.benchmarks.sweep_scaling``; part of `make bench`. The clock starts when the workers have computed a
sweep before, so that their start and the loading of compiled code do not count.
"""

import argparse
import statistics
import tempfile
import time
from pathlib import Path

from rich.console import Console
from rich.table import Table

from schemas.sweep import SweepRequest
from service.jobs.desk import Desk
from service.settings import Settings
from tests.benchmarks.sweep_case import sweep

WORKERS = (1, 2)


def seconds(request: SweepRequest, workers: int) -> float:
    """From handing the sweep in to its last row on disk, with workers that are warm."""
    with tempfile.TemporaryDirectory() as folder:
        desk = Desk(Settings(data_dir=Path(folder), database_url=None, engine="processes", sweep_workers=workers))
        try:
            _run(desk, sweep(2000 * workers, seed=1))
            began = time.perf_counter()
            _run(desk, request)
            return time.perf_counter() - began
        finally:
            desk.close()


def _run(desk: Desk, request: SweepRequest) -> None:
    jobs = desk.of()
    job, _ = jobs.sweep(request)
    while job.active:
        time.sleep(0.02)
        job = jobs.get(job.id)
    if (job.state, job.done) != ("done", request.total):
        raise RuntimeError(f"the sweep {job.state}: {job.error}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--designs", type=int, default=300_000)
    parser.add_argument("--turns", type=int, default=3)
    asked = parser.parse_args()
    request = sweep(asked.designs)
    taken: dict[int, list[float]] = {workers: [] for workers in WORKERS}
    for _ in range(asked.turns):
        for workers in WORKERS:
            taken[workers].append(seconds(request, workers))
    table = Table(title=f"{request.total} designs of the 2D12 with 8 webs through the process pool, median in turns")
    for heading in ("workers", "s", "designs/s", "times one worker"):
        table.add_column(heading, justify="right")
    for workers, found in taken.items():
        middle = statistics.median(found)
        gain = statistics.median(one / many for one, many in zip(taken[1], found, strict=True))
        table.add_row(str(workers), f"{middle:.1f}", f"{request.total / middle:,.0f}", f"{gain:.2f}")
    Console(width=120).print(table)


if __name__ == "__main__":
    main()
