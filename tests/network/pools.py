"""A pool of workers, and what becomes of tasks that it is asked at once."""

import gc
import warnings

import anyio

from service.fairness.table import shares
from service.settings import Settings
from service.workers.pool import Pool
from service.workers.worker import Outcome


def pool_of(size: int, places: int) -> Pool:
    """A pool of so many short computations at a time, for which so many may wait, all of them of one client."""
    settings = Settings(concurrent_solves=size, queue_length=places, queue_length_each=places)
    return Pool(shares(settings), timeout_s=600, memory_mb=2000)


def run(pool: Pool, *arguments: object) -> list[Outcome | Exception]:
    """The outcomes of tasks that are given at once."""
    assertion_errors: list[Outcome | Exception] = [AssertionError()] * len(arguments)

    async def task(index: int) -> None:
        try:
            assertion_errors[index] = await pool.run(arguments[index], "one")  # type: ignore[arg-type]
        except Exception as error:
            assertion_errors[index] = error

    async def everything() -> None:
        async with anyio.create_task_group() as group:
            for index in range(len(arguments)):
                group.start_soon(task, index)

    anyio.run(everything)
    return assertion_errors


def close(pool: Pool) -> None:
    """Close a pool whose callers were cancelled: what was being started for them may end with its memory alone."""
    pool.close()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ResourceWarning)
        gc.collect()
