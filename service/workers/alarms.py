"""What is called when something takes too long, which hardly anything does."""

import asyncio
from collections.abc import Callable
from functools import partial
from types import TracebackType


class Alarms:
    """Calls after some time, each unless it is stopped before.

    One timer goes on over many and looks itself whose time has come. The loop's own, started and cancelled for each,
    were a sixth of what an answer costs the front: it keeps those that are cancelled, and looks through them again and
    again.
    """

    def __init__(self) -> None:
        self._loop: asyncio.AbstractEventLoop | None = None
        self._timer: asyncio.TimerHandle | None = None
        # when, and what is called then
        self._set: dict[object, tuple[float, Callable[[], object]]] = {}

    def set(self, seconds: float, late: Callable[[], object]) -> Callable[[], object]:
        """Have something called after a time [s], unless what is returned is called before."""
        loop = asyncio.get_running_loop()
        if loop is not self._loop:
            # what another loop was to call it calls no more
            self._loop, self._timer, self._set = loop, None, {}
        key, end = object(), loop.time() + seconds
        self._set[key] = end, late
        self._wake(loop, end)
        return partial(self._set.pop, key, None)

    def limit(self, seconds: float) -> "Limit":
        """A ``with`` that ends what takes longer [s]."""
        return Limit(self, seconds)

    def _wake(self, loop: asyncio.AbstractEventLoop, end: float) -> None:
        if self._timer is not None:
            if self._timer.when() <= end:
                return
            self._timer.cancel()
        self._timer = loop.call_at(end, self._look)

    def _look(self) -> None:
        loop = asyncio.get_running_loop()
        self._timer, now = None, loop.time()
        for key in [key for key, (end, _) in self._set.items() if end <= now]:
            # who was late before may have stopped it
            alarm = self._set.pop(key, None)
            if alarm is not None:
                alarm[1]()
        if self._set:
            self._wake(loop, min(end for end, _ in self._set.values()))


class Limit:
    """Ends what is in a ``with`` after a time.

    Raises
    ------
    TimeoutError
    """

    def __init__(self, alarms: Alarms, seconds: float) -> None:
        self._alarms = alarms
        self._seconds = seconds
        self._late = False

    def __enter__(self) -> None:
        task = asyncio.current_task()
        assert task is not None
        self._task, self._cancelling = task, task.cancelling()
        self._stop = self._alarms.set(self._seconds, self._end)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stop()
        # as asyncio.timeout does it: others may have cancelled it too, and it ends for them then
        if self._late and self._task.uncancel() <= self._cancelling and kind is asyncio.CancelledError:
            raise TimeoutError from error

    def _end(self) -> None:
        self._late = True
        self._task.cancel()
