"""``python -m tests.verification``: what the checker knows of every kind of answer.

Of each kind every number is falsified in seven ways, one at a time: times 1.001, 0.999 and 1000, 0, the other sign,
swapped with the next number, deleted. Prints kind | claims | covered | tampered | caught | named | rounding | missed
and milliseconds. Rounding is what is left of figures that cancel, below 1e-9 of them. Exit code 1 where something was
missed, neither caught nor named as not covered, or where the answer as it is was broken.
"""

import argparse
import sys
import time
from collections import Counter
from typing import Any

from service.verification import checker
from tests.verification.answers import names, pair
from tests.verification.falsified import Falsified, falsified, numbers, outcome, silent


def tally(request: Any, answer: Any, every: int) -> tuple[Counter[str], list[Falsified]]:
    """What became of every n-th number of an answer, and what was missed."""
    counts, missed = Counter[str](), []
    places = list(numbers(answer))
    for n, path in enumerate(places):
        if n % every == 0:
            for forgery in falsified(answer, path, places[n + 1] if n + 1 < len(places) else None):
                fate = outcome(request, forgery, silent())
                counts[fate] += 1
                if fate == "missed":
                    missed.append(forgery)
    return counts, missed


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.verification", description=__doc__)
    parser.add_argument("--every", type=int, default=1, help="falsify every n-th number")
    parser.add_argument("--kinds", default="", help="those whose name holds this")
    parser.add_argument("--missed", action="store_true", help="print what was missed")
    arguments = parser.parse_args()
    faults, together = 0, Counter[str]()
    print(f"{'kind':<32} verdict       claims covered tampered  caught   named rounding missed      ms")
    for name in (label for label in names() if arguments.kinds in label):
        request, answer = pair(name)
        begun = time.process_time()
        verdict = checker().verify(request, answer)
        spent = time.process_time() - begun
        counts, missed = tally(request, answer, arguments.every)
        together += counts
        faults += bool(counts["missed"]) + (verdict["verdict"] == "broken")
        line = (verdict["leaves"], verdict["checked"], counts.total(), counts["caught"], counts["named"])
        print(
            f"{name:<32} {verdict['verdict']:<12}",
            *(f"{rounding:7}" for rounding in (*line, counts["rounding"], counts["missed"])),
            f"{spent * 1e3:7.1f}",
            flush=True,
        )
        if arguments.missed:
            for forgery in missed:
                print("   missed:", "/".join(map(str, forgery.path)), forgery.way)
    print("all:", dict(together))
    return int(faults > 0)


if __name__ == "__main__":
    sys.exit(main())
