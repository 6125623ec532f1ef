"""What is said to whom the guard refuses."""

from service.common.problems import Fault, FaultTable, fixed, later_by_error
from service.guard.rates import TooManyRequests
from service.guard.refusals import BadHeader, Forbidden, ForeignHost, Unauthorized


def _unauthorized(error: Unauthorized) -> Fault:
    # RFC 6750: an error is named only if a key was given
    challenge = 'Bearer realm="counterweight"' + (', error="invalid_token"' if error.wrong else "")
    return Fault(401, "Unauthorized", str(error), headers={"WWW-Authenticate": challenge})


FAULTS: FaultTable = {
    Unauthorized: _unauthorized,
    Forbidden: fixed(403, "Forbidden"),
    ForeignHost: fixed(421, "Misdirected request"),
    TooManyRequests: later_by_error(429, "Too many requests"),
    BadHeader: fixed(422, "Invalid header"),
}
