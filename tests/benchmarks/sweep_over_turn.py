"""Sweeps whose objective looks over the whole turn: designs a second and core, from the axes to the bytes of Parquet.

``python -m tests.benchmarks.sweep_over_turn``. In time of the core, which what else a machine does changes least.
"""

from tests.benchmarks.single_core import single_thread

if __name__ == "__main__":
    single_thread("tests.benchmarks.sweep_over_turn")

import argparse
import time
from typing import Any, NamedTuple

from rich.console import Console
from rich.table import Table

from optimizer.outputs.registry import OUTPUTS
from schemas.sweep.request import SweepRequest
from service.jobs.kinds import KINDS
from tests.benchmarks.stopwatch import Stopwatch
from tests.benchmarks.whole_turn import six_with_gas, sixteen
from tests.studies.sweep.single import example

_BEARINGS: dict[str, Any] = {"force_weight": 0, "moment_weight": 0, "bearing_weight": 1}
_MASS = "/machine/throws/0/rows/0/reciprocating_mass_kg"
_ELSE = "axes, table, Parquet"
#: outputs that the 2D12 has no data for
_LACKING = ("loads", "pin_loads")
#: part of the work -> functions that do it; what they call belongs to the innermost part
PARTS: dict[str, tuple[str, ...]] = {
    "design as a request, mechanics": ("optimizer.studies.sweep.singles:prepare",),
    "counterweights, proof": ("optimizer.studies.sweep.singles:solve",),
    "columns of outputs": ("optimizer.studies.sweep.rows:columns",),
}


class Case(NamedTuple):
    """A sweep: what is asked of which machine."""

    name: str
    machine: dict[str, Any]
    objective: dict[str, Any]
    outputs: tuple[str, ...] = ("residual",)
    step_deg: float = 10.0


def every_output() -> tuple[str, ...]:
    """All outputs with columns that the 2D12 has data for."""
    return tuple(name for name, output in OUTPUTS.items() if output.columns is not None and name not in _LACKING)


def cases() -> list[Case]:
    six, dozen = six_with_gas(), example("2d12")["machine"]
    first = {**_BEARINGS, "least_mass": False}
    ordered = {"bearing_weight": 1, "priorities": [{"goal": "external", "allowance": 0.01}, {"goal": "bearings"}]}
    return [
        Case("in-line six, gas: bearings", six, first),
        Case("in-line six, gas: bearings, least mass", six, _BEARINGS),
        Case("16 rows, gas, 9 bearings: bearings, least mass", sixteen(), _BEARINGS),
        Case("2D12: bearings, least mass", dozen, _BEARINGS),
        Case("2D12: all orders, least mass", dozen, {"orders": "all"}),
        Case("2D12: external, then bearings", dozen, ordered),
        Case("2D12: bearings, least mass, all outputs at 1 degree", dozen, _BEARINGS, every_output(), 1.0),
    ]


def sweep(case: Case, designs: int) -> SweepRequest:
    """So many masses of the first row, within 2 % of what it has."""
    mass = case.machine["throws"][0]["rows"][0]["reciprocating_mass_kg"]
    base = {
        "machine": case.machine,
        "objective": case.objective,
        "outputs": list(case.outputs),
        "angles": {"step_deg": case.step_deg},
    }
    axis = {"path": _MASS, "start": 0.98 * mass, "stop": 1.02 * mass, "count": designs}
    return SweepRequest.model_validate({"base": base, "axes": [axis]})


def seconds(request: SweepRequest) -> dict[str, float]:
    """Seconds of the core by part, from the bytes of the request to the bytes of the file."""
    body, watch = request.model_dump_json().encode(), Stopwatch(time.process_time)
    with watch.over(PARTS), watch.part(_ELSE):
        KINDS["sweep"].compute(body, 0, request.total, lambda: None)
    return watch.seconds


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--designs", type=int, default=24, help="of each sweep")
    parser.add_argument("--turns", type=int, default=3, help="repeats, of which the fastest counts")
    arguments = parser.parse_args()
    table = Table(title=f"sweeps over the turn, {arguments.designs} designs, fastest of {arguments.turns}, one core")
    table.add_column("sweep")
    for heading in ("designs/s", "ms a design", *PARTS, _ELSE):
        table.add_column(heading, justify="right")
    for case in cases():
        seconds(sweep(case, 2))
        request = sweep(case, arguments.designs)
        best = min((seconds(request) for _ in range(arguments.turns)), key=lambda parts: sum(parts.values()))
        fields = {name: 1e3 * best.get(name, 0.0) / arguments.designs for name in (*PARTS, _ELSE)}
        whole = sum(fields.values())
        table.add_row(case.name, f"{1e3 / whole:.1f}", f"{whole:.1f}", *(f"{field:.1f}" for field in fields.values()))
    Console(width=150).print(table)


if __name__ == "__main__":
    main()
