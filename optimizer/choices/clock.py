"""What is left of the time of a search, and how much of a stage that is enough for."""

import time
from collections.abc import Callable


class Clock:
    """Runs with this thread's own time: what else a machine does changes no answer."""

    def __init__(self, limit_s: float, now: Callable[[], float] = time.thread_time) -> None:
        self._now, self.until = now, now() + limit_s

    @property
    def left_s(self) -> float:
        return self.until - self._now()

    def spent(self) -> bool:
        return self.left_s <= 0.0


class Pace:
    """How much is done at once, of nodes or sums: less than all only where all would take longer than there is time,
    by how long those before took."""

    def __init__(self, clock: Clock) -> None:
        self._clock, self._left, self._per_item = clock, clock.left_s, 0.0

    def took(self, count: int) -> None:
        """So many were done since this was called last, or since the beginning."""
        left = self._clock.left_s
        self._per_item, self._left = (self._left - left) / count, left

    def most(self, size: int) -> int:
        """Of so many those that there is time for, one at least."""
        left = max(self._left, 0.0)
        return size if size * self._per_item <= left else max(1, int(left / self._per_item))
