"""What coordinators do to the chunks of jobs. Every method is one transaction."""

import time
from collections.abc import Callable, Collection, Mapping, Sequence
from functools import cache
from typing import Any

from sqlalchemy import (
    ColumnElement,
    Connection,
    Select,
    and_,
    bindparam,
    exists,
    func,
    insert,
    or_,
    select,
    tuple_,
    update,
)

from service.jobs import room, rows
from service.jobs.database import Database
from service.jobs.job import ACTIVE, Chunk, Computed, Job, Record
from service.jobs.room import on_disk
from service.jobs.rows import Limits
from service.jobs.tables import chunks, jobs

#: so many chunks are made at a time: a transaction of more would keep others waiting
_PLANNED = 250
_CANDIDATES = 20


class Leases:
    """The chunks in a database: leased, returned, finished.

    Parameters
    ----------
    clock : seconds since 1970. Leases of services whose clocks differ by more than a lease overlap, and so do those
        around a jump of the clock, which costs work and no rows.
    """

    def __init__(
        self, database: Database, limits: Limits | None = None, clock: Callable[[], float] = time.time
    ) -> None:
        self._database = database
        self._limits = limits or Limits()
        self._clock = clock

    def claim(
        self, owner: str, lease_s: float, attempted: bool = False, exclusions: Collection[str] = ()
    ) -> Chunk | None:
        """Lease one chunk, see :meth:`claim_chunks`."""
        batch = self.claim_chunks(owner, lease_s, 1, attempted, exclusions)
        return batch[0] if batch else None

    def claim_chunks(
        self, owner: str, lease_s: float, most: int, attempted: bool = False, exclusions: Collection[str] = ()
    ) -> list[Chunk]:
        """Lease chunks of one job: of the owner with the fewest chunks in work, and of their job with the fewest. So
        nobody waits for somebody else's large or many jobs.

        Parameters
        ----------
        most : there may be fewer; none if there is nothing to do.
        attempted : whether to lease chunks that went wrong before, or fresh ones.
        exclusions : jobs that are left to other services.
        """
        now = self._clock()
        # a lease that ends later than any can was made by a clock that has jumped since
        times = {"now": now, "latest": now + 2 * lease_s}
        with self._database.read() as connection:
            candidates: list[str] = list(connection.scalars(_waiting(attempted), {"others": [*exclusions], **times}))
        for job in candidates:
            with self._database.write() as connection:
                entry = rows.find(connection, job, lock=True)
                if entry is None or not entry.active:
                    continue
                spans = _free(connection, attempted, {"job": job, "most": most, **times})
                if not spans and not attempted:
                    spans = _next_spans(connection, entry)[:most]
                if spans:
                    starts = [start for start, _, _ in spans]
                    condition = and_(chunks.c.job == job, chunks.c.start.in_(starts))
                    lease = {"state": "leased", "lease_owner": owner, "lease_until": now + lease_s}
                    connection.execute(update(chunks).where(condition).values(lease))
                    if entry.state == "queued":
                        rows.change(connection, job, state="running", started=entry.started or now)
                    request = bytes(connection.scalar(select(jobs.c.request).where(jobs.c.id == job)) or b"")
                    return [Chunk(job, entry.kind, request, *span) for span in spans]
        return []

    def renew(self, owner: str, leases: Sequence[Chunk], lease_s: float) -> None:
        """Keep the leases of some chunks of an owner."""
        condition = tuple_(chunks.c.job, chunks.c.start).in_([(chunk.job, chunk.start) for chunk in leases])
        mine = and_(condition, chunks.c.lease_owner == owner, chunks.c.state == "leased")
        with self._database.write() as connection:
            connection.execute(update(chunks).where(mine).values(lease_until=self._clock() + lease_s))

    def release(self, owner: str) -> None:
        """Give the chunks of an owner back."""
        mine = and_(chunks.c.lease_owner == owner, chunks.c.state == "leased")
        with self._database.write() as connection:
            connection.execute(update(chunks).where(mine).values(state="pending", lease_owner=None))

    def active(self) -> set[str]:
        """The jobs that are queued or running."""
        with self._database.read() as connection:
            return set(connection.scalars(select(jobs.c.id).where(jobs.c.state.in_(ACTIVE))))

    # ---- outcomes

    def finish(self, computed: Sequence[Computed]) -> list[bool]:
        """The files of some chunks of one job are on disk. Said twice it counts once; said of an ended job it does not
        count.

        Returns
        -------
        which of them count.
        """
        if not computed:
            return []
        job = computed[0].chunk.job
        with self._database.write() as connection:
            entry = rows.find(connection, job, lock=True)
            if entry is None or not entry.active:
                return [False] * len(computed)
            now = self._clock()
            successes = [_finish(connection, piece, now) for piece in computed]
            new = [piece for piece, counts in zip(computed, successes, strict=True) if counts]
            if new:
                counts = {
                    "done": jobs.c.done + sum(piece.chunk.rows for piece in new),
                    "failed": jobs.c.failed + sum(piece.failed for piece in new),
                    "invalid": jobs.c.invalid + sum(piece.invalid for piece in new),
                    "infeasible": jobs.c.infeasible + sum(piece.infeasible for piece in new),
                    "bytes": jobs.c.bytes + sum(on_disk(piece.bytes) for piece in new),
                }
                rows.change(connection, job, **counts)
                self._settle(connection, entry)
            return successes

    def _settle(self, connection: Connection, job: Job) -> None:
        rows.settle(connection, job.id, self._clock(), self._limits.keep_s)
        quota = self._limits.quota_bytes
        entry = rows.get(connection, job.id)
        if quota is not None and entry.active and room.exceeds(connection, job.owner, quota):
            error = f"the {quota / 1e6:.1f} MB of its owner on disk are used up; remove sweeps, then resume this one"
            rows.end(connection, entry, "failed", error, self._clock(), self._limits.keep_s)

    def finish_selection(self, chunk: Chunk, covered: int, remaining: int, file: Record) -> Record | None:
        """The file of the rows that were selected is on disk. It does not count if the job has ended, or another
        selection looked at as many.

        Parameters
        ----------
        covered, remaining : how many rows were looked at, and how many of them stay.

        Returns
        -------
        the file that is free to be removed: that of the selection before, or this one if it does not count.
        """
        with self._database.write() as connection:
            job = rows.find(connection, chunk.job, lock=True)
            if job is None or not job.active or covered <= job.selected:
                return file
            before = connection.execute(select(chunks.c.digest, chunks.c.bytes).where(_own(chunk))).one()
            about = {"digest": file.digest, "bytes": on_disk(file.bytes), "attempts": 0, "lease_owner": None}
            state = "done" if covered == job.total else "waiting"
            connection.execute(update(chunks).where(_own(chunk)).values(state=state, **about))
            size_now = jobs.c.bytes + on_disk(file.bytes) - before.bytes
            rows.change(connection, chunk.job, selected=covered, kept=remaining, bytes=size_now)
            self._settle(connection, job)
            return None if before.digest is None else Record(chunk.start, chunk.stop, before.digest, before.bytes)

    def refuse_selection(self, chunk: Chunk, reason: str) -> None:
        """There will be no selection; the job goes on without."""
        with self._database.write() as connection:
            job = rows.find(connection, chunk.job, lock=True)
            if job is not None and job.active:
                gone = {"state": "done", "digest": None, "lease_owner": None}
                connection.execute(update(chunks).where(_own(chunk)).values(gone))
                rows.change(connection, chunk.job, selected=job.total, kept=0, error=reason)
                self._settle(connection, job)

    def postpone(self, chunk: Chunk) -> None:
        """Select rows later: when those that are computed anew are there, which they may be by now."""
        with self._database.write() as connection:
            job = rows.find(connection, chunk.job, lock=True)
            mine = and_(_own(chunk), chunks.c.state == "leased")
            connection.execute(update(chunks).where(mine).values(state="waiting", lease_owner=None))
            if job is not None:
                self._settle(connection, job)

    def give_back(self, chunk: Chunk, attempts: int) -> None:
        """A chunk went wrong ``attempts`` times by now and shall be tried again."""
        with self._database.write() as connection:
            values = {"state": "pending", "attempts": attempts, "lease_owner": None}
            connection.execute(update(chunks).where(_own(chunk), chunks.c.state == "leased").values(values))

    def halve(self, chunk: Chunk) -> int:
        """Replace a chunk that keeps going wrong by its halves, so that the rows at fault end up alone.

        Returns
        -------
        number of faults of the job so far.
        """
        middle = chunk.start + chunk.rows // 2
        with self._database.write() as connection:
            rows.get(connection, chunk.job, lock=True)
            values = {"state": "pending", "lease_owner": None, "attempts": 1}
            condition = and_(_own(chunk), chunks.c.stop == chunk.stop, chunks.c.state != "done")
            if connection.execute(update(chunks).where(condition).values(stop=middle, **values)).rowcount:
                half = {"job": chunk.job, "start": middle, "stop": chunk.stop, **values}
                connection.execute(insert(chunks).values(half))
                rows.change(connection, chunk.job, faults=jobs.c.faults + 1)
            return int(connection.scalar(select(jobs.c.faults).where(jobs.c.id == chunk.job)) or 0)

    # ---- files that are not what they were

    def reopen(self, job: str, record: Record) -> bool:
        """A file is damaged or missing: its chunk is computed again. A job that was done runs again; one that was
        cancelled or has failed computes it when it goes on.

        Returns
        -------
        whether it is news: not if another has said so before.
        """
        with self._database.write() as connection:
            entry = rows.find(connection, job, lock=True)
            selection = record.rows == 0
            own = and_(chunks.c.job == job, chunks.c.start == record.start, chunks.c.stop == record.stop)
            condition = and_(own, chunks.c.digest == record.digest, chunks.c.state.in_(["done", "waiting"]))
            counts_of = select(chunks.c.failed, chunks.c.invalid, chunks.c.infeasible, chunks.c.bytes)
            row = connection.execute(counts_of.where(condition)).first()
            if entry is None or row is None:
                return False
            sizes = {"bytes": 0, "failed": 0, "invalid": 0, "infeasible": 0}
            blank = {**sizes, "digest": None, "attempts": 0, "finished": None, "lease_owner": None}
            state = "waiting" if selection else "pending"
            connection.execute(update(chunks).where(own).values(state=state, **blank))
            counts = {
                "done": entry.done - record.rows,
                "failed": entry.failed - row.failed,
                "invalid": entry.invalid - row.invalid,
                "infeasible": entry.infeasible - row.infeasible,
            }
            if selection:
                counts |= {"selected": 0, "kept": 0}
            if entry.state == "done":
                counts |= {"state": "running", "ended": None, "expires": None}
            rows.change(connection, job, repaired=entry.repaired + 1, bytes=entry.bytes - row.bytes, **counts)
            rows.settle(connection, job, self._clock(), self._limits.keep_s)
            return True

    def adopt(self, job: str, record: Record, digest: str, size: int) -> None:
        """A file that was written before there were digests has one now."""
        with self._database.write() as connection:
            # the job before its chunks, as everywhere: the other way round two transactions wait for each other
            rows.find(connection, job, lock=True)
            own = and_(chunks.c.job == job, chunks.c.start == record.start, chunks.c.stop == record.stop)
            old = and_(own, chunks.c.digest.is_(None), chunks.c.state == "done")
            if connection.execute(update(chunks).where(old).values(digest=digest, bytes=on_disk(size))).rowcount:
                connection.execute(update(jobs).where(jobs.c.id == job).values(bytes=jobs.c.bytes + on_disk(size)))


def _own(chunk: Chunk) -> ColumnElement[bool]:
    return and_(chunks.c.job == chunk.job, chunks.c.start == chunk.start)


def _available(attempted: bool) -> tuple[tuple[ColumnElement[bool], ColumnElement[bool]], ColumnElement[bool]]:
    """Chunks whose lease is over, chunks that never had one, and whether a chunk was tried."""
    over = or_(chunks.c.lease_until < bindparam("now"), chunks.c.lease_until > bindparam("latest"))
    # those of a service that is gone first: however long a sweep is, nobody waits for its first rows to the end
    free = (and_(chunks.c.state == "leased", over), chunks.c.state == "pending")
    return free, chunks.c.attempts > 0 if attempted else chunks.c.attempts == 0


# put together once: that takes longer than the database takes to answer
@cache
def _waiting(attempted: bool) -> Select[Any]:
    """The jobs that have a chunk to give out, those first that shall have it."""
    free, attempts = _available(attempted)
    leased = (
        select(chunks.c.job, func.coalesce(jobs.c.owner, "").label("owner"))
        .join(jobs, jobs.c.id == chunks.c.job)
        .where(chunks.c.state == "leased", chunks.c.lease_until >= bindparam("now"))
        .subquery()
    )
    of_job = select(leased.c.job, func.count().label("busy")).group_by(leased.c.job).subquery()
    of_owner = select(leased.c.owner, func.count().label("busy")).group_by(leased.c.owner).subquery()
    there = exists().where(chunks.c.job == jobs.c.id, or_(*free), attempts)
    return (
        select(jobs.c.id)
        .outerjoin(of_job, of_job.c.job == jobs.c.id)
        .outerjoin(of_owner, of_owner.c.owner == func.coalesce(jobs.c.owner, ""))
        .where(jobs.c.state.in_(ACTIVE), there if attempted else or_(there, jobs.c.planned < jobs.c.total))
        .where(jobs.c.id.not_in(bindparam("others", expanding=True)))
        .order_by(func.coalesce(of_owner.c.busy, 0), func.coalesce(of_job.c.busy, 0), jobs.c.created)
        .limit(_CANDIDATES)
    )


@cache
def _free_of_job(attempted: bool) -> tuple[Select[Any], ...]:
    """Start, stop and attempts of chunks of a job without a lease, at most so many."""
    free, attempts = _available(attempted)
    query = select(chunks.c.start, chunks.c.stop, chunks.c.attempts).where(chunks.c.job == bindparam("job"), attempts)
    return tuple(query.where(condition).order_by(chunks.c.start).limit(bindparam("most")) for condition in free)


def _free(connection: Connection, attempted: bool, about: Mapping[str, Any]) -> list[tuple[int, int, int]]:
    for query in _free_of_job(attempted):
        matches = connection.execute(query, about).all()
        if matches:
            return [(row.start, row.stop, row.attempts) for row in matches]
    return []


def _next_spans(connection: Connection, job: Job) -> list[tuple[int, int, int]]:
    """Make the next chunks of a job."""
    stop = min(job.planned + _PLANNED * job.chunk_rows, job.total)
    starts = range(job.planned, stop, job.chunk_rows)
    spans = [(start, min(start + job.chunk_rows, job.total), 0) for start in starts]
    if spans:
        new = [{"job": job.id, "start": start, "stop": end} for start, end, _ in spans]
        connection.execute(insert(chunks), new)
        connection.execute(update(jobs).where(jobs.c.id == job.id).values(planned=stop))
    return spans


def _finish(connection: Connection, computed: Computed, now: float) -> bool:
    """Whether a chunk was not done before."""
    condition = and_(_own(computed.chunk), chunks.c.stop == computed.chunk.stop, chunks.c.state != "done")
    about = {
        "failed": computed.failed,
        "invalid": computed.invalid,
        "infeasible": computed.infeasible,
        "digest": computed.digest,
        "bytes": on_disk(computed.bytes),
    }
    statement = update(chunks).where(condition).values(state="done", finished=now, lease_owner=None, **about)
    return connection.execute(statement).rowcount > 0
