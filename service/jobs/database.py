"""The database of the jobs: SQLite in a file, or whatever else a connection string names (PostgreSQL)."""

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from sqlalchemy import URL, Connection, Engine, create_engine, event, make_url
from sqlalchemy.exc import ArgumentError, DBAPIError, IntegrityError, NoSuchModuleError, ProgrammingError
from sqlalchemy.exc import TimeoutError as PoolTimeout

from service.common.private import close, make_file, make_folder
from service.jobs.schema import prepare

#: what stays of the write-ahead log of SQLite when a reader had it grow; as much as it has without that
_LOG_BYTES = 1000 * 4096


class DatabaseUnavailable(Exception):
    """The database is locked, full or cannot be reached; a retry may help.

    full : whether it lacks room on disk.
    """

    def __init__(self, message: str, full: bool = False) -> None:
        self.full = full
        super().__init__(message)


class Database:
    """Transactions on the job tables, which are made if they are missing and brought up to date if they are old.

    Parameters
    ----------
    url : connection string, or the path of an SQLite file.
    busy_s : how long a transaction waits for a locked database, or for one that takes no connection [s].

    Raises
    ------
    ValueError
        if ``url`` is no connection string of a supported database.
    """

    def __init__(self, url: str | Path, busy_s: float = 5.0) -> None:
        try:
            where = URL.create("sqlite", database=str(url)) if isinstance(url, Path) else make_url(url)
            self._engine = _engine(where, busy_s)
        except ModuleNotFoundError as error:
            if error.name != "psycopg":
                raise ValueError(f"not a database: {error}") from None
            message = "PostgreSQL needs an extra: pip install '.[postgres]' beside pyproject.toml"
            raise ValueError(message) from None
        except (ArgumentError, NoSuchModuleError) as error:
            raise ValueError(f"not a database: {error}") from None
        # a reader never waits for a writer; a writer takes the lock at once, as an upgrade ignores the busy timeout
        self._writer = self._engine.execution_options(immediate=True)
        self._folder = url.parent if isinstance(url, Path) else None
        self._file = _file(where)
        self._has_tables = False

    @contextmanager
    def read(self) -> Iterator[Connection]:
        """A transaction that only reads.

        Raises
        ------
        DatabaseUnavailable, WrongSchema
        """
        with self._unavailable():
            self._make_tables()
            with self._engine.begin() as connection:
                yield connection

    @contextmanager
    def write(self) -> Iterator[Connection]:
        """A transaction that is on disk when the block has ended.

        Raises
        ------
        DatabaseUnavailable, WrongSchema
        """
        with self._unavailable():
            self._make_tables()
            with self._writer.begin() as connection:
                yield connection

    def check(self) -> None:
        """Look whether the tables are there, and are those of this service.

        Raises
        ------
        DatabaseUnavailable, WrongSchema
        """
        with self.read():
            pass

    def _make_tables(self) -> None:
        if not self._has_tables:
            if self._folder is not None:
                make_folder(self._folder)
            if self._file is not None:
                _make(self._file)
            with self._writer.begin() as connection:
                if connection.dialect.name == "postgresql":
                    # two services that start together: CREATE TABLE IF NOT EXISTS alone is not safe against itself
                    connection.exec_driver_sql("SELECT pg_advisory_xact_lock(7021962)")
                prepare(connection)
            self._has_tables = True

    @contextmanager
    def _unavailable(self) -> Iterator[None]:
        try:
            yield
        except DBAPIError as error:
            # integrity errors are for the store to read, the rest is the database's own trouble
            if isinstance(error, IntegrityError):
                raise
            if _knows_other_tables(error):
                # somebody has changed them since: the next call raises what is wrong
                self._has_tables = False
            full = getattr(error.orig, "sqlite_errorcode", None) == sqlite3.SQLITE_FULL
            raise DatabaseUnavailable(f"the job database does not answer: {error.orig}", full) from error
        except (sqlite3.Error, PoolTimeout, OSError) as error:
            raise DatabaseUnavailable(f"the job database does not answer: {error}") from error

    def close(self) -> None:
        """Close every connection."""
        self._engine.dispose()


def _knows_other_tables(error: DBAPIError) -> bool:
    """Whether a statement made no sense to the database, which is neither locked nor away."""
    code = getattr(error.orig, "sqlite_errorcode", None)
    return isinstance(error, ProgrammingError) or code == sqlite3.SQLITE_ERROR


def _file(url: URL) -> Path | None:
    """The file of a database; None if it is none, or not named by a path."""
    name = url.database if url.get_backend_name() == "sqlite" else None
    return None if name is None or name == ":memory:" or name.startswith("file:") else Path(name)


def _make(file: Path) -> None:
    """Make the file of a database, which nobody else may read; what SQLite puts beside it gets the same rights."""
    make_file(file)
    for end in ("-wal", "-shm"):
        close(file.with_name(file.name + end))


def _engine(url: URL, busy_s: float) -> Engine:
    if url.get_backend_name() == "sqlite":
        return _sqlite(url, busy_s)
    if url.drivername == "postgresql":
        url = url.set(drivername="postgresql+psycopg")
    # a connection that the server has closed is replaced before it is used; psycopg counts whole seconds
    patience = {"connect_timeout": max(2, round(busy_s))}
    return create_engine(url, pool_pre_ping=True, pool_timeout=busy_s, connect_args=patience)


def _sqlite(url: URL, busy_s: float) -> Engine:
    engine = create_engine(url, connect_args={"timeout": busy_s}, pool_timeout=busy_s)

    @event.listens_for(engine, "connect")
    def connected(connection: Any, _: object) -> None:
        # sqlite3 must not begin transactions of its own
        connection.isolation_level = None
        for pragma in (
            "journal_mode = WAL",
            f"journal_size_limit = {_LOG_BYTES}",
            "synchronous = FULL",
            "foreign_keys = ON",
        ):
            connection.execute(f"PRAGMA {pragma}")

    @event.listens_for(engine, "begin")
    def begun(connection: Connection) -> None:
        immediate = connection.get_execution_options().get("immediate", False)
        connection.exec_driver_sql("BEGIN IMMEDIATE" if immediate else "BEGIN")

    return engine
