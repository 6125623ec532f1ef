"""Computing time of each owner lately: it separates who asks now and then from who asks without end."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import islice

#: what was so long ago counts for a third of what is now [s]
LATELY_S = 5.0
#: who came so long ago is judged by what he had since [s]: in less nobody can ask for much
_NEW_S = 1.0
#: of which nothing is remembered
_NOTHING = 0.001


@dataclass(slots=True)
class _Load:
    """An average that began with nothing, and since when [s]."""

    since: float
    average: float
    turns: int
    at: float

    def now(self, at: float) -> float:
        return self.turns + (self.average - self.turns) * math.exp((self.at - at) / LATELY_S)


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
        """The average of an owner, whoever it is, without the nothing that it began with."""
        load = self._loads.get(owner)
        if load is None:
            return 0.0
        at = self._clock()
        return load.now(at) / -math.expm1(min(load.since - at, -_NEW_S) / LATELY_S)

    def take(self, owner: str) -> None:
        """Begin a turn of an owner."""
        self._change(owner, 1, 0.0)

    def end(self, owner: str, lasted_s: float, computed_s: float) -> None:
        """End a turn that an owner had until now, in which a core computed for part of the time [s]."""
        weight = -math.expm1(-lasted_s / LATELY_S)
        share = min(1.0, computed_s / lasted_s) if lasted_s > 0 else 1.0
        self._change(owner, -1, (share - 1.0) * weight)

    def _change(self, owner: str, turns: int, average: float) -> None:
        at = self._clock()
        load = self._loads.pop(owner, None)
        if load is None:
            load = _Load(at, average, turns, at)
        else:
            load.average, load.turns, load.at = load.now(at) + average, load.turns + turns, at
        self._loads[owner] = load
        # one comes at most, so they do not become many; one turn may be nothing where many are much
        for name, other in tuple(islice(self._loads.items(), 2)):
            if not other.turns and at - other.at >= _NEW_S and other.now(at) < _NOTHING:
                del self._loads[name]
