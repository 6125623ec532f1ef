"""The jobs of whoever asks: taken in, looked up, ended, read."""

from collections.abc import Callable, Collection, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from functools import cached_property, partial
from threading import Event
from typing import TYPE_CHECKING, BinaryIO

from schemas.sweep.answers import SweepLinks, SweepState
from schemas.sweep.request import SweepRequest
from service.computations.computation import request_bytes
from service.jobs import results
from service.jobs.coordinator import Coordinator
from service.jobs.database import DatabaseUnavailable
from service.jobs.files import Damaged, FilesUnavailable, JobFiles
from service.jobs.fingerprints import fingerprint
from service.jobs.job import Job, Order, Record
from service.jobs.leases import Leases
from service.jobs.rate import Rate, rate_by_version
from service.jobs.retention import Retention
from service.jobs.rows import UnknownJob
from service.jobs.store import Store

# a service without sweeps needs neither Arrow nor the optimiser, and is ready sooner
if TYPE_CHECKING:
    import pyarrow as pa


class NotFinished(Exception):
    """The answer is not there: not yet, or never; ``retry`` says which."""

    def __init__(self, message: str, retry: bool) -> None:
        self.retry = retry
        super().__init__(message)


class RowsDamaged(Exception):
    """Some rows are not what was written; they are computed again."""


@dataclass(frozen=True)
class Parts:
    """What the jobs of a service are made of."""

    store: Store
    leases: Leases
    retention: Retention
    files: JobFiles
    coordinator: Coordinator
    #: streams of events end themselves then
    closing: Event

    @cached_property
    def rate(self) -> Rate:
        """Rows per second of a job."""
        return rate_by_version(self.store.last_finished)


@dataclass(frozen=True)
class Rows:
    """Rows of a job, a batch at a time.

    count : indices, or selected rows, that there are to be read, here and beyond.
    complete : whether these are all that there ever will be.
    """

    batches: "Iterator[pa.RecordBatch]"
    count: int
    complete: bool


class OwnerJobs:
    """The jobs of an owner: new ones are theirs, those of others are unknown unless all are seen."""

    def __init__(self, parts: Parts, owner: str | None, sees_all: bool) -> None:
        self._parts, self._owner, self._sees_all = parts, owner, sees_all

    @property
    def view(self) -> tuple[str | None, bool]:
        """Whose jobs are seen: all with the same view see the same."""
        return self._owner, self._sees_all

    @property
    def closing(self) -> Event:
        """Set when the service is about to stop."""
        return self._parts.closing

    # ---- from requests to jobs

    def sweep(self, request: SweepRequest, key: str | None = None, sent: bytes | None = None) -> tuple[Job, bool]:
        """A new sweep, or the one that the key has started before; on disk when this returns.

        Parameters
        ----------
        sent : the body that asks for it; without one, what the request says that is no default.

        Returns
        -------
        the job, and whether it is new.

        Raises
        ------
        MissingInput, KeyReused, TooManyJobs, QuotaExceeded, DatabaseUnavailable
        """
        from optimizer.studies.sweep.plan import plan
        from optimizer.studies.sweep.table import REQUEST

        planned = plan(request)
        content = request.model_dump_json().encode()
        # the request is kept once
        about = {name: value for name, value in (planned.schema.metadata or {}).items() if name != REQUEST}
        return self._submit(
            Order(
                kind="sweep",
                request=content,
                fingerprint=fingerprint("sweep", request_bytes(request) if sent is None else sent),
                total=planned.total,
                chunk_rows=planned.chunk_rows,
                columns=planned.schema.with_metadata(about).serialize().to_pybytes(),
                seed=planned.seed,
                selects=request.top is not None or request.pareto is not None,
                expected_bytes=planned.estimate.bytes,
                owner=self._owner,
                key=key,
            )
        )

    def later(self, kind: str, request: bytes, key: str | None, sent: bytes) -> tuple[Job, bool]:
        """A job that computes one answer; otherwise as :meth:`sweep`."""
        digest = fingerprint(kind, sent)
        return self._submit(Order(kind, request, digest, expected_bytes=len(request), owner=self._owner, key=key))

    def _submit(self, order: Order) -> tuple[Job, bool]:
        result = self._parts.store.submit(order)
        self._parts.coordinator.start()
        return result

    # ---- jobs

    def get(self, job: str) -> Job:
        """
        Raises
        ------
        UnknownJob, DatabaseUnavailable
        """
        entry = self._parts.store.get(job)
        if not self._sees_all and entry.owner != self._owner:
            raise UnknownJob(job)
        return self._judged(entry)

    def by_ids(self, ids: Collection[str]) -> list[Job]:
        """Those of some jobs that there are, of whoever they may be.

        Raises
        ------
        DatabaseUnavailable
        """
        return [self._judged(job) for job in self._parts.store.by_ids(ids)]

    def page(self, limit: int, before: str | None) -> list[Job]:
        """Sweeps, newest first, after the one of id ``before``.

        Raises
        ------
        UnknownJob, DatabaseUnavailable
        """
        if before is not None:
            self.get(before)
        owner = None if self._sees_all else self._owner or ""
        return [self._judged(job) for job in self._parts.store.page(["sweep"], limit, before, owner)]

    def _judged(self, job: Job) -> Job:
        verdict = self._parts.coordinator.verdict(job.id)
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
            cancelled = self._parts.store.cancel(job)
            self._parts.files.stop(job)
            return cancelled
        try:
            self._parts.retention.mark_removed(job)
        except DatabaseUnavailable as error:
            if not error.full:
                raise
            # the files first: the database needs the room to say that they are gone
            self._parts.files.remove(job)
            self._parts.retention.mark_removed(job)
        # a coordinator may be writing there still; then what is marked is removed later
        with suppress(OSError):
            self._parts.files.remove(job)
            self._parts.retention.forget(job)
        return None

    def resume(self, job: str) -> Job:
        """Go on with a job that was cancelled or has failed."""
        self.get(job)
        entry = self._parts.store.resume(job)
        self._parts.coordinator.start()
        return entry

    def state(self, job: Job, prefix: str = "") -> SweepState:
        """What is answered about a job; ``prefix`` is the path that a proxy strips."""
        here = f"{prefix}/v1/sweeps/{job.id}"
        return SweepState(
            id=job.id,
            state=job.state,
            total=job.total,
            done=job.done,
            failed=job.failed,
            invalid=job.invalid,
            infeasible=job.infeasible,
            rows=job.kept if job.selects else job.done,
            selected=job.selected if job.selects else None,
            repaired=job.repaired,
            bytes=job.bytes,
            seed=job.seed,
            eta_s=self._seconds_left(job),
            created_at=_moment(job.created),
            started_at=None if job.started is None else _moment(job.started),
            finished_at=None if job.ended is None else _moment(job.ended),
            message=job.error or _unselected(job),
            links=SweepLinks(self=here, results=f"{here}/results", events=f"{here}/events"),
        )

    def _seconds_left(self, job: Job) -> float | None:
        if not job.active or job.started is None:
            return None
        rate = self._parts.rate(job.id, job.version, job.started)
        return (job.total - job.done) / rate if rate else None

    # ---- results

    def answer(self, job: Job) -> Callable[[], BinaryIO]:
        """What opens the file that holds the answer of a job that computes one; it may find damaged rows then.

        Raises
        ------
        NotFinished, RowsDamaged
        """
        if job.state != "done":
            raise NotFinished(job.error or f"The job is {job.state}.", retry=job.active)
        pieces = self._parts.store.pieces(job.id)
        if not pieces:
            raise NotFinished("The answer is computed again.", retry=True)
        return partial(self._opener(job), pieces[0])

    def schema(self, job: Job) -> "pa.Schema":
        """Columns of a sweep, with its request, versions and seed as metadata."""
        import pyarrow as pa

        from optimizer.studies.sweep.table import REQUEST

        columns = pa.ipc.read_schema(pa.py_buffer(self._parts.store.columns(job.id)))
        return columns.with_metadata({REQUEST: self._parts.store.request(job.id), **(columns.metadata or {})})

    def rows(self, job: Job, schema: "pa.Schema", first: int = 0, last: int | None = None) -> Rows:
        """The rows with first <= index < last that are finished, in order.

        Raises
        ------
        RowsDamaged
            if files are missing; or while the rows are read.
        UnknownJob
            if it has been removed; or while the rows are read.
        FilesUnavailable, DatabaseUnavailable
        """
        pieces = self._parts.store.pieces(job.id)
        if not pieces:
            # it may have been removed meanwhile
            self._parts.store.get(job.id)
        selection = results.within(pieces, first, last)
        self._require(job, selection)
        complete = job.state == "done" and sum(piece.rows for piece in pieces) == job.total
        return Rows(results.batches(selection, self._opener(job), schema, first, last), job.total, complete)

    def selection(self, job: Job, schema: "pa.Schema", first: int = 0, last: int | None = None) -> Rows:
        """The rows that ``top`` or ``pareto`` of the request keep, of those that were there when they were selected.

        Raises
        ------
        NotFinished
            if there is no selection, and will be none.
        RowsDamaged, FilesUnavailable, DatabaseUnavailable
        """
        record = self._parts.store.selection(job.id)
        if record is None:
            if job.selected == job.total and job.error is not None:
                raise NotFinished(f"There is no selection: {job.error}.", retry=False)
            return Rows(iter(()), 0, complete=False)
        complete = job.state == "done" and job.selected == job.total
        return Rows(results.rows_of(partial(self._latest, job, record), schema, first, last), job.kept, complete)

    def _latest(self, job: Job, record: Record) -> BinaryIO:
        """The file of a selection, or of the one that has replaced it since."""
        try:
            return self._opener(job)(record)
        except RowsDamaged:
            now = self._parts.store.selection(job.id)
            if now is None or now.digest == record.digest:
                raise
            return self._latest(job, now)

    def _require(self, job: Job, pieces: list[Record]) -> None:
        absent = self._parts.files.absent(job.id, pieces)
        for record in absent:
            self._repair(job, Damaged(record, "missing"))
        if absent:
            raise RowsDamaged(_message(absent[0], "missing"))

    def _repair(self, job: Job, damage: Damaged) -> None:
        self._parts.coordinator.repair(job.id, damage)
        # nothing is made again of a job that was removed while it was read: it is unknown
        self._parts.store.get(job.id)

    def _opener(self, job: Job) -> Callable[[Record], BinaryIO]:
        def opened(record: Record) -> BinaryIO:
            try:
                if record.digest is None:
                    record = self._adopted(job, record)
                return self._parts.files.opened(job.id, record)
            except Damaged as damage:
                self._repair(job, damage)
                raise RowsDamaged(_message(damage.record, damage.reason)) from damage

        return opened

    def _adopted(self, job: Job, record: Record) -> Record:
        try:
            adopted = self._parts.files.renamed_file(job.id, record)
        except OSError as error:
            raise FilesUnavailable(f"a file of job {job.id} cannot be given its name: {error.strerror}") from error
        except Damaged:
            rows = record.start, record.stop
            for piece in self._parts.store.pieces(job.id):
                # another reader has been faster
                if (piece.start, piece.stop) == rows and piece.digest is not None:
                    return piece
            raise
        self._parts.leases.adopt(job.id, record, str(adopted.digest), adopted.bytes)
        self._parts.files.drop(job.id, record)
        return adopted


def _unselected(job: Job) -> str | None:
    """Why a selection holds nothing where its sweep was cancelled, and where its rows are."""
    if job.state == "cancelled" and job.selects and job.selected < job.total:
        return "The sweep was cancelled before its rows were selected: read the finished rows with select=all."
    return None


def _message(record: Record, reason: str) -> str:
    words = f"The file of the rows {record.start} to {record.stop - 1}" if record.rows else "The file of the selection"
    return f"{words} is {reason}; it is made again."


def _moment(seconds: float) -> str:
    return datetime.fromtimestamp(seconds, UTC).isoformat(timespec="milliseconds").replace("+00:00", "Z")
