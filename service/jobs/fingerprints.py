"""What makes two requests with one idempotency key the same: what their clients sent."""

import hashlib
import json

from service.jobs.job import Order

#: how a fingerprint is made. The column takes 64 characters, so 62 digits of the digest are left
_SCHEME = "2:"
_DIGITS = 62


def fingerprint(kind: str, sent: bytes) -> str:
    """The fingerprint of a body that was read and checked.

    It knows the JSON as it was sent. Defaults do not count, as another version may have more. Nor do white space,
    the order of fields, and the ways to write a number.
    """
    body = json.loads(sent.decode("utf-8-sig"), parse_float=_number)
    text = json.dumps([kind, body], sort_keys=True, separators=(",", ":"))
    return _SCHEME + hashlib.sha256(text.encode()).hexdigest()[:_DIGITS]


def _number(text: str) -> int | float:
    number = float(text)
    return int(number) if number.is_integer() else number


def same(order: Order, earlier: str, request: bytes) -> bool:
    """Whether a job that has a fingerprint and a request is the one that is ordered.

    Fingerprints of earlier versions hold the defaults that there were then. In their place the stored request, in which
    all of these stand, is read as one of today.
    """
    if earlier.startswith(_SCHEME):
        return earlier == order.fingerprint
    return _read_again(order.kind, request) == json.loads(order.request)


def _read_again(kind: str, request: bytes) -> object:
    """All that a stored request says today, with today's defaults; None if it says nothing any more."""
    from schemas.sweep.request import SweepRequest
    from service.common.validation import InvalidRequest, check
    from service.computations.table import COMPUTATIONS

    model = SweepRequest if kind == "sweep" else COMPUTATIONS[kind].request_model
    try:
        return json.loads(check(model, json.loads(request)).model_dump_json())
    except InvalidRequest:
        return None
