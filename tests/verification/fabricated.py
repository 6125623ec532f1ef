"""``python -m tests.verification.fabricated``: answers that somebody made up, whose figures agree with one another.

Doing nothing is called optimal, ceilings that can be kept are called out of reach, a counterweight is there twice. A
proof is left out, or the answer is that to another request. Prints kind | fabricated | broken | refused | not covered |
held. Exit code 1 where one of them is held.
"""

import copy
import sys
from cmath import rect
from collections import Counter
from collections.abc import Callable, Iterator
from math import radians
from typing import Any

from service.verification import checker
from tests.verification.answers import names, pair

Answer = dict[str, Any]


def idle(answer: Answer) -> Answer:
    """The answer of one who does nothing, and calls it optimal: its figures agree with one another."""
    variant = copy.deepcopy(answer)
    for counterweight in variant["counterweights"]:
        fixed = counterweight["fixed"]
        for field in ("mass_kg", "angle_deg", "mass_radius_kg_m", "x_kg_m", "y_kg_m", "centrifugal_force_N"):
            counterweight[field] = counterweight[field] if fixed else 0.0
        counterweight["angle_from_crank_deg"], counterweight["active_limits"], counterweight["shape"] = None, [], None
    for shaft in variant["balance_shafts"]:
        shaft["total_mass_kg"], shaft["counterweights"] = 0.0, []
    proof = variant["certificate"]
    rest = proof["objective_without_counterweights"]
    proof |= {"objective": rest, "lower_bound": rest, "gap": 0.0, "relative_gap": 0.0}
    proof |= {"mass_lower_bound_kg": 0.0, "mass_relative_gap": 0.0, "mass_objective_limit": rest}
    variant |= {"total_mass_kg": 0.0, "shadow_prices": [], "active_limits": [], "sensitivity": None}
    residual = variant["residual"]
    residual["after"], residual["orders"]["after"] = residual["before"], residual["orders"]["before"]
    variant["balance_rate"] = [{**rate, "rate": 0.0, "sideways": 0.0} for rate in variant["balance_rate"]]
    return variant


def out_of_reach(answer: Answer) -> Answer:
    """Nothing keeps the ceilings, by the proof of another request."""
    _, proven = pair("infeasible")
    variant = copy.deepcopy(answer)
    variant |= {"status": "infeasible", "certificate": None, "counterweights": [], "total_mass_kg": None}
    variant |= {"shadow_prices": [], "active_limits": [], "balance_shafts": [], "sensitivity": None, "worst_case": None}
    variant["residual"]["after"] = variant["residual"]["orders"]["after"] = None
    variant["infeasibility"] = {**proven["infeasibility"], "closest": None}
    return variant


def twice(answer: Answer) -> Answer:
    variant = copy.deepcopy(answer)
    variant["counterweights"].append(variant["counterweights"][0])
    return variant


def missing(answer: Answer) -> Answer:
    variant = copy.deepcopy(answer)
    variant["counterweights"].pop()
    return variant


def without_proof(answer: Answer) -> Answer:
    variant = copy.deepcopy(answer)
    variant["certificate"]["multipliers"] = None
    return variant


def with_empty_proof(answer: Answer) -> Answer:
    variant = copy.deepcopy(answer)
    for name in ("objective", "mass"):
        if variant["certificate"]["multipliers"][name]:
            variant["certificate"]["multipliers"][name] |= {"terms": [], "rows": [], "ceilings": [], "budget": 0.0}
    return variant


def closed(answer: Answer) -> Answer:
    """A bound as high as the objective."""
    variant = copy.deepcopy(answer)
    proof = variant["certificate"]
    proof |= {"lower_bound": 1.0001 * proof["objective"], "gap": 0.0, "relative_gap": 0.0}
    return variant


def turned(answer: Answer) -> Answer:
    """Counterweights that are off by a degree, with all that is told of each."""
    variant = copy.deepcopy(answer)
    for counterweight in variant["counterweights"]:
        if counterweight["mass_kg"] > 0 and not counterweight["fixed"]:
            counterweight["angle_deg"] = (counterweight["angle_deg"] + 1.0) % 360
            if counterweight["angle_from_crank_deg"] is not None:
                counterweight["angle_from_crank_deg"] = (counterweight["angle_from_crank_deg"] + 1.0) % 360
            u = rect(counterweight["mass_radius_kg_m"], radians(counterweight["angle_deg"]))
            counterweight["x_kg_m"], counterweight["y_kg_m"] = u.real, u.imag
    return variant


def heavier(answer: Answer) -> Answer:
    """Counterweights that are all heavier by a tenth."""
    variant = copy.deepcopy(answer)
    for counterweight in variant["counterweights"]:
        if not counterweight["fixed"]:
            for field in ("mass_kg", "mass_radius_kg_m", "x_kg_m", "y_kg_m", "centrifugal_force_N"):
                counterweight[field] *= 1.1
    variant["total_mass_kg"] *= 1.1
    return variant


def praised(answer: Answer) -> Answer:
    """Half of what is left is not told."""
    variant = copy.deepcopy(answer)
    after = variant["residual"]["after"]
    for response in after.values():
        for field in response:
            response[field] *= 1.0 if field.endswith("_deg") else 0.5
    variant["certificate"]["objective"] *= 0.5
    variant["certificate"]["lower_bound"] = variant["certificate"]["gap"] = 0.0
    return variant


def exchanged(answer: Answer) -> Answer:
    """What is on the first web is said to be on the last, and the other way round."""
    variant = copy.deepcopy(answer)
    first, last = variant["counterweights"][0], variant["counterweights"][-1]
    first["web"], last["web"] = last["web"], first["web"]
    return variant


#: every way, and the one that takes the answer of another kind
WAYS: dict[str, Callable[[Answer], Answer]] = {
    function.__name__: function
    for function in (
        idle, out_of_reach, twice, missing, without_proof, with_empty_proof, closed, turned, heavier, praised,
        exchanged,
    )
}  # fmt: skip
KINDS = tuple(name for name in names() if name not in ("front", "sweep", "matching") and "infeasible" not in name)


def fabricated(name: str) -> Iterator[tuple[str, Any, Any]]:
    """Name, request and answer of everything that is made up of a kind."""
    request, answer = pair(name)
    fitted = any(
        counterweight["mass_kg"] > 0 and not counterweight["fixed"] for counterweight in answer["counterweights"]
    )
    for way, change in WAYS.items():
        several = len(answer["counterweights"]) > 1
        if (fitted or way not in ("idle", "turned", "heavier")) and (several or way != "exchanged"):
            yield way, request, change(answer)
    _, other = pair(KINDS[KINDS.index(name) - 1])
    yield "another", request, other


def verdict(request: Any, answer: Any) -> str:
    """What becomes of it."""
    try:
        judgement: str = checker().verify(request, answer)["verdict"]
    except checker().Unreadable:
        return "refused"
    return judgement


def main() -> int:
    together = Counter[str]()
    for name in KINDS:
        counts = Counter[str]()
        for way, request, answer in fabricated(name):
            judgement = verdict(request, answer)
            counts[judgement] += 1
            if judgement in ("held", "not covered"):
                print(f"   {judgement}: {name}, {way}")
        together += counts
        print(f"{name:<32}", counts.total(), *(counts[text] for text in ("broken", "refused", "not covered", "held")))
    print("all:", together.total(), dict(together))
    return int(together["held"] > 0)


if __name__ == "__main__":
    sys.exit(main())
