"""Every single answer and every front that the tests compute themselves goes through the independent checker.

Rows of sweeps carry proofs only where a request asks for them: tests/verification/test_many.py and
tests/studies/sweep/test_proof.py do. What services answer is computed in processes of their own.
"""

import importlib
import json
from collections.abc import Callable
from functools import wraps
from typing import Any

from tests.verification.checking import broken

_COMPUTED = {"optimizer.optimize": "optimize", "optimizer.studies.pareto.pareto": "pareto"}


def check_every_answer() -> None:
    """From now on; to be called before anything has taken the computations by name."""
    for module, name in _COMPUTED.items():
        home = importlib.import_module(module)
        setattr(home, name, _checked(getattr(home, name)))


def _checked(compute: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(compute)
    def checked(request: Any, *more: Any) -> Any:
        answer = compute(request, *more)
        # a dictionary is what a request was made of
        sent = request if isinstance(request, dict) else json.loads(request.model_dump_json())
        found = broken(sent, json.loads(answer.model_dump_json()))
        assert not found, "\n".join([*found, json.dumps(sent)])
        return answer

    return checked
