"""What browsers are told about every answer."""

from starlette.datastructures import MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

_HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(), geolocation=(), microphone=()",
}
#: what is said of a page that some origins may show in a frame
_FRAMED = "frame-ancestors http"
#: what is no page loads nothing; pages come with a policy of their own
_NO_PAGE = "default-src 'none'; frame-ancestors 'none'"
_PAGE = "default-src 'self'; img-src 'self' data:; frame-ancestors 'none'; base-uri 'none'; form-action 'self'"


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
                headers = MutableHeaders(scope=message)
                for name, value in _HEADERS.items():
                    headers.setdefault(name, value)
                page = headers.get("content-type", "").startswith(("text/html", "image/svg"))
                headers.setdefault("Content-Security-Policy", _PAGE if page else _NO_PAGE)
                # the older header knows no other origins
                if _FRAMED not in headers["Content-Security-Policy"]:
                    headers.setdefault("X-Frame-Options", "DENY")
                if self._hsts_s and scope.get("scheme") == "https":
                    headers.setdefault("Strict-Transport-Security", f"max-age={self._hsts_s}; includeSubDomains")
            await send(message)

        await self._app(scope, receive, add)
