"""The answers and the fronts that the tests compute themselves go through the independent checker.

Of every test the first ones do, and of many a tenth: the checker takes four times as long as an ordinary answer. Where
the variable CHECKED_ANSWERS is `every`, as at night, all of them do. Rows of sweeps carry proofs only where a request
asks for them: tests/verification/test_many.py and tests/studies/sweep/test_proof.py do. What services answer is
computed in processes of their own.
"""

import importlib
import json
import os
from collections.abc import Callable
from functools import wraps
from typing import Any

from tests.verification.checking import broken

_COMPUTED = {"optimizer.optimize": "optimize", "optimizer.studies.pareto.pareto": "pareto"}
#: of a test, so many answers are checked whatever there are, then one of so many
_FIRST, _STEP = 2, 10


class Spread:
    """Which answers of a test are checked: by their number, so that a run that failed fails again."""

    def __init__(self, every: bool) -> None:
        self._every = every
        self._test: str | None = None
        self._count = 0

    def __call__(self, test: str | None) -> bool:
        """Whether the next answer of a test is checked."""
        if test != self._test:
            self._test, self._count = test, 0
        self._count += 1
        return self._every or self._count <= _FIRST or self._count % _STEP == 0


def check_answers() -> None:
    """From now on; to be called before anything has taken the computations by name."""
    spread = Spread(os.environ.get("CHECKED_ANSWERS") == "every")
    for module, name in _COMPUTED.items():
        home = importlib.import_module(module)
        setattr(home, name, _checked(getattr(home, name), spread))


def unchecked(compute: Callable[..., Any]) -> Callable[..., Any]:
    """For tests whose solver or whose bounds are wrong on purpose."""
    return getattr(compute, "__wrapped__", compute)


def _checked(compute: Callable[..., Any], spread: Spread) -> Callable[..., Any]:
    @wraps(compute)
    def checked(request: Any, *more: Any) -> Any:
        answer = compute(request, *more)
        # the name of the test, and of its phase
        if spread(os.environ.get("PYTEST_CURRENT_TEST")):
            # a dictionary is what a request was made of
            sent = request if isinstance(request, dict) else json.loads(request.model_dump_json())
            found = broken(sent, json.loads(answer.model_dump_json()))
            assert not found, "\n".join([*found, json.dumps(sent)])
        return answer

    return checked
