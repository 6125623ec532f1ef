"""How what workers have computed is taken in: first the files, then the database says that they are there."""

import logging
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor

from service.jobs.files import JobFiles
from service.jobs.housekeeping import Housekeeping
from service.jobs.job import Chunk, Computed, Record
from service.jobs.leases import Leases
from service.jobs.piece import ChunkResult

_LOG = logging.getLogger(__name__)
#: files that are written at the same time: most of the time of one is waiting for the disk
_WRITERS = 8


class CannotWrite(Exception):
    """There is no room for the rows of a job, or the disk is broken."""


class ResultWriter:
    """Takes pieces in; done twice it changes nothing, so that a crash costs work and no rows."""

    def __init__(self, leases: Leases, files: JobFiles, housekeeping: Housekeeping) -> None:
        self._leases, self._files, self._housekeeping = leases, files, housekeeping
        #: number of own answers, so far, that the service has reported as wrong
        self.faults = 0

    def keep_rows(self, job: str, came: Sequence[tuple[Chunk, ChunkResult]]) -> None:
        """Keep the rows of some chunks of one job, in one transaction.

        Raises
        ------
        CannotWrite
            those before are kept all the same.
        """
        for chunk, piece in came:
            self._tell_faults(chunk, piece)
        records, error = self._records(came)
        computed = [
            Computed(chunk, piece.failed, str(record.digest), record.bytes, piece.invalid, piece.infeasible)
            for (chunk, piece), record in zip(came, records, strict=False)
        ]
        for record, counts in zip(records, self._leases.finish(computed), strict=True):
            # another service may have been first, with a file of another content
            if not counts:
                self._housekeeping.remove(job, record)
        if error is not None:
            raise error

    def keep_selection(self, chunk: Chunk, piece: ChunkResult, covers: int) -> None:
        """Keep the rows that were selected of so many.

        Raises
        ------
        CannotWrite
        """
        needless = self._leases.finish_selection(chunk, covers, piece.selection_rows, self._write(chunk, piece))
        if needless is not None:
            self._housekeeping.remove(chunk.job, needless)

    def _tell_faults(self, chunk: Chunk, piece: ChunkResult) -> None:
        for fault in piece.faults:
            _LOG.error("job %s: rows %d to %d: %s", chunk.job, chunk.start, chunk.stop - 1, fault)
        self.faults += len(piece.faults)

    def _records(self, came: Sequence[tuple[Chunk, ChunkResult]]) -> tuple[list[Record], CannotWrite | None]:
        """The files up to the first that cannot be written, and why it cannot; those after it are removed."""
        if len(came) == 1:
            outcomes = [self._outcome(came[0])]
        else:
            with ThreadPoolExecutor(min(_WRITERS, len(came))) as writers:
                outcomes = list(writers.map(self._outcome, came))
        records: list[Record] = []
        error = None
        for (chunk, _), outcome in zip(came, outcomes, strict=True):
            if isinstance(outcome, CannotWrite):
                error = error or outcome
            elif error is None:
                records.append(outcome)
            else:
                self._housekeeping.remove(chunk.job, outcome)
        return records, error

    def _outcome(self, pair: tuple[Chunk, ChunkResult]) -> Record | CannotWrite:
        try:
            return self._write(*pair)
        except CannotWrite as error:
            return error

    def _write(self, chunk: Chunk, piece: ChunkResult) -> Record:
        try:
            return self._files.keep(chunk.job, chunk.start, chunk.stop, piece.content)
        except OSError as error:
            words = f"rows {chunk.start} to {chunk.stop - 1}" if chunk.rows else "selected rows"
            raise CannotWrite(f"{words} cannot be written: {error.strerror}") from error
