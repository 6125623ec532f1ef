"""The body of a request, up to a size and for a time."""

from email.message import Message

from anyio import fail_after
from starlette.requests import Request


class UnsupportedMedia(ValueError):
    """The body is not announced as JSON in UTF-8."""


class BodyTooLarge(ValueError):
    """The body is larger than the service takes."""


class BodyTooSlow(Exception):
    """The body did not arrive in time."""


async def read_body(request: Request, max_bytes: int, timeout_s: float) -> bytes:
    """The body, whether its length was announced or not.

    Raises
    ------
    UnsupportedMedia
        if the content is not announced as uncompressed JSON in UTF-8.
    BodyTooLarge
        if it is, or says it is, larger than ``max_bytes``.
    BodyTooSlow
        if it takes longer than ``timeout_s`` [s].
    ClientDisconnect
        if it ends early.
    """
    require_json(request)
    # counted here and not by the framework, which answers an oversized Content-Length in plain text
    announced = request.headers.get("content-length", "")
    too_large = BodyTooLarge(f"The body is larger than {max_bytes} bytes.")
    if announced.isdecimal() and (len(announced) > 18 or int(announced) > max_bytes):
        raise too_large
    body = bytearray()
    try:
        with fail_after(timeout_s):
            async for chunk in request.stream():
                body += chunk
                if len(body) > max_bytes:
                    raise too_large
    except TimeoutError:
        raise BodyTooSlow(f"The body did not arrive within {timeout_s:g} s.") from None
    return bytes(body)


def require_json(request: Request) -> None:
    """Check the announced content: ``application/json`` or ``application/*+json``, UTF-8, not compressed.

    Raises
    ------
    UnsupportedMedia
        if it is anything else, or nothing was announced.
    """
    announced = Message()
    announced["content-type"] = request.headers.get("content-type", "text/plain")
    kind = announced.get_content_type()
    if not (kind == "application/json" or (kind.startswith("application/") and kind.endswith("+json"))):
        raise UnsupportedMedia("Send the body as Content-Type: application/json.")
    if (announced.get_content_charset("utf-8")) not in ("utf-8", "utf8"):
        raise UnsupportedMedia("Send the body in UTF-8.")
    if request.headers.get("content-encoding", "identity").strip().lower() != "identity":
        raise UnsupportedMedia("Send the body uncompressed.")
