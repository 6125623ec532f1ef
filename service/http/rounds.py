"""Whose bytes are looked at or sent next: client by client, so that one with hundreds of connections delays nobody."""

import asyncio
from collections import OrderedDict, deque
from collections.abc import Callable

Work = Callable[[], None]


class Rounds:
    """One piece of work in each turn of an event loop, of one client after the other.

    What is alone is done at once, so that it costs nothing where there is no haste.

    Parameters
    ----------
    call_soon : has something done in the next turn of the loop.
    """

    def __init__(self, call_soon: Callable[[Work], object]) -> None:
        self._call_soon = call_soon
        self._waiting: OrderedDict[str, deque[Work]] = OrderedDict()
        self._taken = False

    def ask(self, client: str, work: Work) -> bool:
        """Have some work done, in the order in which its client asks; whether it has been done already."""
        if self._taken:
            self._waiting.setdefault(client, deque()).append(work)
            return False
        self._taken = True
        self._call_soon(self._next)
        work()
        return True

    async def turn(self, client: str) -> None:
        """Wait for a turn of the event loop that is a client's."""
        given = asyncio.get_running_loop().create_future()

        def give() -> None:
            # who waited may be gone
            if not given.done():
                given.set_result(None)

        if not self.ask(client, give):
            await given

    def _next(self) -> None:
        if not self._waiting:
            self._taken = False
            return
        client, own = self._waiting.popitem(last=False)
        work = own.popleft()
        if own:
            # behind all others
            self._waiting[client] = own
        self._call_soon(self._next)
        work()


class LoopRounds:
    """The rounds of the event loop that runs; what waited in one that has ended is gone with it."""

    def __init__(self) -> None:
        self._loop: asyncio.AbstractEventLoop | None = None

    async def turn(self, client: str) -> None:
        """Wait for a turn of the event loop that is a client's."""
        loop = asyncio.get_running_loop()
        if loop is not self._loop:
            self._loop, self._rounds = loop, Rounds(loop.call_soon)
        await self._rounds.turn(client)
