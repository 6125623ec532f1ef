"""The application."""

import gc
from collections.abc import AsyncIterator, Awaitable, Mapping, Sequence
from contextlib import asynccontextmanager
from functools import partial
from typing import Any

from anyio import create_task_group, to_thread
from fastapi import Depends, FastAPI
from starlette.middleware import Middleware
from starlette.types import ASGIApp, Receive, Scope, Send
from uvicorn.middleware.proxy_headers import ProxyHeadersMiddleware

from schemas.base.version import package_version
from service.common import validation
from service.documents import faults as document_faults
from service.fairness import faults as fairness_faults
from service.fairness.quotas import quotas
from service.fairness.scheduler import FairScheduler
from service.fairness.single_flight import SingleFlight
from service.fairness.table import shares
from service.fairness.threads import Threads
from service.guard import faults as guard_faults
from service.guard.access import Access
from service.guard.hosts import Hosts
from service.guard.keys import keys
from service.guard.rates import RateLimits
from service.guard.users import Users
from service.http import faults as http_faults
from service.http.computing import Computing
from service.http.cut import Cut
from service.http.direct import Direct
from service.http.errors import ErrorAnswers, union
from service.http.methods import Methods
from service.http.openapi import Documented
from service.http.parameters import of_the_route
from service.jobs import faults as job_faults
from service.jobs.desk import JobService
from service.jobs.events import Watch
from service.routes import computations, effects, examples, guide, health, portal, problems, reference_page, sweeps
from service.routes import faults as route_faults
from service.routes import metrics as metrics_route
from service.routes import version as version_route
from service.settings import Settings
from service.watch import faults as watch_faults
from service.watch.memory import give_back
from service.watch.metrics import Metrics
from service.watch.needs import database, disk, workers
from service.watch.readiness import Readiness
from service.watch.request_log import RequestLog
from service.watch.tracing import tracing
from service.wire import leaving
from service.wire.cors import Cors
from service.wire.pacing import Pacing
from service.wire.security_headers import SecurityHeaders
from service.workers import faults as worker_faults
from service.workers.pool import Pool

_RESOURCES = (sweeps, effects, examples, health, version_route, metrics_route, problems, portal)

#: what is said about every exception, as the rooms declare it; the last one is the last resort
FAULTS = union(
    validation.FAULTS,
    document_faults.FAULTS,
    fairness_faults.FAULTS,
    guard_faults.FAULTS,
    job_faults.FAULTS,
    worker_faults.FAULTS,
    watch_faults.FAULTS,
    leaving.FAULTS,
    route_faults.FAULTS,
    http_faults.FAULTS,
)

#: what pages of the origins that are allowed may send and read
CORS: Mapping[str, Any] = {
    "allow_methods": ("GET", "HEAD", "POST", "DELETE"),
    "allow_headers": (
        "Authorization",
        "Content-Type",
        "Idempotency-Key",
        "If-None-Match",
        "Last-Event-ID",
        "Prefer",
        "Traceparent",
        "X-API-Key",
        "X-Request-ID",
    ),
    "expose_headers": (
        "Content-Disposition",
        "ETag",
        "Idempotency-Replayed",
        "Link",
        "Location",
        "Preference-Applied",
        "RateLimit",
        "RateLimit-Policy",
        "Retry-After",
        "Sweep-Complete",
        "Sweep-State",
        "X-Request-ID",
    ),
}

_DESCRIPTION = """\
Certified optimum counterweights for reciprocating and scroll machines.

Angles are degrees, counter-clockwise about +z from +x, as drawn at shaft angle 0. Every physical field carries its
unit as a suffix; a number is in that unit, a string such as `"140 mm"` is read with its own.
"""


def create_app(settings: Settings | None = None, warm: bool = True, jobs: JobService | None = None) -> FastAPI:
    """The service as an ASGI application.

    Parameters
    ----------
    settings : by default from the environment.
    warm : start the workers in the background, and be ready when they are; else be ready at once, and start workers at
        the first request for one.
    jobs : by default as the settings have it.

    Raises
    ------
    ValueError
        if the settings name an engine or a database that there is not, keys that cannot be read, or no keys on an
        address that other machines reach.
    """
    options = settings or Settings()
    desk = jobs or JobService(options)
    table = shares(options)
    pool = Pool(
        table,
        options.request_timeout_s,
        options.solve_memory_mb,
        options.data_dir,
    )
    threads, rounds, errors = Threads(table["threads"]), FairScheduler(), ErrorAnswers(FAULTS)
    readiness = Readiness(
        {
            "database": partial(database, desk.counts),
            "disk": partial(disk, options.data_dir, options.min_free_mb),
            "workers": partial(workers, lambda: pool.pids),
        },
        threads,
        "warming" if warm else "ready",
    )
    metrics = Metrics(pool, desk.counts, desk.faults)
    traces = tracing(options)

    def warm_up() -> None:
        pool.open()
        # what is loaded by now stays. Each full collection of garbage would stop everything for a tenth of a second to
        # look through all of it again; where many ask there are some a second
        gc.collect()
        gc.freeze()

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        async with create_task_group() as tasks:
            if warm:
                tasks.start_soon(readiness.warm, warm_up)
                tasks.start_soon(give_back)
            desk.open()
            tasks.start_soon(readiness.watch)
            tasks.start_soon(app.state.watch.run)
            yield
            # not on the loop: events that are still open may need it to end
            await to_thread.run_sync(desk.close)
            await to_thread.run_sync(pool.close)
            await to_thread.run_sync(traces.close)
            tasks.cancel_scope.cancel()

    def template(scope: Scope) -> str | None:
        return methods.template(scope)

    app = Application(
        (
            Middleware(HeadAsGet),
            *_behind_proxies(options),
            Middleware(RequestLog, metrics, traces, template, options.log_machines),
            Middleware(Cut, errors),
            Middleware(SecurityHeaders, options.hsts_s),
            Middleware(Cors, options.cors_origins, **CORS),
            Middleware(Pacing, rounds),
            Middleware(
                Access,
                keys(options),
                Hosts(options.allowed_hosts),
                RateLimits(options),
                quotas(table),
                errors.answer,
            ),
            Middleware(Direct, computations.endpoints(), errors),
        ),
        keyed=options.keys_file is not None,
        title="counterweight",
        contact={"name": "The Counterweight authors"},
        version=package_version(),
        description=_DESCRIPTION,
        lifespan=lifespan,
        dependencies=[Depends(of_the_route)],
        redirect_slashes=False,
        # the service traces by itself
        telemetry={"tracing": False, "metrics": False, "logs": False},
    )
    app.state.frame_origins = options.frame_origins
    app.state.readiness = readiness
    app.state.desk = desk
    app.state.sweep_workers = options.sweep_workers
    app.state.pool = pool
    app.state.threads = threads
    app.state.rounds = rounds
    app.state.looks = SingleFlight(rounds.turn)
    app.state.watch = Watch(desk.of())
    app.state.metrics = metrics
    app.state.computing = Computing(options, readiness, pool, metrics, traces)
    methods = _routes(app, options)
    errors.install(app, methods)
    return app


def _routes(app: FastAPI, settings: Settings) -> Methods:
    """All routes into the application, and the methods at their paths."""
    routers = [computations.router(), *(resource.router for resource in _RESOURCES)]
    for router in routers:
        app.include_router(router)
    reference_page.install(app)
    guide.install(app, settings.guide_dir)
    return Methods(route for router in [app, *routers] for route in router.routes)


def _behind_proxies(settings: Settings) -> Sequence[Middleware]:
    """What believes proxies, where there are any."""
    if not settings.trusted_proxies:
        return ()
    proxies = Middleware(ProxyHeadersMiddleware, list(settings.trusted_proxies))
    return Middleware(Users, settings.owner_header, settings.trusted_proxies), proxies


class Application(Documented):
    """With something around everything, also around what answers the exceptions that nobody else does."""

    def __init__(self, outer: Sequence[Middleware], **settings_of: Any) -> None:
        super().__init__(**settings_of)
        self._outer = outer

    def build_middleware_stack(self) -> ASGIApp:
        stack = super().build_middleware_stack()
        for around in reversed(self._outer):
            stack = around.cls(stack, *around.args, **around.kwargs)
        return stack


class HeadAsGet:
    """HEAD is answered wherever GET is; the server leaves out the body, and streams look for ``head`` in the scope."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    def __call__(self, scope: Scope, receive: Receive, send: Send) -> Awaitable[None]:
        if scope["type"] == "http" and scope["method"] == "HEAD":
            scope = {**scope, "method": "GET", "head": True}
        return self.app(scope, receive, send)
