"""Which client something is for: all that is shared out is counted by this one name."""

import ipaddress
from functools import lru_cache

from starlette.types import Scope

from service.common.addresses import address_of

#: one client has as many addresses of IPv6 as it likes, below one prefix of this length
_PREFIX = 64
#: whose addresses are not read anew with every request
_CLIENTS = 4096


def client_of_request(scope: Scope, owner: str | None) -> str:
    """The owner of the key of a request; its address where nobody needs a key."""
    return f"owner {owner}" if owner is not None else client_network(address_of(scope))


@lru_cache(_CLIENTS)
def client_network(address: str) -> str:
    """Which client an address belongs to: itself, or its network of IPv6; what is no address is itself."""
    try:
        host = ipaddress.ip_address(address)
    except ValueError:
        return address
    if host.version == 4 or host.is_loopback:
        return str(host)
    return str(host.ipv4_mapped or ipaddress.ip_network((int(host), _PREFIX), strict=False))
