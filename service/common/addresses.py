"""What an address says: whether other machines reach it, and on which lists it is."""

import ipaddress
from collections.abc import Iterable
from functools import lru_cache

from starlette.types import Scope

#: names by which requests come, which are few
_NAMES = 256


@lru_cache(_NAMES)
def is_loopback(host: str) -> bool:
    """Whether only this machine reaches a name or an address."""
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def address_of(scope: Scope) -> str:
    """The address from which a request comes; empty where the server does not know."""
    return str((scope.get("client") or ("",))[0])


class Networks:
    """A list of addresses and networks, as ``in`` asks; ``*`` is any, and a name is itself."""

    def __init__(self, names: Iterable[str]) -> None:
        self._names = frozenset(names)
        self._networks = tuple(network for network in map(_network, self._names) if network is not None)

    def __contains__(self, address: str) -> bool:
        if "*" in self._names or address in self._names:
            return True
        try:
            host = ipaddress.ip_address(address)
        except ValueError:
            return False
        return any(host in network for network in self._networks)


def _network(text: str) -> ipaddress.IPv4Network | ipaddress.IPv6Network | None:
    try:
        return ipaddress.ip_network(text, strict=False)
    except ValueError:
        return None
