"""Workers lent to requests: started on demand, ended when a client is gone or its time over, replaced when dead."""

import logging
from asyncio import FIRST_COMPLETED, Future, ensure_future, gather, timeout, wait
from collections.abc import Callable, Mapping
from contextlib import ExitStack, suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TypeVar

from anyio import CancelScope, CapacityLimiter, get_cancelled_exc_class, move_on_after, to_thread

from service.fairness import length
from service.fairness.faults import Busy
from service.fairness.queue import FairQueue, Full, Turn
from service.fairness.table import Resource, Share
from service.workers.process import Dead, Haste, Start, Worker, WorkersFailed, forked, preload
from service.workers.task import Priority, Task
from service.workers.worker import Answer, Crashed, Long, Outcome

_LOG = logging.getLogger(__name__)
#: a request whose client is gone may end within this time, which is cheaper than another worker
_GRACE_S = 0.1
#: what a connection takes without waiting for its reader
_AT_ONCE_BYTES = 32_000
_MB = 1_000_000

Result = TypeVar("Result")


class WorkerDied(Exception):
    """The worker died while it computed, more than once; a retry may help."""


class TooSlow(Exception):
    """The request was not answered in time; ``computing`` says whether its computation had begun."""

    def __init__(self, seconds: float, computing: bool) -> None:
        self.computing = computing
        super().__init__(
            f"The computation was not finished within {seconds:g} s."
            if computing
            else f"No computation could begin within {seconds:g} s."
        )


@dataclass
class PoolCounts:
    """What happened so far."""

    started: int = 0
    died: int = 0
    ended_late: int = 0
    ended_gone: int = 0
    refused_busy: int = 0
    moved_long: int = 0
    begun_anew: int = 0


@dataclass
class Pool:
    """So many computations at a time, each in a process.

    Long ones (:mod:`service.fairness.length`) have turns of their own, half as many and one at least, and so they have
    processes of their own. What turns out to be long goes on in a turn of the long ones if there is one. Else it goes
    on in its own until somebody waits for that. It is then begun anew when it has one.

    Parameters
    ----------
    shares : processes for short computations and for long ones, and requests that may wait for each.
    timeout_s : for waiting and computing [s].
    memory_mb : of one worker [MB].
    folder : for large answers while they are read; by default that of the system for such files.
    """

    shares: Mapping[Resource, Share]
    timeout_s: float
    memory_mb: int
    folder: Path | None = None
    counts: PoolCounts = field(default_factory=PoolCounts)

    def __post_init__(self) -> None:
        short, long, waiting = (self.shares[name] for name in ("short", "long", "waiting"))
        self._short, self._long = FairQueue(short, waiting), FairQueue(long, waiting)
        # who has no turn while all have one is not to wait for a start
        self._most_workers = int(short.altogether + short.reserve + long.altogether)
        self._threads = CapacityLimiter(2 * self._most_workers)
        self._idle: list[Worker] = []
        # and the turns of the short ones in which they compute, or did
        self._busy: dict[Worker, Turn] = {}
        # of recent computations, short and long, for Retry-After [s]
        self._typical_s = {False: 0.1, True: length.BRIEF_S}
        self._closed = False
        # workers that there always are, and their starts
        self._least = 0
        self._starts: Future[None] | None = None
        preload()

    @property
    def running(self) -> int:
        return len(self._busy)

    @property
    def queued(self) -> int:
        return self._short.waiting + self._long.waiting

    @property
    def pids(self) -> tuple[int, ...]:
        """Process ids of the workers."""
        return tuple(worker.pid for worker in (*self._idle, *self._busy))

    def open(self) -> None:
        """Load the optimiser and start every worker; this takes seconds. Without it they start on demand.

        From then on a worker that ends is replaced before anybody needs it. A pool that is closed meanwhile needs none.

        Raises
        ------
        WorkersFailed
        """
        while len(self._idle) < self._most_workers and not self._closed:
            try:
                self._idle.append(self._start())
            except WorkersFailed:
                if not self._closed:
                    raise
        self._least = self._most_workers

    def close(self) -> None:
        """End every worker; what is computed or waits comes to :class:`WorkersFailed`."""
        self._closed = True
        for worker in self._busy:
            worker.kill()
        while self._idle:
            self._idle.pop().end()

    async def run(self, task: Task, owner: str) -> Outcome:
        """The outcome of a task of an owner; if the caller is cancelled, its worker is ended.

        Raises
        ------
        Busy, TooSlow, WorkerDied, WorkersFailed
        """
        computing = False
        short, long = self._short.turn(owner), self._long.turn(owner)
        try:
            async with timeout(self.timeout_s):
                with ExitStack() as ends:
                    ends.callback(short.end)
                    ends.callback(long.end)
                    if not task.long:
                        await short.granted()
                        computing = True
                        outcome = await self._answer(task, self._priority(short), short, long)
                        if not isinstance(outcome, Long):
                            return outcome
                        computing = False
                        short.end()
                    await long.granted()
                    computing = True
                    outcome = await self._answer(replace(task, long=True), Priority.LONG, short, long)
                    assert not isinstance(outcome, Long), "a long computation has been granted"
                    return outcome
        except Full:
            self.counts.refused_busy += 1
            turns = self._long if long.asks_for_place else self._short
            seconds = self._typical_s[long.asks_for_place] * turns.waiting / turns.size
            raise Busy(turns.waiting, max(1, round(seconds))) from None
        except TimeoutError:
            self.counts.ended_late += 1
            raise TooSlow(self.timeout_s, computing) from None

    def _priority(self, turn: Turn) -> Priority:
        """That of a turn which has just begun; who asks without end gives way to who asks now and then."""
        if self._short.more(turn.owner) or self._short.gives_way(turn):
            return Priority.FURTHER
        if turn.seldom:
            for worker, turn_of_worker in self._busy.items():
                if turn_of_worker.begun and not turn_of_worker.ended and not turn_of_worker.seldom:
                    worker.lower(Priority.FURTHER)
        return Priority.FIRST

    async def _answer(self, task: Task, priority: Priority, short: Turn, long: Turn) -> Outcome | Long:
        # the second one is new: the first may have died long before, and the next idle one with it
        for take in (self._free, self._fresh):
            worker = await take()
            self._busy[worker] = short
            try:
                outcome = await self._outcome(worker, task, priority, short, long)
            except Dead:
                if not self._closed:
                    _LOG.warning("a worker died while it computed")
                    self.counts.died += 1
                await self._in_thread(worker.end)
            except Exception:
                # nobody knows what it would say next
                await self._in_thread(worker.end)
                raise
            else:
                (long if task.long or short.ended else short).computed_s = worker.computed_s
                await self._keep(worker, outcome, task.long)
                return outcome
            finally:
                del self._busy[worker]
        raise WorkerDied("The process that computed this died; try again later.")

    async def _outcome(self, worker: Worker, task: Task, priority: Priority, short: Turn, long: Turn) -> Outcome | Long:
        try:
            if len(task.body) < _AT_ONCE_BYTES:
                worker.send(task, priority)
            else:
                await self._in_thread(worker.send, task, priority)
            if task.long or short.ended:
                return await worker.outcome()
            with Haste(worker):
                with move_on_after(length.BRIEF_S):
                    return await worker.outcome()
                return await self._overrun(worker, short, long)
        except get_cancelled_exc_class():
            with CancelScope(shield=True):
                await self._abandon(worker)
            raise

    async def _overrun(self, worker: Worker, short: Turn, long: Turn) -> Outcome | Long:
        """The outcome of what is long though it did not look so."""
        worker.lower()
        outcome, place = ensure_future(worker.outcome()), ensure_future(long.granted())
        crowd = ensure_future(self._short.crowded.wait())
        try:
            await wait((outcome, place, crowd), return_when=FIRST_COMPLETED)
            if outcome.done():
                return outcome.result()
            if not place.done():
                self.counts.begun_anew += 1
                return Long()
            place.result()
            self.counts.moved_long += 1
            short.end()
            return await outcome
        finally:
            for waiting in (outcome, place, crowd):
                waiting.cancel()
            await gather(outcome, place, crowd, return_exceptions=True)

    async def _abandon(self, worker: Worker) -> None:
        with suppress(Dead, OSError), move_on_after(_GRACE_S):
            left = await worker.outcome()
            if isinstance(left, Answer) and left.file is not None:
                left.file.close()
            self._idle.append(worker)
            return
        self.counts.ended_gone += 1
        await self._in_thread(worker.end)
        self._replace()

    async def _free(self) -> Worker:
        while self._idle:
            worker = self._idle.pop()
            if worker.alive():
                return worker
            _LOG.warning("a worker died while it was idle")
            self.counts.died += 1
            await self._in_thread(worker.end)
        return await self._fresh()

    async def _fresh(self) -> Worker:
        start = Start(self._start, self._spare)
        try:
            return await self._in_thread(start)
        except get_cancelled_exc_class():
            start.leave()
            raise

    def _replace(self) -> None:
        """Have workers started for those that have ended."""
        if self._starts is None or self._starts.done():
            self._starts = ensure_future(self._start_all())

    async def _start_all(self) -> None:
        # the next request for a worker raises why none can be started
        with suppress(WorkersFailed):
            while len(self._idle) + len(self._busy) < self._least and not self._closed:
                self._spare(await self._fresh())

    def _start(self) -> Worker:
        if not self._closed:
            worker = forked(self.memory_mb * _MB, self.folder, first=not self.counts.started)
            self.counts.started += 1
            if not self._closed:
                return worker
            worker.end()
        raise WorkersFailed("The service ends.")

    def _spare(self, worker: Worker) -> None:
        if len(self._idle) < self._most_workers and not self._closed:
            self._idle.append(worker)
            if self._closed:
                # closed meanwhile, by another thread that may not have seen this one
                self.close()
        else:
            worker.end()

    async def _keep(self, worker: Worker, outcome: Outcome | Long, long: bool) -> None:
        # one that was begun anew elsewhere is still computed here
        spent = isinstance(outcome, Crashed) or worker.computed_s is None
        if spent or getattr(outcome, "resident", 0) > self.memory_mb * _MB / 2 or len(self._idle) >= self._most_workers:
            # fresh ones hold no more memory than necessary, and there are no more of them than necessary
            await self._in_thread(worker.end)
            self._replace()
        else:
            self._idle.append(worker)
        typical = self._typical_s[long]
        self._typical_s[long] += 0.1 * (getattr(outcome, "seconds", typical) - typical)

    async def _in_thread(self, work: Callable[..., Result], *arguments: object) -> Result:
        # whoever leaves a thread behind ends its worker, and with it the thread
        return await to_thread.run_sync(work, *arguments, limiter=self._threads, abandon_on_cancel=True)
