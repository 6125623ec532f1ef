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

from optimizer.errors import MissingInput, NotComputable, OutOfRange
from schemas.base import FieldProblem
from schemas.problem import FieldError, Problem
from service.documents.examples import UnknownExample
from service.guard.rates import TooManyRequests
from service.guard.refusals import BadHeader, Forbidden, ForeignHost, TooManyConnections, Unauthorized
from service.guard.shares import OverShare
from service.http.accept import NotAcceptable
from service.http.computing import ComputationFailed
from service.http.leaving import ClientGone
from service.http.request_body import BodyTooLarge, BodyTooSlow, UnsupportedMedia
from service.jobs.database import DatabaseUnavailable
from service.jobs.files import FilesUnavailable
from service.jobs.owner_jobs import NotFinished, RowsDamaged
from service.jobs.results import UnknownColumn
from service.jobs.rows import UnknownJob
from service.jobs.schema import WrongSchema
from service.jobs.store import KeyReused, QuotaExceeded, TooManyJobs
from service.jobs.worksheet import TooLargeForWorksheet
from service.validation import MAX_ERRORS, InvalidRequest, UnreadableBody, UnreadableJson, pointer
from service.watch.readiness import NotReady
from service.workers.pool import Busy, TooSlow, WorkerDied
from service.workers.process import WorkersFailed
from service.workers.worker import NoRoom, OutOfMemory

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


def _not_computable(title: str) -> Callable[[NotComputable], Fault]:
    return lambda error: _fields(title, error.problems[:MAX_ERRORS], len(error.problems) > MAX_ERRORS)


def _parameters(error: RequestValidationError) -> Fault:
    names = ", ".join(sorted({str(detail["loc"][-1]) for detail in error.errors()}))
    return Fault(422, "Invalid parameter", f"Wrong parameters of path or query: {names}.")


def _not_ready(error: NotReady) -> Fault:
    headers = {} if error.retry_after_s is None else {"Retry-After": str(error.retry_after_s)}
    return Fault(503, "Not ready", str(error), headers=headers)


def _not_finished(error: NotFinished) -> Fault:
    return Fault(409, "Not finished", str(error), headers={"Retry-After": "1"} if error.retry else {})


def _later(status: int, title: str, retry_after_s: int) -> Callable[[Exception], Fault]:
    return lambda error: Fault(status, title, str(error), headers={"Retry-After": str(retry_after_s)})


def _database(error: DatabaseUnavailable) -> Fault:
    # where it is, and as whom it was asked, is for the log
    what = "has no room left" if error.full else "is locked, or does not answer"
    return Fault(
        503, "Database unavailable", f"The job database {what}; try again later.", headers={"Retry-After": "5"}
    )


def _too_many(title: str) -> Callable[[Busy | TooManyRequests], Fault]:
    return lambda error: Fault(429, title, str(error), headers={"Retry-After": str(error.retry_after_s)})


def _unauthorized(error: Unauthorized) -> Fault:
    # RFC 6750: an error is named only if a key was given
    challenge = 'Bearer realm="counterweight"' + (', error="invalid_token"' if error.wrong else "")
    return Fault(401, "Unauthorized", str(error), headers={"WWW-Authenticate": challenge})


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


_internal = _fixed(500, "Internal error", "The service failed; its log says why.")

FAULTS: Mapping[type[Exception], Callable[[Any], Fault]] = {
    UnreadableJson: lambda error: Fault(400, "Unreadable JSON", f"The body is not JSON: {error}."),
    UnreadableBody: lambda error: Fault(400, "Unreadable body", f"The body is no workbook: {error}."),
    ClientDisconnect: _fixed(400, "Incomplete request", "The body ended early."),
    NotAcceptable: _fixed(406, "Not acceptable"),
    BodyTooSlow: _fixed(408, "Body too slow"),
    # nobody reads this but the log and the metrics; the number is that of nginx
    ClientGone: _fixed(499, "Client gone", "The client closed its connection."),
    Unauthorized: _unauthorized,
    Forbidden: _fixed(403, "Forbidden"),
    ForeignHost: _fixed(421, "Misdirected request"),
    TooManyRequests: _too_many("Too many requests"),
    TooManyConnections: _later(503, "Too many connections", 1),
    Busy: _too_many("Busy"),
    OverShare: _later(429, "Over share", 1),
    TooSlow: _later(503, "Too slow", 5),
    WorkerDied: _later(503, "Worker died", 1),
    WorkersFailed: _later(503, "Workers failed", 5),
    NoRoom: _later(503, "No room", 30),
    OutOfMemory: _fixed(422, "Out of memory"),
    UnknownExample: _fixed(404, "Unknown example", "There is no example of this name; GET /v1/examples lists them."),
    UnknownJob: _fixed(404, "Unknown sweep", "There is no sweep of this id, or its results have expired."),
    KeyReused: _fixed(409, "Key reused"),
    NotFinished: _not_finished,
    BadHeader: _fixed(422, "Invalid header"),
    UnknownColumn: _fixed(422, "Unknown column"),
    TooLargeForWorksheet: _fixed(422, "Too large for a worksheet"),
    TooManyJobs: _later(429, "Too many jobs", 30),
    QuotaExceeded: _fixed(409, "Quota exceeded"),
    DatabaseUnavailable: _database,
    WrongSchema: _fixed(503, "Wrong schema"),
    FilesUnavailable: _later(503, "Files unavailable", 5),
    RowsDamaged: _later(503, "Rows damaged", 2),
    BodyTooLarge: _fixed(413, "Body too large"),
    UnsupportedMedia: _fixed(415, "Unsupported media type"),
    InvalidRequest: _invalid,
    MissingInput: _not_computable("Missing input"),
    OutOfRange: _not_computable("Out of range"),
    RequestValidationError: _parameters,
    NotReady: _not_ready,
    HTTPException: _http,
    ComputationFailed: _internal,
    Exception: _internal,
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


def fault(error: Exception) -> Fault:
    """What is said about an exception."""
    return next(FAULTS[kind] for kind in type(error).__mro__ if kind in FAULTS)(error)


def answered(error: Exception, path: str) -> Response:
    """The problem details of an exception as an answer to a request for a path."""
    said = fault(error)
    return Response(problem(said, path).model_dump_json(), said.status, said.headers, PROBLEM_JSON)


def install(app: FastAPI) -> None:
    """Answer every exception of the table with problem details."""

    async def handle(request: Request, error: Exception) -> Response:
        return answered(error, request.scope["path"])

    for kind in FAULTS:
        app.add_exception_handler(kind, handle)
