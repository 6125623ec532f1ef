"""The one thread of a service that gives out chunks and takes in their files.

Services that share a database and a folder share the work: a chunk is leased, and a lease that is not renewed is free
again. Everything that is done twice is done with the same outcome, so a crash at any moment costs work and no rows.
"""

import logging
import threading
import time
import uuid
from collections.abc import Callable, Sequence
from concurrent.futures import BrokenExecutor, CancelledError, Future
from contextlib import suppress
from itertools import groupby
from operator import attrgetter

from service.jobs import selection, worker
from service.jobs.database import DatabaseUnavailable
from service.jobs.engines import Engine, EngineUnavailable
from service.jobs.files import Damaged, JobFiles
from service.jobs.flight import RunningChunk
from service.jobs.housekeeping import Housekeeping
from service.jobs.intake import CannotWrite, ResultWriter
from service.jobs.job import Chunk
from service.jobs.kinds import KINDS
from service.jobs.leases import Leases
from service.jobs.pace import Pace
from service.jobs.piece import ChunkResult, Run, Stopped, Unanswerable
from service.jobs.rows import UnknownJob
from service.jobs.schema import WrongSchema
from service.jobs.store import Store

_LOG = logging.getLogger(__name__)
#: chunks that an engine holds are leased in so many turns, so that a job gets a sixteenth of it more than its share
_TURNS = 16
#: chunks whose rows are taken in before anything else is looked at
_AT_A_TIME = 100
_job = attrgetter("chunk.job")


class Coordinator:
    """Runs the chunks of jobs on an engine, in a thread of its own.

    A database that does not answer costs time and nothing else: jobs stay as they are, and are gone on with. A full
    disk fails the jobs that need it.

    Parameters
    ----------
    selector : engine whose workers read the files of the jobs; the same as ``engine`` if that one's do.
    run : computes a chunk; importable by workers.
    begun : whether there can be jobs at all; until then the store is not touched.
    clock : monotonic seconds.
    """

    def __init__(  # noqa: PLR0913 - whom it works with, each by itself in tests
        self,
        store: Store,
        leases: Leases,
        files: JobFiles,
        housekeeping: Housekeeping,
        engine: Engine,
        *,
        selector: Engine | None = None,
        pace: Pace | None = None,
        run: Run = worker.run,
        begun: Callable[[], bool] = lambda: True,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._store, self._leases, self._files, self._housekeeping = store, leases, files, housekeeping
        self._intake = ResultWriter(leases, files, housekeeping)
        self._engine, self._selector, self._run, self._clock = engine, selector or engine, run, clock
        self._pace, self._begun = pace or Pace(), begun
        self._name = uuid.uuid4().hex
        self._flights: list[RunningChunk] = []
        self._active: set[str] = set()
        # jobs that are read here, and those of a later version, which services of that one compute
        self._read, self._later = set[str](), set[str]()
        # chunks that were in a pool when it broke are tried alone, to identify the one at fault
        self._suspects = True
        # jobs that ended badly while the database was out of reach
        self._verdicts: dict[str, str] = {}
        self._away = False
        self._renewed = self._tidied = float("-inf")
        self._stopping = False
        self._wake = threading.Event()
        self._thread: threading.Thread | None = None
        self._starting = threading.Lock()

    def start(self) -> None:
        """Start the thread, once, and have it look for work."""
        with self._starting:
            if self._thread is None and not self._stopping:
                self._thread = threading.Thread(target=self._work, name="jobs", daemon=True)
                self._thread.start()
        self._wake.set()

    def stop(self) -> None:
        """End soon: the workers are ended, and their chunks are free again."""
        self._stopping = True
        self._wake.set()
        if self._thread is not None:
            self._thread.join(6)

    @property
    def faults(self) -> int:
        """Number of own answers, so far, that the service has reported as wrong."""
        return self._intake.faults

    def verdict(self, job: str) -> str | None:
        """Why a job failed, until the database has recorded it."""
        return self._verdicts.get(job)

    def _work(self) -> None:
        pause = self._pace.poll_s
        while not self._stopping:
            self._wake.clear()
            try:
                self._step()
            except (DatabaseUnavailable, WrongSchema) as error:
                # once, not at every attempt
                if not self._away:
                    _LOG.warning("%s; the jobs wait", error)
                if isinstance(error, DatabaseUnavailable) and error.full:
                    # as when their rows cannot be written; without a running chunk it was a lease without room
                    for job in {flight.chunk.job for flight in self._flights} or self._active:
                        self._verdicts.setdefault(job, str(error))
                self._away, pause = True, min(self._pace.longest_pause_s, 2 * pause)
            except EngineUnavailable as error:
                _LOG.warning("%s", error)
                pause = min(self._pace.longest_pause_s, 2 * pause)
            except Exception:
                # nothing that happens to one chunk may end the thread that all jobs need
                _LOG.exception("the coordinator of the jobs stumbled")
                pause = min(self._pace.longest_pause_s, 2 * pause)
            else:
                self._away, pause = False, self._pace.poll_s
            self._wake.wait(pause)
        self._end_engines()
        if self._begun():
            # without this the leases run out by themselves
            with suppress(DatabaseUnavailable, WrongSchema):
                self._leases.release(self._name)

    def _end_engines(self) -> None:
        self._engine.end()
        if self._selector is not self._engine:
            self._selector.end()

    def _step(self) -> None:
        if not self._begun():
            return
        self._tell_verdicts()
        self._active = self._leases.active()
        self._drop_ended()
        self._collect()
        self._fill()
        self._keep_leases()
        self._tidy()

    def _tell_verdicts(self) -> None:
        for job, error in list(self._verdicts.items()):
            with suppress(UnknownJob):
                self._store.fail(job, error)
            del self._verdicts[job]

    def _fail(self, job: str, error: str) -> None:
        _LOG.warning("job %s failed: %s", job, error)
        self._verdicts[job] = error
        self._tell_verdicts()

    def _drop_ended(self) -> None:
        for flight in self._flights:
            if flight.chunk.job not in self._active and not flight.dropped:
                flight.dropped = True
                flight.future.cancel()
                self._files.stop(flight.chunk.job)

    # ---- outcomes

    def _collect(self) -> None:
        self._collect_rows()
        for flight in [flight for flight in self._flights if flight.future.done() and not flight.rows_came]:
            # a broken pool takes every flight with it
            if flight in self._flights:
                self._take(flight)

    def _collect_rows(self) -> None:
        """Keep rows that came, those of a job together: of many workers some are always done at the same time."""
        came = [flight for flight in self._flights if flight.rows_came]
        if len(came) > _AT_A_TIME:
            # leases are renewed and new chunks leased in between
            self._wake.set()
        for job, group in groupby(sorted(came[:_AT_A_TIME], key=_job), key=_job):
            flights = list(group)
            self._keep_rows(job, [(flight.chunk, flight.future.result()) for flight in flights])
            gone = set(flights)
            self._flights = [flight for flight in self._flights if flight not in gone]

    def _keep_rows(self, job: str, came: Sequence[tuple[Chunk, ChunkResult]]) -> None:
        try:
            self._intake.keep_rows(job, came)
        except CannotWrite as error:
            self._fail(job, str(error))

    def _keep_selection(self, chunk: Chunk, piece: ChunkResult, covers: int) -> None:
        try:
            self._intake.keep_selection(chunk, piece, covers)
        except CannotWrite as error:
            self._fail(chunk.job, str(error))

    def _take(self, flight: RunningChunk) -> None:
        chunk = flight.chunk
        try:
            piece = flight.future.result()
        except (BrokenExecutor, CancelledError) as error:
            if not flight.dropped or isinstance(error, BrokenExecutor):
                self._restart(broken=isinstance(error, BrokenExecutor))
                return
        except Stopped:
            if not flight.dropped:
                # the flag is left over from before the job went on
                self._files.go(chunk.job)
            self._leases.give_back(chunk, chunk.attempts)
        except Unanswerable as error:
            self._refuse(chunk, str(error))
        except Damaged as error:
            self.repair(chunk.job, error)
            self._leases.postpone(chunk)
        except Exception as error:
            if not flight.dropped:
                self._went_wrong(chunk, f"{type(error).__name__}: {error}", alone=True)
        else:
            if not flight.dropped:
                self._keep_selection(chunk, piece, flight.covers)
        self._flights.remove(flight)

    def _refuse(self, chunk: Chunk, reason: str) -> None:
        if chunk.rows:
            self._fail(chunk.job, reason)
        else:
            _LOG.warning("job %s: %s", chunk.job, reason)
            self._leases.refuse_selection(chunk, reason)

    def repair(self, job: str, damage: Damaged) -> None:
        """Have a chunk computed again whose file is not what was written."""
        record = damage.record
        if self._leases.reopen(job, record):
            words = f"rows {record.start} to {record.stop - 1}" if record.rows else "selected rows"
            _LOG.error("job %s: the file of the %s is %s; it is made again", job, words, damage.reason)
        self.start()

    def _restart(self, broken: bool) -> None:
        _LOG.warning("the workers of the sweeps %s; they are started again", "died" if broken else "are gone")
        self._end_engines()
        flights = [flight for flight in self._flights if not flight.dropped]
        while flights:
            flight = flights.pop()
            if broken:
                self._went_wrong(flight.chunk, "the worker died", alone=len(self._flights) == 1)
            else:
                self._leases.give_back(flight.chunk, flight.chunk.attempts)
        self._flights.clear()

    def _went_wrong(self, chunk: Chunk, reason: str, alone: bool) -> None:
        self._suspects = True
        attempts = chunk.attempts + 1
        _LOG.warning("rows %d to %d of job %s: %s", chunk.start, chunk.stop - 1, chunk.job, reason)
        if attempts < self._pace.tries or not alone:
            self._leases.give_back(chunk, attempts)
        elif chunk.rows == 0:
            self._refuse(chunk, f"the rows cannot be selected: {reason}")
        elif chunk.rows > 1:
            if self._leases.halve(chunk) > self._pace.max_faults:
                self._fail(chunk.job, f"too many rows cannot be computed, the last because {reason}")
        else:
            self._record_failed_row(chunk, reason)

    def _record_failed_row(self, chunk: Chunk, reason: str) -> None:
        failed = KINDS[chunk.kind].failed
        if failed is None:
            self._fail(chunk.job, f"it cannot be computed: {reason}")
        else:
            self._keep_rows(chunk.job, [(chunk, failed(chunk.request, chunk.start, chunk.stop, reason))])

    # ---- work

    def _fill(self) -> None:
        if not self._active:
            return
        if self._suspects and not self._flights:
            chunk = self._leases.claim(self._name, self._pace.lease_s, attempted=True, exclusions=self._later)
            if chunk is not None:
                self._submit(chunk)
                return
            self._suspects = False
        window = self._engine.window()
        while not self._suspects and not self._stopping and len(self._flights) < window:
            # not all at once, as the next may be somebody else's turn
            count = min(max(1, window // _TURNS), window - len(self._flights))
            claimed = self._leases.claim_chunks(self._name, self._pace.lease_s, count, exclusions=self._later)
            if not claimed:
                # what is left, if anything, went wrong before or is leased
                self._suspects = True
                return
            self._submit_all(claimed)

    def _submit_all(self, claimed: Sequence[Chunk]) -> None:
        left = list(claimed[::-1])
        try:
            # one may find that the pool is broken
            while left and not self._suspects:
                self._submit(left.pop())
        finally:
            for chunk in left:
                self._leases.give_back(chunk, chunk.attempts)

    def _is_later(self, chunk: Chunk) -> bool:
        """Whether a chunk is of a job that this version does not understand."""
        job = chunk.job
        self._read, self._later = self._read & self._active, self._later & self._active
        if job not in self._read | self._later:
            kind = KINDS.get(chunk.kind)
            later = kind is None or kind.later(chunk.request)
            (self._later if later else self._read).add(job)
            if later:
                _LOG.warning("job %s says what this version does not know: a service of its own has to compute it", job)
        return job in self._later

    def _submit(self, chunk: Chunk) -> None:
        if self._is_later(chunk):
            self._leases.give_back(chunk, chunk.attempts)
            return
        try:
            future, covers = self._begin(chunk)
        except BrokenExecutor:
            # it broke while it was idle or with the flights that are about to say so
            self._leases.give_back(chunk, chunk.attempts)
            self._restart(broken=True)
            return
        except BaseException:
            self._leases.give_back(chunk, chunk.attempts)
            raise
        self._flights.append(RunningChunk(chunk, future, covers))
        future.add_done_callback(lambda _: self._wake.set())

    def _begin(self, chunk: Chunk) -> "tuple[Future[ChunkResult], int]":
        flag = str(self._files.flag(chunk.job))
        if chunk.rows:
            return self._engine.submit(self._run, chunk.kind, chunk.request, chunk.start, chunk.stop, flag), 0
        pieces = self._store.pieces(chunk.job)
        files = [(self._files.piece(chunk.job, piece), piece) for piece in pieces]
        columns = self._store.columns(chunk.job)
        future = self._selector.submit(selection.select, chunk.request, columns, files, flag)
        return future, sum(piece.rows for piece in pieces)

    def _keep_leases(self) -> None:
        now = self._clock()
        if self._flights and now - self._renewed > self._pace.lease_s / 3:
            self._leases.renew(self._name, [flight.chunk for flight in self._flights], self._pace.lease_s)
            self._renewed = now

    def _tidy(self) -> None:
        now = self._clock()
        if now - self._tidied > self._pace.tidy_s:
            self._housekeeping.tidy()
            self._tidied = now
