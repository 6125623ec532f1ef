"""A computation behind a route: bytes in, bytes out, off the event loop and only so many at a time."""

from collections.abc import Callable
from typing import Annotated, TypeVar

from anyio import CapacityLimiter, to_thread
from fastapi import Depends
from starlette.requests import Request
from starlette.responses import Response

from schemas.base import Model
from service.readiness import Readiness
from service.request_body import read_body
from service.settings import Settings
from service.validation import check, read_json

Question = TypeVar("Question", bound=Model)


class Computing:
    """Computes answers, once the service is ready."""

    def __init__(self, settings: Settings, readiness: Readiness) -> None:
        self._max_body_bytes = settings.max_body_bytes
        self._readiness = readiness
        self._limiter = CapacityLimiter(settings.concurrent_solves)

    async def answer(self, request: Request, model: type[Question], compute: Callable[[Question], Model]) -> Response:
        """The answer to the question in the body.

        Raises
        ------
        NotReady, UnsupportedMedia, BodyTooLarge, UnreadableJson, InvalidRequest, MissingInput, OutOfRange
            all of which have a row in the table of :mod:`service.errors`.
        """
        self._readiness.require()
        body = await read_body(request, self._max_body_bytes)

        def work() -> str:
            return compute(check(model, read_json(body))).model_dump_json()

        content = await to_thread.run_sync(work, limiter=self._limiter)
        return Response(content, media_type="application/json", headers={"Cache-Control": "no-store"})


def computing(request: Request) -> Computing:
    """The application's :class:`Computing`."""
    found: Computing = request.app.state.computing
    return found


Computes = Annotated[Computing, Depends(computing)]
