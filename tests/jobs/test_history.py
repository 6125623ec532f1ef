"""A few kills, and the judge of histories: it has to find what is wrong (histories and verdicts by hand)."""

from pathlib import Path
from typing import Any

import pytest

from tests.jobs import postgres
from tests.jobs.calls import Action, Call
from tests.jobs.history import run
from tests.jobs.judge import contradictions

JOB = "f" * 32


@pytest.mark.nightly
def test_kills_of_services_and_of_their_database(tmp_path: Path) -> None:
    # each of them once; three hundred, and 1,700 faults of the network: python -m tests.jobs.history
    try:
        texts, fields = run(tmp_path, kills=4, seed=60, most=3)
    except postgres.Missing as missing:
        pytest.skip(str(missing))
    assert texts == []
    assert fields["kills"] == {"one": 1, "two": 1, "three": 1, "database": 1}
    assert sum(fields["network"].values()) > 0  # type: ignore[attr-defined]
    assert fields["sweeps"] > 0  # type: ignore[operator]
    assert fields["rows_read"] >= 1500  # type: ignore[operator]


def call(action: Action, began: float, status: int | None = 200, state: str = "", count: int = 0, **more: Any) -> Call:
    """One of a second, about the sweep of all these histories."""
    about: dict[str, Any] = {
        "service": "one",
        "subject": {"submit": "key", "list": ""}.get(action, JOB),
        "ended": began + 1,
        "document": {"id": JOB, "state": state, "done": count} if state else None,
        "ids": frozenset([JOB] if state else []),
    }
    return Call(action=action, began=began, status=status, **{**about, **more})


SUBMITTED = call("submit", 0, 202, "queued")
CANCELLED = call("end", 10, 200, "cancelled", 4)
#: by what it shows: what follows upon the submission
WRONG: dict[str, list[Call]] = {
    "lost": [call("state", 2, 404)],
    "back after it was deleted": [CANCELLED, call("end", 12, 204), call("state", 14, 200, "queued")],
    "not in the list": [call("list", 2)],
    "in the list after": [CANCELLED, call("end", 12, 204), call("list", 14, ids=frozenset([JOB]))],
    "listed, and nobody's": [call("list", 2, ids=frozenset([JOB, "e" * 32]))],
    "key key: not one to one": [call("submit", 2, 202, "queued", ids=frozenset(["e" * 32]))],
    "sweep " + JOB: [call("submit", 2, 202, "queued", subject="another")],
    "done, then running": [call("state", 2, 200, "done", 9), call("state", 4, 200, "running", 9)],
    "done, then cancelled": [call("state", 2, 200, "done", 9), CANCELLED],
    "cancelled, then running": [CANCELLED, call("state", 12, 200, "running", 4)],
    "running, then queued": [call("state", 2, 200, "running"), call("state", 4, 200, "queued")],
    "cancelled by nobody": [call("state", 2, 200, "cancelled")],
    "5 rows, then 4": [call("state", 2, 200, "running", 5), call("state", 4, 200, "running", 4)],
    "2 rows are gone": [
        call("rows", 2, rows=frozenset([1, 2]), whole=True),
        call("rows", 4, rows=frozenset([3, 4]), whole=True),
    ],
    "500 while": [call("state", 2, 500)],
    "503 while the database was there": [call("state", 2, 503)],
    "not answered by a service that lived": [call("state", 2, None)],
    "state " + JOB + ": 409": [call("state", 2, 409)],
    "rows differ": [call("rows", 2, wrong="rows differ")],
}


@pytest.mark.parametrize("fault", WRONG)
def test_what_cannot_be_is_found(fault: str) -> None:
    actual_contradictions = contradictions([SUBMITTED, *WRONG[fault]], {})
    assert any(fault in actual_contradiction for actual_contradiction in actual_contradictions), actual_contradictions


def test_what_can_be_is_not_found() -> None:
    overlapping = {"ended": 30.0}
    calls = [
        SUBMITTED,
        # the same key again, and an answer that came late
        call("submit", 2, 202, "queued"),
        call("state", 3, 200, "queued", **overlapping),
        call("state", 4, 200, "running", 2),
        call("rows", 5, rows=frozenset([1, 2]), whole=True),
        call("rows", 6, rows=frozenset([3]), whole=False),
        # nobody knows whether it came through, nor the one who asks it to go on
        call("end", 8, None),
        CANCELLED,
        call("resume", 12, None),
        call("state", 14, 200, "running", 4),
        call("state", 16, 503),
        call("state", 18, 200, "done", 9),
        call("rows", 20, None, **overlapping),
        # the network lost its answer
        call("state", 20.5, None, cut=True),
        call("end", 22, 204, **overlapping),
        call("list", 23, ids=frozenset([JOB])),
        call("list", 31),
        call("state", 32, 404),
    ]
    outages = {"one": [(8.5, 8.6), (12.5, 12.6)], "database": [(16.9, 17.5)]}
    assert contradictions(calls, outages) == []
    # the same without the outages that explain it
    assert len(contradictions(calls, {})) == 3
