"""Room on disk that the jobs of an owner take: their files, and their part of a database that is a file."""

import os
from contextlib import suppress

from sqlalchemy import ColumnElement, Connection, and_, case, func, select

from service.jobs.job import ACTIVE
from service.jobs.tables import jobs

#: a file takes whole blocks of a disk
_BLOCK = 4096
#: what the database keeps of a job or a chunk beside the request and the columns, with its indexes, roughly [bytes]
_ROW = 400
#: of one job in the database: its request, and the columns of its answer
_TEXT: ColumnElement[int] = func.length(jobs.c.request) + func.coalesce(func.length(jobs.c.columns), 0)


def on_disk(size: int) -> int:
    """What a file of a size takes."""
    return -(-size // _BLOCK) * _BLOCK


def of(owner: str | None) -> ColumnElement[bool]:
    """The condition that a job belongs to an owner; nobody is an owner too."""
    return jobs.c.owner.is_(None) if owner is None else jobs.c.owner == owner


def exceeds(connection: Connection, owner: str | None, quota: int) -> bool:
    """Whether the jobs of an owner take more than so many bytes on disk."""
    # runs for each chunk: his part of the database is looked at where all of it would be too much
    most = int(connection.scalar(select(func.sum(jobs.c.bytes)).where(of(owner))) or 0)
    if connection.dialect.name == "sqlite":
        most += _database(connection)
    return most > quota and usage(connection, owner) > quota


def usage(connection: Connection, owner: str | None, planned: bool = False) -> int:
    """Bytes on disk of the jobs of an owner; with those that the active ones are expected to come to if planned.

    SQLite keeps its file beside those of the jobs, with all that it writes there. Each owner has a part of it, by what
    it keeps of his jobs. A database elsewhere counts as the requests and columns in it.
    """
    size: ColumnElement[int] = jobs.c.bytes
    if planned:
        more = and_(jobs.c.state.in_(ACTIVE), jobs.c.expected_bytes > jobs.c.bytes)
        size = case((more, jobs.c.expected_bytes), else_=jobs.c.bytes)
    if connection.dialect.name != "sqlite":
        return int(connection.scalar(select(func.sum(size)).where(of(owner))) or 0)
    content = _TEXT + _ROW * (1 + jobs.c.planned / jobs.c.chunk_rows)
    of_owner = select(func.sum(size), func.sum(_TEXT), func.sum(content)).where(of(owner))
    everything, text, content_of_owner = (int(value or 0) for value in connection.execute(of_owner).one())
    whole = int(connection.scalar(select(func.sum(content))) or 0)
    # the text is in the database, which is counted as it is
    return everything - text + (-(-_database(connection) * content_of_owner // whole) if whole else 0)


def _database(connection: Connection) -> int:
    """What SQLite takes; pages that are free again are anybody's."""
    count, free, size = (
        int(connection.exec_driver_sql(f"PRAGMA {name}").scalar() or 0)
        for name in ("page_count", "freelist_count", "page_size")
    )
    path = connection.exec_driver_sql("SELECT file FROM pragma_database_list WHERE name = 'main'").scalar()
    beside = 0
    for end in ("-wal", "-shm"):
        # one in memory has none, and the last to close it removes them
        with suppress(OSError):
            beside += os.stat(f"{path}{end}").st_size
    return (count - free) * size + beside
