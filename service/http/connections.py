"""One connection of the HTTP server: what is said to clients that are slow, too many, or speak no HTTP."""

import asyncio
import sys
from collections.abc import Callable
from typing import Any

import h11
from starlette.types import Receive, Scope, Send
from uvicorn.protocols.http.h11_impl import H11Protocol

from service.guard.refusals import TooManyConnections
from service.http.errors import PROBLEM_JSON, Fault, answered, problem
from service.http.joined import Joined
from service.settings import Settings

_TITLES = {431: "Headers too large", 501: "Not implemented"}


def connections(settings: Settings) -> type[asyncio.Protocol]:
    """The protocol of a server with these settings."""

    class Limited(Connection):
        max_connections = settings.max_connections
        headers_timeout_s = settings.headers_timeout_s
        write_timeout_s = settings.write_timeout_s

    return Limited


class Connection(H11Protocol):
    """Closed when its client sends no whole header, goes on with a body that was answered, or reads nothing, for too
    long."""

    max_connections: int
    headers_timeout_s: float
    write_timeout_s: float

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._headers_timer: asyncio.TimerHandle | None = None
        self._write_timer: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        super().connection_made(Joined(transport, self.loop))  # type: ignore[arg-type]
        if len(self.connections) > self.max_connections:
            self.app = _refused(self.max_connections)
        self._watch_headers()

    def connection_lost(self, exc: Exception | None) -> None:
        _stop(self._headers_timer)
        _stop(self._write_timer)
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        super().data_received(data)
        self._watch_headers()

    def _watch_headers(self) -> None:
        if not self._owes_headers() or self.transport.is_closing():
            _stop(self._headers_timer)
            self._headers_timer = None
        elif self._headers_timer is None:
            self._headers_timer = self.loop.call_later(self.headers_timeout_s, self._headers_late)

    def _owes_headers(self) -> bool:
        # a body that was answered early is read to its end, as its client may read the answer only then
        answered = self.conn.our_state in (h11.DONE, h11.MUST_CLOSE) and self.conn.their_state is h11.SEND_BODY
        return self.conn.their_state is h11.IDLE or answered

    def _headers_late(self) -> None:
        self._headers_timer = None
        if self.transport.is_closing() or not self._owes_headers():
            return
        if self.conn.their_state is h11.SEND_BODY:
            self.transport.close()
        else:
            self._refuse(Fault(408, "Headers too slow", f"No whole header came within {self.headers_timeout_s:g} s."))

    def pause_writing(self) -> None:
        super().pause_writing()
        self._watch_writing()

    def resume_writing(self) -> None:
        super().resume_writing()
        _stop(self._write_timer)
        self._write_timer = None

    def on_response_complete(self) -> None:
        super().on_response_complete()
        if self.conn.their_state is h11.SEND_BODY:
            self._watch_headers()
        self.transport.flush()  # type: ignore[attr-defined]
        # what is left is too little to pause for, and still must not stay for ever
        if self.transport.get_write_buffer_size():
            self._watch_writing()

    def _watch_writing(self) -> None:
        if self._write_timer is None:
            self._write_timer = self.loop.call_later(self.write_timeout_s, self._writing_late)

    def _writing_late(self) -> None:
        self._write_timer = None
        if self.transport.get_write_buffer_size():
            self.transport.abort()

    def send_400_response(self, msg: str) -> None:
        error = sys.exc_info()[1]
        status = error.error_status_hint if isinstance(error, h11.RemoteProtocolError) else 400
        self._refuse(Fault(status, _TITLES.get(status, "Unreadable request"), msg))

    def _refuse(self, fault: Fault) -> None:
        content = problem(fault, "").model_dump_json().encode()
        headers = [
            (b"content-type", PROBLEM_JSON.encode()),
            (b"content-length", str(len(content)).encode()),
            (b"connection", b"close"),
        ]
        try:
            for event in (
                h11.Response(status_code=fault.status, headers=headers),
                h11.Data(data=content),
                h11.EndOfMessage(),
            ):
                self.transport.write(self.conn.send(event) or b"")
        except h11.LocalProtocolError:
            # an answer is on its way already, and what follows its question is no HTTP
            pass
        self.transport.close()


def _refused(most: int) -> Callable[..., Any]:
    async def refuse(scope: Scope, receive: Receive, send: Send) -> None:
        answer = answered(TooManyConnections(most), scope["path"])
        answer.headers["Connection"] = "close"
        await answer(scope, receive, send)

    return refuse


def _stop(timer: asyncio.TimerHandle | None) -> None:
    if timer is not None:
        timer.cancel()
