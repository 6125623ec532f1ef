"""The short way to routes that take bytes and give bytes."""

from collections.abc import Callable, Coroutine, Mapping
from dataclasses import dataclass
from typing import Any

from starlette.requests import Request
from starlette.responses import Response
from starlette.types import ASGIApp, Receive, Scope, Send

from service.guard.access import own_path
from service.http.errors import ErrorAnswers

#: answers a request, or says in an exception why it does not
Endpoint = Callable[[Request], Coroutine[Any, Any, Response]]


@dataclass(frozen=True)
class Template:
    """What a route is called in log and metrics."""

    path: str


class Direct:
    """Takes POST requests to some endpoints, by their paths.

    The framework's way to a route looks for what they do not have, for a tenth of the front's work.

    Parameters
    ----------
    app : answers all else, another method at these paths too.
    """

    def __init__(self, app: ASGIApp, endpoints: Mapping[str, Endpoint], errors: ErrorAnswers) -> None:
        self._app = app
        self._endpoints = endpoints
        self._errors = errors

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        path = own_path(scope) if scope["type"] == "http" and scope["method"] == "POST" else ""
        endpoint = self._endpoints.get(path)
        if endpoint is None:
            await self._app(scope, receive, send)
            return
        scope["route"] = Template(path)
        unforeseen: Exception | None = None
        try:
            response = await endpoint(Request(scope, receive, send))
        except Exception as error:
            response = self._errors.answer(error, scope["path"])
            if not self._errors.foreseen(error):
                unforeseen = error
            else:
                # one that several wait for would grow with each of them
                error.__traceback__ = None
        await response(scope, receive, send)
        if unforeseen is not None:
            # the server logs it
            raise unforeseen
