"""What is said to whom the guard refuses."""

from service.common.problems import Fault, FaultTable, fixed
from service.guard.rates import TooManyRequests
from service.guard.refusals import BadHeader, Forbidden, ForeignHost, Unauthorized


def _unauthorized(error: Unauthorized) -> Fault:
    # RFC 6750: an error is named only in answer to a key
    challenge = 'Bearer realm="counterweight"' + (', error="invalid_token"' if error.wrong else "")
    return Fault(401, "Unauthorized", str(error), headers={"WWW-Authenticate": challenge})


def _too_many(error: TooManyRequests) -> Fault:
    again = {"Retry-After": str(error.rate.reset_s), **error.rate.headers}
    return Fault(429, "Too many requests", str(error), headers=again)


FAULTS: FaultTable = {
    Unauthorized: _unauthorized,
    Forbidden: fixed(403, "Forbidden"),
    ForeignHost: fixed(421, "Misdirected request"),
    TooManyRequests: _too_many,
    BadHeader: fixed(422, "Invalid header"),
}
