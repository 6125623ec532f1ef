"""One connection of the HTTP server: what is said to clients that are slow, too many, or speak no HTTP."""

import asyncio
import sys
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from typing import Any

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

from service.guard.addresses import client_network
from service.guard.refusals import TooManyConnections
from service.http.errors import PROBLEM_JSON, Fault, fault, problem
from service.http.joined import Joined
from service.http.rounds import Rounds
from service.settings import Settings

#: what may wait to be read by a client, and what is read of it at a time [bytes]
_UNREAD_BYTES = 32_768
_READ_BYTES = 32_768
_TOO_LARGE = 431


def connections(settings: Settings, shared: Rounds) -> "type[Connection]":
    """The protocol of a server with these settings, whose connections share rounds with whatever else goes by turns."""

    class Limited(Connection):
        rounds = shared
        headers_timeout_s = settings.headers_timeout_s
        write_timeout_s = settings.write_timeout_s

    return Limited


class Connection(H11Protocol):
    """Closed when its client sends no whole header, goes on with a body that was answered, or reads nothing, for too
    long."""

    rounds: Rounds
    headers_timeout_s: float
    write_timeout_s: float

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._headers_timer: asyncio.TimerHandle | None = None
        self._write_timer: asyncio.TimerHandle | None = None
        self._unread = 0
        self._waits = False
        #: called when it has ended
        self.left: Callable[[], None] = _nothing

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        super().connection_made(Joined(transport, self.loop))  # type: ignore[arg-type]
        transport.set_write_buffer_limits(high=_UNREAD_BYTES)
        # what is read at a time: a client that sends more than is asked for fills no more than this
        transport.max_size = _READ_BYTES  # type: ignore[attr-defined]
        self._watch_headers()

    def give_up(self) -> None:
        """End it, as there is no room for it any more."""
        if self.cycle is not None and not self.cycle.response_complete:
            # its answer would come after the refusal
            self.transport.abort()
        else:
            self.transport.write(no_room())
            self.transport.close()

    @property
    def _address(self) -> str:
        return self.client[0] if self.client else ""

    def connection_lost(self, exc: Exception | None) -> None:
        _stop(self._headers_timer)
        _stop(self._write_timer)
        self.left()
        super().connection_lost(exc)
        if isinstance(self.transport, Joined):
            self.transport.ended()

    def data_received(self, data: bytes) -> None:
        # it is not idle while it waits
        self._unset_keepalive_if_required()
        self._waits = True
        if not self.rounds.ask(client_network(self._address), lambda: self._look_at(data)):
            self.transport.hold_back()  # type: ignore[attr-defined]

    def _look_at(self, data: bytes) -> None:
        self._waits = False
        if self.transport.is_closing():
            # lost, or refused, while it waited
            return
        self.transport.go_on()  # type: ignore[attr-defined]
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
        if self._waits:
            # it is not for the client that nobody has looked
            self._watch_headers()
            return
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
        if self._waits:
            # it is not idle: what comes next has come
            self._unset_keepalive_if_required()
        if self.conn.their_state is h11.SEND_BODY:
            self._watch_headers()
        self.transport.flush()  # type: ignore[attr-defined]
        # what is left is too little to pause for, and still must not stay for ever
        if self.transport.get_write_buffer_size():
            self._watch_writing()

    def _watch_writing(self) -> None:
        if self._write_timer is None:
            self._unread = self.transport.get_write_buffer_size()
            self._write_timer = self.loop.call_later(self.write_timeout_s, self._writing_late)

    def _writing_late(self) -> None:
        self._write_timer = None
        left = self.transport.get_write_buffer_size()
        if left and left >= self._unread:
            self.transport.abort()
        elif left:
            # it reads, however slowly
            self._watch_writing()

    def send_400_response(self, msg: str) -> None:
        error = sys.exc_info()[1]
        too_large = isinstance(error, h11.RemoteProtocolError) and error.error_status_hint == _TOO_LARGE
        # a coding that nobody knows is no fault of the service, so it is not 501
        status, title = (_TOO_LARGE, "Headers too large") if too_large else (400, "Unreadable request")
        self._refuse(Fault(status, title, msg))

    def _refuse(self, fault: Fault) -> None:
        if self.cycle is not None and not self.cycle.response_complete:
            # who answers a request whose body turned out to be no HTTP has nobody to answer any more
            self.cycle.disconnected = True
            self.cycle.message_event.set()
        # if an answer is on its way already, what follows its question is no HTTP
        with suppress(h11.LocalProtocolError):
            self.transport.write(_refusal(self.conn, fault))
        self.transport.close()


@cache
def no_room() -> bytes:
    """The answer to a connection for which there is no room, made once: whoever comes too often is told as often."""
    return _refusal(h11.Connection(h11.SERVER), fault(TooManyConnections()))


def _refusal(connection: h11.Connection, fault: Fault) -> bytes:
    """An answer that is the last of its connection."""
    content = problem(fault, "").model_dump_json().encode()
    headers = [
        *((name.encode(), value.encode()) for name, value in fault.headers.items()),
        (b"content-type", PROBLEM_JSON.encode()),
        (b"content-length", str(len(content)).encode()),
        (b"connection", b"close"),
    ]
    events = (h11.Response(status_code=fault.status, headers=headers), h11.Data(data=content), h11.EndOfMessage())
    return b"".join(connection.send(event) or b"" for event in events)


def _nothing() -> None:
    pass


def _stop(timer: asyncio.TimerHandle | None) -> None:
    if timer is not None:
        timer.cancel()
