"""A queue of turns on a clock that stands still: a test says when turns end, and how long they last."""

import anyio

from service.fairness.queue import FairQueue as _Turns
from service.fairness.queue import Full
from service.fairness.table import Share, shares
from service.settings import Settings

ABOVE = int(shares(Settings())["short"].reserve)


class Clock:
    """Time that goes by when it is told to."""

    def __init__(self) -> None:
        self.seconds = 0.0

    def __call__(self) -> float:
        return self.seconds


class FairQueue(_Turns):
    """With a clock of its own, which stands."""

    def __init__(self, size: int, waiting: int, count: int, above: int = ABOVE) -> None:
        self.clock = Clock()
        super().__init__(Share("turn", size, size, 1, above), Share("place", count, waiting), self.clock)


async def settled() -> None:
    """Whoever can go on has gone on: rounds of the loop; anyio's own waiting sleeps for a tenth of a second."""
    for _ in range(10):
        await anyio.lowlevel.checkpoint()


class Queue:
    """Turns that are asked for in order, each ended by hand."""

    def __init__(self, turns: FairQueue, group: anyio.abc.TaskGroup) -> None:
        self.turns = turns
        self.begun: list[str] = []
        self.refused: list[str] = []
        #: of turns, where it is not all the time that they last
        self.computed_s: dict[str, float] = {}
        self._group = group
        self._ends: dict[str, anyio.Event] = {}

    async def ask(self, name: str) -> None:
        """Ask for a turn of the owner that the first letter of a name names."""
        self._ends[name] = anyio.Event()

        async def have() -> None:
            try:
                turn = self.turns.turn(name[0])
                async with turn:
                    self.begun.append(name)
                    await self._ends[name].wait()
                    turn.computed_s = self.computed_s.get(name)
            except Full:
                self.refused.append(name)

        self._group.start_soon(have)
        await settled()

    async def end(self, *names: str, after_s: float = 0.0) -> None:
        """End turns, each when so much time has gone by."""
        for name in names:
            self.turns.clock.seconds += after_s
            self._ends[name].set()
            await settled()


def play(turns: FairQueue, story: object) -> Queue:
    rungs: list[Queue] = []

    async def tell() -> None:
        async with anyio.create_task_group() as group:
            rungs.append(Queue(turns, group))
            await story(rungs[0])  # type: ignore[operator]
            group.cancel_scope.cancel()

    anyio.run(tell)
    assert turns.waiting == 0
    return rungs[0]
