"""Whose bytes are looked at or sent next: client by client, so that one with hundreds of connections delays nobody."""

import asyncio
from collections import OrderedDict, deque
from collections.abc import Callable

Work = Callable[[], None]
#: a client of whom much waits has a piece done in every so many-th turn, which is short for everybody else
_APART = 4


class FairScheduler:
    """At most one piece of work in each turn of an event loop.

    What is alone is done at once, so that it costs nothing where there is no haste. A client of whom one piece waits
    comes next; those of whom more wait take turns that are further apart, as long as anything else is done in between.
    No turn in which nothing is done is waited for: a loop that runs through them computes, and keeps threads waiting.

    Parameters
    ----------
    call_soon : has something done in the next turn of the loop; by default that of the loop that runs.
    busy : whether anything else is to be done in this turn; likewise.
    """

    def __init__(
        self, call_soon: Callable[[Work], object] | None = None, busy: Callable[[], bool] | None = None
    ) -> None:
        self._loop: asyncio.AbstractEventLoop | None = None
        self._own = call_soon is None
        self._busy = busy or self._loop_is_busy
        self._begin(call_soon or _nothing)

    def _loop_is_busy(self) -> bool:
        # no loop says so in public. What is next here was handed to the loop first, so all else of the turn is to come
        return bool(getattr(self._loop, "_ready", True))

    def _begin(self, call_soon: Callable[[Work], object]) -> None:
        self._call_soon = call_soon
        self._few: OrderedDict[str, deque[Work]] = OrderedDict()
        self._many: OrderedDict[str, deque[Work]] = OrderedDict()
        self._is_busy = False
        self._since = 0

    @property
    def waiting(self) -> int:
        """Pieces of work that wait."""
        return sum(len(own) for clients in (self._few, self._many) for own in clients.values())

    def ask(self, client: str, work: Work) -> bool:
        """Have some work done, in the order in which its client asks; whether it has been done already."""
        if self._own and (loop := asyncio.get_running_loop()) is not self._loop:
            # what waited in a loop that has ended is gone with it
            self._loop = loop
            self._begin(loop.call_soon)
        if self._is_busy:
            self._wait(client, work)
            return False
        self._is_busy = True
        self._call_soon(self._next)
        work()
        return True

    def _wait(self, client: str, work: Work) -> None:
        own = self._many.get(client)
        if own is None:
            own = self._few.pop(client, None)
            clients = self._few if own is None else self._many
            own = clients[client] = own or deque()
        own.append(work)

    async def turn(self, client: str) -> None:
        """Wait for a turn of the event loop that is a client's."""
        future = asyncio.get_running_loop().create_future()

        def give() -> None:
            # who waited may be gone
            if not future.done():
                future.set_result(None)

        if not self.ask(client, give):
            await future

    def _next(self) -> None:
        if not (self._few or self._many):
            self._is_busy = False
            return
        idle = not (self._few or self._busy())
        self._call_soon(self._next)
        self._since += 1
        if self._many and (idle or self._since >= _APART):
            self._since = 0
            client, own = self._many.popitem(last=False)
            work = own.popleft()
            # behind all others
            (self._many if len(own) > 1 else self._few)[client] = own
            work()
        elif self._few:
            _, own = self._few.popitem(last=False)
            own.popleft()()


def _nothing(_: Work) -> None:
    pass
