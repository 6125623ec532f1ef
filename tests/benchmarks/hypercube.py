"""A Latin hypercube of ten million designs and twelve axes: its memory, its time, and whether it is one.

``python -m tests.benchmarks.hypercube``; by hand, a minute. Designs are asked for in ranges, as chunks ask for them.
Every stratum of every axis has to hold exactly one design; which of them were met is remembered by this program, not by
a sweep.
"""

import argparse
import time

import numpy as np
import psutil
from rich.console import Console
from rich.table import Table

from optimizer.numerics.arrays import Real
from optimizer.studies.sweep.designs import axis_values
from schemas.sweep.request import SweepRequest
from tests.benchmarks.sweep_case import sweep

_MB = 1e6
#: of a place on an axis of 10^7 strata, in strata: some ten times what rounding can do
_ROUNDING = 1e-7
#: designs that are asked for at once
_ROWS = 10_000


def request(samples: int, axes: int) -> SweepRequest:
    """So many axes that are largest masses of webs, and masses of the 2D12 with eight webs."""
    query = sweep(samples)
    extra = [f"/machine/webs/{k}/max_mass_kg" for k in range(1, 7)]
    paths = [*(axis.path for axis in query.axes), *extra][:axes]
    body = query.model_dump(exclude_unset=True)
    body["axes"] = [{"path": path, "start": 1.0, "stop": 2.0} for path in paths]
    return SweepRequest.model_validate(body)


class Strata:
    """Which strata of an axis from 1 to 2 hold a design."""

    def __init__(self, count: int) -> None:
        # written to, so that the memory is taken now
        self._met = np.full(count, False)
        self._doubtful: list[int] = []
        self._twice = 0

    def add(self, values: Real) -> None:
        """More designs; those within rounding of a border wait for the end."""
        place = (values - 1.0) * self._met.size
        clear = np.abs(place - np.round(place)) > _ROUNDING
        floor = np.floor(place[clear]).astype(np.int64)
        self._twice += int(np.sum(self._met[floor])) + floor.size - np.unique(floor).size
        self._met[floor] = True
        self._doubtful += np.round(place[~clear]).astype(np.int64).tolist()

    @property
    def wrong(self) -> int:
        """Strata without a design, or designs that are not the only one."""
        for border in self._doubtful:
            free = [k for k in (border - 1, border) if 0 <= k < self._met.size and not self._met[k]]
            self._met[free[:1]] = True
        return self._twice + int(np.sum(~self._met))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--samples", type=int, default=10_000_000)
    parser.add_argument("--axes", type=int, default=12, choices=range(1, 14))
    arguments = parser.parse_args()
    sampled = request(arguments.samples, arguments.axes)
    axes = [Strata(arguments.samples) for _ in range(arguments.axes)]
    axis_values(sampled, 0, min(_ROWS, arguments.samples))
    process, seconds = psutil.Process(), 0.0
    table = Table(title=f"a Latin hypercube of {arguments.samples:,} designs and {arguments.axes} axes")
    for heading in ("designs", "resident MB more than at the start", "us a design (CPU)", "strata wrong"):
        table.add_column(heading, justify="right")
    before = process.memory_info().rss
    for mark in range(10):
        start, stop = (arguments.samples * k // 10 for k in (mark, mark + 1))
        for first in range(start, stop, _ROWS):
            began = time.process_time()
            columns = axis_values(sampled, first, min(first + _ROWS, stop))
            seconds += time.process_time() - began
            for axis, values in zip(axes, columns, strict=True):
                axis.add(values)
        more = (process.memory_info().rss - before) / _MB
        wrong = str(sum(axis.wrong for axis in axes)) if mark == 9 else ""
        table.add_row(f"{stop:,}", f"{more:.1f}", f"{1e6 * seconds / stop:.2f}", wrong)
    Console(width=120).print(table)


if __name__ == "__main__":
    main()
