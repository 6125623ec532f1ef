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
from typing import Any

import pytest

from service.verification import checker
from tests.verification.answers import answered, names, request_of
from tests.verification.kinds import SINGLE

FILE = Path(__file__).with_name("recorded.json.xz")

#: claim, where it stands, room (None where it is not covered), and size
Line = list[Any]


@cache
def records() -> dict[str, dict[str, Any]]:
    """Request, answer, claims, and what is made of them all, by the name of the kind."""
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
        whole = tools.verify(request, answer)
    return {"claims": lines, "whole": {name: value for name, value in whole.items() if name != "claims"}}


def _rounded(number: Any) -> float | None:
    return None if number is None else float(f"{float(number):.4g}")


def main() -> None:
    """Writes the file."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--answers", action="store_true", help="ask for the answers anew")
    if parser.parse_args().answers:
        bodies = SINGLE | {name: _coarse(request_of(name)) for name in names()}
        pairs = {name: {"request": body, "answer": answered(body)} for name, body in bodies.items()}
    else:
        pairs = {name: {part: one[part] for part in ("request", "answer")} for name, one in records().items()}
    found = {name: one | judgement(one["request"], one["answer"]) for name, one in pairs.items()}
    text = json.dumps(found, separators=(",", ":"))
    FILE.write_bytes(lzma.compress(text.encode(), preset=9))


def _coarse(body: dict[str, Any]) -> dict[str, Any]:
    """With few angles: what is checked at each is the same."""
    return body if {"base", "parts", "points"} & body.keys() else {**body, "angles": {"step_deg": 45.0}}


if __name__ == "__main__":
    main()
