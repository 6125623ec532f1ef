"""A job and a chunk of it, as they are in the database."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Literal

State = Literal["queued", "running", "done", "failed", "cancelled"]

#: states in which chunks are still given out
ACTIVE: tuple[State, ...] = ("queued", "running")
#: a job whose files are being removed; nobody sees it any more
REMOVED = "removed"


@dataclass(frozen=True)
class Job:
    """Something that is computed apart from the request that asked for it; times in seconds since 1970."""

    id: str
    kind: str
    request: bytes
    columns: bytes | None
    owner: str | None
    state: State
    total: int
    done: int
    failed: int
    version: int
    created: float
    started: float | None
    ended: float | None
    expires: float | None
    error: str | None

    @property
    def active(self) -> bool:
        return self.state in ACTIVE


FIELDS = tuple(field.name for field in fields(Job))


def job_from(row: Mapping[Any, Any]) -> Job:
    return Job(**{name: row[name] for name in FIELDS})


@dataclass(frozen=True)
class Chunk:
    """Rows [start, stop) of a job, leased to be computed."""

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
