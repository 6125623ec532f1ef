"""The answers and the fronts that the tests compute themselves go through the independent checker.

Which of them do, tests/verification/checking.py says. Rows of sweeps carry proofs only where a request
asks for them: tests/verification/test_many.py and tests/studies/sweep/test_proof.py do. What services answer is
computed in processes of their own.
"""

import importlib
from collections.abc import Callable
from functools import wraps
from typing import Any

from tests.verification.checking import require

_COMPUTED = {"optimizer.optimize": "optimize", "optimizer.studies.pareto.pareto": "pareto"}


def check_answers() -> None:
    """From now on; to be called before anything has taken the computations by name."""
    for module, name in _COMPUTED.items():
        home = importlib.import_module(module)
        setattr(home, name, _checked(getattr(home, name)))


def unchecked(compute: Callable[..., Any]) -> Callable[..., Any]:
    """For tests whose solver or whose bounds are wrong on purpose."""
    return getattr(compute, "__wrapped__", compute)


def _checked(compute: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(compute)
    def checked(request: Any, *more: Any, **named: Any) -> Any:
        answer = compute(request, *more, **named)
        require(request, answer)
        return answer

    return checked
