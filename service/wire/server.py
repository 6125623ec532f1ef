"""The HTTP server around the application."""

import asyncio
import gc
import logging
import resource
import socket
import sys
from contextlib import suppress
from types import FrameType

import uvicorn
from fastapi import FastAPI

from service.common.time_slices import SHORT_S, set_slice, slice_s
from service.fairness.connection_limits import ConnectionLimits
from service.fairness.table import connections as connections_share
from service.settings import Settings
from service.wire.connections import Connection, connections
from service.wire.entrance import Entrance

_LOG = logging.getLogger(__name__)
_TO_ANSWER_S = 1.0
#: files that are no connections: workers, database, log, libraries
_OTHER_FILES = 128
#: connections that wait to be let in
_BACKLOG = 2048
#: a thread that computes gives way to the event loop after so long; five times as long by default
_SWITCH_S = 0.001
#: new objects before a collection of the youngest garbage, which are fewer than of a command that computes once. Then
#: collections of the youngest garbage before one of what is older, and of those before a full one. For each everything
#: stops: 5 ms with a thousand connections after ten of the youngest, as by default, and 0.1 s for a full one. A request
#: leaves nothing for it
_YOUNGEST_AFTER, _OLDER_AFTER, _FULL_AFTER = 700, 2, 250


def listen(settings: Settings) -> socket.socket:
    """A listening socket.

    Raises
    ------
    OSError
        if the address is taken, unknown or not allowed.
    """
    family = socket.AF_INET6 if ":" in settings.host else socket.AF_INET
    listening = socket.create_server((settings.host, settings.port), family=family, backlog=_BACKLOG)
    # inherited by every connection. The event loop sets it only where a socket names its protocol, which these do not.
    # Without it an answer on a kept connection waits 40 ms for the client's delayed acknowledgement
    listening.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return listening


def url(listening: socket.socket) -> str:
    """Address of a listening socket."""
    host, port = listening.getsockname()[:2]
    return f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"


def _take_short_slices() -> None:
    """Have this thread and those that it starts woken at once, whatever computes."""
    try:
        set_slice(SHORT_S)
        heeded = slice_s() == SHORT_S
    except OSError:
        heeded = False
    if not heeded:
        _LOG.info("the system has no time slices of threads: beside computations an answer waits up to 4 ms longer")


def run(app: FastAPI, settings: Settings, listening: socket.socket) -> None:
    """Serve until SIGINT or SIGTERM; open requests get time to end."""
    sys.setswitchinterval(_SWITCH_S)
    _take_short_slices()
    gc.set_threshold(_YOUNGEST_AFTER, _OLDER_AFTER, _FULL_AFTER)
    most = max(1, _files() - _OTHER_FILES)
    if most < settings.max_connections:
        _LOG.warning("the system allows %d open connections, not %d", most, settings.max_connections)
    protocol = connections(settings, app.state.rounds)
    config = uvicorn.Config(
        app,
        # named, as uvicorn takes any uvloop that it sees: its transports have no bound on what is read at a time
        loop="asyncio",
        http=protocol,
        ws="none",
        root_path=settings.root_path,
        # the application does, once it has seen whose connection it is
        proxy_headers=False,
        log_config=None,
        access_log=False,
        server_header=False,
        timeout_keep_alive=settings.keep_alive_s,
        timeout_graceful_shutdown=settings.graceful_shutdown_s,
    )
    share = connections_share(min(most, settings.max_connections), settings.max_connections_each)
    doors = ConnectionLimits(share, settings.trusted_proxies)
    with suppress(KeyboardInterrupt):
        _Server(config, app, protocol, doors).run(sockets=[listening])


def _files() -> int:
    """How many files may be open. A connection is one: as many as the system allows, not as it hands out at first."""
    _, most = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))
    return sys.maxsize if most == resource.RLIM_INFINITY else most


class _Server(uvicorn.Server):
    """Lets connections in by its own entrance.

    Has the streams of events end first: they would be waited for, and the lifespan ends after them.
    """

    def __init__(
        self, config: uvicorn.Config, app: FastAPI, protocol: type[Connection], doors: ConnectionLimits
    ) -> None:
        super().__init__(config)
        self._app = app
        self._protocol = protocol
        self._doors = doors
        self._entrances: list[Entrance] = []

    def handle_exit(self, sig: int, frame: FrameType | None) -> None:
        self._app.state.desk.closing.set()
        super().handle_exit(sig, frame)

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup([])
        for listening in sockets or ():
            entrance = Entrance(
                listening, self._doors, self._protocol.rounds, self._connection, self._protocol.headers_timeout_s
            )
            entrance.open()
            self._entrances.append(entrance)

    def _connection(self) -> Connection:
        return self._protocol(config=self.config, server_state=self.server_state, app_state=self.lifespan.state)

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        for entrance in self._entrances:
            entrance.close()
        # computations that do not end by themselves are answered 503 while there is still time to send it
        grace_s = self.config.timeout_graceful_shutdown or 0
        asyncio.get_running_loop().call_later(max(0.0, grace_s - _TO_ANSWER_S), self._app.state.pool.close)
        await super().shutdown(sockets)
