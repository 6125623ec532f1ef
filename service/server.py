"""The HTTP server around the application."""

import socket
from contextlib import suppress

import uvicorn

from service.app import create_app
from service.settings import Settings


def listen(settings: Settings) -> socket.socket:
    """A listening socket.

    Raises
    ------
    OSError
        if the address is taken, unknown or not allowed.
    """
    family = socket.AF_INET6 if ":" in settings.host else socket.AF_INET
    return socket.create_server((settings.host, settings.port), family=family, backlog=2048)


def url(listening: socket.socket) -> str:
    """Address of a listening socket."""
    host, port = listening.getsockname()[:2]
    return f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"


def run(settings: Settings, listening: socket.socket) -> None:
    """Serve until SIGINT or SIGTERM; open requests get time to end."""
    config = uvicorn.Config(
        create_app(settings),
        root_path=settings.root_path,
        log_level="warning",
        access_log=False,
        server_header=False,
        timeout_graceful_shutdown=settings.graceful_shutdown_s,
    )
    with suppress(KeyboardInterrupt):
        uvicorn.Server(config).run(sockets=[listening])
