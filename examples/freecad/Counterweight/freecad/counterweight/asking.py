"""One question to the service; whatever goes wrong is said at the cell that it concerns. No CAD."""

from __future__ import annotations

import os
from typing import Any, Dict

from .service import Refused, Service
from .sheets import Asked, Wrong

#: environment variable of the API key; it is never stored
KEY = "COUNTERWEIGHT_KEY"


def service_at(url: str, key: str | None = None) -> Service:
    """The service; its key from the environment if none is given."""
    return Service(url, key or os.environ.get(KEY), patience_s=20.0)


def ask(service: Service, asked: Asked) -> Dict[str, Any]:
    """The answer, with counterweights.

    Raises
    ------
    Wrong
    """
    try:
        answer = service.optimize(asked.body)
    except Refused as refused:
        lines = [f"{asked.where(pointer)}: {message}" for pointer, message in refused.fields.items()]
        raise Wrong(lines or [str(refused)]) from None
    except (OSError, ValueError) as error:
        raise Wrong([f"the service does not answer: {error}"]) from None
    if answer["status"] == "infeasible":
        raise Wrong(["no counterweights within the limits keep what is asked for: allow more, or ask for less"])
    return answer
