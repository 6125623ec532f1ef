"""``python -m tests.verification.fabricated``: answers that somebody made up, whose figures agree with one another.

Doing nothing is called optimal, ceilings that can be kept are called out of reach, a counterweight is there twice, a
proof is left out, the answer is that to another request. Prints kind | fabricated | broken | refused | not covered |
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
    found = copy.deepcopy(answer)
    for one in found["counterweights"]:
        fixed = one["fixed"]
        for field in ("mass_kg", "angle_deg", "mass_radius_kg_m", "x_kg_m", "y_kg_m", "centrifugal_force_N"):
            one[field] = one[field] if fixed else 0.0
        one["angle_from_crank_deg"], one["active_limits"], one["shape"] = None, [], None
    for shaft in found["balance_shafts"]:
        shaft["total_mass_kg"], shaft["counterweights"] = 0.0, []
    proof = found["certificate"]
    rest = proof["objective_without_counterweights"]
    proof |= {"objective": rest, "lower_bound": rest, "gap": 0.0, "relative_gap": 0.0}
    proof |= {"mass_lower_bound_kg": 0.0, "mass_relative_gap": 0.0, "mass_objective_limit": rest}
    found |= {"total_mass_kg": 0.0, "shadow_prices": [], "active_limits": [], "sensitivity": None}
    residual = found["residual"]
    residual["after"], residual["orders"]["after"] = residual["before"], residual["orders"]["before"]
    found["balance_rate"] = [{**one, "rate": 0.0, "sideways": 0.0} for one in found["balance_rate"]]
    return found


def out_of_reach(answer: Answer) -> Answer:
    """Nothing keeps the ceilings, by the proof of another request."""
    _, other = pair("infeasible")
    found = copy.deepcopy(answer)
    found |= {"status": "infeasible", "certificate": None, "counterweights": [], "total_mass_kg": None}
    found |= {"shadow_prices": [], "active_limits": [], "balance_shafts": [], "sensitivity": None, "worst_case": None}
    found["residual"]["after"] = found["residual"]["orders"]["after"] = None
    found["infeasibility"] = {**other["infeasibility"], "closest": None}
    return found


def twice(answer: Answer) -> Answer:
    found = copy.deepcopy(answer)
    found["counterweights"].append(found["counterweights"][0])
    return found


def missing(answer: Answer) -> Answer:
    found = copy.deepcopy(answer)
    found["counterweights"].pop()
    return found


def without_proof(answer: Answer) -> Answer:
    found = copy.deepcopy(answer)
    found["certificate"]["multipliers"] = None
    return found


def with_empty_proof(answer: Answer) -> Answer:
    found = copy.deepcopy(answer)
    for name in ("objective", "mass"):
        if found["certificate"]["multipliers"][name]:
            found["certificate"]["multipliers"][name] |= {"terms": [], "rows": [], "ceilings": [], "budget": 0.0}
    return found


def closed(answer: Answer) -> Answer:
    """A bound as high as the objective."""
    found = copy.deepcopy(answer)
    proof = found["certificate"]
    proof |= {"lower_bound": 1.0001 * proof["objective"], "gap": 0.0, "relative_gap": 0.0}
    return found


def turned(answer: Answer) -> Answer:
    """Counterweights that are off by a degree, with all that is told of each."""
    found = copy.deepcopy(answer)
    for one in found["counterweights"]:
        if one["mass_kg"] > 0 and not one["fixed"]:
            one["angle_deg"] = (one["angle_deg"] + 1.0) % 360
            if one["angle_from_crank_deg"] is not None:
                one["angle_from_crank_deg"] = (one["angle_from_crank_deg"] + 1.0) % 360
            u = rect(one["mass_radius_kg_m"], radians(one["angle_deg"]))
            one["x_kg_m"], one["y_kg_m"] = u.real, u.imag
    return found


def heavier(answer: Answer) -> Answer:
    """Counterweights that are all heavier by a tenth."""
    found = copy.deepcopy(answer)
    for one in found["counterweights"]:
        if not one["fixed"]:
            for field in ("mass_kg", "mass_radius_kg_m", "x_kg_m", "y_kg_m", "centrifugal_force_N"):
                one[field] *= 1.1
    found["total_mass_kg"] *= 1.1
    return found


def praised(answer: Answer) -> Answer:
    """Half of what is left is not told."""
    found = copy.deepcopy(answer)
    after = found["residual"]["after"]
    for response in after.values():
        for field in response:
            response[field] *= 1.0 if field.endswith("_deg") else 0.5
    found["certificate"]["objective"] *= 0.5
    found["certificate"]["lower_bound"] = found["certificate"]["gap"] = 0.0
    return found


def exchanged(answer: Answer) -> Answer:
    """What is on the first web is said to be on the last, and the other way round."""
    found = copy.deepcopy(answer)
    first, last = found["counterweights"][0], found["counterweights"][-1]
    first["web"], last["web"] = last["web"], first["web"]
    return found


#: every way, and the one that takes the answer of another kind
WAYS: dict[str, Callable[[Answer], Answer]] = {
    each.__name__: each
    for each in (
        idle, out_of_reach, twice, missing, without_proof, with_empty_proof, closed, turned, heavier, praised,
        exchanged,
    )
}  # fmt: skip
KINDS = tuple(one for one in names() if one not in ("front", "sweep", "matching") and "infeasible" not in one)


def fabricated(name: str) -> Iterator[tuple[str, Any, Any]]:
    """Name, request and answer of everything that is made up of a kind."""
    request, answer = pair(name)
    fitted = any(one["mass_kg"] > 0 and not one["fixed"] for one in answer["counterweights"])
    for way, change in WAYS.items():
        several = len(answer["counterweights"]) > 1
        if (fitted or way not in ("idle", "turned", "heavier")) and (several or way != "exchanged"):
            yield way, request, change(answer)
    _, other = pair(KINDS[KINDS.index(name) - 1])
    yield "another", request, other


def verdict(request: Any, answer: Any) -> str:
    """What becomes of it."""
    try:
        found: str = checker().verify(request, answer)["verdict"]
    except checker().Unreadable:
        return "refused"
    return found


def main() -> int:
    together = Counter[str]()
    for name in KINDS:
        found = Counter[str]()
        for way, request, answer in fabricated(name):
            told = verdict(request, answer)
            found[told] += 1
            if told in ("held", "not covered"):
                print(f"   {told}: {name}, {way}")
        together += found
        print(f"{name:<32}", found.total(), *(found[each] for each in ("broken", "refused", "not covered", "held")))
    print("all:", together.total(), dict(together))
    return int(together["held"] > 0)


if __name__ == "__main__":
    sys.exit(main())
