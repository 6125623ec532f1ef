"""What an address says: whether other machines reach it, and which client it is."""

import ipaddress
from collections.abc import Iterable
from functools import lru_cache

#: one client has as many addresses of IPv6 as it likes, below one prefix of this length
_PREFIX = 64
#: whose addresses are not read anew with every request
_CLIENTS = 4096


def is_loopback(host: str) -> bool:
    """Whether only this machine reaches a name or an address."""
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


@lru_cache(_CLIENTS)
def client_network(address: str) -> str:
    """Which client an address belongs to: itself, or its network of IPv6; what is no address is itself."""
    try:
        found = ipaddress.ip_address(address)
    except ValueError:
        return address
    if found.version == 4 or found.is_loopback:
        return str(found)
    return str(found.ipv4_mapped or ipaddress.ip_network((int(found), _PREFIX), strict=False))


class Networks:
    """A list of addresses and networks, as ``in`` asks; ``*`` is any, and a name is itself."""

    def __init__(self, listed: Iterable[str]) -> None:
        self._names = frozenset(listed)
        self._networks = tuple(found for found in map(_network, self._names) if found is not None)

    def __contains__(self, address: str) -> bool:
        if "*" in self._names or address in self._names:
            return True
        try:
            found = ipaddress.ip_address(address)
        except ValueError:
            return False
        return any(found in network for network in self._networks)


def _network(text: str) -> ipaddress.IPv4Network | ipaddress.IPv6Network | None:
    try:
        return ipaddress.ip_network(text, strict=False)
    except ValueError:
        return None
