"""What each owner has had of what all share, so that who has had least is next."""

from collections.abc import Callable
from dataclasses import dataclass


@dataclass
class _Account:
    had_s: float
    turns: int
    at: float

    def now(self, at: float) -> float:
        return self.had_s + self.turns * (at - self.at)


class Accounts:
    """Seconds for which owners had turns, of those who have or want one.

    A new owner counts as having had no less than the least of those who are here. So nobody gathers credit by staying
    away, and the share of an owner who was alone is not held against it.
    Source: P. Goyal, H. M. Vin and H. Cheng, Start-time fair queueing, SIGCOMM 1996; by the time that turns last, as
    nobody knows it before.

    Parameters
    ----------
    clock : seconds that only go forward.
    """

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._here: dict[str, _Account] = {}
        #: of those who left with more than the least of those who stayed
        self._left: dict[str, float] = {}
        self._least_s = 0.0

    def __contains__(self, owner: str) -> bool:
        return owner in self._here

    def had(self, owner: str) -> float:
        """What an owner who is here has had [s]."""
        return self._here[owner].now(self._clock())

    def least(self) -> float:
        """The least that anybody who is here has had, and never less than before [s]."""
        if self._here:
            at = self._clock()
            self._least_s = max(self._least_s, min([account.now(at) for account in self._here.values()]))
        return self._least_s

    def come(self, owner: str) -> None:
        """Have an owner here who was not."""
        least, before = self.least(), self._left.pop(owner, 0.0)
        self._here[owner] = _Account(max(before, least), 0, self._clock())

    def go(self, owner: str) -> None:
        """An owner wants no more."""
        had = self._here.pop(owner).now(self._clock())
        if not self._here:
            # whoever comes next is the first
            self._left.clear()
            return
        self._left[owner] = had
        least = self.least()
        self._left = {name: more for name, more in self._left.items() if more > least}

    def take(self, owner: str, turns: int) -> None:
        """Have an owner have so many turns more, or fewer."""
        account, at = self._here[owner], self._clock()
        account.had_s, account.at = account.now(at), at
        account.turns += turns
