"""The body of a request, up to a size and for a time."""

import asyncio
import re

from starlette.requests import ClientDisconnect, Request

from service.common.headers import header
from service.fairness.quotas import Holding
from service.wire.leaving import client_of

_TOKEN = r"[!#$%&'*+.^_`|~0-9A-Za-z-]+"
#: RFC 9110, 8.3.1 and 5.6.6; a parameter may be empty
_MEDIA_TYPE = re.compile(rf"[ \t]*({_TOKEN}/{_TOKEN})[ \t]*((?:;.*)?)")
_PARAMETER = re.compile(rf';[ \t]*(?:({_TOKEN})=({_TOKEN}|"(?:[^"\\]|\\.)*"))?[ \t]*')
_UTF_8 = (("charset", "utf-8"), ("charset", "utf8"))


class UnsupportedMedia(ValueError):
    """The body is not announced as something that is read here."""


class BodyTooLarge(ValueError):
    """The body is larger than the service takes."""


class BodyTooSlow(Exception):
    """The body did not arrive in time."""


async def read_body(request: Request, max_bytes: int, timeout_s: float, holding: Holding) -> bytes:
    """The body, whether its length was announced or not; what has come of it is counted for its client.

    Raises
    ------
    BodyTooLarge
        if it is, or says it is, larger than ``max_bytes``.
    BodyTooSlow
        if it takes longer than ``timeout_s`` [s].
    OverShare
        if the client holds as many bytes of bodies as it may.
    ClientDisconnect
        if it ends early.
    """
    # counted here and not by the framework, which answers an oversized Content-Length in plain text
    announced = header(request.scope, b"content-length") or ""
    if announced.isdecimal() and (len(announced) > 18 or int(announced) > max_bytes):
        raise _too_large(max_bytes)
    client = client_of(request)
    if client is not None and client.sent_all:
        # what has come needs no timer
        return await _received(request, max_bytes, holding)
    try:
        async with asyncio.timeout(timeout_s):
            return await _received(request, max_bytes, holding)
    except TimeoutError:
        raise BodyTooSlow(f"The body did not arrive within {timeout_s:g} s.") from None


async def _received(request: Request, max_bytes: int, holding: Holding) -> bytes:
    pieces, size, more = [], 0, True
    while more:
        message = await request.receive()
        if message["type"] == "http.disconnect":
            raise ClientDisconnect
        piece, more = message.get("body", b""), message.get("more_body", False)
        size += len(piece)
        if size > max_bytes:
            raise _too_large(max_bytes)
        holding.take("bodies", len(piece))
        pieces.append(piece)
    return b"".join(pieces)


def _too_large(max_bytes: int) -> BodyTooLarge:
    return BodyTooLarge(f"The body is larger than {max_bytes} bytes.")


def announced(request: Request, alternative: str | None = None) -> str:
    """The announced content: ``application/json``, also for ``application/*+json``, or another media type.

    Parameters
    ----------
    alternative : that is read too, if any.

    Raises
    ------
    UnsupportedMedia
        if it is anything else, nothing was announced, it is compressed, or JSON in another code than UTF-8.
    """
    kind, parameters = _media_type(header(request.scope, b"content-type") or "")
    coding = header(request.scope, b"content-encoding")
    if coding is not None and coding.strip().lower() != "identity":
        raise UnsupportedMedia("Send the body uncompressed.")
    if alternative is not None and kind == alternative:
        return alternative
    if not (kind == "application/json" or (kind.startswith("application/") and kind.endswith("+json"))):
        choices = "application/json" + ("" if alternative is None else f" or {alternative}")
        raise UnsupportedMedia(f"Send the body as Content-Type: {choices}.")
    # charset* and charset*0 are forms of mail, which HTTP does not have here
    if any(name.startswith("charset") and (name, value) not in _UTF_8 for name, value in parameters):
        raise UnsupportedMedia("Send the body in UTF-8.")
    return "application/json"


def _media_type(announced: str) -> tuple[str, list[tuple[str, str]]]:
    """Kind and parameters of a ``Content-Type`` in small letters; an empty kind if it is none."""
    match = _MEDIA_TYPE.fullmatch(announced)
    if match is None:
        return "", []
    parameters, end = [], 0
    for parameter in _PARAMETER.finditer(match[2]):
        if parameter.start() != end:
            break
        end = parameter.end()
        if parameter[1]:
            parameters.append((parameter[1].lower(), parameter[2].strip('"').lower()))
    return (match[1].lower(), parameters) if end == len(match[2]) else ("", [])
