"""Jobs as the routes see them: taken in, looked up, ended; the parts of :mod:`service.jobs` put together."""

import json
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from copy import copy
from dataclasses import replace
from datetime import UTC, datetime
from functools import lru_cache
from pathlib import Path
from threading import Event

import pyarrow as pa
import pyarrow.parquet as pq

from optimizer.sweep.plan import plan
from schemas.sweep import SweepLinks, SweepRequest, SweepState
from service.jobs import results, worker
from service.jobs.coordinator import Coordinator, Pace
from service.jobs.database import Database, DatabaseUnavailable
from service.jobs.engines import engine
from service.jobs.files import JobFiles
from service.jobs.job import Job
from service.jobs.kinds import table_bytes
from service.jobs.piece import Run
from service.jobs.selection import Selections
from service.jobs.store import Store, UnknownJob, digest
from service.settings import Settings

#: the rate is that of the last so many seconds
_RATE_S = 60.0
_DAY_S = 86_400.0


class NotFinished(Exception):
    """The answer is not there: not yet, or never; ``retry`` says which."""

    def __init__(self, message: str, retry: bool) -> None:
        self.retry = retry
        super().__init__(message)


class Desk:
    """The jobs of a service.

    Parameters
    ----------
    run : computes a chunk; importable by workers.

    Raises
    ------
    ValueError
        if the settings name an engine or a database that there is not.
    """

    def __init__(self, settings: Settings, pace: Pace | None = None, run: Run = worker.run) -> None:
        where: str | Path = settings.database_url or settings.data_dir / "jobs.sqlite"
        keep_s = settings.results_keep_days * _DAY_S if settings.results_keep_days else None
        # no file is made before it is needed; another service may make it
        self._begun: Callable[[], bool] = lambda: not isinstance(where, Path) or where.exists()
        self.store = Store(Database(where, settings.database_busy_s), keep_s, settings.max_jobs)
        self.files = JobFiles(settings.data_dir / "results")
        pace = pace or Pace(lease_s=settings.lease_s, patience_s=settings.database_patience_s)
        self._coordinator = Coordinator(
            self.store,
            self.files,
            engine(settings.engine, settings.sweep_workers),
            pace,
            run,
            begun=self._begun,
        )
        self._selections = Selections()
        #: streams of events end themselves then
        self.closing = Event()
        self._owner: str | None = None
        self._sees_all = True

    def of(self, owner: str | None, sees_all: bool) -> "Desk":
        """The same jobs for an owner: new ones are theirs, those of others are unknown unless all are seen."""
        found = copy(self)
        found._owner, found._sees_all = owner, sees_all
        return found

    def open(self) -> None:
        """Go on with what was begun before."""
        self._coordinator.start()

    def close(self) -> None:
        """Park what runs; it goes on at the next start."""
        self.closing.set()
        self._coordinator.stop()
        self.store.close()

    # ---- from requests to jobs

    def sweep(self, asked: SweepRequest, key: str | None = None) -> tuple[Job, bool]:
        """A new sweep, or the one that the key has started before; on disk when this returns.

        Returns
        -------
        the job, and whether it is new.

        Raises
        ------
        MissingInput, KeyReused, TooManyJobs, DatabaseUnavailable
        """
        found = plan(asked)
        request, columns = asked.model_dump_json().encode(), found.schema.serialize().to_pybytes()
        fingerprint = digest("sweep", json.loads(request))
        return self._submit("sweep", request, fingerprint, found.total, found.chunk_rows, columns, key)

    def later(self, kind: str, body: bytes, key: str | None = None) -> tuple[Job, bool]:
        """A job that computes one answer; otherwise as :meth:`sweep`."""
        fingerprint = digest(kind, json.loads(body.decode("utf-8-sig")))
        return self._submit(kind, body, fingerprint, 1, 1, None, key)

    def _submit(
        self,
        kind: str,
        body: bytes,
        fingerprint: str,
        total: int,
        chunk_rows: int,
        columns: bytes | None,
        key: str | None,
    ) -> tuple[Job, bool]:
        found = self.store.submit(kind, body, fingerprint, total, chunk_rows, columns, self._owner, key)
        self._coordinator.start()
        return found

    # ---- jobs

    def get(self, job: str) -> Job:
        """
        Raises
        ------
        UnknownJob, DatabaseUnavailable
        """
        found = self.store.get(job)
        if not self._sees_all and found.owner != self._owner:
            raise UnknownJob(job)
        return self._judged(found)

    def page(self, limit: int, before: str | None) -> list[Job]:
        """Sweeps, newest first, after the one of id ``before``.

        Raises
        ------
        UnknownJob, DatabaseUnavailable
        """
        if before is not None:
            self.get(before)
        owner = None if self._sees_all else self._owner or ""
        return [self._judged(job) for job in self.store.page(["sweep"], limit, before, owner)]

    def counts(self) -> Mapping[str, tuple[int, int, int]] | None:
        """By state: number of jobs, their finished rows, and those of them that failed; None if nobody can say."""
        if not self._begun():
            return {}
        with suppress(DatabaseUnavailable):
            return self.store.counts()
        return None

    def _judged(self, job: Job) -> Job:
        verdict = self._coordinator.verdict(job.id)
        if verdict is None or not job.active:
            return job
        return replace(job, state="failed", error=verdict, version=job.version + 1)

    def end(self, job: str) -> Job | None:
        """Cancel a job that runs, remove one that has ended.

        Returns
        -------
        the job that was cancelled; None if it was removed.
        """
        if self.get(job).active:
            cancelled = self.store.cancel(job)
            self.files.stop(job)
            return cancelled
        self.store.mark_removed(job)
        # a coordinator may be writing there still; then what is marked is removed later
        with suppress(OSError):
            self.files.remove(job)
            self.store.forget(job)
        return None

    def resume(self, job: str) -> Job:
        """Go on with a job that was cancelled or has failed."""
        self.get(job)
        found = self.store.resume(job)
        self._coordinator.start()
        return found

    def state(self, job: Job, prefix: str = "") -> SweepState:
        """What is answered about a job; ``prefix`` is the path that a proxy strips."""
        here = f"{prefix}/v1/sweeps/{job.id}"
        return SweepState(
            id=job.id,
            state=job.state,
            total=job.total,
            done=job.done,
            failed=job.failed,
            rows=self._rows(job),
            seed=_request(job).seed if job.kind == "sweep" else 0,
            eta_s=self._seconds_left(job),
            created_at=_moment(job.created),
            started_at=None if job.started is None else _moment(job.started),
            finished_at=None if job.ended is None else _moment(job.ended),
            message=job.error,
            links=SweepLinks(self=here, results=f"{here}/results", events=f"{here}/events"),
        )

    def _rows(self, job: Job) -> int:
        if job.kind != "sweep":
            return job.done
        return int(self.kept(job).num_rows) if self.keeps(job) else job.done

    def _seconds_left(self, job: Job) -> float | None:
        if not job.active or job.started is None:
            return None if job.active else 0.0
        now = time.time()
        since = max(job.started, now - _RATE_S)
        rows = self.store.rows_since(job.id, since)
        return (job.total - job.done) * (now - since) / rows if rows else None

    # ---- results

    def answer(self, job: Job) -> bytes:
        """The answer of a job that computes one.

        Raises
        ------
        NotFinished
        """
        if job.state != "done":
            raise NotFinished(job.error or f"The job is {job.state}.", retry=job.active)
        return self.files.piece(job.id, 0, 1).read_bytes()

    def schema(self, job: Job) -> pa.Schema:
        """Columns of a sweep, with its request, versions and seed as metadata."""
        return pa.ipc.read_schema(pa.py_buffer(job.columns or b""))

    def rows(self, job: Job, schema: pa.Schema, first: int, last: int | None) -> Iterator[pa.RecordBatch]:
        """The rows with first <= index < last that are finished, in order."""
        return results.batches(self.store.pieces(job.id), self._path(job), schema, first, last)

    def kept(self, job: Job) -> pa.Table:
        """The rows that ``top`` or ``pareto`` of the request keep of those that are finished.

        Raises
        ------
        OSError
            if files cannot be read or written.
        """
        path = self.files.kept(job.id)
        if not job.active and path.exists():
            return pq.read_table(path)
        pieces = self.store.pieces(job.id)
        found = self._selections.of(job.id, _request(job)).table(pieces, self._path(job), self.schema(job))
        if job.state == "done":
            # found once, not after every start of the service
            self.files.write(path, table_bytes(found))
        return found

    def keeps(self, job: Job) -> bool:
        """Whether the request has ``top`` or ``pareto``."""
        asked = _request(job)
        return asked.top is not None or asked.pareto is not None

    def _path(self, job: Job) -> Callable[[int, int], Path]:
        return lambda start, stop: self.files.piece(job.id, start, stop)


@lru_cache(maxsize=64)
def _parsed(request: bytes) -> SweepRequest:
    return SweepRequest.model_validate_json(request)


def _request(job: Job) -> SweepRequest:
    return _parsed(job.request)


def _moment(seconds: float) -> str:
    return datetime.fromtimestamp(seconds, UTC).isoformat(timespec="milliseconds").replace("+00:00", "Z")
