"""Threads for what takes time though it computes nothing, so many for each client."""

from collections import Counter
from collections.abc import AsyncIterator, Callable, Iterator
from functools import wraps
from typing import Any, TypeVar

from anyio import CapacityLimiter, to_thread
from starlette.requests import Request

from service.fairness.quotas import holding
from service.fairness.table import THREADS, Share

Result = TypeVar("Result")


class Threads:
    """Threads for all that clients ask, none of them those that libraries share; who uses as many as it may waits for
    its own to end."""

    def __init__(self, share: Share = THREADS) -> None:
        self._per_client = share.per_client
        self._all = CapacityLimiter(share.altogether)
        self._own: dict[str, CapacityLimiter] = {}
        self._using: Counter[str] = Counter()

    async def run(self, who: str, work: Callable[[], Result], abandon: bool = False) -> Result:
        """The result of some work of a client; ``abandon`` it if it is still at work when nobody waits any more."""
        own = self._own.setdefault(who, CapacityLimiter(self._per_client))
        self._using[who] += 1
        try:
            async with own:
                return await to_thread.run_sync(work, limiter=self._all, abandon_on_cancel=abandon)
        finally:
            self._using[who] -= 1
            if not self._using[who]:
                del self._using[who], self._own[who]

    async def pieces(self, who: str, content: Iterator[bytes]) -> AsyncIterator[bytes]:
        """The pieces of a client's iterator; it goes on with each call."""
        while (piece := await self.run(who, lambda: next(content, None))) is not None:
            yield piece


def in_threads(work: Callable[..., Result]) -> Callable[..., Any]:
    """An endpoint that reads or writes jobs, in the threads that are for that; it takes ``request``."""

    @wraps(work)
    async def endpoint(*, request: Request, **arguments: Any) -> Result:
        return await threads_of(request).run(holding(request).who, lambda: work(request=request, **arguments))

    return endpoint


def threads_of(request: Request) -> Threads:
    """The threads of the application."""
    threads: Threads = request.app.state.threads
    return threads
