"""What crosses a boundary: frozen pydantic models with the unit of every field in its name.

Requests and answers stand here by name, docs/python.md shows them; each is loaded at its first use.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from schemas.answer.answers import AnalyzeAnswer, OptimizeAnswer
    from schemas.front.pareto import ParetoAnswer, ParetoRequest
    from schemas.machine.reciprocating import ReciprocatingMachine
    from schemas.machine.scroll_machine import ScrollMachine
    from schemas.match.answer import MatchAnswer
    from schemas.match.request import MatchRequest
    from schemas.rating.answer import RatingAnswer
    from schemas.rating.request import RatingRequest
    from schemas.request.accuracy import AccuracyAnswer, AccuracyRequest
    from schemas.request.requests import AnalyzeRequest, OptimizeRequest
    from schemas.request.rounding import RoundAnswer, RoundRequest
    from schemas.request.verify import VerifyAnswer, VerifyRequest
    from schemas.scroll.pin_loads import PinLoadsAnswer, PinLoadsRequest
    from schemas.sweep.request import SweepRequest

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
    "RoundAnswer",
    "RoundRequest",
    "ScrollMachine",
    "SweepRequest",
    "VerifyAnswer",
    "VerifyRequest",
]

_HOMES = {
    "AccuracyAnswer": "schemas.request.accuracy",
    "AccuracyRequest": "schemas.request.accuracy",
    "AnalyzeAnswer": "schemas.answer.answers",
    "AnalyzeRequest": "schemas.request.requests",
    "MatchAnswer": "schemas.match.answer",
    "MatchRequest": "schemas.match.request",
    "OptimizeAnswer": "schemas.answer.answers",
    "OptimizeRequest": "schemas.request.requests",
    "ParetoAnswer": "schemas.front.pareto",
    "ParetoRequest": "schemas.front.pareto",
    "PinLoadsAnswer": "schemas.scroll.pin_loads",
    "PinLoadsRequest": "schemas.scroll.pin_loads",
    "RatingAnswer": "schemas.rating.answer",
    "RatingRequest": "schemas.rating.request",
    "ReciprocatingMachine": "schemas.machine.reciprocating",
    "RoundAnswer": "schemas.request.rounding",
    "RoundRequest": "schemas.request.rounding",
    "ScrollMachine": "schemas.machine.scroll_machine",
    "SweepRequest": "schemas.sweep.request",
    "VerifyAnswer": "schemas.request.verify",
    "VerifyRequest": "schemas.request.verify",
}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)
