"""What one client may hold at a time of what all share, so that its legal traffic harms nobody else."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from starlette.requests import Request

from service.fairness.faults import OverShare
from service.fairness.table import OVER_SHARE, Resource, Share


class Quota:
    """What clients hold of one resource."""

    def __init__(self, share: Share) -> None:
        self.share = share
        self._amounts: dict[str, int] = {}
        self._total = 0

    def take(self, client: str, amount: int = 1, many: bool = False) -> bool:
        """Whether a client may hold more; it does then.

        Parameters
        ----------
        many : it stands for many clients, who have more than what is there for each.
        """
        share, then = self.share, self.holding_of(client) + amount
        reserve = share.reserve if then <= share.assured else 0
        if self._total + amount > share.altogether + reserve or not (
            many or then <= max(share.per_client, share.assured)
        ):
            return False
        self._amounts[client] = then
        self._total += amount
        return True

    def give(self, client: str, amount: int = 1) -> None:
        """Have a client hold less."""
        self._total -= amount
        left = self._amounts.pop(client, 0) - amount
        if left:
            self._amounts[client] = left

    def holding_of(self, client: str) -> int:
        """What a client holds."""
        return self._amounts.get(client, 0)


def quotas(shares: Mapping[Resource, Share]) -> Mapping[Resource, Quota]:
    """Of all that requests hold until they have been answered."""
    return {resource: Quota(share) for resource, share in shares.items() if share.answer is OVER_SHARE}


@dataclass
class Holding:
    """What one request holds until it has been answered."""

    quotas: Mapping[Resource, Quota]
    who: str
    _amounts: dict[Resource, int] = field(default_factory=dict)

    def take(self, resource: Resource, amount: int = 1) -> None:
        """Hold more.

        Raises
        ------
        OverShare
        """
        quota = self.quotas[resource]
        if not quota.take(self.who, amount):
            units = quota.share.unit
            raise OverShare(f"Too many {units} are open for this client; try again when some of them have ended.")
        self._amounts[resource] = self._amounts.get(resource, 0) + amount

    def give(self, resource: Resource, amount: int) -> None:
        """Hold less."""
        self.quotas[resource].give(self.who, amount)
        self._amounts[resource] -= amount

    def end(self) -> None:
        """Hold nothing any more."""
        for resource, amount in self._amounts.items():
            self.quotas[resource].give(self.who, amount)
        self._amounts.clear()


def holding(request: Request) -> Holding:
    """What a request holds; :class:`~service.guard.access.Access` has made it, and ends it."""
    result: Holding = request.scope["state"]["holding"]
    return result
