"""The HTTP server around the application."""

import asyncio
import resource
import socket
from contextlib import suppress
from types import FrameType

import uvicorn
from fastapi import FastAPI

from service.http.connections import connections
from service.settings import Settings

_TO_ANSWER_S = 1.0


def listen(settings: Settings) -> socket.socket:
    """A listening socket.

    Raises
    ------
    OSError
        if the address is taken, unknown or not allowed.
    """
    family = socket.AF_INET6 if ":" in settings.host else socket.AF_INET
    listening = socket.create_server((settings.host, settings.port), family=family, backlog=2048)
    # inherited by every connection. The event loop sets it only where a socket names its protocol, which these do not;
    # without it an answer on a kept connection waits 40 ms for the client's delayed acknowledgement
    listening.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return listening


def url(listening: socket.socket) -> str:
    """Address of a listening socket."""
    host, port = listening.getsockname()[:2]
    return f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"


def run(app: FastAPI, settings: Settings, listening: socket.socket) -> None:
    """Serve until SIGINT or SIGTERM; open requests get time to end."""
    _allow_files()
    config = uvicorn.Config(
        app,
        http=connections(settings),
        ws="none",
        root_path=settings.root_path,
        forwarded_allow_ips=list(settings.trusted_proxies),
        log_config=None,
        access_log=False,
        server_header=False,
        timeout_keep_alive=settings.keep_alive_s,
        timeout_graceful_shutdown=settings.graceful_shutdown_s,
    )
    with suppress(KeyboardInterrupt):
        _Server(config, app).run(sockets=[listening])


def _allow_files() -> None:
    """A connection is a file: as many as the system allows, not as many as it hands out at first."""
    _, most = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))


class _Server(uvicorn.Server):
    """Has the streams of events end first: they would be waited for, and the lifespan ends after them."""

    def __init__(self, config: uvicorn.Config, app: FastAPI) -> None:
        super().__init__(config)
        self._app = app

    def handle_exit(self, sig: int, frame: FrameType | None) -> None:
        self._app.state.desk.closing.set()
        super().handle_exit(sig, frame)

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        # computations that do not end by themselves are answered 503 while there is still time to send it
        grace_s = self.config.timeout_graceful_shutdown or 0
        asyncio.get_running_loop().call_later(max(0.0, grace_s - _TO_ANSWER_S), self._app.state.pool.close)
        await super().shutdown(sockets)
