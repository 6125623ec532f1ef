"""The jobs in the database, and the changes that clients make to them. Every method is one transaction."""

import time
import uuid
from collections.abc import Callable, Collection, Sequence
from functools import cache

from sqlalchemy import ColumnElement, Connection, Select, and_, bindparam, func, insert, or_, select, update
from sqlalchemy.exc import IntegrityError

from service.jobs import room, rows
from service.jobs.database import Database
from service.jobs.fingerprints import same
from service.jobs.job import ACTIVE, REMOVED, Job, Order, Record, State, job_from
from service.jobs.rows import JOB, Limits
from service.jobs.tables import chunks, jobs


class KeyReused(ValueError):
    """The idempotency key came with another request before."""


class TooManyJobs(Exception):
    """As many jobs as are allowed are waiting or running."""


class QuotaExceeded(Exception):
    """The job would take more room on disk than its owner has left."""


class Store:
    """The jobs in a database, as clients see and change them.

    Parameters
    ----------
    clock : seconds since 1970.
    """

    def __init__(
        self, database: Database, limits: Limits | None = None, clock: Callable[[], float] = time.time
    ) -> None:
        self._database = database
        self._limits = limits or Limits()
        self._clock = clock

    def submit(self, order: Order) -> tuple[Job, bool]:
        """A new job, or the one that the key has started before; it is on disk when this returns.

        Returns
        -------
        the job, and whether it is new.

        Raises
        ------
        KeyReused
            if the key came with another request before.
        TooManyJobs, QuotaExceeded
        """
        try:
            with self._database.write() as connection:
                entry = _by_key(connection, order)
                if entry is None:
                    self._require_room(connection, order)
                    return self._insert(connection, order), True
        except IntegrityError:
            # another service took the same key in the same moment
            with self._database.read() as connection:
                entry = _by_key(connection, order)
            if entry is None:
                raise
        job, digest, content = entry
        if job.kind != order.kind or not same(order, digest, content):
            raise KeyReused("This Idempotency-Key came with another request before; take a new key.")
        return job, False

    def _require_room(self, connection: Connection, order: Order) -> None:
        active = select(func.count()).select_from(jobs).where(jobs.c.state.in_(ACTIVE))
        for query, most in (
            (active, self._limits.active),
            (active.where(room.of(order.owner)), self._limits.active_per_owner),
        ):
            count = connection.scalar(query) or 0
            if count >= most:
                raise TooManyJobs(f"{count} jobs are waiting or running; try again later.")
        quota = self._limits.quota_bytes
        if quota is not None:
            used = room.usage(connection, order.owner, planned=True)
            if used + order.expected_bytes > quota:
                raise QuotaExceeded(
                    f"The job is expected to take {order.expected_bytes / 1e6:.1f} MB on disk; of {quota / 1e6:.1f} MB "
                    f"{used / 1e6:.1f} MB are taken or promised. Remove sweeps, or ask for fewer columns or designs."
                )

    def _insert(self, connection: Connection, order: Order) -> Job:
        job = uuid.uuid4().hex
        connection.execute(
            insert(jobs).values(
                id=job,
                kind=order.kind,
                request=order.request,
                digest=order.fingerprint,
                idempotency_key=order.key,
                owner=order.owner,
                columns=order.columns,
                state="queued",
                total=order.total,
                created=self._clock(),
                seed=order.seed,
                chunk_rows=order.chunk_rows,
                selects=order.selects,
                bytes=len(order.request) + len(order.columns or b""),
                expected_bytes=order.expected_bytes,
            )
        )
        if order.selects:
            selection = {"job": job, "start": order.total, "stop": order.total, "state": "waiting"}
            connection.execute(insert(chunks).values(selection))
        return rows.get(connection, job)

    def get(self, job: str) -> Job:
        """
        Raises
        ------
        UnknownJob
        """
        with self._database.read() as connection:
            return rows.get(connection, job)

    def by_ids(self, ids: Collection[str]) -> list[Job]:
        """Those of some jobs that there are."""
        with self._database.read() as connection:
            query = select(*JOB).where(jobs.c.id.in_(ids), jobs.c.state != REMOVED)
            return [job_from(row) for row in connection.execute(query).mappings()]

    def request(self, job: str) -> bytes:
        """The request of a job.

        Raises
        ------
        UnknownJob
        """
        with self._database.read() as connection:
            rows.get(connection, job)
            return bytes(connection.scalar(select(jobs.c.request).where(jobs.c.id == job)) or b"")

    def columns(self, job: str) -> bytes:
        """The Arrow schema of the answer; empty if it is no table.

        Raises
        ------
        UnknownJob
        """
        with self._database.read() as connection:
            rows.get(connection, job)
            return bytes(connection.scalar(select(jobs.c.columns).where(jobs.c.id == job)) or b"")

    def page(self, kinds: Sequence[str], limit: int, before: str | None = None, owner: str | None = None) -> list[Job]:
        """Jobs of an owner, or of all, newest first, after the one of id ``before``.

        Raises
        ------
        UnknownJob
            if there is no job ``before``.
        """
        values: dict[str, object] = {"kinds": list(kinds), "limit": limit}
        if owner is not None:
            values["owner"] = owner
        with self._database.read() as connection:
            if before is not None:
                last = rows.get(connection, before)
                values |= {"created": last.created, "id": last.id}
            result = connection.execute(_page(owner is not None, before is not None), values)
            return [job_from(row) for row in result.mappings()]

    def counts(self) -> dict[str, tuple[int, int, int, int]]:
        """By state: number of jobs, their finished rows, and those of them that failed or are invalid."""
        query = (
            select(jobs.c.state, func.count(), func.sum(jobs.c.done), func.sum(jobs.c.failed), func.sum(jobs.c.invalid))
            .where(jobs.c.state != REMOVED)
            .group_by(jobs.c.state)
        )
        with self._database.read() as connection:
            result = connection.execute(query)
            return {
                state: (count, int(finished), int(failed), int(wrong))
                for state, count, finished, failed, wrong in result
            }

    def pieces(self, job: str) -> list[Record]:
        """The files of the rows that are there, in order."""
        return self._records(job, chunks.c.stop > chunks.c.start, chunks.c.state == "done")

    def selection(self, job: str) -> Record | None:
        """The file of the rows that were selected last, if there is one."""
        records = self._records(job, chunks.c.stop == chunks.c.start, chunks.c.digest.is_not(None))
        return records[0] if records else None

    def _records(self, job: str, *conditions: ColumnElement[bool]) -> list[Record]:
        query = select(chunks.c.start, chunks.c.stop, chunks.c.digest, chunks.c.bytes)
        with self._database.read() as connection:
            result = connection.execute(query.where(chunks.c.job == job, *conditions).order_by(chunks.c.start))
            return [Record(row.start, row.stop, row.digest, row.bytes) for row in result]

    def last_finished(self, job: str, most: int) -> list[tuple[float, int]]:
        """When the last chunks were finished [s since 1970], and how many rows each of them has; the latest first."""
        query = select(chunks.c.finished, chunks.c.stop - chunks.c.start).order_by(chunks.c.finished.desc())
        latest = query.where(chunks.c.job == job, chunks.c.finished.is_not(None)).limit(most)
        with self._database.read() as connection:
            return [(float(moment), int(rows)) for moment, rows in connection.execute(latest)]

    def cancel(self, job: str) -> Job:
        """Give out no more chunks; what is finished stays. An ended job stays as it is.

        Raises
        ------
        UnknownJob
        """
        return self._ended(job, "cancelled", None)

    def fail(self, job: str, error: str) -> Job:
        """End a job with a reason; the rows that are there stay. An ended job stays as it is.

        Raises
        ------
        UnknownJob
        """
        return self._ended(job, "failed", error)

    def _ended(self, job: str, state: State, error: str | None) -> Job:
        with self._database.write() as connection:
            entry = rows.get(connection, job, lock=True)
            if entry.active:
                rows.end(connection, entry, state, error, self._clock(), self._limits.keep_s)
            return rows.get(connection, job)

    def resume(self, job: str) -> Job:
        """Go on with a cancelled or failed job where it ended; any other job stays as it is.

        Raises
        ------
        UnknownJob
        """
        with self._database.write() as connection:
            entry = rows.get(connection, job, lock=True)
            if entry.state in ("cancelled", "failed"):
                open_chunk = and_(chunks.c.job == job, chunks.c.state.not_in(["done", "waiting"]))
                values = {"state": "pending", "attempts": 0, "lease_owner": None}
                connection.execute(update(chunks).where(open_chunk).values(values))
                again = {"state": "queued", "error": None, "ended": None, "expires": None, "faults": 0}
                rows.change(connection, job, **again)
                rows.settle(connection, job, self._clock(), self._limits.keep_s)
            return rows.get(connection, job)


@cache
def _page(owned: bool, later: bool) -> Select[tuple[object, ...]]:
    """The statement of a page, of one owner and after a job if so; put together once, as every look runs it."""
    query = select(*JOB).where(jobs.c.state != REMOVED, jobs.c.kind.in_(bindparam("kinds", expanding=True)))
    if owned:
        query = query.where(jobs.c.owner == bindparam("owner"))
    if later:
        created, job = bindparam("created", type_=jobs.c.created.type), bindparam("id", type_=jobs.c.id.type)
        query = query.where(or_(jobs.c.created < created, and_(jobs.c.created == created, jobs.c.id < job)))
    return query.order_by(jobs.c.created.desc(), jobs.c.id.desc()).limit(bindparam("limit"))


def _by_key(connection: Connection, order: Order) -> tuple[Job, str, bytes] | None:
    """The job that has the key of an order, its fingerprint and its request."""
    if order.key is None:
        return None
    condition = and_(func.coalesce(jobs.c.owner, "") == (order.owner or ""), jobs.c.idempotency_key == order.key)
    row = connection.execute(select(*JOB, jobs.c.digest, jobs.c.request).where(condition)).mappings().first()
    return None if row is None else (job_from(row), row["digest"], bytes(row["request"]))
