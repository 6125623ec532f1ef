"""Where the time of a sweep goes, and how far the program is from what the core could do."""

import time
from typing import Any
from unittest.mock import patch

import numpy as np
from rich.console import Console
from rich.table import Table

from optimizer.program.kernel import discs
from schemas.sweep.request import SweepRequest
from service.jobs.kinds import KINDS
from tests.benchmarks.operations import operations_per_program
from tests.benchmarks.stopwatch import Stopwatch

_STAGES = "program, both stages"
#: part of the work -> functions that do it; what they call belongs to the innermost part
PARTS: dict[str, tuple[str, ...]] = {
    "axes": ("optimizer.studies.sweep.rows:axis_values",),
    "validity": ("optimizer.studies.sweep.rows:_refuse", "optimizer.studies.sweep.rows:_same_nulls"),
    "columns, phasors, statement": (
        "optimizer.studies.sweep.counterweights:layout_of",
        "optimizer.studies.sweep.counterweights:first_order",
        "optimizer.solve.certify:cone_program",
    ),
    _STAGES: ("optimizer.program.kernel.discs:solve", "optimizer.program.kernel.interior_point:solve"),
    "scaling": (
        "optimizer.program.methods.optima:stage_solutions",
        "optimizer.program.methods.optima:yardstick",
    ),
    "certificate, choice of the point": ("optimizer.program.kernel.judging:judge",),
    "reference solver": ("optimizer.program.methods.optima:cascade",),
    "masses, angles, residuals": (
        "optimizer.solve.certify:masses_and_angles",
        "optimizer.solve.certify:unbalance",
        "optimizer.solve.certify:claim",
        "optimizer.solve.certify:verdict",
        "optimizer.studies.sweep.rows:columns",
    ),
    "table, Parquet": ("optimizer.studies.sweep.chunk:result_table", "service.jobs.kinds:_piece"),
}


def where_the_time_goes(request: SweepRequest) -> dict[str, float]:
    """Seconds by part of one worker's work, the bytes of the request to the bytes of the file."""
    # others may use the machine too
    body, watch = request.model_dump_json().encode(), Stopwatch(time.process_time)
    with watch.over(PARTS), watch.part("everything else"):
        KINDS["sweep"].compute(body, 0, request.total, lambda: None)
    return watch.seconds


def solved(request: SweepRequest, designs: int) -> list[tuple[Any, ...]]:
    """What the first designs of a sweep hand to the interior point of plain discs."""
    calls: list[tuple[Any, ...]] = []
    solve = discs.solve

    def recorder(*arguments: Any) -> Any:
        calls.append(arguments)
        return solve(*arguments)

    with patch.object(discs, "solve", recorder):
        KINDS["sweep"].compute(request.model_dump_json().encode(), 0, designs, lambda: None)
    return calls


def first_stage_share(request: SweepRequest) -> float:
    """Share of the first stage in the time of the program, on the same programs: its own work, best of five."""
    calls, solve = solved(request, min(request.total, 2000)), discs.solve
    seconds = {False: np.inf, True: np.inf}
    for least_mass in (False, True) * 5:
        began = time.thread_time()
        for *programs, budgeted, _, share, tolerance, mass_tolerance in calls:
            solve(*programs, budgeted, least_mass, share, tolerance, mass_tolerance)
        seconds[least_mass] = min(seconds[least_mass], time.thread_time() - began)
    return seconds[False] / seconds[True]


def peak_rate(size: int = 768, repeats: int = 12) -> float:
    """Operations a second that this core reaches: the best of some matrix products with one thread."""
    a, b = np.ones((size, size)), np.ones((size, size))
    best = np.inf
    for _ in range(repeats):
        began = time.perf_counter()
        a @ b
        best = min(best, time.perf_counter() - began)
    return 2.0 * size**3 / best


def show(console: Console, request: SweepRequest) -> None:
    """Both tables."""
    taken = [where_the_time_goes(request) for _ in range(3)]
    seconds = min(taken, key=lambda fields: sum(fields.values()))
    share, total = first_stage_share(request), sum(seconds.values())
    both = seconds.pop(_STAGES)
    seconds = {"program, stage 1": share * both, "program, stage 2": (1.0 - share) * both, **seconds}
    table = Table(title=f"where the time goes: {1e6 * total / request.total:.1f} us a design")
    for heading in ("part", "us a design", "share"):
        table.add_column(heading, justify="left" if heading == "part" else "right")
    for name, duration in sorted(seconds.items(), key=lambda second: -second[1]):
        table.add_row(name, f"{1e6 * duration / request.total:.2f}", f"{duration / total:.1%}")
    console.print(table)
    operations, iterations = operations_per_program(solved(request, 12))
    rate, peak = operations * request.total / both, peak_rate()
    console.print(
        f"program: {operations:,.0f} operations a design in {iterations:.1f} iterations, "
        f"{rate / 1e9:.2f} of {peak / 1e9:.1f} Gflop/s of this core (matrix product): {rate / peak:.0%}; at that peak "
        f"{1e6 * operations / peak:.1f} us a design"
    )
