"""How often a key may ask."""

import math
import time
from dataclasses import dataclass

from limits import RateLimitItem, parse
from limits.aio.storage import MemoryStorage
from limits.aio.strategies import SlidingWindowCounterRateLimiter

from service.settings import Settings


@dataclass(frozen=True)
class Rate:
    """What is left of a limit.

    policy : what is counted, the requests of a key or the wrong keys of an address.
    remaining : requests until there are more again, in ``reset_s``.
    """

    policy: str
    limit: RateLimitItem
    remaining: int
    reset_s: int

    @property
    def headers(self) -> dict[str, str]:
        """The same for a client, as draft-ietf-httpapi-ratelimit-headers-10 has it."""
        return {
            "RateLimit-Policy": f'"{self.policy}";q={self.limit.amount};w={self.limit.get_expiry()}',
            "RateLimit": f'"{self.policy}";r={self.remaining};t={self.reset_s}',
        }


class TooManyRequests(Exception):
    """More requests than the limit allows; a retry helps when the rate says so."""

    def __init__(self, rate: Rate) -> None:
        self.rate = rate
        super().__init__(f"More requests than {rate.limit}.")


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

    async def count(self, key: str, rate: str | None) -> Rate | None:
        """Count a request of a key, which may have a rate of its own; None where there is no limit.

        Raises
        ------
        TooManyRequests
        """
        return await self._count("key", key, self._usual if rate is None else parsed(rate))

    async def refused(self, client: str) -> None:
        """Count a wrong key of a client.

        Raises
        ------
        TooManyRequests
        """
        await self._count("address", client, self._refusals)

    async def _count(self, kind: str, name: str, limit: RateLimitItem | None) -> Rate | None:
        if limit is None:
            return None
        success = await self._limiter.hit(limit, kind, name)
        reset, remaining = await self._limiter.get_window_stats(limit, kind, name)
        rate = Rate(kind, limit, int(remaining), max(1, math.ceil(reset - time.time())))
        if not success:
            raise TooManyRequests(rate)
        return rate


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
