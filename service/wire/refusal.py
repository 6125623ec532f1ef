"""Faults as answers: of a request, and as the last words of a connection."""

from functools import cache

import h11
from starlette.responses import Response

from service.common.problems import PROBLEM_JSON, Fault, problem
from service.fairness.faults import FAULTS, TooManyConnections


def response(fault: Fault, path: str) -> Response:
    """The problem details of a fault as an answer to a request for a path."""
    return Response(problem(fault, path).model_dump_json(), fault.status, fault.headers, PROBLEM_JSON)


def last_answer(connection: h11.Connection, fault: Fault) -> bytes:
    """An answer that is the last of its connection."""
    content = problem(fault, "").model_dump_json().encode()
    headers = [
        *((name.encode(), value.encode()) for name, value in fault.headers.items()),
        (b"content-type", PROBLEM_JSON.encode()),
        (b"content-length", str(len(content)).encode()),
        (b"connection", b"close"),
    ]
    events = (h11.Response(status_code=fault.status, headers=headers), h11.Data(data=content), h11.EndOfMessage())
    return b"".join(connection.send(event) or b"" for event in events)


def too_many_connections() -> Fault:
    """What is said where there is no room for a connection."""
    error = TooManyConnections()
    return FAULTS[type(error)](error)


@cache
def no_room() -> bytes:
    """The answer to a connection for which there is no room, made once: whoever comes too often gets it as often."""
    return last_answer(h11.Connection(h11.SERVER), too_many_connections())
