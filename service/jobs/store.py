"""What is known about jobs, and the only place that changes it. Every method is one transaction."""

import hashlib
import json
import re
import time
import uuid
from collections.abc import Callable, Sequence

from sqlalchemy import Connection, and_, delete, exists, func, insert, or_, select, tuple_, update
from sqlalchemy.exc import IntegrityError

from service.jobs.database import Database
from service.jobs.job import ACTIVE, FIELDS, REMOVED, Chunk, Job, State, job_from
from service.jobs.tables import chunks, jobs

_ID = re.compile(r"[0-9a-f]{32}")
_JOB = [jobs.c[name] for name in FIELDS]


class UnknownJob(LookupError):
    """There is no job of this id."""


class KeyReused(ValueError):
    """The idempotency key came with another request before."""


class TooManyJobs(Exception):
    """As many jobs as are allowed are waiting or running."""


def digest(kind: str, body: object) -> str:
    """What makes two requests the same: kind and JSON value, not white space or the order of fields."""
    text = json.dumps([kind, body], sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()


class Store:
    """The jobs in a database.

    Parameters
    ----------
    keep_s : how long the results of an ended job are kept [s]; None is for ever.
    max_active : how many jobs may be queued or running.
    clock : seconds since 1970. Leases of services whose clocks differ overlap, which costs work and no rows.
    """

    def __init__(
        self,
        database: Database,
        keep_s: float | None = None,
        max_active: int = 1000,
        clock: Callable[[], float] = time.time,
    ) -> None:
        self._database = database
        self._keep_s = keep_s
        self._max_active = max_active
        self._clock = clock

    def close(self) -> None:
        self._database.close()

    # ---- what clients do

    def submit(
        self,
        kind: str,
        request: bytes,
        fingerprint: str,
        total: int,
        chunk_rows: int,
        columns: bytes | None = None,
        owner: str | None = None,
        key: str | None = None,
    ) -> tuple[Job, bool]:
        """A new job, or the one that the key has started before; it is on disk when this returns.

        Returns
        -------
        the job, and whether it is new.

        Raises
        ------
        KeyReused
            if the key came with another request before.
        TooManyJobs
        """
        try:
            with self._database.write() as connection:
                known = _by_key(connection, owner, key)
                if known is None:
                    return self._insert(
                        connection, kind, request, fingerprint, total, chunk_rows, columns, owner, key
                    ), True
        except IntegrityError:
            # another service took the same key in the same moment
            with self._database.read() as connection:
                known = _by_key(connection, owner, key)
            if known is None:
                raise
        found, its_fingerprint = known
        if its_fingerprint != fingerprint:
            raise KeyReused("This Idempotency-Key came with another request before; take a new key.")
        return found, False

    def _insert(
        self,
        connection: Connection,
        kind: str,
        request: bytes,
        fingerprint: str,
        total: int,
        chunk_rows: int,
        columns: bytes | None,
        owner: str | None,
        key: str | None,
    ) -> Job:
        active = connection.scalar(select(func.count()).select_from(jobs).where(jobs.c.state.in_(ACTIVE)))
        if active is not None and active >= self._max_active:
            raise TooManyJobs(f"{active} jobs are waiting or running; try again later.")
        job = uuid.uuid4().hex
        connection.execute(
            insert(jobs).values(
                id=job,
                kind=kind,
                request=request,
                digest=fingerprint,
                idempotency_key=key,
                owner=owner,
                columns=columns,
                state="queued",
                total=total,
                created=self._clock(),
            )
        )
        starts = range(0, total, chunk_rows)
        rows = [{"job": job, "start": start, "stop": min(start + chunk_rows, total)} for start in starts]
        connection.execute(insert(chunks), rows)
        return _get(connection, job)

    def get(self, job: str) -> Job:
        """
        Raises
        ------
        UnknownJob
        """
        with self._database.read() as connection:
            return _get(connection, job)

    def page(self, kinds: Sequence[str], limit: int, before: str | None = None, owner: str | None = None) -> list[Job]:
        """Jobs of an owner, or of all, newest first, after the one of id ``before``.

        Raises
        ------
        UnknownJob
            if there is no job ``before``.
        """
        wanted = select(*_JOB).where(jobs.c.state != REMOVED, jobs.c.kind.in_(kinds))
        if owner is not None:
            wanted = wanted.where(jobs.c.owner == owner)
        with self._database.read() as connection:
            if before is not None:
                last = _get(connection, before)
                older = and_(jobs.c.created == last.created, jobs.c.id < last.id)
                wanted = wanted.where(or_(jobs.c.created < last.created, older))
            wanted = wanted.order_by(jobs.c.created.desc(), jobs.c.id.desc()).limit(limit)
            return [job_from(row) for row in connection.execute(wanted).mappings()]

    def counts(self) -> dict[str, tuple[int, int, int]]:
        """By state: number of jobs, their finished rows, and those of them that failed."""
        sums = (func.count(), func.sum(jobs.c.done), func.sum(jobs.c.failed))
        wanted = select(jobs.c.state, *sums).where(jobs.c.state != REMOVED).group_by(jobs.c.state)
        with self._database.read() as connection:
            return {state: (count, int(done), int(failed)) for state, count, done, failed in connection.execute(wanted)}

    def pieces(self, job: str) -> list[tuple[int, int]]:
        """Start and stop of the chunks that are done, in order."""
        wanted = select(chunks.c.start, chunks.c.stop).where(chunks.c.job == job, chunks.c.state == "done")
        with self._database.read() as connection:
            return [(row.start, row.stop) for row in connection.execute(wanted.order_by(chunks.c.start))]

    def rows_since(self, job: str, moment: float) -> int:
        """Number of rows that were finished after a moment [s since 1970]."""
        rows = select(func.sum(chunks.c.stop - chunks.c.start))
        with self._database.read() as connection:
            return int(connection.scalar(rows.where(chunks.c.job == job, chunks.c.finished > moment)) or 0)

    def cancel(self, job: str) -> Job:
        """Give out no more chunks; what is finished stays. An ended job stays as it is.

        Raises
        ------
        UnknownJob
        """
        with self._database.write() as connection:
            self._end(connection, job, "cancelled", None)
            return _get(connection, job)

    def resume(self, job: str) -> Job:
        """Go on with a cancelled or failed job where it ended; any other job stays as it is.

        Raises
        ------
        UnknownJob
        """
        with self._database.write() as connection:
            found = _get(connection, job, lock=True)
            if found.state in ("cancelled", "failed"):
                open_chunk = and_(chunks.c.job == job, chunks.c.state != "done")
                connection.execute(
                    update(chunks).where(open_chunk).values(state="pending", attempts=0, lease_owner=None)
                )
                values = {"state": "queued", "error": None, "ended": None, "expires": None, "faults": 0}
                _change(connection, job, **values)
            return _get(connection, job)

    # ---- what coordinators do

    def claim(self, owner: str, lease_s: float, attempted: bool = False) -> Chunk | None:
        """Lease one chunk of the job with the fewest chunks in work, so that small jobs need not wait for large ones.

        Parameters
        ----------
        attempted : whether to lease a chunk that went wrong before, or a fresh one.
        """
        now = self._clock()
        busy = (
            select(chunks.c.job, func.count().label("busy"))
            .where(chunks.c.state == "leased", chunks.c.lease_until >= now)
            .group_by(chunks.c.job)
            .subquery()
        )
        waiting = (
            select(jobs.c.id)
            .outerjoin(busy, busy.c.job == jobs.c.id)
            .where(jobs.c.state.in_(ACTIVE))
            .order_by(func.coalesce(busy.c.busy, 0), jobs.c.created)
        )
        tried = chunks.c.attempts > 0 if attempted else chunks.c.attempts == 0
        free = (
            chunks.c.state == "pending",
            and_(chunks.c.state == "leased", chunks.c.lease_until < now),
        )
        with self._database.read() as connection:
            candidates = list(
                connection.scalars(waiting.where(exists().where(chunks.c.job == jobs.c.id, or_(*free), tried)))
            )
        for job in candidates:
            with self._database.write() as connection:
                found = _get(connection, job, lock=True, missing_ok=True)
                if found is None or not found.active:
                    continue
                for condition in free:
                    wanted = select(chunks).where(chunks.c.job == job, condition, tried)
                    row = connection.execute(wanted.order_by(chunks.c.start).limit(1)).first()
                    if row is not None:
                        this = and_(chunks.c.job == job, chunks.c.start == row.start)
                        lease = {"state": "leased", "lease_owner": owner, "lease_until": now + lease_s}
                        connection.execute(update(chunks).where(this).values(lease))
                        if found.state == "queued":
                            _change(connection, job, state="running", started=found.started or now)
                        return Chunk(job, found.kind, found.request, row.start, row.stop, row.attempts)
        return None

    def renew(self, owner: str, held: Sequence[Chunk], lease_s: float) -> None:
        """Keep the leases of some chunks of an owner."""
        these = tuple_(chunks.c.job, chunks.c.start).in_([(chunk.job, chunk.start) for chunk in held])
        mine = and_(these, chunks.c.lease_owner == owner, chunks.c.state == "leased")
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

    def finish(self, chunk: Chunk, failed: int) -> None:
        """The file of a chunk is on disk. Said twice it counts once; said of an ended job it does not count."""
        with self._database.write() as connection:
            found = _get(connection, chunk.job, lock=True, missing_ok=True)
            if found is None or not found.active:
                return
            this = and_(chunks.c.job == chunk.job, chunks.c.start == chunk.start, chunks.c.stop == chunk.stop)
            done = update(chunks).where(this, chunks.c.state != "done").values(state="done", finished=self._clock())
            if connection.execute(done).rowcount == 0:
                return
            _change(connection, chunk.job, done=jobs.c.done + chunk.rows, failed=jobs.c.failed + failed)
            if found.done + chunk.rows == found.total:
                self._end(connection, chunk.job, "done", None)

    def give_back(self, chunk: Chunk, attempts: int) -> None:
        """A chunk went wrong ``attempts`` times by now and shall be tried again."""
        this = and_(chunks.c.job == chunk.job, chunks.c.start == chunk.start, chunks.c.state == "leased")
        with self._database.write() as connection:
            values = {"state": "pending", "attempts": attempts, "lease_owner": None}
            connection.execute(update(chunks).where(this).values(values))

    def halve(self, chunk: Chunk) -> int:
        """Replace a chunk that keeps going wrong by its halves, so that the rows at fault end up alone.

        Returns
        -------
        number of faults of the job so far.
        """
        middle = chunk.start + chunk.rows // 2
        this = and_(chunks.c.job == chunk.job, chunks.c.start == chunk.start, chunks.c.stop == chunk.stop)
        with self._database.write() as connection:
            _get(connection, chunk.job, lock=True)
            values = {"state": "pending", "lease_owner": None, "attempts": 1}
            cut = update(chunks).where(this, chunks.c.state != "done").values(stop=middle, **values)
            if connection.execute(cut).rowcount:
                half = {"job": chunk.job, "start": middle, "stop": chunk.stop, **values}
                connection.execute(insert(chunks).values(half))
                _change(connection, chunk.job, faults=jobs.c.faults + 1)
            return int(connection.scalar(select(jobs.c.faults).where(jobs.c.id == chunk.job)) or 0)

    def fail(self, job: str, error: str) -> None:
        """End a job with a reason; the rows that are there stay."""
        with self._database.write() as connection:
            self._end(connection, job, "failed", error)

    def _end(self, connection: Connection, job: str, state: State, error: str | None) -> None:
        if _get(connection, job, lock=True).active:
            now = self._clock()
            expires = None if self._keep_s is None else now + self._keep_s
            _change(connection, job, state=state, error=error, ended=now, expires=expires)

    # ---- removal: marked, then the files, then the rows, so that a crash in between leaves nothing behind

    def mark_removed(self, job: str) -> None:
        """Make an ended job unknown; its idempotency key is free again.

        Raises
        ------
        UnknownJob
        """
        with self._database.write() as connection:
            _get(connection, job)
            _change(connection, job, state=REMOVED, idempotency_key=None)

    def mark_expired(self) -> None:
        """Mark the jobs whose time is over."""
        with self._database.write() as connection:
            over = and_(jobs.c.expires < self._clock(), jobs.c.state.not_in([*ACTIVE, REMOVED]))
            connection.execute(update(jobs).where(over).values(state=REMOVED, idempotency_key=None))

    def removed(self) -> list[str]:
        """Jobs whose files are to be removed."""
        with self._database.read() as connection:
            return list(connection.scalars(select(jobs.c.id).where(jobs.c.state == REMOVED)))

    def forget(self, job: str) -> None:
        """Remove the rows of a job that is marked."""
        with self._database.write() as connection:
            connection.execute(delete(chunks).where(chunks.c.job == job))
            connection.execute(delete(jobs).where(jobs.c.id == job, jobs.c.state == REMOVED))


def _get(connection: Connection, job: str, lock: bool = False, missing_ok: bool = False) -> Job:
    wanted = select(*_JOB).where(jobs.c.id == job, jobs.c.state != REMOVED)
    # a database may choke on what is no id
    known = _ID.fullmatch(job) is not None
    row = connection.execute(wanted.with_for_update() if lock else wanted).mappings().first() if known else None
    if row is None:
        if missing_ok:
            return None  # type: ignore[return-value]
        raise UnknownJob(job)
    return job_from(row)


def _by_key(connection: Connection, owner: str | None, key: str | None) -> tuple[Job, str] | None:
    if key is None:
        return None
    same = and_(func.coalesce(jobs.c.owner, "") == (owner or ""), jobs.c.idempotency_key == key)
    row = connection.execute(select(*_JOB, jobs.c.digest).where(same)).mappings().first()
    return None if row is None else (job_from(row), row["digest"])


def _change(connection: Connection, job: str, **values: object) -> None:
    connection.execute(update(jobs).where(jobs.c.id == job).values(version=jobs.c.version + 1, **values))
