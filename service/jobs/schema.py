"""The number of the schema of the job database, and the way from older ones to today's.

1: jobs and chunks, without a number.
2: this table; digests, sizes and failures of chunks; what a job selects, has repaired and takes on disk; chunks made
   when they are leased; expiry in seconds lived.
3: rows of invalid designs counted apart; those of older chunks stay among the failed.
4: rows that are proven infeasible counted among those that failed; of older chunks none.
"""

import json
import uuid

from sqlalchemy import Connection, bindparam, insert, inspect, select, text, update
from sqlalchemy.schema import CreateColumn

from service.jobs.tables import chunks, jobs, metadata, schema

NUMBER = 4

_OLD_JOBS = {
    *("id", "kind", "request", "digest", "idempotency_key", "owner", "columns", "state", "total", "done", "failed"),
    *("faults", "version", "created", "started", "ended", "expires", "error"),
}


_NEW_INDEXES = {"jobs_by_owner", "chunks_by_lease", "chunks_by_finish"}


class WrongSchema(Exception):
    """The database is of another version of the service, or of another program."""


def prepare(connection: Connection) -> None:
    """Make the tables, or bring those of an older schema up to date.

    Raises
    ------
    WrongSchema
        if the database is newer than this service, or has tables that no version of it made.
    """
    tables = set(inspect(connection).get_table_names())
    if "schema" in tables:
        _require_columns(connection, "schema")
        number = connection.scalar(select(schema.c.number))
        if number in (2, 3):
            _add_columns(connection)
            connection.execute(update(schema).values(number=NUMBER))
        elif number != NUMBER:
            raise WrongSchema(f"the job database has schema {number}; this service knows {NUMBER}")
    elif "jobs" in tables:
        columns = _columns(connection, "jobs")
        if columns != _OLD_JOBS:
            raise WrongSchema(
                f"the job database has a table jobs of no known schema: {', '.join(sorted(columns ^ _OLD_JOBS))}"
            )
        _from_1(connection)
        _number(connection)
    else:
        metadata.create_all(connection)
        _number(connection)
    for table in metadata.tables:
        _require_columns(connection, table)


def _number(connection: Connection) -> None:
    connection.execute(insert(schema).values(number=NUMBER, identity=uuid.uuid4().hex, lived=0.0))


def _columns(connection: Connection, table: str) -> set[str]:
    return {column["name"] for column in inspect(connection).get_columns(table)}


def _require_columns(connection: Connection, table: str) -> None:
    missing = {column.name for column in metadata.tables[table].columns} - _columns(connection, table)
    if missing:
        raise WrongSchema(f"the table {table} of the job database lacks {', '.join(sorted(missing))}")


def _add_columns(connection: Connection) -> None:
    for table in (jobs, chunks):
        there = _columns(connection, table.name)
        for column in table.columns:
            if column.name not in there:
                definition = CreateColumn(column).compile(dialect=connection.dialect)
                # rows that are there need a value
                default = "" if column.nullable else f" DEFAULT {'false' if column.name == 'selects' else 0}"
                connection.execute(text(f"ALTER TABLE {table.name} ADD COLUMN {definition}{default}"))


def _from_1(connection: Connection) -> None:
    _add_columns(connection)
    for table in (jobs, chunks):
        for index in table.indexes:
            if index.name in _NEW_INDEXES:
                index.create(connection)
    schema.create(connection)
    # every chunk of theirs was made at once; an end of their time is counted from now
    connection.execute(
        update(jobs).values(planned=jobs.c.total, chunk_rows=1, expires=jobs.c.expires - jobs.c.ended, bytes=0)
    )
    _selections_of_1(connection)


def _selections_of_1(connection: Connection) -> None:
    """Selections that requests computed are computed by workers now, once more."""
    sweeps = select(jobs.c.id).where(jobs.c.kind == "sweep", jobs.c.state != "removed")
    for job in connection.scalars(sweeps).all():
        row = connection.execute(select(jobs.c.request, jobs.c.state, jobs.c.total).where(jobs.c.id == job)).one()
        request = json.loads(row.request)
        statement = update(jobs).where(jobs.c.id == bindparam("job"))
        selects = request.get("top") is not None or request.get("pareto") is not None
        connection.execute(statement.values(seed=request.get("seed", 0), selects=selects), {"job": job})
        if selects:
            ready = row.state == "done"
            chunk = {"job": job, "start": row.total, "stop": row.total, "state": "pending" if ready else "waiting"}
            connection.execute(insert(chunks).values(chunk))
            if ready:
                connection.execute(statement.values(state="running"), {"job": job})
