"""A job and a chunk of it, as they are in the database."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Literal

State = Literal["queued", "running", "done", "failed", "cancelled"]

#: states in which chunks are still leased
ACTIVE: tuple[State, ...] = ("queued", "running")
#: a job whose files are being removed; nobody sees it any more
REMOVED = "removed"


@dataclass(frozen=True)
class Order:
    """What somebody wants to be computed apart from the request that asks for it."""

    kind: str
    request: bytes
    #: what makes two requests the same
    fingerprint: str
    total: int = 1
    chunk_rows: int = 1
    #: an Arrow schema; None where the answer is no table
    columns: bytes | None = None
    seed: int = 0
    #: whether some of the rows are selected in the end
    selects: bool = False
    expected_bytes: int = 0
    owner: str | None = None
    #: the idempotency key
    key: str | None = None


@dataclass(frozen=True)
class Job:
    """A computation apart from its request; times in seconds since 1970."""

    id: str
    kind: str
    owner: str | None
    state: State
    total: int
    done: int
    #: rows without a certified answer, and rows of designs that break a rule; no row is both
    failed: int
    invalid: int
    #: of the rows that failed, those that are proven infeasible
    infeasible: int
    version: int
    created: float
    started: float | None
    ended: float | None
    error: str | None
    seed: int
    chunk_rows: int
    planned: int
    selects: bool
    #: how many rows were looked at for the selection, and how many of them stay
    selected: int
    kept: int
    repaired: int
    bytes: int

    @property
    def active(self) -> bool:
        return self.state in ACTIVE


FIELDS = tuple(field.name for field in fields(Job))


def job_from(row: Mapping[Any, Any]) -> Job:
    return Job(**{name: row[name] for name in FIELDS})


@dataclass(frozen=True)
class Chunk:
    """Rows [start, stop) of a job, leased to be computed; without rows it is the selection of the job."""

    job: str
    kind: str
    request: bytes
    start: int
    stop: int
    #: how often it went wrong so far
    attempts: int

    @property
    def rows(self) -> int:
        return self.stop - self.start


@dataclass(frozen=True)
class Computed:
    """A chunk whose file is on disk: rows without a certified answer, digest and size of the file, rows of invalid
    designs. Of the rows without an answer it has the proven infeasible ones."""

    chunk: Chunk
    failed: int
    digest: str
    bytes: int
    invalid: int = 0
    infeasible: int = 0


@dataclass(frozen=True)
class Record:
    """The file of a finished chunk; without a digest it was written before there were digests."""

    start: int
    stop: int
    digest: str | None
    bytes: int

    @property
    def rows(self) -> int:
        return self.stop - self.start
