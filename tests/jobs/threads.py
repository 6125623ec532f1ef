"""The simplest engine: chunks are computed in threads of the test."""

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor

from service.jobs.engines import Engine
from service.jobs.piece import ChunkResult


class Threads:
    """The simplest executor."""

    def __init__(self, workers: int) -> None:
        self.executor = ThreadPoolExecutor(workers)
        self._workers = workers

    def submit(self, task: Callable[..., ChunkResult], *arguments: object) -> "Future[ChunkResult]":
        return self.executor.submit(task, *arguments)

    def window(self) -> int:
        return 2 * self._workers

    def end(self) -> None:
        self.executor.shutdown(wait=True, cancel_futures=True)


def threads(workers: int = 2) -> Engine:
    return Engine(lambda: Threads(workers))
