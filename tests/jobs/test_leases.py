"""What becomes of a chunk and of the counts of its job: every number is analytic."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy import select, update

from service.jobs.job import Chunk, Computed, Job, Record
from service.jobs.rows import Limits
from service.jobs.tables import chunks, jobs
from tests.jobs import synthetic
from tests.jobs.house import House
from tests.jobs.test_races import claimed, submitted

#: rows without an answer, digest, bytes, rows of invalid designs; on disk these are two pages and one
FIRST, SECOND = (2, "a", 5000, 1, 2), (3, "b", 4096, 2, 1)
BYTES = 8192 + 4096
#: what a request and the names of its columns take
REQUEST_BYTES = len(b"{}") + synthetic.SCHEMA.serialize().size


@pytest.fixture
def house(tmp_path: Path) -> Iterator[House]:
    """Of results that are kept for some time."""
    jobs_house = House(tmp_path, limits=Limits(keep_s=100.0))
    yield jobs_house
    jobs_house.database.close()


def computed(house: House, selects: bool = False) -> str:
    """A job whose two chunks are finished."""
    job = submitted(house, selects)
    for about in (FIRST, SECOND):
        assert house.leases.finish([Computed(claimed(house), *about)]) == [True]
    return job


def row(house: House, job: str, start: int) -> dict[str, Any]:
    with house.database.read() as connection:
        cursor_result = connection.execute(select(chunks).where(chunks.c.job == job, chunks.c.start == start))
        return dict(cursor_result.mappings().one())


def ends(house: House, job: str) -> tuple[float | None, float | None]:
    """When it ended, and until when it is kept."""
    with house.database.read() as connection:
        ended, expires = connection.execute(select(jobs.c.ended, jobs.c.expires).where(jobs.c.id == job)).one()
        return ended, expires


def counts(job: Job) -> tuple[object, ...]:
    return job.state, job.done, job.failed, job.invalid, job.infeasible, job.bytes - REQUEST_BYTES, job.repaired


def test_a_damaged_file_is_computed_again_and_its_rows_are_counted_anew(house: House) -> None:
    job = computed(house)
    assert counts(house.store.get(job)) == ("done", 20, 5, 3, 3, BYTES, 0)
    for number in (1, 2):
        assert house.leases.reopen(job, Record(0, 10, "a", 5000))
        assert counts(house.store.get(job)) == ("running", 10, 3, 2, 1, 4096, number)
        assert ends(house, job) == (None, None)
        blank = {"state": "pending", "failed": 0, "invalid": 0, "infeasible": 0, "bytes": 0, "attempts": 0}
        empty = {"digest": None, "finished": None, "lease_owner": None}
        chunk = row(house, job, 0)
        assert {name: chunk[name] for name in (*blank, *empty)} == blank | empty
        # once it is known it is no news
        assert not house.leases.reopen(job, Record(0, 10, "a", 5000))
        again = claimed(house)
        assert again == Chunk(job, "synthetic", b"{}", 0, 10, 0)
        assert not house.leases.reopen(job, Record(0, 10, "a", 5000))
        assert house.leases.finish([Computed(again, *FIRST)]) == [True]
        assert counts(house.store.get(job)) == ("done", 20, 5, 3, 3, BYTES, number)
        assert None not in ends(house, job)


@pytest.mark.parametrize(
    "record",
    [
        Record(0, 10, "b", 5000),
        Record(0, 9, "a", 5000),
        Record(0, 20, "a", 5000),
        Record(1, 10, "a", 5000),
        Record(10, 20, "a", 5000),
        Record(20, 20, "a", 5000),
    ],
)
def test_a_file_that_nobody_knows_opens_nothing(house: House, record: Record) -> None:
    job = computed(house)
    before = house.store.get(job)
    assert not house.leases.reopen(job, record)
    assert not house.leases.reopen("f" * 32, Record(0, 10, "a", 5000))
    assert house.store.get(job) == before


def test_a_damaged_file_of_a_cancelled_job_waits_until_it_goes_on(house: House) -> None:
    job = submitted(house, selects=False)
    assert house.leases.finish([Computed(claimed(house), *FIRST)]) == [True]
    house.store.cancel(job)
    before = ends(house, job)
    assert house.leases.reopen(job, Record(0, 10, "a", 5000))
    assert counts(house.store.get(job)) == ("cancelled", 0, 0, 0, 0, 0, 1)
    assert ends(house, job) == before
    assert house.leases.claim("one", 600.0) is None


def test_rows_are_selected_again_whose_file_is_damaged(house: House) -> None:
    job = computed(house, selects=True)
    selection, file = claimed(house), Record(20, 20, "s", 9000)
    for number in (0, 1):
        assert house.leases.finish_selection(selection, 20, 3, file) is None
        record = house.store.get(job)
        assert counts(record) == ("done", 20, 5, 3, 3, BYTES + 12288, number)
        assert (record.selected, record.kept) == (20, 3)
        assert house.leases.reopen(job, file)
        state = house.store.get(job)
        assert counts(state) == ("running", 20, 5, 3, 3, BYTES, number + 1)
        assert (state.selected, state.kept) == (0, 0)
        selection = claimed(house)
        assert (selection.start, selection.stop) == (20, 20)


def test_a_selection_that_is_put_off_waits_for_more_rows(house: House) -> None:
    job = submitted(house)
    assert house.leases.finish([Computed(claimed(house), *FIRST)]) == [True]
    second, selection = claimed(house), claimed(house)
    assert selection.rows == 0
    house.leases.postpone(selection)
    # there are rows that it has not looked at
    assert (row(house, job, 20)["state"], row(house, job, 20)["lease_owner"]) == ("pending", None)
    again = claimed(house)
    assert again == selection
    assert house.leases.finish_selection(again, 10, 1, Record(20, 20, "s", 10)) is None
    # what is not leased is not put off
    house.leases.postpone(selection)
    assert row(house, job, 20)["state"] == "waiting"
    assert house.leases.claim("two", 600.0) is None
    house.leases.finish([Computed(second, *SECOND)])
    assert row(house, job, 20)["state"] == "pending"
    # a file takes the place of the one before, and so do its bytes
    assert counts(house.store.get(job))[5] == BYTES + 4096
    assert house.leases.finish_selection(claimed(house), 20, 3, Record(20, 20, "t", 9000)) == Record(20, 20, "s", 4096)
    assert counts(house.store.get(job)) == ("done", 20, 5, 3, 3, BYTES + 12288, 0)


def test_a_job_goes_on_without_a_selection_that_cannot_be_made(house: House) -> None:
    job = computed(house, selects=True)
    house.leases.refuse_selection(claimed(house), "too many")
    record = house.store.get(job)
    assert (record.state, record.error, record.selected, record.kept) == ("done", "too many", 20, 0)
    assert row(house, job, 20)["state"] == "done"


def test_nothing_is_put_off_of_a_job_that_there_is_not(house: House) -> None:
    gone = Chunk("f" * 32, "synthetic", b"{}", 20, 20, 0)
    house.leases.postpone(gone)
    house.leases.refuse_selection(gone, "too many")
    assert house.leases.finish_selection(gone, 10, 1, Record(20, 20, "s", 10)) == Record(20, 20, "s", 10)
    assert house.leases.finish([Computed(gone, 0, "d", 9)]) == [False]


def test_a_file_without_a_digest_is_given_one_once(house: House) -> None:
    job, rival = computed(house), computed(house)
    with house.database.write() as connection:
        connection.execute(update(chunks).values(digest=None, bytes=0))
    before, beside = house.store.get(job), house.store.get(rival)
    for digest, size in (("x", 5000), ("y", 9000)):
        house.leases.adopt(job, Record(0, 10, None, 0), digest, size)
        assert (row(house, job, 0)["digest"], row(house, job, 0)["bytes"]) == ("x", 8192)
        assert house.store.get(job).bytes == before.bytes + 8192
    for start, stop in ((0, 9), (1, 10)):
        house.leases.adopt(rival, Record(start, stop, None, 0), "x", 5000)
    assert [row(house, job, 10)["digest"], *(row(house, rival, start)["digest"] for start in (0, 10))] == [None] * 3
    assert house.store.get(rival) == beside


def test_a_chunk_that_is_not_finished_is_given_no_digest(house: House) -> None:
    job = submitted(house, selects=False)
    chunk = claimed(house)
    house.leases.adopt(job, Record(0, 10, None, 0), "x", 5000)
    assert row(house, job, 0)["digest"] is None
    assert house.store.get(job).bytes == REQUEST_BYTES
    assert house.leases.finish([Computed(chunk, *FIRST)]) == [True]


def test_halves_were_tried_once_and_are_counted_once(house: House) -> None:
    job = submitted(house, selects=False)
    whole = claimed(house)
    assert [house.leases.halve(whole), house.leases.halve(whole)] == [1, 1]
    halves = [house.leases.claim("one", 600.0, attempted=True) for _ in range(3)]
    expected = [Chunk(job, "synthetic", b"{}", start, start + 5, 1) for start in (0, 5)]
    assert halves == [*expected, None]
    # what is finished is not halved
    assert house.leases.finish([Computed(expected[0], *FIRST)]) == [True]
    assert house.leases.halve(expected[0]) == 1
    assert house.leases.halve(expected[1]) == 2


def test_an_owner_of_many_jobs_has_as_many_chunks_in_work_as_one_of_one(house: House) -> None:
    first, second = (house.submit(owner="a", number=number) for number in (1, 2))
    future = house.submit(owner="b")
    turns = [claimed(house).job for _ in range(6)]
    assert turns == [first, future, second, future, first, future]
