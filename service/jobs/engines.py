"""Where chunks run: any executor of :mod:`concurrent.futures`, made anew when it breaks."""

import multiprocessing
from collections.abc import Callable
from concurrent.futures import Executor, Future, ProcessPoolExecutor
from contextlib import suppress
from multiprocessing.context import ForkServerContext
from multiprocessing.process import BaseProcess
from typing import Any, Protocol

from service.jobs.piece import ChunkResult
from service.jobs.spool import Spool
from service.jobs.worker import prepare

#: behind what computes answers, which is nicer than the service by 13 at most; more would starve beside other programs
NICENESS = 15
_CONNECT_S = 4


class EngineUnavailable(Exception):
    """The engine cannot be reached; a retry may help."""


class Running(Protocol):
    """An executor that runs."""

    def submit(self, task: Callable[..., ChunkResult], *arguments: object) -> "Future[ChunkResult]":
        """As :meth:`concurrent.futures.Executor.submit`."""

    def window(self) -> int:
        """How many chunks to have submitted at a time: enough that no worker waits, few enough to be bounded."""

    def end(self) -> None:
        """End it at once, with what it runs."""


class Engine:
    """An executor that starts with the first chunk and again after it broke.

    Parameters
    ----------
    start : makes a running executor; may raise :class:`EngineUnavailable`.
    """

    def __init__(self, start: Callable[[], Running]) -> None:
        self._start = start
        self._running: Running | None = None

    def submit(self, task: Callable[..., ChunkResult], *arguments: object) -> "Future[ChunkResult]":
        """
        Raises
        ------
        EngineUnavailable
        BrokenExecutor
            if it broke and was not ended yet.
        """
        return self._started().submit(task, *arguments)

    def window(self) -> int:
        return self._started().window()

    def end(self) -> None:
        """End the executor; the next chunk starts another one."""
        running, self._running = self._running, None
        if running is not None:
            running.end()

    def _started(self) -> Running:
        if self._running is None:
            self._running = self._start()
        return self._running


def engine(name: str, workers: int, niceness: int = NICENESS) -> Engine:
    """The engine of a setting: ``processes``, or ``dask:`` and the address of a scheduler.

    Parameters
    ----------
    workers, niceness : of processes on this machine; those of a cluster are what they are.

    Raises
    ------
    ValueError
        if there is no such engine, or it is not installed.
    """
    kind, _, address = name.partition(":")
    if kind == "processes" and not address:
        return Engine(lambda: Processes(workers, niceness))
    if kind == "dask" and address:
        try:
            import distributed  # noqa: F401
        except ModuleNotFoundError:
            raise ValueError("the engine dask needs an extra: pip install '.[dask]' beside pyproject.toml") from None
        return Engine(lambda: Dask(address))
    raise ValueError(f"there is no engine {name!r}: take processes or dask:tcp://host:port")


def reads_files(name: str) -> bool:
    """Whether the workers of an engine are on this machine, and read what the service has written."""
    return name.partition(":")[0] == "processes"


class Processes:
    """Processes on this machine."""

    def __init__(self, workers: int, niceness: int = NICENESS) -> None:
        self._context = _Recording()
        self._workers = workers
        self.executor: Executor = ProcessPoolExecutor(
            workers, mp_context=self._context, initializer=prepare, initargs=(niceness,)
        )
        self._spool = Spool(self.executor)

    def submit(self, task: Callable[..., ChunkResult], *arguments: object) -> "Future[ChunkResult]":
        return self._spool.submit(task, *arguments)

    def window(self) -> int:
        return 2 * self._workers

    def end(self) -> None:
        for process in self._context.processes:
            process.kill()
        # now it has nothing left to wait for, and tells every future so
        self.executor.shutdown(wait=True, cancel_futures=True)
        self._spool.remove()


class _Recording(ForkServerContext):
    """Forked from a process of one thread, as the threads and locks of the service would be no one's.

    What that process has loaded, who starts it says first: the service what answers need, the command line
    :mod:`service.jobs.preload`. Recorded, as the executor cannot end a running worker.
    """

    def __init__(self) -> None:
        self.processes: list[BaseProcess] = []

    def Process(self, *args: Any, **kwargs: Any) -> BaseProcess:  # type: ignore[override]
        process = multiprocessing.get_context("forkserver").Process(*args, **kwargs)
        self.processes.append(process)
        return process


class Dask:
    """A dask.distributed cluster, whose workers have this package installed."""

    def __init__(self, address: str) -> None:
        from distributed import Client

        try:
            self._client = Client(address, timeout=_CONNECT_S, set_as_default=False)
        except (OSError, ValueError, TimeoutError) as error:
            raise EngineUnavailable(f"the dask scheduler at {address} does not answer: {error}") from error
        # a chunk whose worker died comes back as an exception, and is counted like any other
        self._executor: Executor = self._client.get_executor(pure=False)

    def submit(self, task: Callable[..., ChunkResult], *arguments: object) -> "Future[ChunkResult]":
        return self._executor.submit(task, *arguments)

    def window(self) -> int:
        # what the scheduler last said; asking it would block while it is away
        workers = self._client.scheduler_info(n_workers=-1)["workers"].values()
        return max(4, 2 * sum(worker["nthreads"] for worker in workers))

    def end(self) -> None:
        with suppress(OSError, TimeoutError):
            self._client.close(timeout=2)
