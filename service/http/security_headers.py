"""What browsers are told about every answer."""

from collections.abc import Iterator

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

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return

        async def add(message: Message) -> None:
            if message["type"] == "http.response.start":
                # names are in small letters (ASGI)
                headers = message.get("headers", ())
                message["headers"] = [*headers, *self._missing(dict(headers), scope.get("scheme") == "https")]
            await send(message)

        await self._app(scope, receive, add)

    def _missing(self, headers: dict[bytes, bytes], https: bool) -> Iterator[tuple[bytes, bytes]]:
        page = headers.get(b"content-type", b"").startswith((b"text/html", b"image/svg"))
        policy = headers.get(_POLICY, _PAGE if page else _NO_PAGE)
        wanted = [*_HEADERS, (_POLICY, policy)]
        # the older header knows no other origins
        if _FRAMED not in policy:
            wanted.append((b"x-frame-options", b"DENY"))
        if self._hsts_s and https:
            wanted.append((b"strict-transport-security", b"max-age=%d; includeSubDomains" % self._hsts_s))
        return (each for each in wanted if each[0] not in headers)
