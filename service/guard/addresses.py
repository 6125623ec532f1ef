"""What an address says: whether other machines reach it, and which client it is."""

import ipaddress

#: one client has as many addresses of IPv6 as it likes, below one prefix of this length
_PREFIX = 64


def is_loopback(host: str) -> bool:
    """Whether only this machine reaches a name or an address."""
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def client_network(address: str) -> str:
    """Which client an address belongs to: itself, or its network of IPv6; what is no address is itself."""
    try:
        found = ipaddress.ip_address(address)
    except ValueError:
        return address
    if found.version == 4 or found.is_loopback:
        return str(found)
    return str(found.ipv4_mapped or ipaddress.ip_network((int(found), _PREFIX), strict=False))
