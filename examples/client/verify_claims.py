"""What a claim is, and what becomes of many."""

from __future__ import annotations

import sys
from typing import Any, Callable, Dict, Generator, Iterable, Iterator, Optional, Sequence, Tuple

from verify_leaves import account
from verify_machine import NOTHING
from verify_numbers import (
    ONE,
    NotCovered,
    Number,
    Place,
    Unreadable,
    pointer,
    read,
    real,
)

_ROOM = real(NOTHING)
#: kind of claim, where it stands, the room that is left (None: not covered), and what it is a share of
Claim = Tuple[str, Place, Optional[Number], Number]
Claims = Generator[Claim, None, Any]
#: no claim, but what one was proven by: with other numbers it may prove as much; or words about it
EVIDENCE = "evidence"
#: sizes whose shares are told in doubles
SMALL, LARGE = 1e-100, 1e100
VERDICTS = ("held", "not covered", "broken")
#: exit codes of the verdicts; 2 is for what cannot be read
CODES = {"held": 0, "broken": 1, "not covered": 3}


def near(claim: str, place: Place, figure: Number, size: Optional[Number] = None) -> Claim:
    """A figure lies where it has to; of a size, if not its own."""
    if not place:
        return claim, place, None, ONE
    off = place.number() - figure
    if -off.low < off.high:
        off = -off
    return claim, place, off + _ROOM, abs(figure) if size is None else size


def figure(claim: str, place: Place, number: Number, size: Optional[Number] = None) -> Claim:
    """The same of a figure that has to be there."""
    return near(claim, place, number, size) if place else (claim, place, -ONE, ONE)


def same(claim: str, place: Place, value: Any) -> Claim:
    """A text, a number that is counted, or nothing, is what it has to be."""
    there = place.value if isinstance(place.value, (str, bool, int, float, type(None))) else [place.value]
    return claim, place, ONE if there == value else -ONE, ONE


def is_contradiction(room: Number) -> bool:
    """Whether a claim with this room left is broken: not even its largest reading leaves any."""
    return room.high < 0


def judged(claims: Iterable[Claim], answer: Place) -> Dict[str, Any]:
    """What becomes of every kind of claim, of several of one kind the worst, of every leaf, and the verdict.

    Raises
    ------
    Unreadable
        where a leaf of the answer is no finite number.
    """
    kinds: Dict[str, Tuple[int, float, Dict[str, Any]]] = {}
    visits, evidence = set(), set()
    for claim, place, room, size in claims:
        if claim == EVIDENCE:
            evidence.add(place.path)
            continue
        share = None if room is None else _share(room, size)
        rank = 1 if room is None else 2 if is_contradiction(room) else 0
        if rank != 1:
            visits.add(place.path)
        elif not place and place.path[:1] == ("answer",):
            # nothing is claimed
            continue
        worse = rank, -(share or 0.0)
        if claim not in kinds or worse > kinds[claim][:2]:
            entry = {"claim": claim, "verdict": VERDICTS[rank], "margin": share, "where": pointer(place.path)}
            kinds[claim] = *worse, entry
    leaves = account(answer, visits, evidence)
    worst = max([rank for rank, _, _ in kinds.values()], default=1)
    rank = max(worst, 1 if leaves["not_covered"] else 0)
    return {"claims": [entry for _, _, entry in kinds.values()], **leaves, "verdict": VERDICTS[rank]}


def _share(room: Number, size: Number) -> float:
    """The room as a share of what it is a share of."""
    whole = float(size)
    if SMALL < whole < LARGE:
        return max(min(float(room) / whole, LARGE), -LARGE)
    return float(room / Number(size.high, size.high) if size.high > 0 else room)


def covered(claims: Iterator[Claim]) -> Iterator[Claim]:
    """The claims as far as what they stand on is known."""
    try:
        yield from claims
    except NotCovered as error:
        (place,) = error.args
        yield "request", place, None, ONE
    except Unreadable:
        raise
    except (ArithmeticError, ValueError):
        # beyond what doubles hold nothing is told
        yield "request", Place({}, "request"), None, ONE


def main(check: Callable[[Any, Any], Dict[str, Any]], usage: Optional[str], arguments: Sequence[str]) -> int:
    """Checks the two files that are named and prints what is found; returns the exit code."""
    if len(arguments) != 2:
        print(usage, file=sys.stderr)
        return 2
    try:
        report = check(*map(read, arguments))
    except (OSError, ValueError) as error:
        print(error, file=sys.stderr)
        return 2
    for claim in report["claims"]:
        margin = "" if claim["margin"] is None else f"{claim['margin']:.1e}"
        print(f"{claim['claim']:<18} {claim['verdict']:<12} {margin:>9}  {claim['where']}")
    for name in report["not_covered"]:
        print(f"{'':<18} {'not covered':<12} {'':>9}  {name}")
    print(f"{report['verdict']}: {report['checked']} of {report['leaves']} claims are checked")
    return CODES[report["verdict"]]
