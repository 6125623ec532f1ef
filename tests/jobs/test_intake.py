"""What comes from workers at the same time, and a disk that does not take all of it."""

import errno
import os
from concurrent.futures import Future

import pytest

from service.jobs.engines import Engine
from service.jobs.files import JobFiles
from service.jobs.housekeeping import Housekeeping
from service.jobs.intake import CannotWrite, ResultWriter
from service.jobs.job import Chunk, Record
from service.jobs.pace import Pace
from service.jobs.piece import ChunkResult
from tests.jobs import synthetic
from tests.jobs.house import House

LEASE_S = 60.0


def intake(house: House) -> ResultWriter:
    return ResultWriter(house.leases, house.files, Housekeeping(house.store, house.retention, house.files))


def computed(chunk: Chunk) -> tuple[Chunk, ChunkResult]:
    return chunk, synthetic.run(chunk.kind, chunk.request, chunk.start, chunk.stop, "")


def test_all_rows_that_came_are_kept_once(house: House) -> None:
    job = house.submit(total=95, chunk_rows=10)
    chunks = house.leases.claim_chunks("a", LEASE_S, 20)
    for some in (chunks[:4], chunks):
        intake(house).keep_rows(job, [computed(chunk) for chunk in some])
    assert house.store.get(job).state == "done"
    assert house.rows(job).equals(synthetic.rows(0, 95))
    house.wait_until_tidy(job)


@pytest.mark.parametrize("first", [0, 30])
def test_rows_before_the_first_that_cannot_be_written_are_kept(
    house: House, monkeypatch: pytest.MonkeyPatch, first: int
) -> None:
    job = house.submit(total=80, chunk_rows=10)
    keep = JobFiles.keep

    def breaks(self: JobFiles, job: str, start: int, stop: int, content: bytes) -> Record:
        if start in (first, 60):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return keep(self, job, start, stop, content)

    monkeypatch.setattr(JobFiles, "keep", breaks)
    came = [computed(chunk) for chunk in house.leases.claim_chunks("a", LEASE_S, 8)]
    with pytest.raises(CannotWrite, match=f"rows {first} to {first + 9} cannot be written: No space left"):
        intake(house).keep_rows(job, came)
    assert house.store.get(job).done == first
    assert house.rows(job).equals(synthetic.rows(0, first))
    # what was written after it is gone
    assert len(house.files.names(job)) == first // 10


class Large:
    """Many workers that have done everything at once."""

    def __init__(self) -> None:
        self.held: list[int] = []

    def submit(self, task: object, *arguments: object) -> "Future[ChunkResult]":
        _, _, start, stop, _ = arguments
        assert isinstance(start, int)
        assert isinstance(stop, int)
        self.held.append(stop - start)
        future: Future[ChunkResult] = Future()
        future.set_result(synthetic.run("synthetic", b"{}", start, stop, ""))
        return future

    def window(self) -> int:
        return 160

    def end(self) -> None:
        pass


def test_a_large_engine_is_filled_by_turns_and_emptied_in_few_transactions(house: House) -> None:
    job = house.submit(total=120, chunk_rows=1)
    future = house.submit(total=120, chunk_rows=1)
    large = Large()
    coordinator = house.coordinator_on(Engine(lambda: large), Pace(lease_s=3600.0))
    coordinator._step()
    # analytic: the window is full, half of it of each job
    assert len(large.held) == 160
    assert sorted(_leased(house, text) for text in (job, future)) == [80, 80]
    before = house.store.get(job).version
    coordinator._step()
    assert house.store.get(job).done + house.store.get(future).done == 100
    assert house.store.get(job).version == before + 1
    for _ in range(3):
        coordinator._step()
    for text in (job, future):
        assert house.store.get(text).state == "done"
        assert house.rows(text).equals(synthetic.rows(0, 120))


def _leased(house: House, job: str) -> int:
    with house.database.read() as connection:
        cursor_result = connection.exec_driver_sql(
            f"SELECT count(*) FROM chunks WHERE state = 'leased' AND job = '{job}'"
        )
        return int(cursor_result.scalar_one())
