"""The end of jobs: marked, then the files, then the rows, so that a crash in between leaves nothing behind."""

import time
from collections.abc import Callable

from sqlalchemy import and_, delete, func, select, update

from service.jobs import rows
from service.jobs.database import Database
from service.jobs.job import ACTIVE, REMOVED
from service.jobs.tables import chunks, jobs, schema


class Retention:
    """Which jobs there still are.

    Time is that in which some service lives, so that no jump of a clock ends anything. Each service adds the time since
    its last look, unless another has added it already.

    Parameters
    ----------
    clock : monotonic seconds.
    """

    def __init__(self, database: Database, clock: Callable[[], float] = time.monotonic) -> None:
        self._database = database
        self._clock = clock
        #: lived seconds as last seen, and when that was
        self._last: tuple[float, float] | None = None

    def mark_removed(self, job: str) -> None:
        """Make an ended job unknown; its idempotency key is free again.

        Raises
        ------
        UnknownJob
        """
        with self._database.write() as connection:
            rows.get(connection, job)
            rows.change(connection, job, state=REMOVED, idempotency_key=None)

    def mark_expired(self) -> None:
        """Mark the jobs whose time is over."""
        with self._database.write() as connection:
            now, lived = self._clock(), connection.scalar(select(schema.c.lived)) or 0.0
            if self._last is not None:
                before, then = self._last
                lived = max(lived, before + max(0.0, now - then))
                connection.execute(update(schema).values(lived=lived))
            self._last = lived, now
            over = and_(jobs.c.expires < lived, jobs.c.state.not_in([*ACTIVE, REMOVED]))
            connection.execute(update(jobs).where(over).values(state=REMOVED, idempotency_key=None))

    def removed(self) -> list[str]:
        """Jobs whose files are to be removed."""
        with self._database.read() as connection:
            return list(connection.scalars(select(jobs.c.id).where(jobs.c.state == REMOVED)))

    def forget(self, job: str) -> None:
        """Remove the rows of a job that is marked."""
        with self._database.write() as connection:
            marked = and_(jobs.c.id == job, jobs.c.state == REMOVED)
            if connection.scalar(select(func.count()).select_from(jobs).where(marked)):
                connection.execute(delete(chunks).where(chunks.c.job == job))
                connection.execute(delete(jobs).where(marked))

    def job_ids(self) -> set[str]:
        """All jobs, also those that are marked."""
        with self._database.read() as connection:
            return set(connection.scalars(select(jobs.c.id)))

    def ended(self) -> dict[str, int]:
        """The versions of the jobs that have ended, by id."""
        with self._database.read() as connection:
            over = jobs.c.state.not_in([*ACTIVE, REMOVED])
            query = select(jobs.c.id, jobs.c.version).where(over).order_by(jobs.c.id)
            return {row.id: row.version for row in connection.execute(query)}

    def identity(self) -> str:
        """Of the database: the same for all services that share it."""
        with self._database.read() as connection:
            return str(connection.scalar(select(schema.c.identity)))
