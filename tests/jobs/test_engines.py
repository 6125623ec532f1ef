"""Engines: workers that are handed pieces, killed, or outlive their service. Expected values are analytic."""

import os
import threading
import time
from contextlib import suppress
from pathlib import Path

import pytest

from service.jobs.engines import Processes, engine
from service.jobs.piece import ChunkResult


@pytest.mark.parametrize("name", ["threads", "dask", "dask:", "processes:2", ""])
def test_engines_that_there_are_not(name: str) -> None:
    with pytest.raises(ValueError, match="there is no engine"):
        engine(name, 1)


def content_of(size: int) -> ChunkResult:
    return ChunkResult(b"x" * size, 0)


def hand_back(content: bytes) -> ChunkResult:
    return ChunkResult(content, len(content))


@pytest.mark.parametrize("size", [0, 10, 10_000_000])
def test_long_messages_to_and_from_workers(size: int) -> None:
    running = Processes(1)
    try:
        assert running.submit(hand_back, b"y" * size).result(180) == ChunkResult(b"y" * size, size)
        assert [path.name for path in Path(running._spool._folder).iterdir()] == ["lock"]
    finally:
        running.end()
    assert not Path(running._spool._folder).exists()


def test_workers_that_are_killed_while_they_hand_over() -> None:
    # pieces far longer than a pipe holds: most of the time goes into handing them over
    for moment_s in (0.0, 0.01):
        running = Processes(2)
        futures = [running.submit(content_of, 20_000_000) for _ in range(8)]
        futures[0].result(180)
        time.sleep(moment_s)
        # where the first is seen to have ended, the pool ends the others by itself: they may be gone already
        for worker in running._context.processes:
            worker.kill()
        ended = threading.Thread(target=running.end, daemon=True)
        ended.start()
        ended.join(180)
        assert not ended.is_alive()
        assert all(future.done() for future in futures)


def threads_of_a_product() -> tuple[int, int]:
    """How many threads there are before and after large matrices are multiplied."""
    import numpy as np

    before = len(os.listdir("/proc/self/task"))
    matrix = np.ones((1000, 1000))
    assert np.sum(matrix @ matrix) == 1e9
    return before, len(os.listdir("/proc/self/task"))


def test_workers_compute_with_one_thread() -> None:
    running = Processes(1)
    try:
        # read when numpy is loaded and never again, whoever has loaded it
        assert running.executor.submit(os.getenv, "OPENBLAS_NUM_THREADS").result(180) == "1"
        before = running.executor.submit(threads_of_a_product).result(180)
        assert before[0] == before[1]
    finally:
        running.end()


def test_workers_end_with_a_service_that_is_killed(tmp_path: Path) -> None:
    running = Processes(1)
    worker = running.executor.submit(os.getpid).result(180)
    running.end()
    with suppress(ProcessLookupError):
        deadline = time.monotonic() + 180
        while True:
            os.kill(worker, 0)
            assert time.monotonic() < deadline
            time.sleep(0.02)
