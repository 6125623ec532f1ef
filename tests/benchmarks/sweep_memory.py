"""Memory of the service and of its workers over millions of designs: flat, or growing with the rows?

``python -m tests.benchmarks.sweep_memory``; by hand, as it takes minutes: ten million optimisations on two workers with
``--analyze 0 --optimize 10000000 --formats parquet csv``. The result is read back in some formats at the end, which has
to stay flat as well.
"""

import argparse
import os
import tempfile
import time
from collections.abc import Iterable
from pathlib import Path

import psutil
from rich.console import Console
from rich.table import Table

from schemas.sweep.request import SweepRequest
from service.jobs.desk import JobService
from service.jobs.formats import FORMATS, Name
from service.settings import Settings
from tests.benchmarks.sweep_case import sweep
from tests.processes import all_children, fork_servers

_MB = 1e6


def workers() -> list[psutil.Process]:
    """The processes that compute, not the one that tracks their semaphores."""
    return [worker for server in fork_servers(os.getpid()) for worker in all_children(server.pid)]


def measure(console: Console, request: SweepRequest, processes: int, formats: Iterable[Name], marks: int = 10) -> None:
    """Run a sweep and show the memory in use as it grows, and then as it is read."""
    table = Table(title=f"{request.task}: {request.total:,} designs, {processes} workers, resident memory in MB")
    for heading in ("designs", "service", "largest worker", "results on disk", "designs/s"):
        table.add_column(heading, justify="right")
    with tempfile.TemporaryDirectory() as folder:
        desk = JobService(
            Settings(data_dir=Path(folder), database_url=None, engine="processes", sweep_workers=processes)
        )
        try:
            jobs = desk.of()
            job, _ = jobs.sweep(request)
            began, mark = time.perf_counter(), 1
            while job.active:
                time.sleep(0.1)
                job = jobs.get(job.id)
                if job.done * marks >= mark * job.total:
                    mark = job.done * marks // job.total + 1
                    table.add_row(f"{job.done:,}", *_memory(Path(folder)), f"{job.done / _since(began):,.0f}")
            if job.state != "done":
                raise RuntimeError(f"the sweep {job.state}: {job.error}")
            for name in formats:
                began = time.perf_counter()
                schema = jobs.schema(job)
                size = sum(len(part) for part in FORMATS[name].encode(schema, jobs.rows(job, schema).batches))
                rate = job.total / _since(began)
                table.add_row(f"read as {name}", *_memory(Path(folder))[:2], f"{size / _MB:,.0f}", f"{rate:,.0f}")
        finally:
            desk.close()
    console.print(table)


def _since(moment: float) -> float:
    return time.perf_counter() - moment


def _memory(folder: Path) -> tuple[str, str, str]:
    largest = max((child.memory_info().rss for child in workers()), default=0)
    size = sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())
    return tuple(f"{number / _MB:,.0f}" for number in (psutil.Process().memory_info().rss, largest, size))  # type: ignore[return-value]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--analyze", type=int, default=5_000_000)
    parser.add_argument("--optimize", type=int, default=300_000)
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    # a workbook takes no more than a million rows
    several = [name for name in FORMATS if name != "xlsx"]
    parser.add_argument("--formats", nargs="*", choices=several, default=several)
    arguments = parser.parse_args()
    console = Console(width=120)
    for task, designs in (("analyze", arguments.analyze), ("optimize", arguments.optimize)):
        if designs:
            measure(console, sweep(designs, task), arguments.workers, arguments.formats)


if __name__ == "__main__":
    main()
