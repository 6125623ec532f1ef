"""Which connections are let in: some for each address, some altogether, and a few more for those who ask for health."""

from collections import Counter
from collections.abc import Callable, Iterable

from service.common.addresses import Networks, client_network

#: every so many-th connection is kept for those who have fewer than these
_KEPT, _FEW = 10, 8
#: further connections of an address, and altogether, that may ask for health and nothing else
_PROBING_EACH = 4
_PROBING = 32


class Doors:
    """Counts the connections of a service.

    Parameters
    ----------
    altogether, each : open ones, and those of one address.
    proxies : addresses and networks behind which there are many clients.
    """

    def __init__(self, altogether: int, each: int, proxies: Iterable[str]) -> None:
        self._altogether = altogether
        self._each = each
        self._proxies = Networks(proxies)
        self._open: Counter[str] = Counter()
        self._all = 0
        self._probing: dict[str, list[Callable[[], None]]] = {}

    def enter(self, address: str) -> bool:
        """Whether there is room for a connection from an address; it is counted then."""
        client = client_network(address)
        kept = 0 if self._open[client] < _FEW else self._altogether // _KEPT
        room = self._all < self._altogether - kept
        if not (room and (self._open[client] < self._each or address in self._proxies)):
            return False
        self._open[client] += 1
        self._all += 1
        return True

    def leave(self, address: str) -> None:
        """A connection that was let in has ended."""
        client = client_network(address)
        self._all -= 1
        self._open[client] -= 1
        if not self._open[client]:
            del self._open[client]

    def probe(self, address: str, give_up: Callable[[], None]) -> None:
        """Let in a connection that may ask for health, in place of the one that does so for longest if there are many.

        Parameters
        ----------
        give_up : called, once at most, when another one takes the place.
        """
        own = self._probing.setdefault(client_network(address), [])
        own.append(give_up)
        if len(own) > _PROBING_EACH:
            own.pop(0)()
        elif sum(map(len, self._probing.values())) > _PROBING:
            max(self._probing.values(), key=len).pop(0)()

    def probed(self, address: str, give_up: Callable[[], None]) -> None:
        """A connection that could ask for health has ended."""
        client = client_network(address)
        own = self._probing.get(client, [])
        if give_up in own:
            own.remove(give_up)
        if not own:
            self._probing.pop(client, None)
