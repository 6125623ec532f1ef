"""``python -m tests.hard.boundary --count N``: ceilings on, and a hair to either side of, what can just be reached.

Every machine is asked several times, its ceilings put at a place times 1 + d. Places are the smallest peaks that can be
reached, those without counterweights, those of the optimum without ceilings, and the floor. Analytic: the smallest
objective does not grow, and no ceiling gets out of reach, as the ceilings are raised.
"""

import argparse
import json
import sys
import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from rich.console import Console
from rich.table import Table

from optimizer.formulation.goals import cone_program
from optimizer.formulation.limits import limits
from optimizer.optimize import optimize
from optimizer.outputs.registry import prepare
from optimizer.program.rows import combined, statement, weighted_peak
from optimizer.program.solution import CEILING_TOLERANCE, ConeSolution
from optimizer.program.verdict import yardstick
from optimizer.responses.response import Response
from schemas.request.requests import OptimizeRequest
from tests.hard.cases.case import Body, machine, row, throw, web
from tests.program.cases import optimum

#: how far the ceilings are from the place
DISTANCES = (-1e-3, -1e-6, -1e-8, -1e-9, -1e-10, -1e-12, 0.0, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-6, 1e-3)
#: answers count as on the boundary up to here
NEAR = 1e-8
PLACES = ("reachable", "at rest", "unlimited", "floor")
FIELDS = {"force": "force_ceiling_N", "moment": "moment_ceiling_Nm"}
#: what two answers of the same optimum may differ by: the asked gap, relative to the yardstick
_GAP = 1.01e-6


@dataclass(frozen=True)
class Rung:
    """One answer."""

    distance: float
    body: Body
    status: str
    objective: float  # NaN where infeasible
    method: str
    cpu_s: float


@dataclass(frozen=True)
class Ladder:
    """One machine with its ceilings at one place times 1 + distance, in rising order."""

    place: str
    ceilings: Mapping[str, float]
    yardstick: float
    rungs: Sequence[Rung]
    faults: Sequence[str] = field(default_factory=list)


def bodies(rng: np.random.Generator) -> Body:
    """A machine of moderate size with every kind of limit, and an objective without ceilings."""
    angles = [0.0, 60.0, 90.0, 120.0, 180.0, 240.0, 270.0]

    def angle() -> float:
        return float(rng.choice(angles) if rng.random() < 0.5 else rng.uniform(0, 360))

    throws = [
        throw(
            float(rng.uniform(-0.5, 0.5)),
            angle(),
            [row(angle(), float(rng.uniform(1, 20))) for _ in range(rng.integers(0, 3))],
            rotating=float(rng.choice([0.0, rng.uniform(0.1, 10)])),
        )
        for _ in range(rng.integers(1, 5))
    ]
    sectors, largest = rng.random() < 0.3, float(rng.choice([0.3, 3.0, 30.0, 1e4]))
    webs = [
        web(
            str(k),
            float(rng.uniform(-0.6, 0.6)),
            largest * float(rng.uniform(0.1, 1.0)) * float(rng.choice([1.0, 1.0, 1e-6])),
            float(rng.uniform(0.05, 0.3)),
            (angle(), float(rng.choice([1.0, 30.0, 60.0, 90.0]))) if sectors and rng.random() < 0.6 else None,
        )
        for k in range(rng.choice([1, 2, 2, 3, 4, 4, 6, 8, 16, 32]))
    ]
    budget = {} if rng.random() < 0.7 else {"max_total_mass_kg": 0.4 * sum(web["max_mass_kg"] for web in webs)}
    goal = {
        "combine": str(rng.choice(["sum", "max"])),
        "direction_weights": {"x": 1.0, "y": float(rng.choice([1.0, 1.0, 0.3, 0.0]))},
        "force_weight": float(rng.choice([1.0, 1.0, 0.0, 1e-3])),
        "least_mass": bool(rng.random() < 0.8),
    }
    return {"machine": machine(throws, webs, **budget), "objective": goal}


def ladders(rng: np.random.Generator, distances: Sequence[float] = DISTANCES) -> Iterator[Ladder]:
    """The places of one random machine that it has; none where counterweights change nothing that counts."""
    body = bodies(rng)
    request = OptimizeRequest.model_validate(body)
    scene = prepare(request, ("residual",))
    limited = [response for response in scene.responses if rng.random() < 0.6] or [scene.responses[0]]
    without = cone_program(request.machine, request.objective, scene.responses, scene.omega_squared)
    size = float(yardstick(without)) * scene.omega_squared
    if size == 0.0:
        return
    for place in PLACES:
        peaks = _peaks(place, request, limited, without)
        ceilings = {FIELDS[name]: peak * scene.omega_squared for name, peak in peaks.items()}
        if all(ceiling > 0 for ceiling in ceilings.values()):
            rungs = [_ask(body, ceilings, distance) for distance in distances]
            yield Ladder(place, ceilings, size, rungs, list(faults(rungs, size)))


def _peaks(place: str, request: OptimizeRequest, limited: Sequence[Response], without: object) -> dict[str, float]:
    """The peaks at a place, in kg m and kg m^2."""
    rest = {response.name: float(response.baseline.peak) for response in limited}
    if place == "at rest":
        return rest
    if place == "floor":
        return {response.name: float(np.abs(response.baseline.counter)) for response in limited}
    if place == "unlimited":
        best = optimum(without, 1e-6, request.objective.least_mass)
        return {response.name: float(response.to(best.unbalance).peak) for response in limited}
    if not all(rest.values()):
        return dict.fromkeys(rest, 0.0)
    # all of them by the same share of what they are without counterweights
    lowered = [weighted_peak(response, 1.0 / rest[response.name]) for response in limited]
    least = optimum(statement(combined(lowered, "max"), [], limits(request.machine)), 1e-13, False)
    assert isinstance(least, ConeSolution)
    return {name: peak * least.objective for name, peak in rest.items()}


def _ask(body: Body, ceilings: Mapping[str, float], distance: float) -> Rung:
    put = {name: ceiling * (1.0 + distance) for name, ceiling in ceilings.items()}
    whole = {**body, "objective": {**body["objective"], **put}}
    began = time.process_time()
    answer = optimize(OptimizeRequest.model_validate(whole))
    cpu_s = time.process_time() - began
    proof = answer.certificate
    if proof is None:
        return Rung(distance, whole, answer.status, np.nan, "", cpu_s)
    return Rung(distance, whole, answer.status, proof.objective, proof.method, cpu_s)


def faults(rungs: Sequence[Rung], size: float) -> Iterator[str]:
    """Jumps: an objective that grows, or a ceiling that gets out of reach, as the ceilings are raised."""
    for at, lower in enumerate(rungs):
        for higher in rungs[at + 1 :]:
            if np.isnan(lower.objective):
                continue
            step = f"from {lower.distance:g} to {higher.distance:g}"
            if higher.status == "infeasible":
                if lower.status == "optimal" or higher.distance - lower.distance > 2 * CEILING_TOLERANCE:
                    yield f"{step}: out of reach"
            elif higher.distance - lower.distance > 2 * CEILING_TOLERANCE:
                rise = (higher.objective - lower.objective) / size
                # a point that breaks its ceilings says so, and shows nothing about smaller ones
                if rise > _GAP and lower.status == "optimal":
                    yield f"{step}: the objective rises by {rise:.1e} ({lower.status}, {higher.status})"


def run(count: int, seed: int, distances: Sequence[float] = DISTANCES) -> list[Ladder]:
    """The ladders of some machines; a machine depends on its own number alone."""
    return [ladder for n in range(count) for ladder in ladders(np.random.default_rng((seed, n)), distances)]


def summary(ladders: Sequence[Ladder], console: Console) -> None:
    table = Table("place", "answers", "optimal", "infeasible", "inaccurate", "near", "of them inaccurate", "jumps", "s")
    for place in (*PLACES, "all"):
        chosen = [ladder for ladder in ladders if place in (ladder.place, "all")]
        rungs = [rung for ladder in chosen for rung in ladder.rungs]
        near = [rung for rung in rungs if abs(rung.distance) <= NEAR]
        statuses, undecided = (
            Counter(rung.status for rung in rungs),
            Counter(rung.status for rung in near)["inaccurate"],
        )
        table.add_row(
            place,
            str(len(rungs)),
            *(str(statuses[name]) for name in ("optimal", "infeasible", "inaccurate")),
            str(len(near)),
            f"{undecided} ({undecided / max(len(near), 1):.2%})",
            str(sum(bool(ladder.faults) for ladder in chosen)),
            f"{max((rung.cpu_s for rung in rungs), default=0.0):.2f}",
        )
    console.print(table)
    rungs = [rung for ladder in ladders for rung in ladder.rungs]
    console.print(dict(Counter(rung.method or rung.status for rung in rungs).most_common()))
    slow = sorted((rung.cpu_s for rung in rungs), reverse=True)
    console.print(
        f"CPU time of an answer: {sum(t > 1 for t in slow)} above 1 s, {sum(t > 0.3 for t in slow)} above 0.3 s"
    )


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.hard.boundary", description=__doc__)
    parser.add_argument("--count", type=int, default=100, metavar="N", help="machines, of up to 56 answers each")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--show", type=int, default=0, metavar="N", help="requests that are inaccurate or jump, whole")
    arguments = parser.parse_args()
    console = Console()
    ladders = run(arguments.count, arguments.seed)
    summary(ladders, console)
    for ladder in [ladder for ladder in ladders if ladder.faults][: arguments.show]:
        print(
            ladder.place,
            ladder.ceilings,
            *ladder.faults,
            *(json.dumps(rung.body) for rung in ladder.rungs[:1]),
            sep="\n  ",
        )
        for rung in ladder.rungs:
            print(f"    {rung.distance:8.0e} {rung.status:10} {rung.objective:.12g} {rung.method}")
    bad = [rung for ladder in ladders for rung in ladder.rungs if rung.status == "inaccurate"]
    for rung in bad[: arguments.show]:
        print(rung.distance, rung.method, json.dumps(rung.body))
    near = [rung for ladder in ladders for rung in ladder.rungs if abs(rung.distance) <= NEAR]
    share = sum(rung.status == "inaccurate" for rung in near) / max(len(near), 1)
    return int(share > 1e-3 or any(ladder.faults for ladder in ladders))


if __name__ == "__main__":
    sys.exit(main())
