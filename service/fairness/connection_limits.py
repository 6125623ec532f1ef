"""Which connections are let in: some for each address, some altogether, and a few more for those who ask for health."""

from collections.abc import Callable, Iterable

from service.common.addresses import Networks
from service.fairness.client import client_network
from service.fairness.quotas import Quota
from service.fairness.table import PROBES, Share


class ConnectionLimits:
    """Counts the connections of a service.

    Parameters
    ----------
    share : open ones, the clients of which are addresses.
    proxies : addresses and networks behind which there are many clients.
    """

    def __init__(self, share: Share, proxies: Iterable[str]) -> None:
        self._proxies = Networks(proxies)
        self._open = Quota(share)
        self._probing: dict[str, list[Callable[[], None]]] = {}

    def enter(self, address: str) -> bool:
        """Whether there is room for a connection from an address; it is counted then."""
        return self._open.take(client_network(address), many=address in self._proxies)

    def leave(self, address: str) -> None:
        """A connection that was let in has ended."""
        self._open.give(client_network(address))

    def probe(self, address: str, give_up: Callable[[], None]) -> None:
        """Let in a connection that may ask for health, in place of the one that does so for longest if there are many.

        Parameters
        ----------
        give_up : called, once at most, when another one takes the place.
        """
        own = self._probing.setdefault(client_network(address), [])
        own.append(give_up)
        if len(own) > PROBES.per_client:
            own.pop(0)()
        elif sum(map(len, self._probing.values())) > PROBES.altogether:
            max(self._probing.values(), key=len).pop(0)()

    def probed(self, address: str, give_up: Callable[[], None]) -> None:
        """A connection that could ask for health has ended."""
        client = client_network(address)
        own = self._probing.get(client, [])
        if give_up in own:
            own.remove(give_up)
        if not own:
            self._probing.pop(client, None)
