"""``python -m tests.verification.genuine --count 10000``: genuine answers, of which none may be broken.

Pairs of features of tests/pairs, and random machines of tests/hard with what their bodies may ask for, some with masses
that are off. Sweeps and fronts through both are drawn too (tests.verification.studies), their rows and points checked;
and parts are matched to machines. Prints what came of them, and every claim that was broken. Exit code 1 where there
was one, or where the checker or the optimiser raised something, also in one row alone; a warning is raised.
"""

import argparse
import json
import random
import sys
import time
import warnings
from collections import Counter
from collections.abc import Callable, Container, Iterator
from typing import Any, NamedTuple

from optimizer.errors import MissingInput, OutOfRange
from optimizer.optimize import optimize
from optimizer.studies.matching.match import match
from schemas.match.request import MatchRequest
from schemas.request.requests import OptimizeRequest
from service.common.validation import InvalidRequest, check
from service.verification import checker
from tests.hard.bodies import drawn
from tests.hard.random_features import FEATURES
from tests.pairs.asking import body_of
from tests.pairs.combinations import all_pairs
from tests.verification.studies import front_answer, front_of, sweep_of, sweep_rows

#: s, of searches
_TIME_LIMIT = 0.3
#: of so many random machines one is asked with masses that are off as well
_OFF = 5
#: answers after which it is said how many there are
_REPORT_STEP = 100


class Kind(NamedTuple):
    """What is made of a request to optimise one machine, and what answers it; both may refuse."""

    made: Callable[[Any, random.Random], Any]
    answered: Callable[[Any], Any]


class Question(NamedTuple):
    """What is asked: a kind of answer, and what that is made of."""

    name: str
    kind: str
    sent: Any


KINDS = {
    "optimize": Kind(
        lambda body, _: body, lambda body: json.loads(optimize(check(OptimizeRequest, body)).model_dump_json())
    ),
    "sweep": Kind(sweep_of, sweep_rows),
    "front": Kind(front_of, front_answer),
    "match": Kind(lambda body, _: body, lambda body: json.loads(match(check(MatchRequest, body)).model_dump_json())),
}
#: in turn: each of a random machine, and sweeps and fronts of a pair of features
_STUDIES = (("sweep", True), ("sweep", False), ("front", True), ("sweep", False), ("match", True), ("front", False))


def questions(seed: int) -> Iterator[Question]:
    """Without end: a random machine, a pair of features, and a study of one of them."""
    pairs = list(all_pairs())
    order = random.Random(seed)
    order.shuffle(pairs)
    modes = [feature for feature in FEATURES if feature != "match"]
    for number in range(10**9):
        mode, drawing = modes[number % len(modes)], drawn(number, seed, modes[number % len(modes)])
        yield Question(f"{mode} {number} of seed {seed}", "optimize", drawing)
        if number % _OFF == 0 and drawing is not None:
            yield Question(f"{mode} {number} of seed {seed}, masses off", "optimize", with_masses_off(drawing, number))
        base, features = pairs[number % len(pairs)]
        pair = body_of(base, features, _TIME_LIMIT)
        yield Question(f"{base} {features}", "optimize", pair)
        kind, of_machine = _STUDIES[number % len(_STUDIES)]
        study = drawn(number, seed, "match") if kind == "match" else drawing if of_machine else pair
        name = f"{mode} {number}" if of_machine else f"{base} {features}"
        yield Question(f"{kind} {number} of seed {seed}, {name}", kind, study)


def with_masses_off(subject: Any, number: int) -> Any:
    """The same with reciprocating masses that are off by a share, up to all of them."""
    share = (0.02, 0.1, 1.0)[number // _OFF % 3]
    return subject | {"tolerances": (subject.get("tolerances") or {}) | {"reciprocating_mass_relative": share}}


def judged(question: Question) -> dict[str, Any] | None:
    """What the checker finds of the answer to a question; None where that is refused."""
    kind = KINDS[question.kind]
    try:
        document = kind.made(question.sent, random.Random(question.name))
        answer = kind.answered(document)
    except (InvalidRequest, MissingInput, OutOfRange):
        return None
    verdict: dict[str, Any] = checker().verify(json.loads(json.dumps(document)), answer)
    return verdict


def run(
    count: int, seed: int, seconds: float = float("inf"), only: Container[str] = KINDS
) -> tuple[Counter[str], list[str]]:
    """Verdicts of so many answers, or of so many seconds of computing, and what was broken or raised."""
    verdicts, faults, begun = Counter[str](), [], time.process_time()
    for question in questions(seed):
        if verdicts.total() >= count or time.process_time() - begun > seconds:
            break
        if question.sent is None or question.kind not in only:
            continue
        try:
            verdict = judged(question)
        except Exception as error:  # whatever it is, it is a fault
            verdicts[f"{question.kind} raised"] += 1
            faults.append(f"{question.name}: raised {error!r}")
            print(faults[-1], flush=True)
            continue
        if verdict is not None:
            verdicts[f"{question.kind} {verdict['verdict']}"] += 1
            broken = (claim for claim in verdict["claims"] if claim["verdict"] == "broken")
            new = [f"{question.name}: {claim['claim']} {claim['margin']} {claim['where']}" for claim in broken]
            faults += new
            print(*new, sep="\n", end="\n" if new else "", flush=True)
            if verdicts.total() % _REPORT_STEP == 0:
                print(f"{verdicts.total()} {dict(verdicts)}", file=sys.stderr, flush=True)
    return verdicts, faults


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.verification.genuine", description=__doc__)
    parser.add_argument("--count", type=int, default=1_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", choices=KINDS, action="append", help="kinds of answers; all if not given")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="of computing, at most")
    arguments = parser.parse_args()
    warnings.simplefilter("error")
    verdicts, faults = run(arguments.count, arguments.seed, arguments.seconds, arguments.only or KINDS)
    print(verdicts.total(), dict(verdicts))
    return int(bool(faults))


if __name__ == "__main__":
    sys.exit(main())
