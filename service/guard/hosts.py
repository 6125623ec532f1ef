"""For which hosts the service answers where nobody needs a key.

A web page may give its own name the address of this machine (DNS rebinding), and a browser then lets it ask here as if
it asked at home. The header ``Host`` shows it: it holds the name of the page.
"""

import re
from collections.abc import Iterable

from starlette.types import Scope

from service.common.addresses import is_loopback
from service.common.headers import header
from service.guard.refusals import ForeignHost

_HOST = re.compile(r"(?:\[([0-9A-Fa-f:.]+)\]|([^:\[\]/@]+))(?::[0-9]*)?")


class Hosts:
    """Names and addresses of this machine for itself, the address that a request came to, and those of a list.

    Parameters
    ----------
    hosts : further ones; ``*`` is any.
    """

    def __init__(self, hosts: Iterable[str]) -> None:
        self._hosts = frozenset(map(str.lower, hosts))

    def require(self, scope: Scope) -> None:
        """Go on only if a request asks for one of them; browsers always say for which.

        Raises
        ------
        ForeignHost
        """
        text = header(scope, b"host")
        if text is None or "*" in self._hosts:
            return
        match = _HOST.fullmatch(text)
        host = (match[1] or match[2]).lower().removesuffix(".") if match else ""
        came_to = (scope.get("server") or ("",))[0]
        if not (host in self._hosts or is_loopback(host) or host.endswith(".localhost") or (host and host == came_to)):
            raise ForeignHost
