"""Who asks, and whether they may: before a path is even looked at."""

from collections.abc import Mapping

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Receive, Scope, Send

from service.guard.addresses import client_network
from service.guard.hosts import Hosts
from service.guard.keys import ANYONE, NOBODY, PROBES, PUBLIC, PUBLIC_FOLDERS, Caller, Keys
from service.guard.keys import Scope as KeyScope
from service.guard.rates import RateLimits, TooManyRequests
from service.guard.refusals import Forbidden, ForeignHost, Unauthorized
from service.http.errors import answered

#: any key will do
_ANY: tuple[KeyScope, ...] = ("compute", "sweeps", "read", "metrics")
#: a job may also come from a computing route, with Prefer: respond-async
_JOBS: Mapping[str, tuple[KeyScope, ...]] = {
    "GET": ("sweeps", "read", "compute"),
    "POST": ("sweeps",),
    "DELETE": ("sweeps", "compute"),
}


class Access:
    """Lets requests pass that have a key with the scope they need, and not too many of them.

    Where nobody needs a key, those for hosts that are known.

    Whose request it is goes into ``state["caller"]``, and whose share of the service it takes into ``state["who"]``.
    """

    def __init__(self, app: ASGIApp, keys: Keys | None, hosts: Hosts, limits: RateLimits) -> None:
        self._app = app
        self._keys = keys
        self._hosts = hosts
        self._limits = limits

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        try:
            caller = await self._admitted(scope, self._keys)
        except (Unauthorized, Forbidden, ForeignHost, TooManyRequests) as error:
            await answered(error, scope["path"])(scope, receive, send)
            return
        scope.setdefault("state", {}).update(caller=caller, who=_who(scope, caller))
        await self._app(scope, receive, send)

    async def _admitted(self, scope: Scope, keys: Keys | None) -> Caller:
        path = _own_path(scope)
        if keys is None:
            # who asks for health comes by whatever address there is, and learns nothing else
            if path not in PROBES:
                self._hosts.require(scope)
            return ANYONE
        if path in PUBLIC or path.startswith(PUBLIC_FOLDERS):
            return NOBODY
        given = _key(Headers(scope=scope))
        caller = None if given is None else keys.caller(given)
        if caller is None:
            if given is not None:
                await self._limits.refused((scope.get("client") or ("",))[0])
            raise Unauthorized(given is not None)
        await self._limits.asked(caller.key or "", caller.rate_limit)
        needed = _needed(scope["method"], path)
        if not caller.may(*needed):
            raise Forbidden(needed)
        return caller


def _who(scope: Scope, caller: Caller) -> str:
    return f"owner {caller.owner}" if caller.owner is not None else client_network((scope.get("client") or ("",))[0])


def _own_path(scope: Scope) -> str:
    path, prefix = str(scope["path"]), str(scope.get("root_path", "")).rstrip("/")
    return path[len(prefix) :] if prefix and path.startswith(f"{prefix}/") else path


def _key(headers: Headers) -> str | None:
    kind, _, token = headers.get("authorization", "").partition(" ")
    if kind.lower() == "bearer":
        return token.strip()
    return headers.get("x-api-key")


def _needed(method: str, path: str) -> tuple[KeyScope, ...]:
    if path == "/metrics":
        return ("metrics",)
    if path == "/v1/sweeps" or path.startswith("/v1/sweeps/"):
        return _JOBS.get(method, _ANY)
    return ("compute",) if method == "POST" else _ANY
