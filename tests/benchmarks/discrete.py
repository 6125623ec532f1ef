"""Choices from what there is and sixteen rows matched, beside SCIP; the orders of eight throws.

Every order of cranks is answered, with counterweights of its own; a program for SCIP has the best of them alone, so it
has no column there. Times are those of the processor, so that others on the machine count little.
"""

import json
import statistics
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from optimizer.choices.catalogue_options import stock
from optimizer.optimize import optimize
from optimizer.studies.matching.match import match
from optimizer.studies.matching.problem import stated
from optimizer.studies.sweep.whole import sweep_table
from schemas.match.request import MatchRequest
from schemas.request.requests import OptimizeRequest
from schemas.sweep.request import SweepRequest
from tests.benchmarks.cases import EXAMPLES
from tests.choices.any_mass import of_any_mass
from tests.choices.scip import scip, scip_matched
from tests.studies.matching.cases import machine, mirrored, parts

_GAP = 1e-4


class Beside(NamedTuple):
    """One choice: computing time [s], gap over the yardstick and nodes, ours and of SCIP; no nodes without a tree."""

    ours_s: float
    ours_gap: float
    ours_nodes: int | None
    theirs_s: float
    theirs_gap: float
    theirs_nodes: int
    apart: float  # objectives, over the yardstick: above 0 where SCIP's is larger


def choice(webs: int, holes: int | None, seed: int = 0, masses: int = 9) -> dict[str, Any]:
    """Cranks with two webs each, whose counterweights are too small to reach the floor; without holes at one angle."""
    rng = np.random.default_rng(seed)
    throws = webs // 2
    cranks = (rng.permutation(throws) * 360.0 / throws).tolist()
    scatter = rng.uniform(0.95, 1.08, (throws, 2)).tolist()
    turning = [
        {
            "position_m": 0.3 * k,
            "crank_radius_m": 0.1,
            "crank_angle_deg": cranks[k],
            "rotating_mass_kg": 10.0 * scatter[k][0],
            "rows": [{"axis_deg": 0.0, "reciprocating_mass_kg": 20.0 * scatter[k][1]}],
        }
        for k in range(throws)
    ]
    places = [
        {
            "name": f"{k // 2}{'ab'[k % 2]}",
            "position_m": 0.3 * (k // 2) + (0.1 if k % 2 else -0.1),
            "counterweight_radius_m": 0.15,
            "max_mass_kg": 2.0,
            "hole_angles_deg": [(cranks[k // 2] + 180.0) % 360.0]
            if holes is None
            else [360.0 * n / holes for n in range(holes)],
        }
        for k in range(webs)
    ]
    catalogue = {"masses_kg": [2.0 * n / masses for n in range(1, masses + 1)]}
    machine = {"kind": "reciprocating", "speed_rpm": 500, "throws": turning, "webs": places, "catalogue": catalogue}
    return {"machine": machine, "accuracy": {"relative_gap": _GAP, "time_limit_s": 30}}


CHOICES = {"8 webs, 12 holes, 9 masses and none": choice(8, 12), "32 webs at fixed angles": choice(32, None)}


def beside(body: dict[str, Any], repeats: int, time_limit_s: float) -> Beside:
    """Our choice and that of SCIP, from the same options."""
    request = OptimizeRequest.model_validate(body)
    answer = optimize(request)
    proof = answer.certificate
    assert proof is not None
    assert proof.relative_gap is not None
    assert proof.nodes is not None
    relaxed, size = of_any_mass(request)
    began = time.process_time()
    theirs = scip(relaxed.program.subset(0), stock(request.machine).options, _GAP, size, time_limit_s)
    theirs_s = time.process_time() - began
    return Beside(
        median_s(lambda: optimize(request), repeats),
        proof.relative_gap,
        proof.nodes,
        theirs_s,
        (theirs.objective - theirs.lower_bound) / size,
        theirs.nodes,
        theirs.objective / size - proof.objective / float(relaxed.certificate["yardstick"][0]),
    )


def matched_beside(request: MatchRequest, repeats: int, time_limit_s: float) -> Beside:
    """Our assignment of parts, without counterweights, and that of SCIP."""
    proof = match(request).certificate
    assert proof.relative_gap is not None
    size = proof.yardstick / (request.machine.speed_rpm * np.pi / 30.0) ** 2
    none = np.zeros(len(request.machine.webs))
    began = time.process_time()
    theirs = scip_matched(stated(request, request.machine, none, none), _GAP, size, time_limit_s)
    theirs_s = time.process_time() - began
    return Beside(
        median_s(lambda: match(request), repeats),
        proof.relative_gap,
        None,
        theirs_s,
        (theirs.objective - theirs.lower_bound) / size,
        theirs.nodes,
        theirs.objective / size - proof.objective / proof.yardstick,
    )


def median_s(operation: Callable[[], object], repeats: int) -> float:
    """Seconds of the processor, warm."""
    operation()
    taken = []
    for _ in range(repeats):
        began = time.process_time()
        operation()
        taken.append(time.process_time() - began)
    return statistics.median(taken)


def rival_seconds(repeats: int) -> dict[str, float]:
    """Seconds of what else is chosen from few possibilities."""
    orders = eight_orders()
    return {
        f"all {orders.total} orders of 8 throws with counterweights, enumerated": median_s(
            lambda: sweep_table(orders), repeats
        )
    }


def rows_matched(cranks_deg: list[float]) -> MatchRequest:
    """An in-line machine with one class of parts, one of which goes on each throw."""
    count = len(cranks_deg)
    body = {"machine": machine(cranks_deg, [90.0] * count), "parts": parts(16, count, scatter=0.01)}
    return MatchRequest.model_validate(body | {"accuracy": {"relative_gap": _GAP}})


def in_some_order(throws: int) -> list[float]:
    """Even cranks as they come: of equal masses a moment is left."""
    return [float(angle) for angle in np.random.default_rng(0).permutation(throws) * 360.0 / throws]


MATCHES = {
    "16 rows matched, cranks in some order": rows_matched(in_some_order(16)),
    "16 rows matched, the same from both ends": rows_matched(mirrored(16)),
}


def eight_orders() -> SweepRequest:
    """Eight angles on the throws of the example, each once."""
    body = json.loads((EXAMPLES / "sweeps" / "inline-eight-crank-orders.json").read_bytes())
    del body["pareto"]
    body["base"]["outputs"] = ["residual"]
    return SweepRequest.model_validate(body | {"angles_deg": [45 * n for n in range(8)]})
