"""``python -m tests.verification.recorded``: writes down what the checker makes of answers that are kept in a file.

The answers are of every kind, in ``recorded.json.xz``, each with all of its claims: where, the room that is left, and
what that is a share of. A claim that becomes wider, narrower, or is no longer made, is seen by that. Where it is meant
to, the command writes the claims anew, and asks for what is not recorded yet. With ``--answers`` it asks for all
answers anew, which is needed only where requests or answers have new fields that are to be looked at.
"""

import argparse
import json
import lzma
from collections.abc import Iterator, Sequence
from functools import cache
from itertools import islice
from pathlib import Path
from random import Random
from typing import Any

import pytest

from service.verification import checker
from tests.pairs.asking import body_of
from tests.verification import combined
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
#: kinds of which nothing else is made up: each takes a tenth of a second or more
_DEAR = ("gas", "dynamics", "four strokes", "priorities", "priorities, masses off")
#: characters of an answer, above which so many others are made up
_SHORT, _OF_LONG = 12_000, 3
#: share of the numbers that are others
_OTHERS = 0.15

#: claim, where it stands, room (None where it is not covered), and size
Line = list[Any]


@cache
def records() -> dict[str, dict[str, Any]]:
    """Request, answer, and what is made of them, by the name of the kind."""
    document: dict[str, dict[str, Any]] = json.loads(lzma.decompress(FILE.read_bytes()))
    return document


def judgement(request: Any, answer: Any) -> dict[str, Any]:
    """All claims of an answer, and what is made of them."""
    tools, lines = checker(), []
    judged = tools.judged

    def noting(claims: Any, place: Any) -> Any:
        every = list(claims)
        for claim, where, room, size in every:
            lines.append([claim, "/".join(map(str, where.path)), *(_rounded(bound) for bound in (room, size))])
        return judged(iter(every), place)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(tools, "judged", noting)
        try:
            whole = tools.verify(request, answer)
        except tools.Unreadable as error:
            return {"claims": lines, "whole": {"unreadable": str(error)}}
    return {"claims": lines, "whole": {name: value for name, value in whole.items() if name != "claims"}}


def _with_new_numbers(value: Any, random: Random, numbers: Sequence[float | None]) -> Any:
    """Some numbers are a little or very different, or one of some others."""
    if isinstance(value, dict):
        return {name: _with_new_numbers(value, random, numbers) for name, value in value.items()}
    if isinstance(value, list):
        return [_with_new_numbers(value, random, numbers) for value in value]
    if not isinstance(value, float) or random.random() > _OTHERS:
        return value
    near = (value * (1.0 + share) for share in (1e-13, 1e-7, -1e-3, 2.0))
    return random.choice([*near, 0.0, 1.0, -value, *numbers])


def _with_another_form(value: Any, random: Random) -> Any:
    """One field is missing, empty, of another type, or there twice; deep inside as a rule."""
    if isinstance(value, dict | list) and value and random.random() < _DEEPER:
        key = random.choice([*value]) if isinstance(value, dict) else random.randrange(len(value))
        changed = _with_another_form(value[key], random)
        items = value.items() if isinstance(value, dict) else enumerate(value)
        if changed is _GONE:
            values = [(name, value) for name, value in items if name != key]
        elif changed is _TWICE:
            values = [*items, ("again", value[key])]
        else:
            values = [(name, changed if name == key else value) for name, value in items]
        return dict(values) if isinstance(value, dict) else [value for _, value in values]
    entries = [_GONE, _GONE, _TWICE, None, [], {}, "", "optimal", True, 0, 1, -1.0]
    if isinstance(value, bool):
        entries += 5 * [not value]
    elif isinstance(value, int | float):
        entries += 5 * [value + 1]
    return random.choice(entries)


#: chance to go one level deeper, and what is done with a field
_DEEPER, _GONE, _TWICE = 0.9, object(), object()


def variants(name: str, request: Any, answer: Any) -> Iterator[tuple[Any, Any]]:
    """What somebody else might have sent: other numbers, or another form."""
    random = Random(name)
    yield request, _with_new_numbers(answer, random, ())
    yield request, _with_another_form(answer, random)
    yield _with_new_numbers(request, random, (None,)), answer
    yield request, _with_another_form(answer, random)
    yield _with_another_form(request, random), answer


def submissions(name: str, request: Any, answer: Any) -> list[tuple[Any, Any]]:
    """An answer, and what is made up of it where that costs little; each with its request."""
    actual_variants = () if name in _DEAR else variants(name, request, answer)
    most = None if len(json.dumps(answer)) < _SHORT else _OF_LONG
    return [(request, answer), *islice(actual_variants, most)]


def _rounded(number: Any) -> float | None:
    return None if number is None else float(f"{float(number):.4g}")


def main() -> None:
    """Writes the file."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--answers", action="store_true", help="ask for the answers anew")
    actual_records = {} if parser.parse_args().answers else records()
    pairs = {
        name: actual_records[name] if name in actual_records else _exchange(body) for name, body in _bodies().items()
    }
    fields = {
        name: {
            **pair,
            "judgements": [judgement(*submission) for submission in submissions(name, pair["request"], pair["answer"])],
        }
        for name, pair in pairs.items()
    }
    text = json.dumps(fields, separators=(",", ":"))
    FILE.write_bytes(lzma.compress(text.encode(), preset=9 | lzma.PRESET_EXTREME))


def _bodies() -> dict[str, Any]:
    of_table = {name: _coarse(request_of(name)) for name in names() if name not in _ALIKE}
    return SINGLE | of_table | _more() | combined.bodies()


def _exchange(body: Any) -> dict[str, Any]:
    return {"request": json.loads(json.dumps(body)), "answer": answered(body)}


def _more() -> dict[str, Any]:
    bodies = {f"{base}, {name}": body_of(base, (name,)) for base, texts in _MORE.items() for name in texts}
    assert all(body is not None for body in bodies.values())
    return bodies


def _coarse(body: dict[str, Any]) -> dict[str, Any]:
    """With few angles: what is checked at each is the same."""
    return body if {"base", "parts", "points"} & body.keys() else {**body, "angles": {"step_deg": 45.0}}


if __name__ == "__main__":
    main()
