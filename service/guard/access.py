"""Who asks, before a path is even looked at; and, at each route, whether they may."""

from collections.abc import Awaitable, Callable, Mapping
from typing import Any

from fastapi import Depends
from starlette.datastructures import Headers
from starlette.requests import Request
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from service.fairness.client import client_of_request
from service.fairness.quotas import Holding, Quota
from service.fairness.table import Resource
from service.guard.hosts import Hosts
from service.guard.keys import ANYONE, NOBODY, PROBES, PUBLIC, PUBLIC_FOLDERS, Caller, Keys, caller_of
from service.guard.keys import Scope as KeyScope
from service.guard.rates import Rate, RateLimits, TooManyRequests
from service.guard.refusals import BadHeader, Forbidden, ForeignHost, Unauthorized
from service.guard.users import user_of

#: the answer to a request for a path that is refused for a reason
Refused = Callable[[Exception, str], ASGIApp]


def require(request: Request, *scopes: KeyScope) -> None:
    """Go on only if the key of a request allows it, by one of some scopes.

    Raises
    ------
    Forbidden
    """
    if not caller_of(request).may(*scopes):
        raise Forbidden(scopes)


def needs(*scopes: KeyScope) -> Any:
    """What stands at a route that a key must allow, by one of some scopes; for other routes any key will do."""

    async def at_route(request: Request) -> None:
        require(request, *scopes)

    return Depends(at_route)


class Access:
    """Lets requests pass that have a key, and not too many of them.

    Where nobody needs a key, requests for hosts on the list.

    Whose request it is goes into ``state["caller"]``, and what of the service it takes into ``state["holding"]``.
    """

    def __init__(
        self,
        app: ASGIApp,
        keys: Keys | None,
        hosts: Hosts,
        limits: RateLimits,
        quotas: Mapping[Resource, Quota],
        refused: Refused,
    ) -> None:
        self._app = app
        self._keys = keys
        self._hosts = hosts
        self._limits = limits
        self._quotas = quotas
        self._refused = refused

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        try:
            admitted, rate = await self._admitted(scope, self._keys)
            caller = admitted.acting_for(user_of(scope))
        except (Unauthorized, ForeignHost, TooManyRequests, BadHeader) as error:
            await self._refused(error, scope["path"])(scope, receive, send)
            return
        holding = Holding(self._quotas, client_of_request(scope, caller.owner))
        state = scope.setdefault("state", {})
        state.update(caller=caller, holding=holding, still_admitted=lambda: self._still_admitted(scope, caller))
        try:
            await self._app(scope, receive, send if rate is None else _saying(rate, send))
        finally:
            holding.end()
            # it holds the scope that holds it, and with it all of the request until the next collection of garbage
            del state["still_admitted"]

    def _still_admitted(self, scope: Scope, caller: Caller) -> bool:
        if self._keys is None or caller.key is None:
            return True
        now = self._keys.caller(_key(Headers(scope=scope)) or "")
        return now is not None and now.acting_for(user_of(scope)).owner == caller.owner

    async def _admitted(self, scope: Scope, keys: Keys | None) -> tuple[Caller, Rate | None]:
        path = own_path(scope)
        if keys is None:
            # who asks for health comes by whatever address there is, and learns nothing else
            if path not in PROBES:
                self._hosts.require(scope)
            return ANYONE, None
        if path in PUBLIC or path.startswith(PUBLIC_FOLDERS):
            return NOBODY, None
        key = _key(Headers(scope=scope))
        caller = None if key is None else keys.caller(key)
        if caller is None:
            if key is not None:
                await self._limits.refused(client_of_request(scope, None))
            raise Unauthorized(key is not None)
        return caller, await self._limits.count(caller.key or "", caller.rate_limit)


def _saying(rate: Rate, send: Send) -> Send:
    """State with an answer what is left of the rate of its key."""
    headers = [(name.lower().encode(), value.encode()) for name, value in rate.headers.items()]

    def say(message: Message) -> Awaitable[None]:
        if message["type"] == "http.response.start":
            message["headers"] = [*message.get("headers", ()), *headers]
        return send(message)

    return say


def own_path(scope: Scope) -> str:
    """The path of a request without the prefix that a proxy strips."""
    path, prefix = str(scope["path"]), str(scope.get("root_path", "")).rstrip("/")
    return path[len(prefix) :] if prefix and path.startswith(f"{prefix}/") else path


def _key(headers: Headers) -> str | None:
    kind, _, token = headers.get("authorization", "").partition(" ")
    if kind.lower() == "bearer":
        return token.strip()
    return headers.get("x-api-key")
