"""How long a kept connection may be idle between two requests."""

import asyncio
from collections.abc import Callable


class Idleness:
    """Calls something when a connection has been idle for too long.

    One timer goes on over many requests and looks itself since when it is: to stop and start one for each costs more
    than to read the request.

    Parameters
    ----------
    patience_s : how long it may be [s].
    """

    def __init__(self, loop: asyncio.AbstractEventLoop, patience_s: float, late: Callable[[], None]) -> None:
        self._loop = loop
        self._patience_s = patience_s
        self._late = late
        self._since: float | None = None
        self._timer: asyncio.TimerHandle | None = None

    def begin(self) -> None:
        """It is idle from now on."""
        self._since = self._loop.time()
        if self._timer is None:
            self._timer = self._loop.call_at(self._since + self._patience_s, self._look)

    def end(self) -> None:
        """It is not idle any more."""
        self._since = None

    def stop(self) -> None:
        """The connection has ended, and is not held any longer."""
        self._late = _nothing
        if self._timer is not None:
            self._timer.cancel()

    def _look(self) -> None:
        self._timer = None
        if self._since is None:
            return
        end = self._since + self._patience_s
        if self._loop.time() < end:
            self._timer = self._loop.call_at(end, self._look)
        else:
            self._late()


def _nothing() -> None:
    pass
