"""One worker as the service sees it: a process that is forked, called, and killed."""

import asyncio
import logging
import multiprocessing
import os
import pickle
import signal
import socket
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, nullcontext, suppress
from dataclasses import replace
from multiprocessing import forkserver
from multiprocessing.process import BaseProcess
from pathlib import Path
from threading import Lock, Timer

from service.fairness.length import QUICK_S
from service.workers import lanes
from service.workers.messages import Listener
from service.workers.task import Priority, Task
from service.workers.worker import Answer, Long, Outcome, Reply, serve

_LOG = logging.getLogger(__name__)
#: what the process has loaded that workers are forked from; every worker runs ``__main__`` anew, which is the last one
_PRELOAD = ["service.workers.preload", "service.cli"]
#: a fork takes a hundredth of a second, and seconds where the process it comes from has to be loaded anew
_START_S = 30.0
#: for a killed worker to be gone; one whose parent has stopped is not said to be
_END_S = 1.0
#: between two looks at how long a worker has computed [s], at least
_LOOK_S = 0.02
#: of the times that the system tells of a process
_TICKS = os.sysconf("SC_CLK_TCK")


class WorkersFailed(Exception):
    """No worker can compute; the message says why."""


class Dead(Exception):
    """The other end of a connection is closed."""


class Worker:
    """A process that computes, started here.

    Raises
    ------
    WorkersFailed
        if it does not start.
    """

    def __init__(self, memory_bytes: int, folder: Path | None) -> None:
        #: for how long cores have computed the last task [s], once its outcome was heard
        self.computed_s: float | None = None
        self._before_s = 0.0
        self._priority, self._lane = Priority.FIRST, lanes.FIRST
        context = multiprocessing.get_context("forkserver")
        answers, theirs = socket.socketpair()
        self._says = Listener(answers)
        pairs = {lane: socket.socketpair() for lane in lanes.LANES}
        self._lanes = {lane: ours for lane, (ours, _) in pairs.items()}
        passed = theirs, *(theirs_of_lane for _, theirs_of_lane in pairs.values())
        self._process: BaseProcess = context.Process(
            target=serve, args=(*passed, memory_bytes, folder), name="solver", daemon=True
        )
        try:
            with ExitStack() as ends:
                for theirs_of_lane in passed:
                    ends.enter_context(theirs_of_lane)
                self._process.start()
            with answers.makefile("rb") as stream:
                failure = pickle.load(stream)
        except (Dead, OSError, EOFError):
            self.end()
            raise WorkersFailed("a worker died at its start") from None
        if failure is not None:
            self.end()
            raise WorkersFailed(str(failure))

    @property
    def pid(self) -> int:
        return self._process.pid or 0

    def alive(self) -> bool:
        return not self._says.gone

    def send(self, task: Task, priority: Priority) -> None:
        """Have a task computed."""
        self.computed_s, self._priority, self._lane = None, priority, lanes.lane_of(priority)
        try:
            self._lanes[self._lane].sendall(task.serialize(priority))
        except OSError as error:
            raise Dead from error

    async def outcome(self) -> Outcome | Long:
        try:
            parts, file = await self._says.receive()
        except EOFError as error:
            raise Dead from error
        reply = Reply.of(parts)
        self.computed_s, self._before_s = reply.computed_s, reply.altogether_s
        outcome = reply.outcome
        # a file comes with an answer alone
        return replace(outcome, file=file) if file is not None and isinstance(outcome, Answer) else outcome

    @property
    def computing_s(self) -> float:
        """For how long cores have computed its task so far [s], to a hundredth of a second."""
        try:
            # after its name, which may be anything
            fields = Path(f"/proc/{self.pid}/stat").read_bytes().rpartition(b")")[2].split()
        except OSError:
            return 0.0
        return (int(fields[11]) + int(fields[12])) / _TICKS - self._before_s

    def lower(self, priority: Priority = Priority.LONG) -> None:
        """Have its task go on behind others, as those of a priority do, if it is not yet; not the next."""
        if priority <= self._priority:
            return
        self._priority = priority
        with suppress(OSError):
            lanes.lower(self._lane, priority, self.pid)

    def kill(self) -> None:
        """Kill it; who waits for its answer gets the fault."""
        with suppress(OSError, ValueError, AttributeError):
            self._process.kill()

    def end(self) -> None:
        """Kill it; nobody may be waiting for its answer."""
        self.kill()
        with suppress(OSError, ValueError, AssertionError):
            self._process.join(_END_S)
        for connection in self._lanes.values():
            connection.close()
        self._says.end()


class Haste:
    """Whether the task of a worker is quick, in a ``with``: it is lowered once it has computed for longer."""

    def __init__(self, worker: Worker) -> None:
        self._worker = worker
        self._loop = asyncio.get_running_loop()

    def __enter__(self) -> None:
        self._timer = self._loop.call_later(QUICK_S, self._look)

    def __exit__(self, *raised: object) -> None:
        self._timer.cancel()

    def _look(self) -> None:
        left_s = QUICK_S - self._worker.computing_s
        if left_s <= 0:
            self._worker.lower()
        else:
            self._timer = self._loop.call_later(max(left_s, _LOOK_S), self._look)


def preload() -> None:
    """Have the process that others are forked from load what answers need; to be called before it is started."""
    multiprocessing.set_forkserver_preload(_PRELOAD)


def load() -> None:
    """Start the process that others are forked from: it loads for a second, and so may another at the same time.

    Where it cannot be started, the first worker says so.
    """
    preload()
    with suppress(OSError):
        forkserver.ensure_running()


def forked(memory_bytes: int, folder: Path | None, first: bool) -> Worker:
    """A worker from the process that has loaded everything; the first one of all loads and compiles it.

    Raises
    ------
    WorkersFailed
    """
    with nullcontext() if first else _watched():
        return Worker(memory_bytes, folder)


@contextmanager
def _watched() -> Iterator[None]:
    """A start that takes longer than any does ends the process that workers are forked from; the next makes another."""
    watch = Timer(_START_S, _end_fork_server)
    watch.daemon = True
    watch.start()
    try:
        yield
    finally:
        watch.cancel()


def _end_fork_server() -> None:
    # multiprocessing has no public way to it
    pid = getattr(getattr(forkserver, "_forkserver", None), "_forkserver_pid", None)
    if pid is not None:
        _LOG.error("the process that workers are forked from does not answer, and is ended")
        with suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)


class Start:
    """The start of a worker in a thread; whoever waits for it may leave, and then it is kept for the next one.

    It is not waited for then: a process that workers are forked from may have stopped.
    """

    def __init__(self, start: Callable[[], Worker], keep: Callable[[Worker], None]) -> None:
        self._start = start
        self._keep = keep
        self._lock = Lock()
        self._started: Worker | None = None
        self._left = False

    def __call__(self) -> Worker:
        worker = self._start()
        with self._lock:
            self._started = worker
            if self._left:
                self._keep(worker)
        return worker

    def leave(self) -> None:
        """Keep the worker for somebody else."""
        with self._lock:
            self._left = True
            if self._started is not None:
                self._keep(self._started)
