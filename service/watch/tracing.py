"""Traces for OpenTelemetry, if configured: a span for every request, and one inside for its computation."""

from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from typing import Protocol

from starlette.datastructures import Headers
from starlette.types import Scope

from schemas.base.version import package_version
from service.settings import Settings

_NOTHING: AbstractContextManager[None] = nullcontext()


class NoTelemetry(ValueError):
    """Traces are configured, and the packages to send them are missing."""

    def __init__(self) -> None:
        super().__init__("traces need the extra `telemetry`: pip install '.[telemetry]' beside pyproject.toml")


class Span(Protocol):
    """What a request may say about itself."""

    def set_attribute(self, key: str, value: str | int) -> None: ...


class Tracing:
    """Traces nothing."""

    def request(self, name: str, scope: Scope) -> AbstractContextManager[Span | None]:
        """A span of a request, below that of the client if ``traceparent`` names one."""
        del name, scope
        return _NOTHING

    def span(self, name: str) -> AbstractContextManager[None]:
        """A span of a part of the request that is being answered."""
        del name
        return _NOTHING

    def close(self) -> None:
        """Send what was not sent yet."""


class _OpenTelemetry(Tracing):
    def __init__(self, endpoint: str) -> None:
        try:
            from opentelemetry.exporter.otlp.proto.http.trace_exporter import OTLPSpanExporter
            from opentelemetry.sdk.resources import Resource
            from opentelemetry.sdk.trace import TracerProvider
            from opentelemetry.sdk.trace.export import BatchSpanProcessor
        except ImportError:
            raise NoTelemetry from None
        resource = Resource.create({"service.name": "counterweight", "service.version": package_version()})
        # a provider of its own: the global one can be set only once
        self._provider = TracerProvider(resource=resource, shutdown_on_exit=False)
        where = endpoint if endpoint.endswith("/v1/traces") else f"{endpoint.rstrip('/')}/v1/traces"
        self._provider.add_span_processor(BatchSpanProcessor(OTLPSpanExporter(endpoint=where, timeout=5)))
        self._tracer = self._provider.get_tracer("counterweight")

    @contextmanager
    def request(self, name: str, scope: Scope) -> Iterator[Span | None]:
        from opentelemetry.trace import SpanKind
        from opentelemetry.trace.propagation.tracecontext import TraceContextTextMapPropagator

        parent = TraceContextTextMapPropagator().extract(dict(Headers(scope=scope)))
        with self._tracer.start_as_current_span(
            name, context=parent, kind=SpanKind.SERVER, record_exception=False
        ) as span:
            yield span

    @contextmanager
    def span(self, name: str) -> Iterator[None]:
        # messages of exceptions may quote the request
        with self._tracer.start_as_current_span(name, record_exception=False, set_status_on_exception=False):
            yield

    def close(self) -> None:
        self._provider.shutdown()


def tracing(settings: Settings) -> Tracing:
    """Traces as the settings say.

    Raises
    ------
    NoTelemetry
        if they are to be sent and OpenTelemetry is not installed.
    """
    return Tracing() if settings.otlp_endpoint is None else _OpenTelemetry(settings.otlp_endpoint)
