"""How a request becomes a job: its headers, and the response with the state of the job."""

import re

from starlette.requests import Request
from starlette.responses import Response

from service.common.headers import header, header_list
from service.guard.keys import caller_of
from service.guard.refusals import BadHeader
from service.jobs.job import Job
from service.jobs.owner_jobs import OwnerJobs

_KEY = re.compile(r"[\x21-\x7e]{1,255}")
_PREFERS = re.compile(r"(?:^|[,;])\s*respond-async\s*(?:$|[,;])", re.IGNORECASE)


def desk_of(request: Request) -> OwnerJobs:
    """The jobs that belong to whoever asks."""
    caller = caller_of(request)
    desk: OwnerJobs = request.app.state.desk.of(caller.owner, sees_all=caller.may("admin"))
    return desk


def prefix(request: Request) -> str:
    """The path that a proxy in front strips."""
    return str(request.scope.get("root_path", ""))


def idempotency_key(request: Request) -> str | None:
    """The key that makes a repeated POST the same one.

    Raises
    ------
    BadHeader
    """
    key = header(request.scope, b"idempotency-key")
    if key is not None and _KEY.fullmatch(key) is None:
        raise BadHeader("Idempotency-Key must be 1 to 255 visible ASCII characters.")
    return key


def prefers_later(request: Request) -> bool:
    """Whether the client wants to be answered later (RFC 7240)."""
    return _PREFERS.search(header_list(request.scope, b"prefer")) is not None


def accepted(request: Request, job: Job, new: bool) -> Response:
    """The state of a job that was taken in, and where it is; the status shows whether the job is new."""
    state = desk_of(request).state(job, prefix(request))
    headers = {"Location": state.links.self, "Cache-Control": "no-store"}
    if prefers_later(request):
        headers["Preference-Applied"] = "respond-async"
    if not new:
        headers["Idempotency-Replayed"] = "true"
    return Response(state.model_dump_json(), 202, headers, "application/json")
