"""What is said about requests that are none, about routes, and where nobody foresaw what happened."""

from collections.abc import Sequence
from errno import EMFILE, ENFILE
from http import HTTPStatus

from fastapi.exceptions import RequestValidationError
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect

from schemas.base.model import FieldProblem
from service.common.problems import Fault, FaultTable, fixed
from service.common.validation import message_of
from service.http.accept import NotAcceptable
from service.http.computing import ComputationFailed
from service.http.parameters import UnknownParameter
from service.http.request_body import BodyTooLarge, BodyTooSlow, UnsupportedMedia

_HTTP_DETAILS = {
    404: "There is nothing at this path.",
    405: "The path does not answer this method; the header Allow names those that it answers.",
}


def _http(error: HTTPException) -> Fault:
    title = HTTPStatus(error.status_code).phrase
    detail = _HTTP_DETAILS.get(error.status_code, f"{title}.")
    return Fault(error.status_code, title, detail, headers=error.headers or {})


def _parameters(error: RequestValidationError) -> Fault:
    problems = [FieldProblem(tuple(detail["loc"]), message_of(detail)) for detail in error.errors()]
    return _invalid_parameter([problem for problem in problems if len(problem.path) > 1])


def _invalid_parameter(problems: Sequence[FieldProblem]) -> Fault:
    names = ", ".join(sorted({str(problem.path[1]) for problem in problems}))
    return Fault(422, "Invalid parameter", f"Wrong parameters of path or query: {names}.", problems)


_internal = fixed(500, "Internal error", "The service failed; its log says why.")
_no_file = fixed(503, "No file left", "The service can open no file at the moment: ask again.")


def _unforeseen(error: Exception) -> Fault:
    """Whoever holds all files keeps a request from a file of its own: that is the load, and no failure."""
    without_files = isinstance(error, OSError) and error.errno in (EMFILE, ENFILE)
    return (_no_file if without_files else _internal)(error)


FAULTS: FaultTable = {
    ClientDisconnect: fixed(400, "Incomplete request", "The body ended early."),
    NotAcceptable: fixed(406, "Not acceptable"),
    BodyTooSlow: fixed(408, "Body too slow"),
    BodyTooLarge: fixed(413, "Body too large"),
    UnsupportedMedia: fixed(415, "Unsupported media type"),
    RequestValidationError: _parameters,
    UnknownParameter: lambda error: _invalid_parameter(error.problems),
    HTTPException: _http,
    ComputationFailed: _internal,
    Exception: _unforeseen,
}
