"""Looks at what changes by itself: all who ask for the same while they wait share one."""

import asyncio
import time
from collections.abc import Awaitable, Callable, Hashable
from typing import Any, TypeVar

from anyio import CapacityLimiter, to_thread
from starlette.requests import Request

from service.fairness.queue import FairQueue
from service.fairness.quotas import holding
from service.fairness.table import ANY, LOOKS

Result = TypeVar("Result")
#: after a look its client takes none for so many times what it computed. If it waits again, it takes none for as many
#: times what it took for each other client that waits. Looks compute in the process of the event loop: all of them
#: together must leave it most of its time, and leave a thread to whoever looks now and then
_REST = 3.0


class SingleFlight:
    """One look at a time for each client, whatever it looks at.

    A look begins after the call, so that nobody gets an earlier state; who calls while it is taken waits for
    the next. Hundreds who ask for the state of a job again and again cost one look after the other.

    Parameters
    ----------
    turn : waits until a client may go on with the result: what hundreds wait for comes to all of them at once.
    """

    def __init__(self, turn: Callable[[str], Awaitable[None]]) -> None:
        self._turn = turn
        self._loop: asyncio.AbstractEventLoop | None = None

    def _of_loop(self) -> asyncio.AbstractEventLoop:
        loop = asyncio.get_running_loop()
        if loop is not self._loop:
            # calls in a loop that has ended are gone with it
            self._loop, self._queue = loop, FairQueue(LOOKS, ANY)
            # the queue says who is next
            self._threads = CapacityLimiter(LOOKS.altogether + LOOKS.reserve)
            self._tasks: dict[tuple[str, Hashable], asyncio.Task[Any]] = {}
            self._own: dict[str, asyncio.Semaphore] = {}
        return loop

    async def at(self, who: str, key: Hashable, look: Callable[[], Result]) -> Result:
        """The result of a look that begins from now on.

        Parameters
        ----------
        key : looks of one client at the same find the same.
        """
        loop = self._of_loop()
        shared = self._tasks.get((who, key))
        if shared is None:
            shared = self._tasks[who, key] = loop.create_task(self._result(loop, who, key, look))
            # all who waited may have left
            shared.add_done_callback(lambda task: task.cancelled() or task.exception())
        # who leaves takes nothing away from the others
        await asyncio.wait((shared,))
        await self._turn(who)
        result: Result = shared.result()
        return result

    async def _result(
        self, loop: asyncio.AbstractEventLoop, who: str, key: Hashable, look: Callable[[], Result]
    ) -> Result:
        computed_s = took_s = 0.0

        def work() -> Result:
            nonlocal computed_s, took_s
            # who asks from now on needs a later one
            del self._tasks[who, key]
            begun, begun_at = time.thread_time(), time.monotonic()
            try:
                return look()
            finally:
                computed_s, took_s = time.thread_time() - begun, time.monotonic() - begun_at

        own = self._own.setdefault(who, asyncio.Semaphore(int(LOOKS.per_client)))
        await own.acquire()
        try:
            async with self._queue.turn(who) as turn:
                result = await to_thread.run_sync(work, limiter=self._threads)
                turn.computed_s = computed_s
            return result
        finally:
            waiting_count = self._waiting_count(who)
            loop.call_later(_REST * (computed_s + waiting_count * took_s), self._go_on, who, own)

    def _waiting_count(self, who: str) -> int:
        """How many other clients wait, if this one does too."""
        waiting = {client for client, _ in self._tasks}
        return len(waiting - {who}) if who in waiting else 0

    def _go_on(self, who: str, own: asyncio.Semaphore) -> None:
        own.release()
        if not own.locked():
            # nobody of this client waits
            del self._own[who]


async def shared_look(request: Request, key: Hashable, look: Callable[[], Result]) -> Result:
    """What a look for a request finds, by the looks of the application."""
    looks: SingleFlight = request.app.state.looks
    return await looks.at(holding(request).who, key, look)
