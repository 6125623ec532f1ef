"""Looks at what changes by itself: all who ask for the same while they wait share one."""

import asyncio
import time
from collections.abc import Awaitable, Callable, Hashable
from typing import Any, TypeVar

from anyio import CapacityLimiter, to_thread
from starlette.requests import Request

from service.fairness.quotas import holding
from service.fairness.table import LOOKS

Result = TypeVar("Result")
#: after a look its client takes none for so many times what it computed; as often for each client that waits, if it
#: waits itself: looks compute in the process of the event loop, and all of them together must leave it most of its time
_REST = 3.0


class SingleFlight:
    """One look at a time for each client, whatever it looks at.

    A look begins after it was asked for, so that nobody is told what was before; who asks while it is taken waits for
    the next. Hundreds who ask for the state of a job again and again cost one look after the other.

    Parameters
    ----------
    turn : waits until a client may go on with what was found: what hundreds wait for comes to all of them at once.
    """

    def __init__(self, turn: Callable[[str], Awaitable[None]]) -> None:
        self._turn = turn
        self._loop: asyncio.AbstractEventLoop | None = None

    def _of_loop(self) -> asyncio.AbstractEventLoop:
        loop = asyncio.get_running_loop()
        if loop is not self._loop:
            # what was asked for in a loop that has ended is gone with it
            self._loop, self._threads = loop, CapacityLimiter(LOOKS.altogether)
            self._asked: dict[tuple[str, Hashable], asyncio.Task[Any]] = {}
            self._own: dict[str, asyncio.Semaphore] = {}
        return loop

    async def at(self, who: str, what: Hashable, look: Callable[[], Result]) -> Result:
        """What is found by a look that begins from now on.

        Parameters
        ----------
        what : looks of one client at the same find the same.
        """
        loop = self._of_loop()
        shared = self._asked.get((who, what))
        if shared is None:
            shared = self._asked[who, what] = loop.create_task(self._taken(loop, who, what, look))
            # there may be nobody left to be told
            shared.add_done_callback(lambda task: task.cancelled() or task.exception())
        # who leaves takes nothing away from the others
        await asyncio.wait((shared,))
        await self._turn(who)
        found: Result = shared.result()
        return found

    async def _taken(
        self, loop: asyncio.AbstractEventLoop, who: str, what: Hashable, look: Callable[[], Result]
    ) -> Result:
        computed_s = 0.0

        def work() -> Result:
            nonlocal computed_s
            # who asks from now on needs a later one
            del self._asked[who, what]
            begun = time.thread_time()
            try:
                return look()
            finally:
                computed_s = time.thread_time() - begun

        own = self._own.setdefault(who, asyncio.Semaphore(int(LOOKS.each)))
        await own.acquire()
        try:
            return await to_thread.run_sync(work, limiter=self._threads)
        finally:
            loop.call_later(_REST * computed_s * self._crowd(who), self._go_on, who, own)

    def _crowd(self, who: str) -> int:
        """How many clients wait, if this one does."""
        waiting = {client for client, _ in self._asked}
        return len(waiting) if who in waiting else 1

    def _go_on(self, who: str, own: asyncio.Semaphore) -> None:
        own.release()
        if not own.locked():
            # nobody of this client waits
            del self._own[who]


async def looked(request: Request, what: Hashable, look: Callable[[], Result]) -> Result:
    """What a look for a request finds, by the looks of the application."""
    looks: SingleFlight = request.app.state.looks
    return await looks.at(holding(request).who, what, look)
