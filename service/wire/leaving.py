"""Whether a client has sent all and still waits: that it goes away while its answer is made."""

import asyncio
from collections.abc import Callable
from types import TracebackType

from starlette.requests import Request
from uvicorn.protocols.http.flow_control import FlowControl

from service.common.problems import FaultTable, fixed

#: of the state of a request: its client, where the server says itself when it goes
CLIENT = "client"
Leave = Callable[[], object]


class ClientGone(Exception):
    """The client closed its connection; nobody waits for the answer."""


#: nobody reads this but the log and the metrics; the number is that of nginx
FAULTS: FaultTable = {ClientGone: fixed(499, "Client gone", "The client closed its connection.")}


class Client:
    """Who waits for an answer: the server reports when it has gone, without a task that waits for that.

    sent_all : whether its whole body has come.
    """

    def __init__(self, flow: FlowControl) -> None:
        self.sent_all = False
        self.gone = False
        self._flow = flow
        self._on_leave: Leave | None = None

    def leave(self) -> None:
        """It has gone."""
        self.gone = True
        if self._on_leave is not None:
            self._on_leave()

    def tell(self, leave: Leave | None) -> None:
        """Have something called when it goes, or nothing any more."""
        if leave is not None:
            # what is not read does not end
            self._flow.resume_reading()
        self._on_leave = leave


def client_of(request: Request) -> Client | None:
    """The client of a request, where the server says itself when it goes."""
    client: Client | None = request.scope.get("state", {}).get(CLIENT)
    return client


class Waited:
    """Work for a client, in a ``with``: it is cancelled when the client goes away, after its body has been read.

    Raises
    ------
    ClientGone
    """

    def __init__(self, request: Request) -> None:
        self._request = request
        self._gone = False
        self._client = client_of(request)
        self._watches: asyncio.Task[None] | None = None

    def __enter__(self) -> None:
        task = asyncio.current_task()
        assert task is not None
        self._task, self._cancelling = task, task.cancelling()
        if self._client is None:
            self._watches = asyncio.create_task(self._watch())
        elif self._client.gone:
            raise ClientGone
        else:
            self._client.tell(self._leave)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._client is not None:
            self._client.tell(None)
        elif self._watches is not None:
            self._watches.cancel()
        # as asyncio.timeout does it: others may have cancelled it too, and it ends for them then
        if self._gone and self._task.uncancel() <= self._cancelling and kind is asyncio.CancelledError:
            raise ClientGone from None

    def _leave(self) -> None:
        self._gone = True
        self._task.cancel()

    async def _watch(self) -> None:
        while (await self._request.receive())["type"] != "http.disconnect":
            pass
        self._leave()
