"""Whose computation begins next: owner by owner, so that nobody waits behind all that another one asks."""

import asyncio
from collections import Counter, OrderedDict, deque
from collections.abc import Iterator
from dataclasses import dataclass, field


class Full(Exception):
    """As many as may wait are waiting already, of this owner or altogether."""


@dataclass(eq=False)
class _Turn:
    """Asked for, waited for and had in an ``async with``."""

    turns: "Turns"
    owner: str
    long: bool
    decided: asyncio.Event = field(default_factory=asyncio.Event)
    begun: bool = False

    async def __aenter__(self) -> None:
        self.turns.ask(self)
        try:
            await self.decided.wait()
            if not self.begun:
                raise Full
        except BaseException:
            self.turns.end(self)
            raise

    async def __aexit__(self, *raised: object) -> None:
        self.turns.end(self)


class Turns:
    """So many turns at a time, and one more for an owner who has none.

    Owners take turns, each in the order in which it asked. When as many wait as may, the owner of whom most wait gives
    up its last place to one of whom fewer wait.

    Parameters
    ----------
    size : turns at a time.
    waiting : who may wait altogether.
    each : who may wait of one owner.
    """

    def __init__(self, size: int, waiting: int, each: int) -> None:
        self._size = size
        self._most = waiting
        self._each = each
        # those that take seconds never take every turn, if there are two at least
        self._most_long = max(1, size // 2)
        self._running: Counter[str] = Counter()
        self._running_long = 0
        self._waiting: OrderedDict[str, deque[_Turn]] = OrderedDict()

    @property
    def waiting(self) -> int:
        """How many wait."""
        return sum(map(len, self._waiting.values()))

    def more(self, owner: str) -> bool:
        """Whether an owner has more than one turn, or waits for one."""
        return self._running[owner] > 1 or owner in self._waiting

    def turn(self, owner: str, long: bool) -> _Turn:
        """Wait for a turn, and have it.

        Raises
        ------
        Full
            at once, or when the place is given to another owner.
        """
        return _Turn(self, owner, long)

    def end(self, turn: _Turn) -> None:
        """It was had, or is not wanted any more."""
        if turn.begun:
            self._running[turn.owner] -= 1
            if not self._running[turn.owner]:
                del self._running[turn.owner]
            self._running_long -= turn.long
        else:
            self._leave(turn)
        if self._waiting:
            self._go_on()

    def ask(self, turn: _Turn) -> None:
        """Have it begin, or wait for its decision."""
        # whoever waits may not begin, so nobody is overtaken
        if self._may_begin(turn):
            self._begin(turn)
            return
        own = len(self._waiting.get(turn.owner, ()))
        if own >= self._each:
            raise Full
        if self.waiting >= self._most:
            longest = max(self._waiting.values(), key=len, default=None)
            if longest is None or len(longest) <= own + 1:
                raise Full
            given_up = longest[-1]
            self._leave(given_up)
            given_up.decided.set()
        self._waiting.setdefault(turn.owner, deque()).append(turn)

    def _may_begin(self, turn: _Turn) -> bool:
        if turn.long and self._running_long >= self._most_long:
            return False
        return self._running.total() < self._size + (self._running[turn.owner] == 0)

    def _begin(self, turn: _Turn) -> None:
        turn.begun = True
        self._running[turn.owner] += 1
        self._running_long += turn.long
        turn.decided.set()

    def _leave(self, turn: _Turn) -> None:
        place = self._waiting.get(turn.owner)
        if place is not None and turn in place:
            place.remove(turn)
            if not place:
                del self._waiting[turn.owner]

    def _go_on(self) -> None:
        while (turn := next(self._ready(), None)) is not None:
            self._leave(turn)
            if turn.owner in self._waiting:
                self._waiting.move_to_end(turn.owner)
            self._begin(turn)

    def _ready(self) -> Iterator[_Turn]:
        for place in self._waiting.values():
            yield from (turn for turn in place if self._may_begin(turn))
