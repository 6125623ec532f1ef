"""Whose computation begins next: who has had least, so that nobody waits behind all that another one asks."""

import asyncio
import time
from collections import OrderedDict, deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from service.fairness.accounts import Accounts
from service.fairness.loads import Loads
from service.fairness.table import Share

#: whoever waits and has had no turn for so long is before all who have had less [s]
PATIENCE_S = 2.0
#: who had a turn, or waited for several, for a larger share of the last seconds asks without end
_NOW_AND_THEN = 0.5


class Full(Exception):
    """As many as may wait are waiting already, of this owner or altogether."""


@dataclass(eq=False)
class Turn:
    """Asked for, waited for and had in an ``async with``; or step by step, and then ended in any case.

    begun_at : on the clock of the turns [s].
    computed_s : what a core has computed in it [s]; by default as long as it lasted.
    above : it is one above the size.
    seldom : its owner had little when it began: whoever asks without end gives way to it.
    refused : another owner has its place.
    waits : done once it has begun or is refused; None where nobody waits.
    """

    turns: "FairQueue"
    owner: str
    asks_for_place: bool = False
    begun: bool = False
    begun_at: float = 0.0
    computed_s: float | None = None
    ended: bool = False
    above: bool = False
    seldom: bool = False
    refused: bool = False
    waits: asyncio.Future[None] | None = None

    async def granted(self) -> None:
        """Wait until it begins; who has stopped waiting may wait again.

        Raises
        ------
        Full
            at once, or when another owner gets the place.
        """
        self.turns.ask(self)
        if not (self.begun or self.refused):
            self.waits = asyncio.get_running_loop().create_future()
            await self.waits
        if not self.begun:
            raise Full

    def decide(self) -> None:
        """Go on with whoever waits for it, as it has begun or is refused."""
        # who waited may be gone
        if self.waits is not None and not self.waits.done():
            self.waits.set_result(None)

    def end(self) -> None:
        """It is over, or nobody waits for it any more."""
        # else nobody knows of it
        if self.asks_for_place and not self.ended:
            self.turns.end(self)

    async def __aenter__(self) -> "Turn":
        try:
            await self.granted()
        except BaseException:
            self.end()
            raise
        return self

    async def __aexit__(self, *raised: object) -> None:
        self.end()


class FairQueue:
    """So many turns at a time, and some above them for owners who have none, and had little lately.

    Next is the owner who has had turns for the least time, each in the order of its calls. But nobody waits for ever,
    however many come who have had nothing. When as many wait as may, the owner of whom most wait gives up its last
    place to one of whom fewer wait.

    Little is at most half of an equal share of the cores that turns are for, among all owners who have a turn or wait.
    For at least half of the time, the owner had no turn and waited for one at most. On a full machine, owners who ask
    without end may get as little of a core as one who asks now and then. But they have a turn or wait for several all
    the time, so they leave those turns to him. What the busiest had is no measure: beside one whose computations are
    long, all others would have had little.

    Parameters
    ----------
    processes : turns at a time, of which some are kept for owners who have none.
    places : who may wait.
    clock : seconds that only go forward.
    """

    def __init__(self, processes: Share, places: Share, clock: Callable[[], float] = time.monotonic) -> None:
        self.size = processes.altogether
        self._most_above = processes.reserve
        self._places = places
        self._clock = clock
        self._accounts, self._loads = Accounts(clock), Loads(clock)
        # share of the last seconds in which owners had a turn or waited for several, and who does now. One that waits
        # once is no pressure, else it would wait ever longer
        self._pressure = Loads(clock)
        self._pressing: set[str] = set()
        self._running: dict[str, int] = {}
        self._begun: set[Turn] = set()
        self._above = 0
        #: set while anybody waits
        self.crowded = asyncio.Event()
        # who began last is last
        self._waiting: OrderedDict[str, deque[Turn]] = OrderedDict()
        # when they began to wait, or had a turn
        self._since: dict[str, float] = {}

    @property
    def waiting(self) -> int:
        """How many wait."""
        return sum(map(len, self._waiting.values()))

    def more(self, owner: str) -> bool:
        """Whether an owner has more than one turn, or waits for one."""
        return self._running.get(owner, 0) > 1 or owner in self._waiting

    def gives_way(self, turn: Turn) -> bool:
        """Whether the owner of a turn asks without end while somebody has one who asks now and then."""
        return not turn.seldom and any(other.seldom for other in self._begun)

    def turn(self, owner: str) -> Turn:
        """A turn to wait for, and to have."""
        return Turn(self, owner)

    def end(self, turn: Turn) -> None:
        """A turn is over, or nobody waits for it any more."""
        turn.ended = True
        if turn.begun:
            self._begun.remove(turn)
            left = self._running.pop(turn.owner) - 1
            if left:
                self._running[turn.owner] = left
            self._above -= turn.above
            self._accounts.take(turn.owner, -1)
            lasted_s = self._clock() - turn.begun_at
            self._loads.end(turn.owner, lasted_s, lasted_s if turn.computed_s is None else turn.computed_s)
        else:
            self._leave(turn)
        if turn.owner in self._accounts and turn.owner not in self._running and turn.owner not in self._waiting:
            self._accounts.go(turn.owner)
        self._weigh(turn.owner)
        if self._waiting:
            self._go_on()

    def ask(self, turn: Turn) -> None:
        """Have it begin, or wait for its decision."""
        if turn.asks_for_place:
            return
        turn.asks_for_place = True
        if turn.owner not in self._accounts:
            self._accounts.come(turn.owner)
        # whoever waits may not begin, so nobody is overtaken
        if self._may_begin(turn):
            self._begin(turn)
            return
        own = len(self._waiting.get(turn.owner, ()))
        if own >= self._places.per_client:
            raise Full
        if self.waiting >= self._places.altogether:
            longest = max(self._waiting.values(), key=len, default=None)
            if longest is None or len(longest) <= own + 1:
                raise Full
            victim = longest[-1]
            self._leave(victim)
            victim.refused = True
            victim.decide()
        if not own:
            self._waiting[turn.owner] = deque()
            self._since[turn.owner] = self._clock()
        self._waiting[turn.owner].append(turn)
        self._weigh(turn.owner)
        self.crowded.set()

    def _may_begin(self, turn: Turn) -> bool:
        return self._is_free() or (self._above < self._most_above and self._had_little(turn.owner))

    def _had_little(self, owner: str) -> bool:
        # averages tell of an owner who has just come only later
        if owner in self._pressing:
            return False
        owners = {*self._running, *self._waiting, owner}
        now_and_then = self._pressure.of(owner) <= _NOW_AND_THEN
        return now_and_then and self._loads.of(owner) <= 0.5 * self.size / len(owners)

    def _is_free(self) -> bool:
        return len(self._begun) - self._above < self.size

    def _begin(self, turn: Turn) -> None:
        turn.begun, turn.begun_at, turn.above = True, self._clock(), not self._is_free()
        turn.seldom = self._had_little(turn.owner)
        self._above += turn.above
        self._begun.add(turn)
        self._running[turn.owner] = self._running.get(turn.owner, 0) + 1
        self._accounts.take(turn.owner, 1)
        self._loads.take(turn.owner)
        self._weigh(turn.owner)
        turn.decide()

    def _weigh(self, owner: str) -> None:
        presses = owner in self._running or len(self._waiting.get(owner, ())) > 1
        if presses and owner not in self._pressing:
            self._pressing.add(owner)
            self._pressure.take(owner)
        elif not presses and owner in self._pressing:
            self._pressing.remove(owner)
            self._pressure.end(owner, 0.0, 0.0)

    def _leave(self, turn: Turn) -> None:
        place = self._waiting.get(turn.owner)
        if place is not None and turn in place:
            place.remove(turn)
            if not place:
                del self._waiting[turn.owner], self._since[turn.owner]
        if not self._waiting:
            self.crowded.clear()

    def _go_on(self) -> None:
        while (turn := next(self._ready(), None)) is not None:
            self._leave(turn)
            if turn.owner in self._waiting:
                self._waiting.move_to_end(turn.owner)
                self._since[turn.owner] = self._clock()
            self._begin(turn)

    def _ready(self) -> Iterator[Turn]:
        # most often another owner has the free place already: who cannot begin is not asked one by one
        free = self._is_free()
        if self._above >= self._most_above and not free:
            return
        patient_s = self._clock() - PATIENCE_S

        def rank(owner: str) -> tuple[float, float]:
            return min(self._since[owner], patient_s), self._accounts.had(owner)

        for owner in sorted(self._waiting, key=rank):
            if free or self._had_little(owner):
                yield from (turn for turn in self._waiting[owner] if self._may_begin(turn))
