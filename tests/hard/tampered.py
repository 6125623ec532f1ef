"""``python -m tests.hard.tampered``: falsified answers through the independent checker.

Random machines are answered, and each answer is falsified in every way of tests/verification/tampering.py. There are a
mass, an angle, a residual, the objective or a bound changed by 1e-6 of itself, a limit broken by 1e-6. Prints how many
were caught, by what was falsified; exit code 1 if any was not, or if an answer as it was given is not held.
"""

import argparse
import json
import sys
import time
from collections import Counter
from collections.abc import Iterator
from typing import Any

from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from service.verification import checker
from tests.optimize.machines import random_machine
from tests.verification.kinds import SINGLE
from tests.verification.tampering import beyond_limits, tampered

Body = dict[str, Any]


def bodies() -> Iterator[Body]:
    """Every kind of request, then random machines under one objective after the other."""
    yield from SINGLE.values()
    goals = [body.get("objective", {}) for body in SINGLE.values()]
    seed = 0
    while True:
        goal = {name: value for name, value in goals[seed % len(goals)].items() if "ceiling" not in name}
        yield {"machine": random_machine(seed), "objective": goal}
        seed += 1


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.hard.tampered", description=__doc__)
    parser.add_argument("--count", type=int, default=1000, help="falsified answers")
    count = parser.parse_args().count
    tried, caught, faults, start = Counter[str](), Counter[str](), 0, time.process_time()
    for body in bodies():
        answer = json.loads(optimize(OptimizeRequest.model_validate(body)).model_dump_json())
        if (verdict := checker().verify(body, answer))["verdict"] != "held":
            faults += 1
            print("not held as it was given:", json.dumps([body, verdict]))
        falsified = [("answer", name, body, wrong) for name, wrong in tampered(answer)]
        falsified += [("limit", name, tighter, answer) for name, tighter in beyond_limits(body, answer)]
        for where, name, fields, table in falsified:
            kind = f"{where}: {'/'.join(part for part in name.split('/') if not part.isdecimal())}"
            tried[kind] += 1
            if checker().verify(fields, table)["verdict"] == "broken":
                caught[kind] += 1
            else:
                faults += 1
                print(f"{kind} was not caught:", json.dumps([fields, table]))
            if tried.total() == count:
                break
        if tried.total() == count:
            break
    for kind in sorted(tried):
        print(f"{caught[kind]:6} of {tried[kind]:6}  {kind}")
    print(f"{caught.total()} of {tried.total()} caught, {time.process_time() - start:.0f} s of CPU")
    return int(faults > 0)


if __name__ == "__main__":
    sys.exit(main())
