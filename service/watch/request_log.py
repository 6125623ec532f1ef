"""One line of the log, one count of the metrics and one span for every request."""

import logging
import os
import re
import time
from collections.abc import Awaitable, Callable
from typing import Any

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from service.common.addresses import address_of
from service.common.headers import header
from service.watch.logs import REQUEST
from service.watch.metrics import Metrics
from service.watch.tracing import Tracing

_LOG = logging.getLogger("service.requests")
_ID = re.compile(r"[A-Za-z0-9._-]{1,64}")
_TRACEPARENT = re.compile(r"[0-9a-f]{2}-(?!0{32})([0-9a-f]{32})-(?!0{16})[0-9a-f]{16}-[0-9a-f]{2}(?:-.*)?")
#: requests of monitors, every few seconds
_PROBES = frozenset({"/healthz", "/readyz", "/metrics"})
#: in the first bytes of problem details
_KIND = re.compile(rb'"type":"/problems/([a-z-]+)"')
#: as nginx says it
_GONE = 499
_LONGEST_PATH = 200
_LONGEST_BODY = 10_000


class RequestLog:
    """Gives every request an id, that of the client or a new one, and says what became of it.

    Parameters
    ----------
    template : the path of the route for a request that was refused before it came to one; None where there is none.
    bodies : whether the log quotes the bodies of requests.
    """

    def __init__(
        self, app: ASGIApp, metrics: Metrics, tracing: Tracing, template: Callable[[Scope], str | None], bodies: bool
    ) -> None:
        self._app = app
        self._metrics = metrics
        self._tracing = tracing
        self._template = template
        self._bodies = bodies

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        begun = time.perf_counter()
        client_id = header(scope, b"x-request-id") or ""
        # two at once: each costs a call of the system
        fresh = os.urandom(32).hex()
        request_id = client_id if _ID.fullmatch(client_id) else fresh[:32]
        traced = _TRACEPARENT.fullmatch(header(scope, b"traceparent") or "")
        method = "HEAD" if scope.get("head") else scope["method"]
        ids = {"request_id": request_id, "trace_id": traced[1] if traced else fresh[32:]}
        REQUEST.set(ids)
        status, refused, kind = 0, False, ""

        def note(message: Message) -> Awaitable[None]:
            nonlocal status, refused, kind
            if message["type"] == "http.response.start":
                status = message["status"]
                refused = status >= 400
                message["headers"] = [*message.get("headers", ()), (b"x-request-id", request_id.encode())]
            elif refused and not kind:
                match = _KIND.search(message.get("body", b"")[:_LONGEST_PATH])
                kind = match[1].decode() if match else "other"
            return send(message)

        with self._tracing.request(method, scope) as span:
            try:
                await self._app(scope, receive, note)
            except BaseException:
                status = status or 500
                raise
            finally:
                # a client without an answer has gone before
                status = status or _GONE
                route = self._route(scope)
                if kind:
                    self._metrics.refused(route, kind)
                seconds = time.perf_counter() - begun
                if span is not None:
                    span.set_attribute("http.request.method", method)
                    span.set_attribute("http.route", route)
                    span.set_attribute("http.response.status_code", status)
                self._metrics.requested(method, route, status, seconds)
                self._say(scope, method, route, status, seconds)

    def _route(self, scope: Scope) -> str:
        template = getattr(scope.get("route"), "path", None) or self._template(scope)
        return "unmatched" if template is None else str(template)

    def _say(self, scope: Scope, method: str, route: str, status: int, seconds: float) -> None:
        level = logging.DEBUG if route in _PROBES and status < 500 else logging.INFO
        if not _LOG.isEnabledFor(level):
            return
        state = scope.get("state", {})
        caller = state.get("caller")
        about: dict[str, Any] = {
            "method": method,
            "path": scope["path"][:_LONGEST_PATH],
            "status": status,
            "duration_ms": round(1e3 * seconds, 2),
            "client": address_of(scope),
        }
        if caller is not None and caller.key is not None:
            about |= {"key": caller.key, "owner": caller.owner}
        if self._bodies and "body" in state:
            about["body"] = bytes(state["body"][:_LONGEST_BODY]).decode("utf-8", "replace")
        _LOG.log(level, "%s %s %d", method, route, status, extra={**about, "about": about})
