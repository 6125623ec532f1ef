"""``python -m tests.verification.genuine --count 10000``: genuine answers, of which none may be broken.

Pairs of features of tests/pairs, and random machines of tests/hard with what their bodies may ask for, some with masses
that are off. Prints what came of them, and every claim that was broken. Exit code 1 where there was one, or where the
checker or the optimiser raised something; a warning is raised.
"""

import argparse
import json
import random
import sys
import time
import warnings
from collections import Counter
from collections.abc import Iterator
from typing import Any

from optimizer.errors import MissingInput, OutOfRange
from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from service.common.validation import InvalidRequest, check
from service.verification import checker
from tests.hard.bodies import drawn
from tests.hard.random_features import FEATURES
from tests.pairs.asking import body_of
from tests.pairs.combinations import all_pairs

#: s, of searches
_TIME_LIMIT = 0.3
#: of so many random machines one is asked with masses that are off as well
_OFF = 5
#: answers after which it is said how many there are
_TOLD = 100


def requests(seed: int) -> Iterator[tuple[str, Any]]:
    """Names and bodies without end: every other one a random machine, every other one a pair of features."""
    pairs = list(all_pairs())
    order = random.Random(seed)
    order.shuffle(pairs)
    modes = [one for one in FEATURES if one != "match"]
    for number in range(10**9):
        mode, sent = modes[number % len(modes)], drawn(number, seed, modes[number % len(modes)])
        yield f"{mode} {number} of seed {seed}", sent
        if number % _OFF == 0 and sent is not None:
            yield f"{mode} {number} of seed {seed}, masses off", with_masses_off(sent, number)
        base, features = pairs[number % len(pairs)]
        yield f"{base} {features}", body_of(base, features, _TIME_LIMIT)


def with_masses_off(sent: Any, number: int) -> Any:
    """The same with reciprocating masses that are off by a share, up to all of them."""
    share = (0.02, 0.1, 1.0)[number // _OFF % 3]
    return sent | {"tolerances": (sent.get("tolerances") or {}) | {"reciprocating_mass_relative": share}}


def judged(sent: Any) -> dict[str, Any] | None:
    """What the checker finds of the answer to a request; None where that is refused."""
    try:
        answer = optimize(check(OptimizeRequest, sent))
    except (InvalidRequest, MissingInput, OutOfRange):
        return None
    found: dict[str, Any] = checker().verify(json.loads(json.dumps(sent)), json.loads(answer.model_dump_json()))
    return found


def run(count: int, seed: int, seconds: float = float("inf")) -> tuple[Counter[str], list[str]]:
    """Verdicts of so many answers, or of so many seconds of computing, and what was broken or raised."""
    verdicts, faults, begun = Counter[str](), [], time.process_time()
    for name, sent in requests(seed):
        if verdicts.total() >= count or time.process_time() - begun > seconds:
            break
        if sent is None:
            continue
        try:
            found = judged(sent)
        except Exception as error:  # whatever it is, it is a fault
            verdicts["raised"] += 1
            faults.append(f"{name}: raised {error!r}")
            print(faults[-1], flush=True)
            continue
        if found is not None:
            verdicts[found["verdict"]] += 1
            broken = (one for one in found["claims"] if one["verdict"] == "broken")
            new = [f"{name}: {one['claim']} {one['margin']} {one['where']}" for one in broken]
            faults += new
            print(*new, sep="\n", end="\n" if new else "", flush=True)
        if verdicts.total() % _TOLD == 0:
            print(f"{verdicts.total()} {dict(verdicts)}", file=sys.stderr, flush=True)
    return verdicts, faults


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.verification.genuine", description=__doc__)
    parser.add_argument("--count", type=int, default=1_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=float("inf"), help="of computing, at most")
    arguments = parser.parse_args()
    warnings.simplefilter("error")
    verdicts, faults = run(arguments.count, arguments.seed, arguments.seconds)
    print(verdicts.total(), dict(verdicts))
    return int(bool(faults))


if __name__ == "__main__":
    sys.exit(main())
