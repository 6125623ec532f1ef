"""What a claim is, and what becomes of many."""

from __future__ import annotations

import sys
from typing import Any, Callable, Generator, Iterable, Iterator, Optional, Sequence, Tuple

from verify_machine import NOTHING
from verify_numbers import (
    ONE,
    NotCovered,
    Number,
    Place,
    pointer,
    read,
    real,
)

#: kind of claim, where it stands, the room that is left (None: not covered), and what it is a share of
Claim = Tuple[str, Place, Optional[Number], Number]
Claims = Generator[Claim, None, Any]
#: an answer is held if these claims are, as far as they are made
CENTRAL = {
    "counterweights",
    "max_mass",
    "sector",
    "max_total_mass",
    "ceilings",
    "objective",
    "lower_bound",
    "fixed",
    "web_groups",
    "status",
    "corner",
    "conflict",
    "reach",
    "request",
}
VERDICTS = ("held", "not covered", "broken")


def near(claim: str, place: Place, figure: Number) -> Claim:
    """A figure lies where it has to."""
    if not place:
        return claim, place, None, ONE
    off = min(place.number() - figure, figure - place.number(), key=lambda one: one.high)
    return claim, place, off + real(NOTHING), abs(figure)


def judged(claims: Iterable[Claim]) -> dict[str, Any]:
    """What becomes of every kind of claim, of several of one kind the worst, and the verdict on the whole."""
    found: dict[str, tuple[int, float, dict[str, Any]]] = {}
    for claim, place, room, size in claims:
        share = None if room is None else float(room / Number(size.high, size.high) if size.high > 0 else room)
        rank = 1 if room is None else 0 if room.high >= 0 else 2
        told = {"claim": claim, "verdict": VERDICTS[rank], "margin": share, "where": pointer(place.path)}
        one = rank, -(share or 0.0), told
        found[claim] = max(found.get(claim, one), one, key=lambda one: one[:2])
    central = {rank for claim, (rank, _, _) in found.items() if claim in CENTRAL}
    worst = max([rank for rank, _, _ in found.values()], default=1)
    rank = worst if worst == 2 else 0 if central == {0} else 1
    return {"claims": [told for _, _, told in found.values()], "verdict": VERDICTS[rank]}


def covered(claims: Iterator[Claim]) -> Iterator[Claim]:
    """The claims as far as what they stand on is known."""
    try:
        yield from claims
    except NotCovered as found:
        (place,) = found.args
        yield "request", place, None, ONE


def main(check: Callable[[Any, Any], dict[str, Any]], usage: Optional[str], arguments: Sequence[str]) -> int:
    """Checks the two files that are named and prints what is found; returns the exit code."""
    if len(arguments) != 2:
        print(usage, file=sys.stderr)
        return 2
    try:
        found = check(*map(read, arguments))
    except (OSError, ValueError) as error:
        print(error, file=sys.stderr)
        return 2
    for one in found["claims"]:
        margin = "" if one["margin"] is None else f"{one['margin']:.1e}"
        print(f"{one['claim']:<18} {one['verdict']:<12} {margin:>9}  {one['where']}")
    print(found["verdict"])
    return int(found["verdict"] == "broken")
