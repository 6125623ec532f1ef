"""What two do to one job at the same moment, one step after the other. The value of row i is i / 7 (analytic)."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import pyarrow as pa
import pytest

from service.jobs.coordinator import Coordinator
from service.jobs.engines import Engine
from service.jobs.housekeeping import Housekeeping
from service.jobs.job import Chunk, Computed, Order, Record
from service.jobs.kinds import table_bytes
from service.jobs.owner_jobs import OwnerJobs
from service.jobs.rows import UnknownJob
from tests.jobs import synthetic
from tests.jobs.house import House
from tests.jobs.test_damage import jobs_of


@pytest.fixture
def coordinator(house: House) -> Coordinator:
    """One that never works: the tests do what it would do."""

    def never() -> ThreadPoolExecutor:
        raise AssertionError

    actual_coordinator = house.coordinator_on(Engine(never))  # type: ignore[arg-type]
    actual_coordinator.stop()
    return actual_coordinator


@pytest.fixture
def jobs(house: House, coordinator: Coordinator) -> OwnerJobs:
    return jobs_of(house, coordinator)


def submitted(house: House, selects: bool = True) -> str:
    columns = synthetic.SCHEMA.serialize().to_pybytes()
    order = Order("synthetic", b"{}", "d", total=20, chunk_rows=10, columns=columns, selects=selects)
    return house.store.submit(order)[0].id


def claimed(house: House) -> Chunk:
    chunk = house.leases.claim("one", 600.0)
    assert chunk is not None
    return chunk


def written(house: House, chunk: Chunk, rows: pa.Table | None = None) -> Record:
    rows = synthetic.rows(chunk.start, chunk.stop) if rows is None else rows
    return house.files.keep(chunk.job, chunk.start, chunk.stop, table_bytes(rows))


def finished(house: House, chunk: Chunk) -> Record:
    record = written(house, chunk)
    assert house.leases.finish([Computed(chunk, 0, str(record.digest), record.bytes)]) == [True]
    return record


def tidying(house: House) -> Housekeeping:
    return Housekeeping(house.store, house.retention, house.files)


def read(batches: Callable[[], object]) -> pa.Table:
    return pa.Table.from_batches(batches(), synthetic.SCHEMA)  # type: ignore[arg-type]


def test_a_selection_is_read_though_it_is_replaced_meanwhile(house: House, jobs: OwnerJobs) -> None:
    job = submitted(house)
    finished(house, claimed(house))
    second, selection = claimed(house), claimed(house)
    assert (second.start, selection.start) == (10, 20)
    old = written(house, selection, synthetic.rows(0, 1))
    assert house.leases.finish_selection(selection, 10, 1, old) is None
    rows = jobs.selection(jobs.get(job), synthetic.SCHEMA)
    assert (rows.count, rows.complete) == (1, False)

    finished(house, second)
    new = written(house, claimed(house), synthetic.rows(0, 3))
    assert house.leases.finish_selection(selection, 20, 3, new) == Record(20, 20, old.digest, 4096)
    tidying(house).remove(job, old)
    assert house.files.absent(job, [old, new]) == [old]

    assert read(lambda: rows.batches).equals(synthetic.rows(0, 3))
    assert (jobs.get(job).state, jobs.get(job).repaired) == ("done", 0)


def test_a_file_that_another_service_is_about_to_tell_of_is_left_alone(house: House) -> None:
    job = submitted(house)
    finished(house, claimed(house))
    second, selection = claimed(house), claimed(house)
    ours = written(house, selection, synthetic.rows(0, 1))
    # the lease was over before, and another one looked at more
    finished(house, second)
    theirs = written(house, selection, synthetic.rows(0, 3))
    assert house.leases.finish_selection(selection, 10, 1, ours) is None
    # as it is not counted when it comes again, it is not needed, but it is the one that is known
    assert house.leases.finish_selection(selection, 10, 1, ours) == ours
    tidying(house).remove(job, ours)
    assert house.files.absent(job, [ours, theirs]) == []
    needless = house.leases.finish_selection(selection, 20, 3, theirs)
    assert needless is not None
    tidying(house).remove(job, needless)
    assert house.files.absent(job, [ours, theirs]) == [ours]


def test_rows_are_selected_though_what_was_damaged_is_there_before_it_is_known(house: House) -> None:
    job = submitted(house)
    first = claimed(house)
    damaged = finished(house, first)
    finished(house, claimed(house))
    selection = claimed(house)
    assert selection.rows == 0
    # a reader finds the damage, another service mends it, and only then the one that selects says what it found
    assert house.leases.reopen(job, damaged)
    finished(house, claimed(house))
    assert not house.leases.reopen(job, Record(0, 10, "of another file", 1))
    house.leases.postpone(selection)
    assert claimed(house).start == 20


def test_a_job_that_is_removed_while_it_is_read_is_unknown(house: House, jobs: OwnerJobs) -> None:
    job = submitted(house, selects=False)
    finished(house, claimed(house))
    finished(house, claimed(house))
    task = jobs.get(job)
    rows = jobs.rows(task, synthetic.SCHEMA)
    assert jobs.end(job) is None
    with pytest.raises(UnknownJob):
        list(rows.batches)
    with pytest.raises(UnknownJob):
        jobs.rows(task, synthetic.SCHEMA)


def test_a_job_that_ends_again_is_tidied_again(house: House) -> None:
    job = submitted(house, selects=False)
    first = claimed(house)
    damaged = finished(house, first)
    finished(house, claimed(house))
    tidy = tidying(house)
    tidy.tidy()
    # all of it between two looks for leftovers
    assert house.leases.reopen(job, damaged)
    record = written(house, claimed(house), synthetic.rows(0, 10, failed=(3,)))
    assert house.leases.finish([Computed(first, 1, str(record.digest), record.bytes)]) == [True]
    tidy.tidy()
    assert set(house.files.names(job)) == {house.files.piece(job, piece).name for piece in house.store.pieces(job)}
