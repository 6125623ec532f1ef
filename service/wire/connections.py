"""One connection of the HTTP server: what is said to clients that are slow, too many, or speak no HTTP."""

import asyncio
import sys
from collections.abc import Callable
from contextlib import suppress
from typing import Any
from urllib.parse import unquote

import h11
from uvicorn.protocols.http.flow_control import HIGH_WATER_LIMIT
from uvicorn.protocols.http.h11_impl import H11Protocol

from service.common.problems import Fault
from service.fairness.client import client_network
from service.fairness.scheduler import FairScheduler
from service.settings import Settings
from service.wire.coalescing import CoalescingTransport
from service.wire.framing import Framing, TwoLengths
from service.wire.idleness import Idleness
from service.wire.leaving import CLIENT, Client
from service.wire.plain_requests import Head, Heads, PlainCycle
from service.wire.refusal import last_answer, no_room

#: what may wait to be read by a client, and what is read of it at a time [bytes]
_UNREAD_BYTES = 32_768
_READ_BYTES = 32_768
_TOO_LARGE = 431


def connections(settings: Settings, shared: FairScheduler) -> "type[Connection]":
    """The protocol of a server with these settings, whose connections share rounds with whatever else goes by turns."""

    class Limited(Connection):
        rounds = shared
        headers_timeout_s = settings.headers_timeout_s
        write_timeout_s = settings.write_timeout_s

    return Limited


class Connection(H11Protocol):
    """Closed when its client sends no whole header, goes on with a body that was answered, or reads nothing, for too
    long."""

    rounds: FairScheduler
    headers_timeout_s: float
    write_timeout_s: float

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.conn = Framing(h11.SERVER)
        self._headers_timer: asyncio.TimerHandle | None = None
        self._write_timer: asyncio.TimerHandle | None = None
        self._unread = 0
        self._waits = False
        # while a plain request is read and answered: what of its body is to come, and what came after it
        self._plain = False
        self._missing = 0
        self._next = b""
        self._asks: Client | None = None
        self._heads = Heads()
        # h11 has read something: from then on it decides
        self._by_h11 = False
        self._idle = Idleness(self.loop, self.timeout_keep_alive, self.timeout_keep_alive_handler)
        #: called when it has ended
        self.left: Callable[[], None] = _nothing

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        coalescing = CoalescingTransport(transport, self.loop, self._still_sent, self.headers_timeout_s)
        super().connection_made(coalescing)  # type: ignore[arg-type]
        transport.set_write_buffer_limits(high=_UNREAD_BYTES)
        # size of one read: a client that sends ahead fills no more than this
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
        self._idle.stop()
        self.left()
        super().connection_lost(exc)
        if self._asks is not None:
            self._asks.leave()
        if isinstance(self.transport, CoalescingTransport):
            self.transport.ended()

    def data_received(self, data: bytes) -> None:
        # it is not idle while it waits
        self._unset_keepalive_if_required()
        self._waits = True
        if not self.rounds.ask(client_network(self._address), lambda: self._look_at(data)):
            # also that its client has left is seen later: its request is in the log
            self.transport.hold_back()  # type: ignore[attr-defined]

    def _look_at(self, data: bytes) -> None:
        self._waits = False
        self.transport.go_on()  # type: ignore[attr-defined]
        if not self.transport.is_closing():
            # else lost, refused or answered while it waited
            self._read(data)

    def _read(self, data: bytes) -> None:
        if self._plain:
            self._read_on(data)
        elif (result := self._plain_head(data)) is not None:
            head, end = result
            self._begin(head)
            self._read_on(data[end:])
        else:
            self._by_h11 = True
            super().data_received(data)
        if self._headers_timer is not None or self._missing or not self._plain:
            # else it owes none, and no timer runs
            self._watch_headers()

    def _plain_head(self, data: bytes) -> tuple[Head, int] | None:
        # h11 goes on with what it has begun to read
        if self._by_h11:
            between = self.conn.our_state is h11.IDLE and self.conn.their_state is h11.IDLE
            if not between or self.conn.trailing_data[0]:
                return None
        return self._heads.plain(data)

    def _begin(self, head: Head) -> None:
        path, _, query = head.target.partition(b"?")
        self.headers = head.headers
        self._asks = Client(self.flow)
        self.scope = {
            "type": "http",
            "asgi": {"version": self.asgi_version, "spec_version": "2.3"},
            "http_version": "1.1",
            "server": self.server,
            "client": self.client,
            "scheme": self.scheme,  # type: ignore[typeddict-item]
            "method": head.method,
            "root_path": self.root_path,
            "path": self.root_path + unquote(path.decode("ascii")),
            "raw_path": self.root_path.encode("ascii") + path,
            "query_string": query,
            "headers": list(head.headers),
            "state": {**self.app_state, CLIENT: self._asks},
        }
        self.cycle = PlainCycle(
            scope=self.scope,
            conn=self.conn,
            transport=self.transport,
            flow=self.flow,
            logger=self.logger,
            access_logger=self.access_logger,
            access_log=self.access_log,
            default_headers=self.server_state.default_headers,
            message_event=asyncio.Event(),
            on_response=self.on_response_complete,
        )
        self.cycle.keep_alive = head.keep_alive
        self._plain, self._missing = True, head.length
        if not head.length:
            self.cycle.more_body = False
            self.cycle.message_event.set()
        self.tasks.add(self.loop.create_task(self._answer(self.cycle)))

    async def _answer(self, cycle: PlainCycle) -> None:
        try:
            await cycle.run_asgi(self.app)
        finally:
            # here, as a callback would cost a turn of the loop
            self.tasks.discard(asyncio.current_task())

    def _read_on(self, data: bytes) -> None:
        """More of a plain request, and what its client asks for after it, which waits."""
        body = data[: self._missing]
        self._next += data[self._missing :]
        self._missing -= len(body)
        if self.cycle.response_complete:
            # answered early; its client may read the answer only when all is sent
            if not self._missing:
                self._end()
            return
        if body:
            self.cycle.body += body
            self.cycle.more_body = self._missing > 0
            self.cycle.message_event.set()
        if self._asks is not None:
            self._asks.sent_all = not self._missing
        if self._next or len(self.cycle.body) > HIGH_WATER_LIMIT:
            self.flow.pause_reading()

    def _end(self) -> None:
        self._plain = False
        data, self._next = self._next, b""
        if data and not self.transport.is_closing():
            # it came together with the one before it, and before what has come since, which may wait to be looked at
            self._unset_keepalive_if_required()
            self._read(data)

    def _watch_headers(self) -> None:
        if not self._owes_headers() or self.transport.is_closing():
            _stop(self._headers_timer)
            self._headers_timer = None
        elif self._headers_timer is None:
            self._headers_timer = self.loop.call_later(self.headers_timeout_s, self._headers_late)

    def _owes_headers(self) -> bool:
        # a body that was answered early is read to its end, as its client may read the answer only then
        return self._answered_early or (not self._plain and self.conn.their_state is h11.IDLE)

    @property
    def _answered_early(self) -> bool:
        if self._plain:
            return self.cycle.response_complete and self._missing > 0
        return self.conn.our_state in (h11.DONE, h11.MUST_CLOSE) and self.conn.their_state is h11.SEND_BODY

    def _still_sent(self) -> bool:
        # h11 has said that it closes before the transport hears it
        closed = not self._plain and self.conn.our_state is h11.CLOSED and self.conn.their_state is h11.SEND_BODY
        return self._answered_early or closed

    def _headers_late(self) -> None:
        self._headers_timer = None
        if self._waits:
            # it is not for the client that nobody has looked
            self._watch_headers()
            return
        if self.transport.is_closing() or not self._owes_headers():
            return
        if self._answered_early:
            self.transport.end()  # type: ignore[attr-defined]
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
        if self._plain:
            self.server_state.total_requests += 1
            if not self.transport.is_closing():
                self.flow.resume_reading()
                self._idle.begin()
        else:
            super().on_response_complete()
        if self._waits:
            # it is not idle: what comes next has come
            self._unset_keepalive_if_required()
        if self._answered_early:
            self._watch_headers()
        self.transport.flush()  # type: ignore[attr-defined]
        # what is left is too little to pause for, and still must not stay for ever
        if self.transport.get_write_buffer_size():
            self._watch_writing()
        if self._plain and not self._missing:
            self._end()

    def _unset_keepalive_if_required(self) -> None:
        self._idle.end()
        if self.timeout_keep_alive_task is not None:
            super()._unset_keepalive_if_required()

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
        self._refuse(Fault(status, title, str(error) if isinstance(error, TwoLengths) else msg))

    def _refuse(self, fault: Fault) -> None:
        if self.cycle is not None and not self.cycle.response_complete:
            # who answers a request whose body turned out to be no HTTP has nobody to answer any more
            self.cycle.disconnected = True
            self.cycle.message_event.set()
        # if an answer is on its way already, what follows its question is no HTTP
        with suppress(h11.LocalProtocolError):
            self.transport.write(last_answer(self.conn, fault))
        self.transport.close()


def _nothing() -> None:
    pass


def _stop(timer: asyncio.TimerHandle | None) -> None:
    if timer is not None:
        timer.cancel()
