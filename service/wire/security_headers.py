"""Headers for browsers in every answer."""

from collections.abc import Awaitable
from functools import lru_cache

from starlette.types import ASGIApp, Message, Receive, Scope, Send

_HEADERS = (
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"cross-origin-opener-policy", b"same-origin"),
    (b"cross-origin-resource-policy", b"same-origin"),
    (b"permissions-policy", b"camera=(), geolocation=(), microphone=()"),
)
_POLICY = b"content-security-policy"
#: what is said of a page that some origins may show in a frame
_FRAMED = b"frame-ancestors http"
#: what is no page loads nothing; pages come with a policy of their own
_NO_PAGE = b"default-src 'none'; frame-ancestors 'none'"
_PAGE = b"default-src 'self'; img-src 'self' data:; frame-ancestors 'none'; base-uri 'none'; form-action 'self'"


class SecurityHeaders:
    """Adds the headers that an answer does not have yet.

    Parameters
    ----------
    hsts_s : for how long browsers shall insist on https [s]; 0 is not said.
    """

    def __init__(self, app: ASGIApp, hsts_s: int) -> None:
        self._app = app
        self._hsts_s = hsts_s

    # not a coroutine around others, nor is what it sends by: each costs as much as to look for a header
    def __call__(self, scope: Scope, receive: Receive, send: Send) -> Awaitable[None]:
        if scope["type"] != "http":
            return self._app(scope, receive, send)

        def add(message: Message) -> Awaitable[None]:
            if message["type"] == "http.response.start":
                # names are in small letters (ASGI)
                headers = message.get("headers", ())
                fields = dict(headers)
                page = fields.get(b"content-type", b"").startswith((b"text/html", b"image/svg"))
                additions = _additions(page, fields.get(_POLICY), self._hsts_s if scope.get("scheme") == "https" else 0)
                message["headers"] = [*headers, *[field for field in additions if field[0] not in fields]]
            return send(message)

        return self._app(scope, receive, add)


# policies are those of the service, which are few
@lru_cache(64)
def _additions(page: bool, policy: bytes | None, hsts_s: int) -> tuple[tuple[bytes, bytes], ...]:
    if policy is None:
        policy = _PAGE if page else _NO_PAGE
    additions = [*_HEADERS, (_POLICY, policy)]
    # the older header knows no other origins
    if _FRAMED not in policy:
        additions.append((b"x-frame-options", b"DENY"))
    if hsts_s:
        additions.append((b"strict-transport-security", b"max-age=%d; includeSubDomains" % hsts_s))
    return tuple(additions)
