"""``python -m tests.hard.checked``: the battery and random extremes through the independent checker.

Prints how the answers were judged and how long that took; exit code 1 if a claim of any is broken.
"""

import argparse
import json
import sys
import time
from collections import Counter
from typing import Any

from hypothesis import HealthCheck, Phase, given, seed, settings

from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from service.verification import checker
from tests.hard.cases import all_cases
from tests.hard.wild import requests


class Tally:
    """What became of the answers."""

    def __init__(self) -> None:
        self.verdicts = Counter[tuple[str, str]]()
        self.seconds: list[float] = []
        self.faults = 0

    def judge(self, name: str, body: dict[str, Any]) -> None:
        try:
            answer = json.loads(optimize(OptimizeRequest.model_validate(body)).model_dump_json())
        except Exception as error:  # a fault of the service is counted, and the rest is judged
            self._fault(name, f"{type(error).__name__}: {error}", body)
            self.verdicts["exception", ""] += 1
            return
        start = time.process_time()
        verdict = checker().verify(body, answer)
        self.seconds.append(time.process_time() - start)
        self.verdicts[answer["status"], verdict["verdict"]] += 1
        claims = [claim for claim in verdict["claims"] if claim["verdict"] == "broken"]
        if claims:
            self._fault(name, str(claims), body)

    def _fault(self, name: str, text: str, body: dict[str, Any]) -> None:
        self.faults += 1
        print(f"{name}: {text}\n    {json.dumps(body)}", flush=True)


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.hard.checked", description=__doc__)
    parser.add_argument("--count", type=int, default=10_000, help="random extremes")
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    tally = Tally()
    for case in all_cases():
        tally.judge(case.name, case.body)
    print("battery:", dict(tally.verdicts), flush=True)

    @seed(arguments.seed)
    @settings(
        max_examples=arguments.count,
        database=None,
        deadline=None,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )
    @given(requests())
    def search(body: dict[str, Any]) -> None:
        tally.judge("random", body)

    search()
    times = sorted(tally.seconds)
    print("with random extremes:", dict(tally.verdicts))
    print(f"checker: median {times[len(times) // 2] * 1e3:.1f} ms, most {times[-1] * 1e3:.0f} ms of CPU")
    print(f"{len(times)} answers, {tally.faults} faults")
    return int(tally.faults > 0)


if __name__ == "__main__":
    sys.exit(main())
