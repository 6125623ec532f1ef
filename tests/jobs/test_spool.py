"""Messages that go through files, and what is left of them."""

import gc
import time
import weakref
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from service.jobs.piece import ChunkResult
from service.jobs.spool import Spool


def piece(size: int) -> ChunkResult:
    return ChunkResult(content=bytes(size), failed=0)


def broken() -> ChunkResult:
    raise ArithmeticError("broken")


@pytest.fixture
def spool() -> Iterator[Spool]:
    with ThreadPoolExecutor(1) as executor:
        spool = Spool(executor)
        yield spool
        spool.remove()


@pytest.mark.parametrize("size", [10, 1_000_000])
def test_what_a_worker_gives_back_arrives_whole_and_leaves_no_file(spool: Spool, size: int) -> None:
    assert spool.submit(piece, size).result(180) == piece(size)
    assert [path.name for path in Path(spool._folder).iterdir()] == ["lock"]


def test_a_failure_arrives(spool: Spool) -> None:
    with pytest.raises(ArithmeticError, match="broken"):
        spool.submit(broken).result(180)


def test_an_answer_is_gone_when_nobody_holds_it(spool: Spool) -> None:
    """Megabytes a chunk: they must not wait for a collection of garbage."""
    gc.disable()
    try:
        future = spool.submit(piece, 1_000_000)
        future.result(180)
        held = weakref.ref(future)
        del future
        deadline = time.monotonic() + 180
        while held() is not None and time.monotonic() < deadline:
            # the executor lets go a moment after the result is there
            time.sleep(0.01)
        assert held() is None
    finally:
        gc.enable()
