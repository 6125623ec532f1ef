"""Checks an answer against its request, from the two files alone.

    python verify.py request.json answer.json

Answers of optimize, pareto and pin loads, and rows of sweeps as a JSON list or as NDJSON. The standard library, Python
3.8 or newer; nothing of the service is imported. The other verify_*.py have to lie beside this file. Which of them says
what, by which formulas and to which tolerance is in docs/verify.md. Exit code 0: every claim holds; 1: something is
broken; 2: the files cannot be read; 3: nothing is broken, but claims are not covered. These are named.
"""

from __future__ import annotations

import sys
from math import inf
from typing import Any, Callable, Dict, Iterator

from verify_claims import CODES, Claim, covered, judged, main
from verify_front import front
from verify_leaves import leaves
from verify_match import matching
from verify_numbers import Place, Unreadable, read
from verify_pin_loads import pin_loads
from verify_single import single
from verify_sweep import sweep

__all__ = ["CODES", "PLACES", "Unreadable", "main", "read", "verify"]

#: numbers and texts, of all points or rows together, that a service looks at in one request
PLACES = 200_000


def verify(request: Any, answer: Any, most: float = inf) -> Dict[str, Any]:
    """Every claim of an answer, what of it is not covered, and the verdict on the whole.

    Parameters
    ----------
    request, answer : what a JSON file holds: bodies of optimize or pareto with their answers, or the body of a sweep
        with a list of its rows.
    most : numbers and texts to look at, those of the request again for every point or row.

    Raises
    ------
    Unreadable
        naming the field that is not what the service takes or gives.
    """
    question, reply = Place(request, "request"), Place(answer, "answer")
    many = "base" in request if isinstance(request, dict) else False
    work = leaves(answer) + leaves(request) * (len(answer) if many and isinstance(answer, list) else 1)
    if work > most:
        raise Unreadable(reply.path, f"holds more than is checked at a time: {work} of {most} numbers and texts")
    return judged(covered(_kind(request, answer, many)(question, reply)), reply)


def _kind(request: Any, answer: Any, many: bool) -> Callable[[Place, Place], Iterator[Claim]]:
    """What is claimed of an answer of this form."""
    fields = answer if isinstance(answer, dict) else {}
    if isinstance(request, dict) and "parts" in request:
        return matching
    if isinstance(request, dict) and "dead_points_deg" in fields:
        return pin_loads
    return sweep if many else front if "fronts" in fields else single


if __name__ == "__main__":
    sys.exit(main(verify, __doc__, sys.argv[1:]))
