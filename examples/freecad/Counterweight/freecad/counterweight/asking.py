"""One question to the service; whatever goes wrong is said at the cell that it concerns. No CAD."""

from __future__ import annotations

import os
from typing import Any, Dict, List

from .service import Refused, Service
from .sheets import SheetRequest, Wrong

#: environment variable of the API key; it is never stored
KEY = "COUNTERWEIGHT_KEY"

#: environment variable: 1 to go on where the shaft cannot be one
_FORCE = "COUNTERWEIGHT_FORCE"


def forced() -> bool:
    """Whether to go on where the shaft cannot be one; what comes of it says so."""
    return os.environ.get(_FORCE) == "1"


def service_at(url: str, key: str | None = None) -> Service:
    """The service; its key from the environment if none is given."""
    return Service(url, key or os.environ.get(KEY), patience_s=20.0)


def ask(service: Service, question: SheetRequest) -> Dict[str, Any]:
    """The answer, with counterweights.

    Raises
    ------
    Wrong
    """
    try:
        answer = service.optimize(question.body)
    except Refused as refused:
        lines = [f"{question.where(pointer)}: {message}" for pointer, message in refused.fields.items()]
        raise Wrong(lines or [str(refused)]) from None
    except (OSError, ValueError) as error:
        raise unanswered(service, error) from None
    if answer["status"] == "infeasible":
        raise Wrong(["no counterweights within the limits keep what is asked for: allow more, or ask for less"])
    return answer


def unanswered(service: Service, error: Exception) -> Wrong:
    """Nobody answers, or not as the service does: where it was asked for, and where that is set."""
    line = (
        f"the service at {service.url} does not answer: {error}. Its address is set under Preferences, Counterweight."
    )
    return Wrong([line])


def warnings(answer: Dict[str, Any], question: SheetRequest) -> List[str]:
    """What the service adds to its answer, at the cells that it concerns."""
    return [
        f"Warning: {question.where(warning['pointer'] or '')}: {warning['message']}" for warning in answer["warnings"]
    ]
