"""``python -m tests.verification.recorded``: writes down what the checker makes of answers that are kept in a file.

The answers are of every kind, in ``recorded.json.xz``, each with all of its claims: where, the room that is left, and
what that is a share of. A claim that becomes wider, narrower, or is no longer made, is seen by that. Where it is meant
to, the command writes the claims anew. With ``--answers`` it asks for the answers anew as well, which is needed only
where requests or answers have new fields that are to be looked at.
"""

import argparse
import json
import lzma
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

import pytest

from service.verification import checker
from tests.pairs.asking import body_of
from tests.verification.answers import answered, names, request_of
from tests.verification.kinds import SINGLE

FILE = Path(__file__).with_name("recorded.json.xz")

#: kinds beside those that are falsified, each of which costs no more than a hundredth of a second
_MORE: dict[str, tuple[str, ...]] = {
    "twin": ("cheaper choices", "few pieces", "few sizes", "holes", "part numbers", "few counterweights", "own masses",
             "all fixed", "overspeed and bolts", "least mass false", "tolerances of 0", "no rods", "parts",
             "offset row", "no counterweights", "largest mass of 0", "thin sector", "webs in the reference plane",
             "unbalances", "reference plane", "force ceiling of 0", "balance shaft forwards"),
    "scroll": ("budget", "tolerances of masses and angles", "fixed", "balance quality"),
}  # fmt: skip
#: kinds of the table whose lines others run too
_ALIKE = ("indicated pressure", "bearings, specific", "continuous shaft")
#: of such kinds so many others are made up
_VARIANTS = 3
#: share of the numbers that are others, and characters of an answer of which others are made up
_OTHERS, _SHORT = 0.15, 12_000

#: claim, where it stands, room (None where it is not covered), and size
Line = list[Any]


@cache
def records() -> dict[str, dict[str, Any]]:
    """Request, answer, and what is made of them, by the name of the kind."""
    found: dict[str, dict[str, Any]] = json.loads(lzma.decompress(FILE.read_bytes()))
    return found


def judgement(request: Any, answer: Any) -> dict[str, Any]:
    """All claims of an answer, and what is made of them."""
    tools, lines = checker(), []
    judged = tools.judged

    def noting(claims: Any, place: Any) -> Any:
        every = list(claims)
        for claim, where, room, size in every:
            lines.append([claim, "/".join(map(str, where.path)), *(_rounded(each) for each in (room, size))])
        return judged(iter(every), place)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(tools, "judged", noting)
        try:
            whole = tools.verify(request, answer)
        except tools.Unreadable as error:
            return {"claims": lines, "whole": {"unreadable": str(error)}}
    return {"claims": lines, "whole": {name: value for name, value in whole.items() if name != "claims"}}


def variant(number: int, request: Any, answer: Any) -> tuple[Any, Any]:
    """What somebody else might have sent: some numbers are a little or very different, or nothing at all.

    The first are of other answers alone, the last of other requests.
    """
    random = Random(number)

    def other(value: Any) -> Any:
        if isinstance(value, dict):
            return {name: other(each) for name, each in value.items()}
        if isinstance(value, list):
            return [other(each) for each in value]
        if not isinstance(value, float) or random.random() > _OTHERS:
            return value
        near = (value * (1.0 + share) for share in (1e-13, 1e-7, -1e-3, 2.0))
        return random.choice([*near, 0.0, 1.0, -value, None])

    return (request, other(answer)) if number < _VARIANTS - 1 else (other(request), answer)


def judgements(request: Any, answer: Any) -> list[dict[str, Any]]:
    """Of an answer, and of what is made up of it where that costs little."""
    other = range(_VARIANTS) if len(json.dumps(answer)) < _SHORT else ()
    return [judgement(request, answer), *(judgement(*variant(number, request, answer)) for number in other)]


def _rounded(number: Any) -> float | None:
    return None if number is None else float(f"{float(number):.4g}")


def main() -> None:
    """Writes the file."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--answers", action="store_true", help="ask for the answers anew")
    if parser.parse_args().answers:
        of_table = {name: _coarse(request_of(name)) for name in names() if name not in _ALIKE}
        bodies = SINGLE | of_table | _more()
        pairs = {name: {"request": body, "answer": answered(body)} for name, body in bodies.items()}
    else:
        pairs = {name: {part: one[part] for part in ("request", "answer")} for name, one in records().items()}
    found = {name: one | {"judgements": judgements(**one)} for name, one in pairs.items()}
    text = json.dumps(found, separators=(",", ":"))
    FILE.write_bytes(lzma.compress(text.encode(), preset=9 | lzma.PRESET_EXTREME))


def _more() -> dict[str, Any]:
    bodies = {f"{base}, {name}": body_of(base, (name,)) for base, each in _MORE.items() for name in each}
    assert all(body is not None for body in bodies.values())
    return bodies


def _coarse(body: dict[str, Any]) -> dict[str, Any]:
    """With few angles: what is checked at each is the same."""
    return body if {"base", "parts", "points"} & body.keys() else {**body, "angles": {"step_deg": 45.0}}


if __name__ == "__main__":
    main()
