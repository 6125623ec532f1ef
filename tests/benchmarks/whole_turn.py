"""Bearing optima by cuts: an in-line six by inertia and with gas, sixteen rows with gas on nine bearings.

``python -m tests.benchmarks.whole_turn``; part of `make bench`. In time of the core, which what else a machine does
changes least.
"""

from tests.benchmarks.single_core import single_thread

if __name__ == "__main__":
    single_thread("tests.benchmarks.whole_turn")

import argparse
import statistics
import time
from typing import Any, NamedTuple

from rich.console import Console
from rich.table import Table

from optimizer.formulation.task import Task
from optimizer.optimize import optimize
from optimizer.outputs.registry import prepare
from optimizer.solve.worst_case import best_of_any_mass
from schemas.request.requests import OptimizeRequest
from tests.benchmarks.outputs import sixteen_rows
from tests.benchmarks.stopwatch import Stopwatch
from tests.optimize.whole_turn import inline_six

#: a compressor's cycle whose gas pushes about as hard as the inertia
_CYLINDER = {
    "bore_m": 0.085,
    "piston_rod_diameter_m": 0.02,
    "acting": "double",
    "suction_pressure_Pa": 1e5,
    "discharge_pressure_Pa": 8e6,
    "relative_clearance": 0.02,
    "expansion_exponent": 1.35,
    "compression_exponent": 1.35,
}


_ELSE = "input, mechanics, and the making of the answer"
#: part of an answer -> functions that do it; what they call belongs to the innermost part
PARTS: dict[str, tuple[str, ...]] = {
    "rounds": ("optimizer.solve.uncertain_program:optimum",),
    "cone programs": ("optimizer.program.cuts.stage:solved",),
    "series of the rows, peaks": ("optimizer.mechanics.kernel.entry:over_turn",),
    "rest of the brackets": ("optimizer.responses.piecewise_cubics:_brackets",),
    "smallest circles": ("optimizer.outputs.bearings:floors", "optimizer.program.cuts.samples:smallest_circle"),
    "rest of the proofs": ("optimizer.solve.solve:best_of_any_mass",),
    "figures, warnings": ("optimizer.optimize:fields",),
}


class Times(NamedTuple):
    """Milliseconds of the core, medians."""

    solving: float  # of the counterweights with their proof
    whole: float  # of the answer
    rounds: int
    cuts: int
    gap: float  # relative


def six_with_gas() -> dict[str, Any]:
    machine = inline_six()
    for throw in machine["throws"]:
        for row in throw["rows"]:
            row["cylinder"] = _CYLINDER
    return machine


def sixteen() -> dict[str, Any]:
    machine = sixteen_rows()
    machine["webs"] = [
        {"name": str(k), "position_m": throw["position_m"], "counterweight_radius_m": 0.25, "max_mass_kg": 80.0}
        for k, throw in enumerate(machine["throws"])
    ]
    return machine


MACHINES = {"in-line six, inertia": inline_six, "in-line six, gas": six_with_gas, "16 rows, gas, 9 bearings": sixteen}


def times(machine: dict[str, Any], least_mass: bool, repeats: int) -> Times:
    """A bearing optimum to 1e-6, without samples."""
    request = _request(machine, least_mass)
    optimize(request)
    solving, whole = [], []
    for _ in range(repeats):
        began = time.process_time()
        answer = optimize(request)
        whole.append((time.process_time() - began) * 1e3)
        scene = prepare(request, ("residual", "main_bearings"))
        began = time.process_time()
        best_of_any_mass(Task.of(request), scene)
        solving.append((time.process_time() - began) * 1e3)
    proof = answer.certificate
    assert proof is not None
    assert proof.rounds is not None
    assert proof.cuts is not None
    assert proof.relative_gap is not None
    return Times(statistics.median(solving), statistics.median(whole), proof.rounds, proof.cuts, proof.relative_gap)


def where_the_time_goes(machine: dict[str, Any], repeats: int) -> dict[str, float]:
    """Milliseconds of the core in one answer with least mass, by part."""
    request = _request(machine, least_mass=True)
    optimize(request)
    watch = Stopwatch(time.process_time)
    with watch.over(PARTS):
        for _ in range(repeats):
            with watch.part(_ELSE):
                optimize(request)
    return {name: 1e3 * watch.seconds.get(name, 0.0) / repeats for name in (*PARTS, _ELSE)}


def _request(machine: dict[str, Any], least_mass: bool) -> OptimizeRequest:
    objective = {"force_weight": 0, "moment_weight": 0, "bearing_weight": 1, "least_mass": least_mass}
    return OptimizeRequest.model_validate({"machine": machine, "objective": objective, "angles": {"step_deg": 30}})


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeats", type=int, default=10, help="warm repeats of every case")
    repeats = parser.parse_args().repeats
    table = Table(title=f"bearing optimum to 1e-6, warm median of {repeats}, milliseconds of one core")
    for heading in ("case", "least mass", "optimum", "answer", "rounds", "cuts", "gap"):
        table.add_column(heading, justify="left" if heading == "case" else "right")
    for name, build in MACHINES.items():
        for least_mass in (False, True):
            actual_times = times(build(), least_mass, repeats)
            row = (
                f"{actual_times.solving:.1f}",
                f"{actual_times.whole:.1f}",
                str(actual_times.rounds),
                str(actual_times.cuts),
                f"{actual_times.gap:.1e}",
            )
            table.add_row(name, "yes" if least_mass else "no", *row)
    console = Console(width=120)
    console.print(table)
    split = Table(title="where the time of an answer with least mass goes, mean, milliseconds of one core")
    parts = {name: where_the_time_goes(build(), repeats) for name, build in MACHINES.items()}
    split.add_column("part")
    for name in parts:
        split.add_column(name, justify="right")
    for part in (*PARTS, _ELSE):
        split.add_row(part, *(f"{of[part]:.1f}" for of in parts.values()))
    console.print(split)


if __name__ == "__main__":
    main()
