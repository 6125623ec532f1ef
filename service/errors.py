"""One table from exceptions to problem details (RFC 9457); no route knows a status code."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from http import HTTPStatus
from typing import Any
from urllib.parse import quote

from fastapi import FastAPI
from fastapi.exceptions import RequestValidationError
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect, Request
from starlette.responses import Response

from optimizer.errors import MissingInput
from optimizer.rating.errors import OutOfRange
from schemas.base import FieldProblem
from schemas.problem import FieldError, Problem
from service.examples import UnknownExample
from service.readiness import NotReady
from service.request_body import BodyTooLarge, UnsupportedMedia
from service.validation import MAX_ERRORS, InvalidRequest, UnreadableJson, pointer

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


def _fields(title: str, problems: Sequence[FieldProblem], more: bool) -> Fault:
    if more:
        detail = f"More than {MAX_ERRORS} fields are wrong; the first are listed."
    else:
        detail = "1 field is wrong." if len(problems) == 1 else f"{len(problems)} fields are wrong."
    return Fault(422, title, detail, problems)


def _invalid(error: InvalidRequest) -> Fault:
    return _fields("Invalid request", error.problems, error.more)


def _not_computable(title: str) -> Callable[[MissingInput | OutOfRange], Fault]:
    return lambda error: _fields(title, error.problems[:MAX_ERRORS], len(error.problems) > MAX_ERRORS)


def _parameters(error: RequestValidationError) -> Fault:
    names = ", ".join(sorted({str(detail["loc"][-1]) for detail in error.errors()}))
    return Fault(422, "Invalid parameter", f"Wrong parameters of path or query: {names}.")


def _not_ready(error: NotReady) -> Fault:
    headers = {} if error.retry_after_s is None else {"Retry-After": str(error.retry_after_s)}
    return Fault(503, "Not ready", str(error), headers=headers)


_HTTP_DETAILS = {
    404: "There is nothing at this path.",
    405: "The path does not answer this method; the header Allow names those that it answers.",
}


def _http(error: HTTPException) -> Fault:
    title = HTTPStatus(error.status_code).phrase
    detail = _HTTP_DETAILS.get(error.status_code, f"{title}.")
    return Fault(error.status_code, title, detail, headers=error.headers or {})


def _fixed(status: int, title: str, detail: str | None = None) -> Callable[[Any], Fault]:
    return lambda error: Fault(status, title, str(error) if detail is None else detail)


FAULTS: Mapping[type[Exception], Callable[[Any], Fault]] = {
    UnreadableJson: lambda error: Fault(400, "Unreadable JSON", f"The body is not JSON: {error}."),
    ClientDisconnect: _fixed(400, "Incomplete request", "The body ended early."),
    UnknownExample: _fixed(404, "Unknown example", "There is no example of this name; GET /v1/examples lists them."),
    BodyTooLarge: _fixed(413, "Body too large"),
    UnsupportedMedia: _fixed(415, "Unsupported media type"),
    InvalidRequest: _invalid,
    MissingInput: _not_computable("Missing input"),
    OutOfRange: _not_computable("Out of range"),
    RequestValidationError: _parameters,
    NotReady: _not_ready,
    HTTPException: _http,
    Exception: _fixed(500, "Internal error", "The service failed; its log says why."),
}


def problem(fault: Fault, instance: str) -> Problem:
    """Problem details of a fault."""
    return Problem(
        type="/problems/" + fault.title.lower().replace(" ", "-"),
        title=fault.title,
        status=fault.status,
        detail=fault.detail,
        instance=quote(instance[:_LONGEST_PATH], errors="replace"),
        errors=tuple(FieldError(pointer=pointer(path), message=message) for path, message in fault.problems),
    )


def install(app: FastAPI) -> None:
    """Answer every exception of the table with problem details."""
    for kind, describe in FAULTS.items():
        app.add_exception_handler(kind, _handler(describe))


def _handler(describe: Callable[[Any], Fault]) -> Callable[[Request, Exception], Any]:
    async def handle(request: Request, error: Exception) -> Response:
        fault = describe(error)
        content = problem(fault, request.scope["path"]).model_dump_json()
        return Response(content, fault.status, fault.headers, PROBLEM_JSON)

    return handle
