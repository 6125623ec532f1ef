"""How much was computed for each owner lately, so that who asks now and then is told from who asks without end."""

import math
from collections.abc import Callable
from itertools import islice
from typing import NamedTuple

#: what was so long ago counts for a third of what is now [s]
LATELY_S = 5.0
#: who came so long ago is judged by what he had since [s]: in less nobody can ask for much
_NEW_S = 1.0
#: of which nothing is remembered
_NOTHING = 0.001


class _Load(NamedTuple):
    """An average that began with nothing, and since when [s]."""

    since: float
    average: float
    turns: int
    at: float

    def now(self, at: float) -> float:
        return self.turns + (self.average - self.turns) * math.exp((self.at - at) / LATELY_S)

    def corrected(self, at: float) -> float:
        """The average without the nothing that it began with."""
        return self.now(at) / -math.expm1(min(self.since - at, -_NEW_S) / LATELY_S)


class Loads:
    """Cores that owners had on the average of the last seconds, or since they came, as systems tell how many processes
    run.

    A turn that runs counts as one core. Once it has ended, it counts for what was computed in it: where others compute
    too, a turn lasts longer, and that is no fault of its owner.

    Parameters
    ----------
    clock : seconds that only go forward.
    """

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        # who changed last is last
        self._loads: dict[str, _Load] = {}

    def of(self, owner: str) -> float:
        """The average of an owner, whoever it is."""
        load = self._loads.get(owner)
        return 0.0 if load is None else load.corrected(self._clock())

    def take(self, owner: str) -> None:
        """Begin a turn of an owner."""
        self._change(owner, 1, 0.0)

    def end(self, owner: str, lasted_s: float, computed_s: float) -> None:
        """End a turn that an owner had until now, in which a core computed for part of the time [s]."""
        counted = -math.expm1(-lasted_s / LATELY_S)
        share = min(1.0, computed_s / lasted_s) if lasted_s > 0 else 1.0
        self._change(owner, -1, (share - 1.0) * counted)

    def _change(self, owner: str, turns: int, average: float) -> None:
        at = self._clock()
        load = self._loads.pop(owner, None) or _Load(at, 0.0, 0, at)
        self._loads[owner] = _Load(load.since, load.now(at) + average, load.turns + turns, at)
        # one comes at most, so they do not become many; one turn may be nothing where many are much
        for name, other in tuple(islice(self._loads.items(), 2)):
            if not other.turns and at - other.at >= _NEW_S and other.now(at) < _NOTHING:
                del self._loads[name]
