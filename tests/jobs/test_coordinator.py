"""Coordinators on engines: the same rows whatever happens. The value of row i is i / 7 (analytic)."""

import threading
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from service.jobs.engines import Engine, engine
from service.jobs.pace import Pace
from service.jobs.piece import ChunkResult
from service.jobs.rows import Limits
from service.settings import Settings
from tests.jobs import synthetic
from tests.jobs.failover import CHUNK_S, MOST_S
from tests.jobs.house import QUICK, House
from tests.jobs.threads import Threads, threads
from tests.night import part


def test_the_chunks_of_a_service_that_is_gone_are_another_ones_in_time() -> None:
    # analytic: its lease ends, the other one looks, and has room for each of two when it has done one of its own
    longest_s = Settings().lease_s + Pace().poll_s + 2 * CHUNK_S
    assert longest_s < MOST_S
    assert Pace().lease_s == Settings().lease_s


@pytest.mark.parametrize(("workers", "chunk_rows"), part(2, [(1, 1), (2, 7), (3, 7), (3, 100)], rows=True))
def test_the_same_rows_whatever_the_chunks_and_workers(house: House, workers: int, chunk_rows: int) -> None:
    job = house.submit(total=60, chunk_rows=chunk_rows)
    with house.coordinator(threads(workers)):
        assert house.wait(job).state == "done"
    assert house.rows(job).equals(synthetic.rows(0, 60))


def test_processes(house: House) -> None:
    job = house.submit(total=60, chunk_rows=7)
    with house.coordinator(engine("processes", 2)):
        assert house.wait(job).state == "done"
    assert house.rows(job).equals(synthetic.rows(0, 60))


def test_a_killed_worker_costs_a_retry(house: House, tmp_path: Path) -> None:
    job = house.submit(total=60, chunk_rows=5, kill_at=31, kill_once=str(tmp_path / "killed"))
    with house.coordinator(engine("processes", 2)):
        outcome = house.wait(job)
    assert (tmp_path / "killed").exists()
    assert (outcome.state, outcome.done, outcome.failed) == ("done", 60, 0)
    assert house.rows(job).equals(synthetic.rows(0, 60))


def test_a_row_that_kills_every_worker_is_the_only_one_that_fails(house: House) -> None:
    job = house.submit(total=12, chunk_rows=4, kill_at=6)
    with house.coordinator(engine("processes", 1), Pace(poll_s=0.05, tries=2)):
        outcome = house.wait(job)
    assert (outcome.state, outcome.done, outcome.failed) == ("done", 12, 1)
    assert house.rows(job).equals(synthetic.rows(0, 12, failed=(6,)))


def test_a_row_that_raises_is_the_only_one_that_fails(house: House, tmp_path: Path) -> None:
    job = house.submit(total=100, chunk_rows=50, raise_at=73)
    future = house.submit(total=10, raise_at=3, raise_once=str(tmp_path / "raised"))
    with house.coordinator(threads()):
        outcome = house.wait(job)
        assert house.wait(future).failed == 0
    assert (outcome.state, outcome.done, outcome.failed) == ("done", 100, 1)
    assert house.rows(job).equals(synthetic.rows(0, 100, failed=(73,)))


def test_what_workers_find_wrong_is_logged_and_counted(house: House, caplog: pytest.LogCaptureFixture) -> None:
    def run(*chunk: Any) -> ChunkResult:
        return replace(synthetic.run(*chunk), faults=("a bound is wrong",))

    job = house.submit(total=60, chunk_rows=20)
    # a lease that runs out has a chunk computed, and its faults counted, once more
    coordinator = house.coordinator_on(threads(), replace(QUICK, lease_s=600.0), run=run)
    coordinator.start()
    assert house.wait(job).state == "done"
    coordinator.stop()
    assert coordinator.faults == 3
    assert f"job {job}: rows 20 to 39: a bound is wrong" in caplog.text


def test_a_job_with_too_many_faults_fails(house: House) -> None:
    job = house.submit(total=100, chunk_rows=50, raise_at=73)
    with house.coordinator(threads(), Pace(poll_s=0.05, max_faults=2)):
        outcome = house.wait(job)
    assert outcome.state == "failed"
    assert outcome.error == "too many rows cannot be computed, the last because ArithmeticError: asked for"
    assert outcome.done == house.rows(job).num_rows


def test_a_cancelled_job_ends_soon_and_keeps_its_rows(house: House, tmp_path: Path) -> None:
    go = tmp_path / "go"
    job = house.submit(total=40, chunk_rows=10, held_from=10, held_until=str(go))
    endless = house.submit(total=4, chunk_rows=1, sleep_s=3600)
    with house.coordinator(threads(2)):
        house.wait_for_rows(job)
        house.store.cancel(job)
        house.store.cancel(endless)
        house.files.stop(endless)
        count = house.store.get(job).done
        assert count == 10
        # the workers are free again
        assert house.wait(house.submit(total=10), timeout=180).state == "done"
    assert house.rows(job).num_rows == count == house.store.get(job).done
    house.store.resume(job)
    go.touch()
    with house.coordinator(threads(2)):
        assert house.wait(job).state == "done"
    assert house.rows(job).equals(synthetic.rows(0, 40))


def test_a_stop_parks_and_a_start_goes_on(house: House, tmp_path: Path) -> None:
    go = tmp_path / "go"
    job = house.submit(total=40, chunk_rows=2, held_from=10, held_until=str(go))
    with house.coordinator(engine("processes", 2)):
        house.wait_for_rows(job)
    # what was computed was not waited for: it would last for ever
    assert house.store.get(job).state == "running"
    go.touch()
    # the leases were given back: nothing waits for them
    with house.coordinator(threads(), Pace(poll_s=0.05, lease_s=3600)):
        assert house.wait(job).state == "done"
    assert house.rows(job).equals(synthetic.rows(0, 40))


@pytest.mark.parametrize("any_house", ["sqlite", pytest.param("postgresql", marks=pytest.mark.nightly)], indirect=True)
def test_two_coordinators_share_a_job(any_house: House) -> None:
    job = any_house.submit(total=200, chunk_rows=2, sleep_s=0.01)
    with any_house.coordinator(threads()), any_house.coordinator(threads()):
        outcome = any_house.wait(job)
    assert (outcome.state, outcome.done) == ("done", 200)
    assert any_house.rows(job).equals(synthetic.rows(0, 200))


def test_an_expired_job_leaves_nothing_behind(tmp_path: Path) -> None:
    house = House(tmp_path, limits=Limits(keep_s=0.1))
    job = house.submit(total=10)
    with house.coordinator(threads(), QUICK):
        deadline = time.monotonic() + 180
        while house.retention.removed() or house.store.page(["synthetic"], 1) or house.files.folder(job).exists():
            assert time.monotonic() < deadline
            time.sleep(0.02)


def test_the_window_is_bounded(house: House, tmp_path: Path) -> None:
    go = tmp_path / "go"
    at_once, most = 0, 0
    lock = threading.Lock()

    class Counting(Threads):
        def __init__(self) -> None:
            super().__init__(2)
            submit = self.executor.submit

            def counted(*args: Any) -> Any:
                nonlocal at_once, most
                with lock:
                    at_once += 1
                    most = max(most, at_once)
                future = submit(*args)
                future.add_done_callback(lambda _: gone())
                return future

            def gone() -> None:
                nonlocal at_once
                with lock:
                    at_once -= 1

            self.executor.submit = counted  # type: ignore[method-assign]

    job = house.submit(total=60, chunk_rows=2, held_from=0, held_until=str(go))
    with house.coordinator(Engine(Counting)):
        deadline = time.monotonic() + 180
        while most < 4:
            assert time.monotonic() < deadline
            time.sleep(0.02)
        go.touch()
        assert house.wait(job).state == "done"
    assert most == 4


def test_one_thread_and_none_of_what_has_been_stopped(house: House) -> None:
    with house.coordinator(threads()) as coordinator:
        before = coordinator._thread
        assert before is not None
        coordinator.start()
        assert coordinator._thread is before
    stopped = house.coordinator_on(threads())
    stopped.stop()
    stopped.start()
    assert stopped._thread is None


def test_chunks_are_computed_in_their_order(house: House) -> None:
    """A worker alone, to which several chunks are leased at a time, computes them in the order of their rows."""
    order: list[int] = []

    def run(*arguments: Any) -> ChunkResult:
        order.append(next(argument for argument in arguments if isinstance(argument, int)))
        return synthetic.run(*arguments)

    class Alone(Threads):
        def window(self) -> int:
            # leased two at a time
            return 32

    job = house.submit(total=200, chunk_rows=10)
    coordinator = house.coordinator_on(Engine(lambda: Alone(1)), run=run)
    coordinator.start()
    try:
        house.wait(job)
    finally:
        coordinator.stop()
    assert order == list(range(0, 200, 10))
