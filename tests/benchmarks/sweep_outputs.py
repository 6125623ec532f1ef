"""All outputs of a sweep over the turn: milliseconds a design of analyses of the 2D12 at 1 degree.

``python -m tests.benchmarks.sweep_outputs``. In time of the core, which what else a machine does changes least.
"""

from tests.benchmarks.single_core import single_thread

if __name__ == "__main__":
    single_thread("tests.benchmarks.sweep_outputs")

import argparse
import time

from rich.console import Console
from rich.table import Table

from optimizer.studies.sweep import run_chunk
from schemas.sweep.request import SweepRequest
from tests.benchmarks.stopwatch import Stopwatch
from tests.benchmarks.sweep_over_turn import every_output
from tests.studies.sweep.single import example

_ROW = "/machine/throws/0/rows/0"
#: what varies -> its field and its range
AXES: dict[str, tuple[str, float, float]] = {
    "a mass": (f"{_ROW}/reciprocating_mass_kg", 240.0, 320.0),
    "the speed": ("/machine/speed_rpm", 400.0, 600.0),
    "a bore": (f"{_ROW}/cylinder/bore_m", 0.7, 0.75),
    "a pressure": (f"{_ROW}/cylinder/suction_pressure_Pa", 250e3, 320e3),
    "a rod": (f"{_ROW}/connecting_rod/length_m", 0.6, 0.8),
}
_ELSE = "table, everything else"
#: part of the work -> functions that do it; what they call belongs to the innermost part
PARTS: dict[str, tuple[str, ...]] = {
    "forces, curves, peaks": ("optimizer.mechanics.kernel.entry:over_turn",),
    "effects, integrals": ("optimizer.outputs.registry:simulated",),
    "rest of the brackets": ("optimizer.responses.piecewise_cubics:_brackets",),
}


def sweep(path: str, start: float, stop: float, designs: int) -> SweepRequest:
    """So many analyses with all outputs that the 2D12 has data for."""
    base = {"machine": example("2d12")["machine"], "outputs": list(every_output()), "angles": {"step_deg": 1}}
    axis = {"path": path, "start": start, "stop": stop, "count": designs}
    return SweepRequest.model_validate({"task": "analyze", "base": base, "axes": [axis]})


def seconds(request: SweepRequest) -> dict[str, float]:
    """Seconds of the core by part, from the bytes of the request to the table."""
    body, watch = request.model_dump_json().encode(), Stopwatch(time.process_time)
    with watch.over(PARTS), watch.part(_ELSE):
        run_chunk(body, 0, request.total)
    return watch.seconds


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--designs", type=int, default=200, help="of each sweep")
    parser.add_argument("--turns", type=int, default=5, help="repeats, of which the fastest counts")
    arguments = parser.parse_args()
    table = Table(title=f"all outputs at 1 degree, {arguments.designs} designs, fastest of {arguments.turns}, one core")
    table.add_column("what varies")
    for heading in ("ms a design", *PARTS, _ELSE):
        table.add_column(heading, justify="right")
    for name, axis in AXES.items():
        request = sweep(*axis, arguments.designs)
        seconds(sweep(*axis, 2))
        best = min((seconds(request) for _ in range(arguments.turns)), key=lambda parts: sum(parts.values()))
        fields = {part: 1e3 * best.get(part, 0.0) / arguments.designs for part in (*PARTS, _ELSE)}
        table.add_row(name, f"{sum(fields.values()):.3f}", *(f"{time_ms:.3f}" for time_ms in fields.values()))
    Console(width=120).print(table)


if __name__ == "__main__":
    main()
