"""How often a key may ask."""

import math
import time

from limits import RateLimitItem, parse
from limits.aio.storage import MemoryStorage
from limits.aio.strategies import SlidingWindowCounterRateLimiter

from service.settings import Settings


class TooManyRequests(Exception):
    """More requests than the limit allows; a retry helps after ``retry_after_s``."""

    def __init__(self, limit: RateLimitItem, retry_after_s: int) -> None:
        self.retry_after_s = retry_after_s
        super().__init__(f"More requests than {limit}.")


class RateLimits:
    """Counts requests in windows that slide, in the memory of this service.

    Raises
    ------
    ValueError
        if a setting is no rate.
    """

    def __init__(self, settings: Settings) -> None:
        self._usual = parsed(settings.rate_limit)
        self._refusals = parsed(settings.refusal_limit)
        self._limiter = SlidingWindowCounterRateLimiter(MemoryStorage())

    async def asked(self, key: str, rate: str | None) -> None:
        """Count a request of a key, which may have a rate of its own.

        Raises
        ------
        TooManyRequests
        """
        await self._count("key", key, self._usual if rate is None else parsed(rate))

    async def refused(self, client: str) -> None:
        """Count a wrong key of a client.

        Raises
        ------
        TooManyRequests
        """
        await self._count("address", client, self._refusals)

    async def _count(self, kind: str, name: str, limit: RateLimitItem | None) -> None:
        if limit is None or await self._limiter.hit(limit, kind, name):
            return
        reset = (await self._limiter.get_window_stats(limit, kind, name)).reset_time
        raise TooManyRequests(limit, max(1, math.ceil(reset - time.time())))


def parsed(rate: str) -> RateLimitItem | None:
    """A rate such as ``100/second``; None if it is empty.

    Raises
    ------
    ValueError
    """
    if not rate:
        return None
    try:
        return parse(rate)
    except ValueError:
        raise ValueError(f"{rate!r} is no rate such as 100/second or 6000/minute") from None
