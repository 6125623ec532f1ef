"""Bearing optima by cuts: an in-line six by inertia and with gas, sixteen rows with gas on nine bearings."""

import statistics
import time
from typing import Any, NamedTuple

from optimizer.optimize import optimize
from schemas.requests import OptimizeRequest
from tests.benchmarks.outputs import sixteen_rows
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


class Times(NamedTuple):
    """Milliseconds, medians."""

    solving: float  # of the program
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
    objective = {"force_weight": 0, "moment_weight": 0, "bearing_weight": 1, "least_mass": least_mass}
    body = {"machine": machine, "objective": objective, "angles": {"step_deg": 30}}
    request = OptimizeRequest.model_validate(body)
    optimize(request)
    solving, whole = [], []
    for _ in range(repeats):
        began = time.perf_counter()
        answer = optimize(request)
        whole.append((time.perf_counter() - began) * 1e3)
        solving.append(answer.timing.solve_ms)
    proof = answer.certificate
    assert proof is not None
    assert proof.rounds is not None
    assert proof.cuts is not None
    assert proof.relative_gap is not None
    return Times(statistics.median(solving), statistics.median(whole), proof.rounds, proof.cuts, proof.relative_gap)
