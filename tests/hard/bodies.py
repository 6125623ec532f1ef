"""Random bodies that the schema accepts, in process: whatever they hold, nothing may raise.

``python -m tests.hard.bodies --count 100000`` is the long run; a few hundred belong to the test suite. Every body is
tried as it is drawn, and once more with a feature (``tests.hard.random_features``); the answer to that goes through
the independent checker.
"""

import argparse
import collections
import contextlib
import itertools
import json
import math
import random
import time
import traceback
import warnings
from collections.abc import Callable, Iterator
from typing import Any

from optimizer.analyze import analyze
from optimizer.errors import MissingInput, OutOfRange
from optimizer.optimize import optimize
from optimizer.studies.matching.match import match
from optimizer.studies.pareto.pareto import pareto
from optimizer.studies.sweep import run_chunk
from schemas.front.pareto import ParetoRequest
from schemas.match.request import MatchRequest
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from schemas.sweep.request import SweepRequest
from service.common import faults
from service.common.validation import InvalidRequest, check
from tests.hard.random_bodies import Body, Draw, body
from tests.hard.random_features import FEATURES, with_feature
from tests.verification.checking import broken

#: of every 20 bodies so many are asked as a front, as a sweep and as an analysis; the others are optimised
_PARETO, _SWEEP, _ANALYZE = 1, 3, 2
_RAISED = "raised"


def tried(number: int, seed: int = 0, feature: str | None = None) -> str:
    """Compute one body, as it is drawn or with a feature; what became of it, one word.

    Raises
    ------
    Exception
        as :func:`strictly`, and AssertionError for a claim that the independent checker refutes.
    """
    if feature is not None:
        return strictly(lambda: checked(drawn(number, seed, feature)))
    rng = random.Random(f"{seed}/{number}")
    request = body(rng)
    return strictly(lambda: _computed(request, number % 20, rng))


def drawn(number: int, seed: int, feature: str) -> Body:
    """A body with a feature."""
    plain = body(random.Random(f"{seed}/{number}"))
    return with_feature(Draw(random.Random(f"{seed}/{number}/{feature}")), plain, feature)


def strictly(compute: Callable[[], str]) -> str:
    """What became of a computation; that it was refused counts as well.

    Raises
    ------
    Exception
        whatever it raises, and every warning; AssertionError for a fault that the optimiser logs.
    """
    with warnings.catch_warnings(), faults.error_log() as error_log:
        warnings.simplefilter("error")
        try:
            became = compute()
        except (InvalidRequest, MissingInput, OutOfRange) as refused:
            became = f"refused: {type(refused).__name__}"
    assert not error_log, error_log
    return became


def checked(request: Body) -> str:
    """Status of the answer to a body; no claim of it is refuted."""
    if "parts" in request:
        return _finite(match(check(MatchRequest, request)))
    answer = optimize(check(OptimizeRequest, request))
    became, refuted = _finite(answer), broken(request, json.loads(answer.model_dump_json()))
    assert not refuted, refuted
    return became


def _computed(payload: Body, kind: int, rng: random.Random) -> str:
    if kind < _PARETO:
        return _finite(pareto(check(ParetoRequest, payload | {"points": 3})))
    if kind < _PARETO + _SWEEP:
        axis = {"path": "/machine/speed_rpm", "values": [rng.uniform(1, 1e4) for _ in range(rng.randint(1, 3))]}
        request = check(SweepRequest, {"base": payload, "axes": [axis]})
        rows = run_chunk(request.model_dump_json().encode(), 0, request.total).to_pylist()
        return "sweep " + " ".join(sorted({row["status"] for row in rows}))
    if kind < _PARETO + _SWEEP + _ANALYZE:
        analyze(check(AnalyzeRequest, {"machine": payload["machine"]}))
        return "analyzed"
    return _finite(optimize(check(OptimizeRequest, payload)))


def _finite(answer: Any) -> str:
    for path, value in _numbers(json.loads(answer.model_dump_json()), ""):
        assert math.isfinite(value), f"{path} is {value}"
    return str(answer.status)


def _numbers(value: Any, path: str) -> Iterator[tuple[str, float]]:
    if isinstance(value, float):
        yield path, value
    elif isinstance(value, dict):
        for name, part in value.items():
            yield from _numbers(part, f"{path}/{name}")
    elif isinstance(value, list):
        for index, part in enumerate(value):
            yield from _numbers(part, f"{path}/{index}")


def main() -> int:
    """Try many bodies, print every one that raises; exit code 1 if any did."""
    parser = argparse.ArgumentParser(prog="python -m tests.hard.bodies", description=__doc__)
    parser.add_argument("--count", type=int, default=1000, help="bodies as they are drawn, and as many with a feature")
    parser.add_argument("--start", type=int, default=0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", choices=["plain", *FEATURES], help="no others")
    arguments = parser.parse_args()
    became: collections.Counter[str] = collections.Counter()
    slowest = (0.0, "")
    for number, feature in itertools.chain.from_iterable(
        map(_variants, range(arguments.start, arguments.start + arguments.count))
    ):
        if arguments.only not in (None, feature or "plain"):
            continue
        name = f"{feature or 'plain'} body {number} of seed {arguments.seed}"
        began = time.process_time()
        try:
            became[f"{feature or 'plain'}: {tried(number, arguments.seed, feature)}"] += 1
        except Exception:
            became[_RAISED] += 1
            print(f"{name}:")
            traceback.print_exc(limit=-4)
        slowest = max(slowest, (time.process_time() - began, name))
    for name in sorted(became):
        print(f"{became[name]:7}  {name}")
    print(f"slowest {slowest[0]:.2f} s of CPU, {slowest[1]}")
    return min(became[_RAISED], 1)


def _variants(number: int) -> Iterator[tuple[int, str | None]]:
    """A body as it is drawn, and the same with one feature after the other."""
    yield number, None
    yield number, list(FEATURES)[number % len(FEATURES)]


if __name__ == "__main__":
    with contextlib.suppress(KeyboardInterrupt):
        raise SystemExit(main())
