"""What a request leaves behind: nothing that waits for a collection of garbage, for which everything stops."""

import asyncio
import gc
import http.client
from asyncio.selector_events import _SelectorSocketTransport  # type: ignore[attr-defined]
from contextlib import AsyncExitStack, closing
from pathlib import Path

import uvicorn
from uvicorn.protocols.http.h11_impl import RequestResponseCycle
from uvicorn.server import ServerState

from service.app import create_app
from service.fairness.quotas import Holding
from service.fairness.scheduler import FairScheduler
from service.settings import Settings
from service.wire.connections import Connection, connections

#: of the connection, of a request, and of the framework
OURS = (_SelectorSocketTransport, Connection, RequestResponseCycle, Holding, AsyncExitStack)


def ask(port: int) -> int:
    """The status of an answer, asked for without an event loop, whose transports would be garbage too."""
    with closing(http.client.HTTPConnection("127.0.0.1", port, timeout=180)) as connection:
        connection.request("GET", "/v1/examples", headers={"Connection": "close"})
        answer = connection.getresponse()
        answer.read()
        return answer.status


def test_what_was_answered_is_gone_with_its_last_reference(tmp_path: Path) -> None:
    settings, state = Settings(data_dir=tmp_path), ServerState()
    protocol = connections(settings, FairScheduler())
    config = uvicorn.Config(create_app(settings, warm=False), http=protocol, log_config=None, lifespan="off")
    config.load()

    async def story() -> list[object]:
        loop = asyncio.get_running_loop()
        async with await loop.create_server(lambda: protocol(config, state, {}), "127.0.0.1", 0) as listening:
            port = listening.sockets[0].getsockname()[1]
            # the first makes what stays
            for _ in range(3):
                gc.collect()
                gc.set_debug(gc.DEBUG_SAVEALL)
                assert await asyncio.to_thread(ask, port) == 200
                async with asyncio.timeout(180):
                    while state.connections or state.tasks:
                        await asyncio.sleep(0.01)
                gc.collect()
                gc.set_debug(0)
                values, gc.garbage[:] = [leftover for leftover in gc.garbage if isinstance(leftover, OURS)], []
        return values

    try:
        assert asyncio.run(story()) == []
    finally:
        gc.set_debug(0)
        gc.garbage.clear()
