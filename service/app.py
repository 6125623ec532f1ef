"""The application."""

from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from importlib.metadata import version

from anyio import create_task_group
from fastapi import FastAPI
from starlette.responses import RedirectResponse
from starlette.types import ASGIApp, Receive, Scope, Send

from optimizer import warm_up as solver
from service import docs, errors
from service.computing import Computing
from service.openapi import Documented
from service.readiness import Readiness
from service.routes import analyze, effects, examples, health, optimize, pin_loads, rating
from service.settings import Settings

_DESCRIPTION = """\
Certified optimum counterweights for reciprocating and scroll machines.

Angles are degrees, counter-clockwise about +z from +x, as drawn at shaft angle 0. Every physical field carries its
unit as a suffix; a number is in that unit, a string such as `"140 mm"` is read with its own.
"""


def create_app(settings: Settings | None = None, warm_up: Callable[[], None] = solver.warm_up) -> FastAPI:
    """The service as an ASGI application.

    Parameters
    ----------
    settings : from the environment if not given.
    warm_up : what has to be done, once and in the background, before the service is ready.
    """
    chosen = settings or Settings()
    readiness = Readiness()

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        async with create_task_group() as tasks:
            tasks.start_soon(readiness.warm, warm_up)
            yield
            tasks.cancel_scope.cancel()

    app = Documented(
        title="counterweight",
        version=version("counterweight"),
        description=_DESCRIPTION,
        lifespan=lifespan,
        docs_url=None,
        redoc_url=None,
        redirect_slashes=False,
    )
    app.state.readiness = readiness
    app.state.computing = Computing(chosen, readiness)
    app.add_middleware(HeadAsGet)
    errors.install(app)
    for resource in (optimize, analyze, pin_loads, rating, effects, examples, health):
        app.include_router(resource.router)
    docs.install(app)

    @app.get("/", include_in_schema=False)
    async def home() -> RedirectResponse:
        return RedirectResponse("docs")

    return app


class HeadAsGet:
    """HEAD is answered wherever GET is; the server leaves out the body."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "http" and scope["method"] == "HEAD":
            scope = {**scope, "method": "GET"}
        await self.app(scope, receive, send)
