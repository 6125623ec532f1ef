"""That a client goes away while its answer is made."""

import asyncio
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from starlette.requests import Request
from uvicorn.protocols.http.flow_control import FlowControl

#: of the state of a request: its client, where the server says itself when it goes
CLIENT = "client"
Leave = Callable[[], None]


class Client:
    """Who waits for an answer: told by the server that it has gone, without a task that waits for that."""

    def __init__(self, flow: FlowControl) -> None:
        self._flow = flow
        self._gone = False
        self._told: list[Leave] = []

    def leave(self) -> None:
        """It has gone."""
        self._gone = True
        for tell in tuple(self._told):
            tell()

    @contextmanager
    def watched(self, leave: Leave) -> Iterator[None]:
        """Have something called when it goes, at once if it has gone."""
        # what is not read does not end
        self._flow.resume_reading()
        if self._gone:
            leave()
        self._told.append(leave)
        try:
            yield
        finally:
            self._told.remove(leave)


@contextmanager
def on_leaving(request: Request, leave: Leave) -> Iterator[None]:
    """Have something called if the client goes away meanwhile, after its body has been read."""
    client: Client | None = request.scope.get("state", {}).get(CLIENT)
    if client is not None:
        with client.watched(leave):
            yield
        return

    async def watch() -> None:
        while (await request.receive())["type"] != "http.disconnect":
            pass
        leave()

    watching = asyncio.create_task(watch())
    try:
        yield
    finally:
        watching.cancel()
