"""The entrance of the server: whether there is room for a connection is seen before anything is made for it."""

import asyncio
import logging
import math
import socket
from collections.abc import Callable
from contextlib import suppress
from errno import EMFILE, ENFILE, ENOBUFS, ENOMEM
from functools import partial
from typing import Any

from starlette.types import Message, Receive, Scope, Send

from service.fairness.client import client_network
from service.fairness.connection_limits import ConnectionLimits
from service.fairness.scheduler import FairScheduler
from service.guard.access import own_path
from service.guard.keys import PROBES
from service.wire.connections import Connection
from service.wire.refusal import no_room, response, too_many_connections
from service.wire.spares import Spares

_LOG = logging.getLogger(__name__)
#: connections that are taken in a turn of the event loop
_AT_A_TIME = 16
#: there is no file for a connection: wait, and say so once in a while [s]
_NO_FILES = (EMFILE, ENFILE, ENOBUFS, ENOMEM)
_WAIT_S, _SAY_AGAIN_S = 1.0, 60.0
#: connections in place of spare files, which may say nothing for so long, and last so long [s]: others wait for them.
#: What a client asks is there when its connection is taken, or a moment later
_SPARES = 8
_BRIEFLY_S, _SHORT_S = 0.1, 2.0
#: how requests for health begin
_PROBING = tuple(f"{method} {path}".encode() for method in ("GET", "HEAD") for path in PROBES)
_LONGEST = max(map(len, _PROBING))
#: of what a refused client goes on to send, read at a time [bytes]
_PIECE_BYTES = 65_536


class Entrance:
    """Takes connections from a listening socket.

    Those for which there is room get their protocol client by client; of the others only those that ask for health do.
    Where no file is left for a connection it takes the place of a spare one for a moment, and may ask for health too.

    Parameters
    ----------
    rounds : whose connection is next.
    factory : makes a protocol.
    patience_s : how long a connection for which there is no room may say nothing [s].
    """

    def __init__(
        self,
        listening: socket.socket,
        doors: ConnectionLimits,
        rounds: FairScheduler,
        factory: Callable[[], Connection],
        patience_s: float,
    ) -> None:
        self.doors = doors
        self.factory = factory
        self.patience_s = patience_s
        self.loop = asyncio.get_running_loop()
        self.refused: set[_Refused] = set()
        self._listening = listening
        self._rounds = rounds
        self._last_warning_s = -math.inf
        self._open = False
        self._spares = Spares(_SPARES)
        self._connecting: set[asyncio.Task[Any]] = set()

    def open(self) -> None:
        """Take connections from now on."""
        self._open = True
        self._listening.setblocking(False)
        self.loop.add_reader(self._listening, self._take)

    def close(self) -> None:
        """Take none any more."""
        self._open = False
        self.loop.remove_reader(self._listening)
        for connection in tuple(self.refused):
            connection.end()
        self._spares.close()

    def connect(self, connection: socket.socket, protocol: Connection) -> None:
        """Give a connection its protocol."""
        task = self.loop.create_task(self.loop.connect_accepted_socket(lambda: protocol, connection))
        # nobody else holds it
        self._connecting.add(task)
        task.add_done_callback(self._connecting.discard)

    def _take(self) -> None:
        self._spares.fill()
        for _ in range(_AT_A_TIME):
            try:
                connection, (address, *_) = self._listening.accept()
            except (BlockingIOError, InterruptedError, ConnectionAbortedError):
                return
            except OSError as error:
                if error.errno not in _NO_FILES:
                    raise
                self._say(error)
                if self._take_briefly():
                    continue
                self._wait()
                return
            connection.setblocking(False)
            if self.doors.enter(address):
                self._rounds.ask(client_network(address), partial(self._let_in, connection, address))
            else:
                _Refused(self, connection, address)

    def _let_in(self, connection: socket.socket, address: str) -> None:
        if not self._open:
            connection.close()
            return
        protocol = self.factory()
        protocol.left = partial(self.doors.leave, address)
        self.connect(connection, protocol)

    def _take_briefly(self) -> bool:
        """Take a connection in place of a spare file; whether there was one."""
        if not self._spares.lend():
            return False
        try:
            connection, (address, *_) = self._listening.accept()
        except OSError:
            # its client has left, or a thread has opened a file meanwhile
            self._spares.give_back()
            return False
        connection.setblocking(False)
        _Brief(self, connection, address)
        return True

    def give_back(self) -> None:
        """A connection that took the place of a spare file has ended; the next may come."""
        # its socket is closed in this turn of the loop
        self.loop.call_soon(self._go_on_with_spares)

    def _go_on_with_spares(self) -> None:
        self._spares.give_back()
        self._go_on()

    def _wait(self) -> None:
        # a socket that nobody takes is ready in each turn, thousands of times a second
        self.loop.remove_reader(self._listening)
        self.loop.call_later(_WAIT_S, self._go_on)

    def _say(self, error: OSError) -> None:
        if self.loop.time() - self._last_warning_s > _SAY_AGAIN_S:
            self._last_warning_s = self.loop.time()
            _LOG.error("connections may ask for health alone, as no file can be opened: %s", error.strerror)

    def _go_on(self) -> None:
        if self._open:
            self.loop.add_reader(self._listening, self._take)


class _Refused:
    """A connection for which there is no room: it may ask for health, and is refused as soon as it asks for more."""

    def __init__(self, entrance: Entrance, connection: socket.socket, address: str) -> None:
        self._entrance, self._connection, self._address = entrance, connection, address
        self._protocol: Connection | None = None
        self._notice_sent = False
        self._timer = entrance.loop.call_later(self._patience_s, self._give_up)
        # by its number: the selector quotes a socket that it does not know, which takes three calls of the system
        self._number = connection.fileno()
        entrance.loop.add_reader(self._number, self._look)
        entrance.refused.add(self)
        self._begin()

    @property
    def _patience_s(self) -> float:
        return self._entrance.patience_s

    def _begin(self) -> None:
        self._entrance.doors.probe(self._address, self._give_up)

    def _look(self) -> None:
        try:
            if self._notice_sent:
                # who closes on unread bytes takes the answer from the client
                begun, over = b"", not self._connection.recv(_PIECE_BYTES)
            else:
                begun = self._connection.recv(_LONGEST, socket.MSG_PEEK)
                over = not begun
        except (BlockingIOError, InterruptedError):
            return
        except OSError:
            begun, over = b"", True
        if over:
            self.end()
        elif not self._notice_sent:
            if any(probe.startswith(begun[: len(probe)]) for probe in _PROBING):
                self._let_ask()
            else:
                self._tell()

    def _let_ask(self) -> None:
        self._leave()
        protocol = self._protocol = self._entrance.factory()
        protocol.app = _probes_only(protocol.app)
        protocol.left = self._forget
        self._entrance.connect(self._connection, protocol)

    def _tell(self) -> None:
        self._notice_sent = True
        with suppress(OSError):
            # nothing may have come
            self._connection.recv(_PIECE_BYTES)
        with suppress(OSError):
            self._connection.send(no_room())
            self._connection.shutdown(socket.SHUT_WR)

    def _give_up(self) -> None:
        """Another one takes its place, or it says nothing."""
        if self._protocol is None:
            if not self._notice_sent:
                self._tell()
            self.end()
        elif self._protocol.transport is None:
            # it is about to be made
            with suppress(OSError):
                self._connection.shutdown(socket.SHUT_RDWR)
        else:
            self._protocol.give_up()

    def end(self) -> None:
        """Close it."""
        self._leave()
        self._connection.close()
        self._forget()

    def _leave(self) -> None:
        self._timer.cancel()
        # once: the number of a socket that was closed may be another's
        if self in self._entrance.refused:
            self._entrance.refused.remove(self)
            self._entrance.loop.remove_reader(self._number)

    def _forget(self) -> None:
        self._entrance.doors.probed(self._address, self._give_up)


class _Brief(_Refused):
    """One in place of a spare file: its answer is its last, and it does not last."""

    @property
    def _patience_s(self) -> float:
        return _BRIEFLY_S

    def _begin(self) -> None:
        # there are as many as there are spare files
        pass

    def _let_ask(self) -> None:
        super()._let_ask()
        assert self._protocol is not None
        self._protocol.app = _last(self._protocol.app)
        self._timer = self._entrance.loop.call_later(_SHORT_S, self._give_up)

    def _forget(self) -> None:
        self._timer.cancel()
        self._entrance.give_back()


def _last(app: Callable[..., Any]) -> Callable[..., Any]:
    """An application after whose answer the connection is closed."""

    async def answer(scope: Scope, receive: Receive, send: Send) -> None:
        async def closing(message: Message) -> None:
            if message["type"] == "http.response.start":
                message = {**message, "headers": [*message.get("headers", ()), (b"connection", b"close")]}
            await send(message)

        await app(scope, receive, closing)

    return answer


def _probes_only(app: Callable[..., Any]) -> Callable[..., Any]:
    """The probes of an application; all else is refused, as there is no room."""

    async def answer(scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "http" and own_path(scope) in PROBES:
            await app(scope, receive, send)
            return
        refusal = response(too_many_connections(), scope["path"])
        refusal.headers["Connection"] = "close"
        await refusal(scope, receive, send)

    return answer
