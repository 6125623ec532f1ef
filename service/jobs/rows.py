"""What several transactions do to the rows of a job."""

import re
from dataclasses import dataclass

from sqlalchemy import Connection, Select, and_, bindparam, select, update

from service.jobs.job import FIELDS, REMOVED, Job, State, job_from
from service.jobs.tables import chunks, jobs, schema

_ID = re.compile(r"[0-9a-f]{32}")
JOB = [jobs.c[name] for name in FIELDS]
# put together once, as every turn runs them
_BY_ID: Select[tuple[object, ...]] = select(*JOB).where(jobs.c.id == bindparam("job"), jobs.c.state != REMOVED)
_LOCKED = _BY_ID.with_for_update()


class UnknownJob(LookupError):
    """There is no job of this id."""


@dataclass(frozen=True)
class Limits:
    """What jobs may take, and how long they are kept.

    keep_s : how long the results of an ended job are kept, in seconds in which a service lives; None is for ever.
    active, active_per_owner : how many jobs may be queued or running, together and of one owner.
    quota_bytes : on disk, for one owner; None is any number.
    """

    keep_s: float | None = None
    active: int = 1000
    active_per_owner: int = 1000
    quota_bytes: int | None = None


def find(connection: Connection, job: str, lock: bool = False) -> Job | None:
    """A job that is not removed, if there is one."""
    # a database may choke on what is no id
    if _ID.fullmatch(job) is None:
        return None
    row = connection.execute(_LOCKED if lock else _BY_ID, {"job": job}).mappings().first()
    return None if row is None else job_from(row)


def get(connection: Connection, job: str, lock: bool = False) -> Job:
    """
    Raises
    ------
    UnknownJob
    """
    entry = find(connection, job, lock)
    if entry is None:
        raise UnknownJob(job)
    return entry


def change(connection: Connection, job: str, **values: object) -> None:
    """Change a job, and raise its version for its watchers."""
    connection.execute(update(jobs).where(jobs.c.id == job).values(version=jobs.c.version + 1, **values))


def end(connection: Connection, job: Job, state: State, error: str | None, now: float, keep_s: float | None) -> None:
    """End a job that is active."""
    expires = None
    if keep_s is not None:
        expires = (connection.scalar(select(schema.c.lived)) or 0.0) + keep_s
    change(connection, job.id, state=state, error=error, ended=now, expires=expires)


def settle(connection: Connection, job: str, now: float, keep_s: float | None) -> None:
    """End a job that has all it needs; have rows selected when there are all, or twice as many as the last time."""
    entry = get(connection, job)
    if not entry.active:
        return
    whole = entry.done == entry.total
    if whole and (not entry.selects or entry.selected == entry.total):
        end(connection, entry, "done", entry.error, now, keep_s)
    elif entry.selects and entry.done > entry.selected and (whole or entry.done >= 2 * entry.selected):
        selection = and_(chunks.c.job == job, chunks.c.start == entry.total, chunks.c.state == "waiting")
        connection.execute(update(chunks).where(selection).values(state="pending"))
