"""Metrics for Prometheus: requests, computations, certified gaps, the queue, workers, and sweeps."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict
from functools import cache

from prometheus_client import CollectorRegistry, Counter, Histogram, generate_latest
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, Metric
from prometheus_client.registry import Collector

from service.workers.pool import Pool
from service.workers.worker import Answer

_SECONDS = (0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1, 2.5, 5, 10, 30, 60)
_GAPS = (1e-14, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1)
#: other methods are counted together: a client may send any word
_METHODS = frozenset({"GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS"})

#: counts of jobs by state, of finished, failed and invalid rows; None if the database is away
SweepCounts = Callable[[], Mapping[str, tuple[int, int, int, int]] | None]


class Metrics:
    """The metrics of one service."""

    def __init__(self, pool: Pool, sweeps: SweepCounts, job_faults: Callable[[], int]) -> None:
        self._registry = CollectorRegistry()
        requests = Counter(
            "counterweight_requests", "answered requests", ("method", "route", "status"), registry=self._registry
        )
        refusals = Counter(
            "counterweight_refusals",
            "requests that were answered with a problem, by its kind",
            ("route", "kind"),
            registry=self._registry,
        )
        request_seconds = Histogram(
            "counterweight_request_seconds",
            "time to the end of an answer [s]",
            ("route",),
            buckets=_SECONDS,
            registry=self._registry,
        )
        computation_seconds = Histogram(
            "counterweight_computation_seconds",
            "time of a computation in its worker [s]",
            ("computation",),
            buckets=_SECONDS,
            registry=self._registry,
        )
        solve_seconds = Histogram(
            "counterweight_solve_seconds",
            "time of the convex program [s]",
            ("method",),
            buckets=_SECONDS,
            registry=self._registry,
        )
        gaps = Histogram(
            "counterweight_certified_relative_gap",
            "certified gap over the objective without counterweights",
            ("method",),
            buckets=_GAPS,
            registry=self._registry,
        )
        # what belongs to some labels is looked for once: they are few
        self._refused = cache(refusals.labels)
        self._requests, self._lasted = cache(requests.labels), cache(request_seconds.labels)
        self._took, self._solved = cache(computation_seconds.labels), cache(solve_seconds.labels)
        self._gap = cache(gaps.labels)
        self._faults = 0
        self._registry.register(_Faults(lambda: {"request": self._faults, "job": job_faults()}))
        self._registry.register(_Work(pool))
        self._registry.register(_Sweeps(sweeps))

    def requested(self, method: str, route: str, status: int, seconds: float) -> None:
        """A request was answered; ``route`` is a template, not a path."""
        label = method if method in _METHODS else "other"
        self._requests(label, route, str(status)).inc()
        self._lasted(route).observe(seconds)

    def refused(self, route: str, kind: str) -> None:
        """A request was answered with a problem of a kind."""
        self._refused(route, kind).inc()

    def computed(self, computation: str, answer: Answer) -> None:
        """A worker has answered."""
        self._took(computation).observe(answer.seconds)
        self._faults += len(answer.faults)
        if answer.certified is not None:
            self._solved(answer.certified.method).observe(answer.certified.solve_s)
            self._gap(answer.certified.method).observe(max(0.0, answer.certified.relative_gap))

    def exposition(self) -> bytes:
        """Everything, in the text format of Prometheus."""
        return generate_latest(self._registry)


class _Faults(Collector):
    def __init__(self, counts: Callable[[], Mapping[str, int]]) -> None:
        self._counts = counts

    def collect(self) -> Iterable[Metric]:
        family = CounterMetricFamily(
            "counterweight_faults",
            "answers of which the service itself found that a bound contradicts them, and that are logged",
            labels=["asked_as"],
        )
        for name, count in self._counts().items():
            family.add_metric([name], count)
        yield family


class _Work(Collector):
    def __init__(self, pool: Pool) -> None:
        self._pool = pool

    def collect(self) -> Iterable[Metric]:
        yield _gauge("counterweight_computations_running", "computations that run", self._pool.running)
        yield _gauge("counterweight_computations_waiting", "requests that wait for a worker", self._pool.queued)
        events = CounterMetricFamily(
            "counterweight_worker_events",
            "workers started, found dead, ended late or with their client gone; requests refused as too many wait;"
            " computations that turned out to be long, and went on as such or were begun anew",
            labels=["event"],
        )
        for name, count in asdict(self._pool.counts).items():
            events.add_metric([name], count)
        yield events


class _Sweeps(Collector):
    def __init__(self, counts: SweepCounts) -> None:
        self._counts = counts

    def collect(self) -> Iterable[Metric]:
        totals = self._counts()
        yield _gauge("counterweight_job_database_up", "whether the database of the jobs answers", totals is not None)
        jobs = GaugeMetricFamily("counterweight_jobs", "sweeps and other jobs that are kept", labels=["state"])
        rows = GaugeMetricFamily(
            "counterweight_sweep_rows", "rows of the jobs that are kept, by what they came to", labels=["outcome"]
        )
        for state, (count, *_) in (totals or {}).items():
            jobs.add_metric([state], count)
        if totals is not None:
            finished, failed, invalid = (sum(counts[i] for counts in totals.values()) for i in (1, 2, 3))
            rows.add_metric(["answered"], finished - failed - invalid)
            rows.add_metric(["failed"], failed)
            rows.add_metric(["invalid"], invalid)
        yield jobs
        yield rows


def _gauge(name: str, meaning: str, value: float) -> Metric:
    return GaugeMetricFamily(name, meaning, value=float(value))
