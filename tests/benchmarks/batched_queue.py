"""What requests that wait would gain if they were solved together: ``python -m tests.benchmarks.batched_queue``.

A row of a sweep is what a batch can share of an answer: mechanics, program and certificate. An answer keeps its
reading, its figures and its writing. Least CPU time of many.
"""

import json
import time
from collections.abc import Callable

from rich.console import Console
from rich.table import Table

from optimizer.studies.sweep import run_chunk
from schemas.sweep.request import SweepRequest
from service.documents.examples import bodies
from tests.benchmarks.phases import measure

#: answers that wait for a worker
WAITING = (1, 4, 16, 64, 256)
_PATH = "/machine/throws/0/rows/0/reciprocating_mass_kg"
_SHARED = ("mechanics", "program", "certificate")


def least_ms(work: Callable[[], object], repeats: int) -> float:
    """CPU time of some work."""
    spent = []
    for _ in range(repeats):
        before = time.process_time_ns()
        work()
        spent.append(time.process_time_ns() - before)
    return min(spent) / 1e6


def row_ms(waiting: int, repeats: int) -> float:
    """CPU time of a row among so many that are solved together."""
    axis = {"path": _PATH, "start": 250, "stop": 400, "count": max(2, waiting)}
    request = SweepRequest.model_validate({"base": bodies()["2d12"], "axes": [axis], "design": "grid"})
    content = request.model_dump_json().encode()
    run_chunk(content, 0, waiting)
    return least_ms(lambda: run_chunk(content, 0, waiting), repeats) / waiting


def answer_ms(repeats: int) -> tuple[float, float]:
    """CPU time of an answer alone, and the part of it that no batch shares."""
    body = json.dumps(bodies()["2d12"]).encode()
    phases = [measure(body) for _ in range(repeats)]
    least = min(phases, key=lambda phase: phase["total"])
    whole = least_ms(lambda: measure(body), repeats)
    return whole, whole * (1.0 - sum(least[name] for name in _SHARED) / least["total"])


def main() -> None:
    whole, own = answer_ms(400)
    table = Table("waiting", "a row, ms", "an answer in a batch, ms", "gain of a worker, at most")
    for waiting in WAITING:
        row = row_ms(waiting, max(10, 400 // waiting))
        table.add_row(str(waiting), f"{row:.3f}", f"{own + row:.2f}", f"{whole / (own + row):.2f}")
    console = Console(width=100)
    console.print(f"an answer of the 2D12 alone: {whole:.2f} ms of CPU, of which a batch shares none of {own:.2f}")
    console.print(table)


if __name__ == "__main__":
    main()
