"""Ways to solve a sweep side by side, on one core: cvxpy, cvxpy with parameters, clarabel as it comes and tuned, moreau
in batches, C that is generated for the program, and ours.

``python -m tests.benchmarks.sweep``; part of `make bench`. The methods take turns, so that a slow moment of the
machine meets them all, and what counts is CPU time, as others may use it too. The others get the formulated program of
each design as matrices for nothing, prove nothing and write nothing. Ours is timed from the request to the bytes of the
Parquet file, certificates included.
"""

from tests.benchmarks.single_core import pin, single_thread

if __name__ == "__main__":
    single_thread("tests.benchmarks.sweep")

import argparse
import io
import statistics
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from rich.console import Console
from rich.table import Table

from optimizer.program.solution import INTERIOR_POINT
from schemas.sweep.request import SweepRequest
from service.jobs.kinds import KINDS
from tests.benchmarks import sweep_generated, sweep_time
from tests.benchmarks.sweep_case import Program, programs, sweep
from tests.benchmarks.sweep_rivals import Batch, Direct, Gaps, Parametrised, Stages, gaps, rebuilt

OURS = "(g) ours, axes to Parquet"


@dataclass
class Rate:
    """What a method has done so far."""

    designs: int  # in one turn
    seconds: list[float] = field(default_factory=list)
    worst: Gaps = field(default=Gaps(0.0, 0.0))

    @property
    def per_second(self) -> float:
        return self.designs / statistics.median(self.seconds)

    def times(self, rate: "Rate") -> float:
        """How much faster than another method: the median over the turns that followed each other."""
        pairs = zip(self.seconds, rate.seconds, strict=True)
        return statistics.median((theirs / rate.designs) / (mine / self.designs) for mine, theirs in pairs)


def our_rows(request: SweepRequest) -> bytes:
    """The Parquet file of a sweep, as a worker of the service makes it."""
    return KINDS["sweep"].compute(request.model_dump_json().encode(), 0, request.total, lambda: None).content


def compare(request: SweepRequest, designs: tuple[int, int, int, int], turns: int) -> tuple[dict[str, Rate], pa.Table]:
    """Rates of all methods, and the rows of ours.

    Parameters
    ----------
    designs : number of designs in a turn of (a), (b), (c) and (d), and (e) and (f), spread over the sweep; for the last
        two one batch, and (f) only where there is a compiler; (g) takes all.
    """
    chosen = programs(request, np.linspace(0, request.total - 1, max(designs), dtype=int))
    parametrised, direct, tuned = Parametrised(chosen[0]), Direct(chosen[0]), Direct(chosen[0], tuned=True)
    prepared = [direct.prepare(program) for program in chosen]
    picked = [chosen[i] for i in _picks(len(chosen), designs[3])]
    batch = Batch(picked)
    methods: dict[str, Callable[[list[int]], list[Stages]]] = {
        "(a) cvxpy, rebuilt for each design": lambda picks: [rebuilt(chosen[i]) for i in picks],
        "(b) cvxpy, compiled once (DPP)": lambda picks: [parametrised(chosen[i]) for i in picks],
        "(c) clarabel, prepared matrices": lambda picks: [direct.solve(chosen[i], prepared[i]) for i in picks],
        "(d) clarabel, tuned": lambda picks: [tuned.solve(chosen[i], prepared[i]) for i in picks],
        "(e) moreau, stacked matrices": lambda _: batch.solve(),
    }
    counts = [*designs[:3], designs[2], designs[3]]
    if sweep_generated.available():
        generated = sweep_generated.Generated(picked)
        methods["(f) QOCOGEN, C for this program"] = lambda _: generated.solve()
        counts.append(designs[3])
    rates = {name: Rate(count) for name, count in zip(methods, counts, strict=True)}
    rates[OURS] = Rate(request.total)
    # compiled, and the caches filled
    our_rows(request)
    content = b""
    for turn in range(turns + 1):
        for name, method in methods.items():
            rate, picks = rates[name], _picks(len(chosen), rates[name].designs)
            began = time.process_time()
            stages = method(picks)
            _count(rate, time.process_time() - began, warm=turn > 0)
            rate.worst = _worst(rate.worst, [chosen[i] for i in picks], stages)
        began = time.process_time()
        content = our_rows(request)
        _count(rates[OURS], time.process_time() - began, warm=turn > 0)
    rows = pq.read_table(io.BytesIO(content))
    rates[OURS].worst = Gaps(*(float(np.max(rows[name].to_numpy())) for name in ("relative_gap", "mass_relative_gap")))
    return rates, rows


def _picks(available: int, count: int) -> list[int]:
    return np.linspace(0, available - 1, count, dtype=int).tolist()


def _count(rate: Rate, seconds: float, warm: bool) -> None:
    if warm:
        rate.seconds.append(seconds)


def _worst(largest: Gaps, chosen: Sequence[Program], levels: Sequence[Stages]) -> Gaps:
    all_gaps = [largest, *(gaps(program, stages) for program, stages in zip(chosen, levels, strict=True))]
    return Gaps(max(gap.objective for gap in all_gaps), max(gap.mass for gap in all_gaps))


def at_limits(request: SweepRequest, rows: pa.Table) -> float:
    """Share of the designs of which a counterweight is as heavy as it may be."""
    touched = np.zeros(rows.num_rows, dtype=bool)
    for k, web in enumerate(request.base.machine.webs):
        path = f"/machine/webs/{k}/max_mass_kg"
        most = rows[path].to_numpy() if path in rows.column_names else web.max_mass_kg
        touched |= rows[f"mass_kg.{web.name}"].to_numpy() >= most * (1 - 1e-6)
    return float(np.mean(touched))


def show(console: Console, request: SweepRequest, rates: dict[str, Rate], rows: pa.Table) -> None:
    """The comparison as a table."""
    ours = rates[OURS]
    title = f"{request.total} designs of the 2D12 with 8 webs, both stages, one core, in turns"
    table = Table(title=title)
    for heading in ("method", "designs/s", "us a design", "ours is faster by", "worst gap", "worst gap of the mass"):
        table.add_column(heading, justify="left" if heading == "method" else "right")
    for name, rate in rates.items():
        table.add_row(
            name,
            f"{rate.per_second:,.0f}",
            f"{1e6 / rate.per_second:,.0f}",
            f"{ours.times(rate):.1f}",
            f"{rate.worst.objective:.1e}",
            f"{rate.worst.mass:.1e}",
        )
    console.print(table)
    status, method = rows["status"].to_pylist(), rows["method"].to_pylist()
    referred = sum(name != INTERIOR_POINT for name in method)
    console.print(
        f"certified: {status.count('optimal')} of {len(status)}; by the reference solver: {referred} "
        f"({referred / len(status):.3%}); a counterweight at its limit in {at_limits(request, rows):.0%} of the designs"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--designs", type=int, default=20_000)
    parser.add_argument("--turns", type=int, default=7)
    arguments = parser.parse_args()
    console = Console(width=120)
    console.print(f"on core {pin()}")
    request = sweep(arguments.designs)
    show(console, request, *compare(request, (20, 100, 1000, 2000), arguments.turns))
    sweep_time.show(console, request)


if __name__ == "__main__":
    main()
