"""The problems that the tables of faults describe."""

from typing import Any

from service.app import FAULTS
from service.common.problems import problem
from service.guard.rates import Rate, parsed


def emitted() -> set[tuple[int, str]]:
    """Status and kind of all problems of the tables, by describing an exception of each type."""
    names = set()
    limit = parsed("3/minute")
    assert limit is not None
    rate = Rate("key", limit, 0, 1)
    for kind, describe in FAULTS.items():
        error = kind.__new__(kind)
        anything: dict[str, Any] = {
            "problems": (),
            "more": False,
            "wrong": False,
            "retry": True,
            "retry_after_s": 1,
            "full": False,
        }
        vars(error).update(anything, status_code=404, detail="", headers=None, _errors=(), rate=rate)
        program = problem(describe(error), "")
        names.add((program.status, program.type.removeprefix("/problems/")))
    return names
