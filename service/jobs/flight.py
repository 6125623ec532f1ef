"""A chunk that was handed to an engine."""

from concurrent.futures import Future
from dataclasses import dataclass, field

from service.jobs.job import Chunk
from service.jobs.piece import ChunkResult


@dataclass(eq=False)
class RunningChunk:
    """A chunk on its way.

    covers : rows that a selection looks at.
    dropped : whether its job has ended meanwhile.
    """

    chunk: Chunk
    future: "Future[ChunkResult]"
    covers: int = 0
    dropped: bool = field(default=False)

    @property
    def rows_came(self) -> bool:
        """Whether it is done, and its rows count."""
        future = self.future
        has_rows = self.chunk.rows > 0 and not self.dropped
        return has_rows and future.done() and not future.cancelled() and future.exception() is None
