"""What is said about an exception, and the problem details (RFC 9457) that say it.

Each room declares its faults in a table beside its exceptions; the application joins the tables.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any
from urllib.parse import quote

from schemas.answer.problem import FieldError, Problem
from schemas.base.model import FieldProblem
from schemas.base.target import pointer

PROBLEM_JSON = "application/problem+json"
_LONGEST_PATH = 200


@dataclass(frozen=True)
class Fault:
    """What is said about an exception."""

    status: int
    title: str
    detail: str
    problems: Sequence[FieldProblem] = ()
    headers: Mapping[str, str] = field(default_factory=dict)


#: what is said about exceptions, by their types
FaultTable = Mapping[type[Exception], Callable[[Any], Fault]]


def fixed(status: int, title: str, detail: str | None = None) -> Callable[[Exception], Fault]:
    """A fault that a retry does not mend; its message is the default detail."""
    return lambda error: Fault(status, title, str(error) if detail is None else detail)


def later(status: int, title: str, retry_after_s: int) -> Callable[[Exception], Fault]:
    """A fault that a retry may mend after some time [s]."""
    return lambda error: Fault(status, title, str(error), headers=_retry(retry_after_s))


def later_by_error(status: int, title: str) -> Callable[[Any], Fault]:
    """A fault whose ``retry_after_s`` says when a retry may mend it [s], or None that it does not."""
    return lambda error: Fault(status, title, str(error), headers=_retry(error.retry_after_s))


def _retry(after_s: int | None) -> Mapping[str, str]:
    return {} if after_s is None else {"Retry-After": str(after_s)}


def problem(fault: Fault, instance: str) -> Problem:
    """Problem details of a fault."""
    return Problem(
        type="/problems/" + fault.title.lower().replace(" ", "-"),
        title=fault.title,
        status=fault.status,
        detail=_whole(fault.detail),
        instance=quote(instance[:_LONGEST_PATH], errors="replace"),
        errors=tuple(
            FieldError(pointer=_whole(pointer(path)), message=_whole(message)) for path, message in fault.problems
        ),
    )


def _whole(text: str) -> str:
    """The text without halves of surrogate pairs, which JSON may have brought along and no answer can carry."""
    return text.encode("utf-8", "replace").decode()
