"""What crosses a boundary: frozen pydantic models with the unit of every field in its name.

Requests and answers stand here by name, docs/python.md shows them; each is loaded when it is first asked for.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from schemas.accuracy import AccuracyAnswer, AccuracyRequest
    from schemas.answers import AnalyzeAnswer, OptimizeAnswer
    from schemas.match import MatchRequest
    from schemas.match_answer import MatchAnswer
    from schemas.pareto import ParetoAnswer, ParetoRequest
    from schemas.rating import RatingRequest
    from schemas.rating_answer import RatingAnswer
    from schemas.reciprocating import ReciprocatingMachine
    from schemas.requests import AnalyzeRequest, OptimizeRequest
    from schemas.scroll import PinLoadsAnswer, PinLoadsRequest
    from schemas.scroll_machine import ScrollMachine
    from schemas.sweep import SweepRequest
    from schemas.verify import VerifyAnswer, VerifyRequest

__all__ = [
    "AccuracyAnswer",
    "AccuracyRequest",
    "AnalyzeAnswer",
    "AnalyzeRequest",
    "MatchAnswer",
    "MatchRequest",
    "OptimizeAnswer",
    "OptimizeRequest",
    "ParetoAnswer",
    "ParetoRequest",
    "PinLoadsAnswer",
    "PinLoadsRequest",
    "RatingAnswer",
    "RatingRequest",
    "ReciprocatingMachine",
    "ScrollMachine",
    "SweepRequest",
    "VerifyAnswer",
    "VerifyRequest",
]

_HOMES = {
    "AccuracyAnswer": "schemas.accuracy",
    "AccuracyRequest": "schemas.accuracy",
    "AnalyzeAnswer": "schemas.answers",
    "AnalyzeRequest": "schemas.requests",
    "MatchAnswer": "schemas.match_answer",
    "MatchRequest": "schemas.match",
    "OptimizeAnswer": "schemas.answers",
    "OptimizeRequest": "schemas.requests",
    "ParetoAnswer": "schemas.pareto",
    "ParetoRequest": "schemas.pareto",
    "PinLoadsAnswer": "schemas.scroll",
    "PinLoadsRequest": "schemas.scroll",
    "RatingAnswer": "schemas.rating_answer",
    "RatingRequest": "schemas.rating",
    "ReciprocatingMachine": "schemas.machine",
    "ScrollMachine": "schemas.machine",
    "SweepRequest": "schemas.sweep",
    "VerifyAnswer": "schemas.verify",
    "VerifyRequest": "schemas.verify",
}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)
