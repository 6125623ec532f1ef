"""Whether an answer whose numbers are scaled by powers of 2 is judged as it is."""

import math
from collections.abc import Callable
from typing import Any

from tests.verification.recorded import Line, judgement, records


def differences(name: str, scaled: Callable[[Any], Any], factors: tuple[float, ...]) -> list[Any]:
    """Where claims of a scaled answer of the record are others: verdict, claims, or rooms by none of the factors."""
    record = records()[name]
    verdict, as_it_is = judgement(scaled(record["request"]), scaled(record["answer"])), record["judgements"][0]
    if verdict["whole"] != as_it_is["whole"]:
        return [verdict["whole"], as_it_is["whole"]]
    claims = [[line[:2] for line in judged["claims"]] for judged in (verdict, as_it_is)]
    if claims[0] != claims[1]:
        return [pair for pair in zip(*claims, strict=False) if pair[0] != pair[1]] or claims
    pairs = zip(verdict["claims"], as_it_is["claims"], strict=True)
    return [pair for pair in pairs if not _proportional(*pair, factors)]


def _proportional(line: Line, values: Line, factors: tuple[float, ...]) -> bool:
    """Rooms that are the smallest of all steps remain."""
    room, as_it_is = line[2], values[2]
    if room is None or as_it_is is None or max(abs(room), abs(as_it_is)) < 1e-200:
        return bool(room == as_it_is or (room is not None and as_it_is is not None))
    return any(math.isclose(room, factor * as_it_is, rel_tol=0.004) for factor in factors)
