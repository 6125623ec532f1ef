"""``python -m tests.hard.far_limits --count N``: a budget beside one web of 1e3 to 1e300 kg, answer by answer.

The machine of the issue of false bounds: 10 kg at 1 m turn at 1 rad/s. A web of 2 m and 0.32 kg and one of 1 m with the
far limit share a budget of 1 kg. Analytic: 10 - 2 * 0.32 - 0.68 = 8.68. Every answer goes through the independent
checker. Exit code 1 if a bound is above that, a value below, an answer not optimal or a claim broken.
"""

import argparse
import sys
import time

import numpy as np

from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from tests.optimize.test_far_limits import issued
from tests.verification.checking import broken

SMALLEST = 8.68


def faults(limit: float) -> list[str]:
    """What is wrong with the answer under one limit, kg."""
    body = issued(limit)
    answer = optimize(OptimizeRequest.model_validate(body))
    proof, claims = answer.certificate, broken(body, answer.model_dump(mode="json"))
    if answer.status != "optimal":
        claims.append(f"{answer.status}: {answer.status_reason}")
    elif not SMALLEST * (1 - 1e-9) <= proof.lower_bound <= SMALLEST:
        claims.append(f"bound {proof.lower_bound!r}")
    elif not SMALLEST * (1 - 1e-12) <= proof.objective <= SMALLEST + 1.1e-5:
        claims.append(f"objective {proof.objective!r}")
    return claims


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.hard.far_limits", description=__doc__)
    parser.add_argument("--count", type=int, default=1000, help="limits")
    begun, count = time.process_time(), parser.parse_args().count
    wrong = {
        limit: wrong_faults for limit in np.geomspace(1e3, 1e300, count).tolist() if (wrong_faults := faults(limit))
    }
    for limit, wrong_faults in wrong.items():
        print(f"{limit!r} kg: {wrong_faults}")
    print(f"{count} limits, {len(wrong)} wrong, {time.process_time() - begun:.0f} s of CPU")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
