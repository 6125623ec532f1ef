"""What one client may hold at a time of what all share, so that its legal traffic harms nobody else."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field

from starlette.requests import Request

from service.fairness.faults import OverShare
from service.fairness.table import OVER_SHARE, Resource, Share


class Quota:
    """What clients hold of one resource."""

    def __init__(self, share: Share) -> None:
        self._share = share
        self._held: Counter[str] = Counter()
        self._total = 0

    def take(self, client: str, amount: int = 1, many: bool = False) -> bool:
        """Whether a client may hold more; it does then.

        Parameters
        ----------
        many : it stands for many clients, who have more than what is there for each.
        """
        share, then = self._share, self._held[client] + amount
        kept = share.kept if then <= share.assured else 0
        if self._total + amount > share.altogether + kept or not (many or then <= max(share.each, share.assured)):
            return False
        self._held[client] = then
        self._total += amount
        return True

    def give(self, client: str, amount: int = 1) -> None:
        """Have a client hold less."""
        self._total -= amount
        self._held[client] -= amount
        if not self._held[client]:
            del self._held[client]

    def held(self, client: str) -> int:
        """What a client holds."""
        return self._held[client]


class Quotas:
    """What is held, by resource and by client."""

    def __init__(self, shares: Mapping[Resource, Share]) -> None:
        self._shares = shares
        self._quotas = {name: Quota(share) for name, share in shares.items() if share.answer is OVER_SHARE}

    def take(self, resource: Resource, who: str, amount: int) -> None:
        """Have a client hold more.

        Raises
        ------
        OverShare
        """
        if not self._quotas[resource].take(who, amount):
            units = self._shares[resource].unit
            raise OverShare(f"Too many {units} are open for this client; try again when some of them have ended.")

    def give(self, resource: Resource, who: str, amount: int) -> None:
        """Have a client hold less."""
        self._quotas[resource].give(who, amount)

    def held(self, resource: Resource, who: str) -> int:
        """What a client holds."""
        return self._quotas[resource].held(who)


@dataclass
class Holding:
    """What one request holds until it has been answered."""

    shares: Quotas
    who: str
    _held: Counter[Resource] = field(default_factory=Counter)

    def take(self, resource: Resource, amount: int = 1) -> None:
        """Hold more.

        Raises
        ------
        OverShare
        """
        self.shares.take(resource, self.who, amount)
        self._held[resource] += amount

    def give(self, resource: Resource, amount: int) -> None:
        """Hold less."""
        self.shares.give(resource, self.who, amount)
        self._held[resource] -= amount

    def end(self) -> None:
        """Hold nothing any more."""
        for resource, amount in self._held.items():
            self.shares.give(resource, self.who, amount)
        self._held.clear()


def holding(request: Request) -> Holding:
    """What a request holds; :class:`~service.guard.access.Access` has made it, and ends it."""
    found: Holding = request.state.holding
    return found
