"""For whom a portal asks: its users, named in a header, so that one key serves many without mixing their jobs."""

import re
from collections.abc import Sequence

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Receive, Scope, Send

from service.common.addresses import Networks, address_of
from service.guard.refusals import BadHeader

#: what portals know their users by: names, addresses, digests
_USER = re.compile(r"[\x21-\x7e]{1,128}")


class Users:
    """Notes for whom a proxy that is trusted asks; whoever else sends the header says nothing by it.

    It looks at the connection itself, before headers of the proxy are believed about whose it is.

    Parameters
    ----------
    header : its name; none is looked for if it is empty.
    proxies : addresses and networks.
    """

    def __init__(self, app: ASGIApp, header: str, proxies: Sequence[str]) -> None:
        self._app = app
        self._header = header
        self._proxies = Networks(proxies)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if self._header and scope["type"] == "http" and address_of(scope) in self._proxies:
            scope.setdefault("state", {})["users"] = (self._header, Headers(scope=scope).getlist(self._header))
        await self._app(scope, receive, send)


def user_of(scope: Scope) -> str | None:
    """The user of a portal for whom a request is; None where no proxy that is trusted says so.

    Raises
    ------
    BadHeader
        if it is no name, or more than one: a proxy has to put its own in place of what a client sent.
    """
    header, names = scope.get("state", {}).get("users", ("", []))
    if not names:
        return None
    if len(names) > 1 or _USER.fullmatch(names[0]) is None:
        raise BadHeader(f"{header} must be one name of 1 to 128 visible ASCII characters.")
    user: str = names[0]
    return user
