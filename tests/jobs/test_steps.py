"""The steps of a coordinator one at a time, on an engine whose chunks end when a test says so, by a clock of its own.

No thread runs but for the pauses, and nothing waits, so each step is told apart from the next.
"""

from collections.abc import Callable, Sequence
from concurrent.futures import BrokenExecutor, Future
from pathlib import Path
from typing import Any

import pytest

from service.jobs.coordinator import Coordinator
from service.jobs.database import DatabaseUnavailable
from service.jobs.engines import Engine, EngineUnavailable
from service.jobs.housekeeping import Housekeeping
from service.jobs.job import Chunk
from service.jobs.pace import Pace
from service.jobs.piece import ChunkResult, Stopped
from tests.jobs import synthetic
from tests.jobs.house import House

PACE = Pace(poll_s=0.1, lease_s=9.0, tidy_s=60.0, longest_pause_s=0.5, tries=3)


class Held:
    """An executor whose chunks end when somebody says so; ``sent`` is start, stop and what is to come of each."""

    def __init__(self, window: int) -> None:
        self._window = window
        self.sent: list[tuple[int, int, Future[ChunkResult]]] = []
        self.ends = 0

    def submit(self, task: Callable[..., ChunkResult], *arguments: Any) -> "Future[ChunkResult]":
        future: Future[ChunkResult] = Future()
        self.sent.append((arguments[2], arguments[3], future))
        return future

    def window(self) -> int:
        return self._window

    def end(self) -> None:
        self.ends += 1

    def compute(self) -> None:
        """End all that is on its way with its rows."""
        for start, stop, future in self.sent:
            if not future.done():
                future.set_result(synthetic.run("synthetic", b"{}", start, stop, "no such file"))

    def fail(self, error: Exception) -> None:
        """End all that is on its way with an error."""
        for _, _, future in self.sent:
            if not future.done():
                future.set_exception(error)


class Steps:
    """A coordinator, what it runs on, and the seconds of its clock."""

    def __init__(self, house: House, window: int = 2, pace: Pace = PACE, **more: Any) -> None:
        self.running, self.now = Held(window), 0.0
        self.housekeeping = Housekeeping(house.store, house.retention, house.files)
        self.coordinator = Coordinator(
            house.store,
            house.leases,
            house.files,
            self.housekeeping,
            Engine(lambda: self.running),
            pace=pace,
            run=synthetic.run,
            clock=lambda: self.now,
            **more,
        )

    def __call__(self, at: float = 0.0) -> list[tuple[int, int]]:
        """A step at a time of the clock; the rows of the chunks that it gave to the engine."""
        self.now, before = at, len(self.running.sent)
        self.coordinator._step()
        return [(start, stop) for start, stop, _ in self.running.sent[before:]]

    def pauses(self, monkeypatch: pytest.MonkeyPatch, count: int) -> list[float]:
        """So many pauses of its thread, one after each step, s; then it ends."""
        pauses: list[float] = []

        def wait(pause: float) -> bool:
            pauses.append(round(pause, 9))
            self.coordinator._stopping = len(pauses) == count
            return True

        monkeypatch.setattr(self.coordinator._wake, "wait", wait)
        self.coordinator._work()
        return pauses


@pytest.fixture
def renewed(house: House, monkeypatch: pytest.MonkeyPatch) -> list[list[int]]:
    """The chunks of every renewal."""
    renewals: list[list[int]] = []
    renew = house.leases.renew

    def recorded(owner: str, held: Sequence[Chunk], lease_s: float) -> None:
        assert lease_s == PACE.lease_s
        renewals.append([chunk.start for chunk in held])
        renew(owner, held, lease_s)

    monkeypatch.setattr(house.leases, "renew", recorded)
    return renewals


def test_leases_are_renewed_when_a_third_of_them_is_over(house: House, renewed: list[list[int]]) -> None:
    house.submit(total=20, chunk_rows=10)
    step = Steps(house)
    step(0.0)
    assert renewed == [[0, 10]]
    step(2.9)
    assert len(renewed) == 1
    step(3.1)
    step(6.0)
    assert len(renewed) == 2
    # nothing on its way has no lease
    step.running.compute()
    step(20.0)
    assert len(renewed) == 2


@pytest.mark.parametrize(("window", "at_a_time"), [(2, 1), (32, 2), (40, 2)])
def test_a_window_is_filled_in_sixteenths_and_no_further(
    house: House, monkeypatch: pytest.MonkeyPatch, window: int, at_a_time: int
) -> None:
    values: list[int] = []
    claim = house.leases.claim_chunks

    def claim_and_note(owner: str, lease_s: float, most: int, *more: Any, **named: Any) -> list[Chunk]:
        values.append(most)
        return claim(owner, lease_s, most, *more, **named)

    house.submit(total=100, chunk_rows=1)
    step = Steps(house, window)
    monkeypatch.setattr(house.leases, "claim_chunks", claim_and_note)
    assert step() == [(n, n + 1) for n in range(window)]
    # the first looks for what went wrong before
    assert values == [1, *[at_a_time] * (window // at_a_time)]
    assert step() == []


def test_the_last_turn_of_a_window_takes_what_is_left_of_it(house: House) -> None:
    house.submit(total=100, chunk_rows=1)
    assert len(Steps(house, 33)()) == 33


def test_chunks_of_a_pool_that_broke_are_tried_alone_until_the_one_at_fault_is_known(house: House) -> None:
    job = house.submit(total=4, chunk_rows=2)
    step = Steps(house)
    assert step() == [(0, 2), (2, 4)]
    step.running.fail(BrokenExecutor())
    # both went wrong once, and neither is blamed while it was not alone
    assert step() == [(0, 2)]
    assert step.running.ends == 1
    step.running.fail(BrokenExecutor())
    # it is tried three times before it is halved, and its halves have been tried already
    assert step() == [(0, 2)]
    step.running.fail(BrokenExecutor())
    assert step() == [(0, 1)]
    assert house.store.get(job).failed == 0
    for rows in ((1, 2), (2, 4)):
        step.running.compute()
        assert step() == [rows]
    step.running.compute()
    step()
    record = house.store.get(job)
    assert (record.state, record.done, record.failed) == ("done", 4, 0)


def test_an_error_of_a_row_is_recorded_when_it_was_tried_as_often_as_asked(house: House) -> None:
    job = house.submit(total=1, chunk_rows=1)
    step = Steps(house)
    for _ in range(PACE.tries):
        assert step() == [(0, 1)]
        step.running.fail(ArithmeticError("so it is"))
    assert step() == []
    record = house.store.get(job)
    assert (record.state, record.done, record.failed) == ("done", 1, 1)


def test_a_job_fails_when_it_has_more_faults_than_allowed(house: House) -> None:
    job = house.submit(total=8, chunk_rows=8)
    step = Steps(house, pace=Pace(tries=1, max_faults=1))
    step()
    step.running.fail(ArithmeticError())
    # halved once: as many as are allowed
    assert step() == [(0, 4)]
    step.running.fail(ArithmeticError("again"))
    step()
    record = house.store.get(job)
    assert record.error == "too many rows cannot be computed, the last because ArithmeticError: again"


def test_what_was_stopped_though_its_job_goes_on_is_computed(house: House) -> None:
    job = house.submit(total=2, chunk_rows=2)
    step = Steps(house)
    step()
    house.files.stop(job)
    step.running.fail(Stopped())
    # the flag of the time before is gone, so that the next one is not stopped by it
    assert step() == [(0, 2)]
    assert not Path(house.files.flag(job)).exists()
    assert house.store.get(job).failed == 0


def test_a_cancelled_job_has_its_chunks_cancelled_and_its_workers_told_once(
    house: House, monkeypatch: pytest.MonkeyPatch
) -> None:
    job, stopped = house.submit(total=4, chunk_rows=2), list[str]()
    actual_future = house.submit(total=2, chunk_rows=2, sleep_s=0.0)
    step = Steps(house, 4)
    assert len(step()) == 3
    monkeypatch.setattr(house.files, "stop", stopped.append)
    house.store.cancel(job)
    # those of the job that goes on are not given back
    assert step() == []
    assert stopped == [job, job]
    assert [future.cancelled() for *_, future in step.running.sent].count(True) == 2
    step.running.compute()
    step()
    assert (house.store.get(actual_future).state, house.store.get(job).done) == ("done", 0)
    # nor is the pool started again
    assert step.running.ends == 0


def test_leftovers_are_looked_for_every_minute(house: House, monkeypatch: pytest.MonkeyPatch) -> None:
    step, times = Steps(house), list[float]()
    monkeypatch.setattr(step.housekeeping, "tidy", lambda: times.append(step.now))
    for at in (0.0, 30.0, 60.0, 61.0, 90.0, 122.0):
        step(at)
    assert times == [0.0, 61.0, 122.0]


def test_where_there_can_be_no_jobs_the_store_is_left_alone(house: House, monkeypatch: pytest.MonkeyPatch) -> None:
    def away(*_: Any) -> None:
        raise AssertionError("the store was touched")

    house.submit(total=2)
    step = Steps(house, begun=lambda: False)
    monkeypatch.setattr(house.leases, "active", away)
    monkeypatch.setattr(house.leases, "release", away)
    assert step() == []
    step.coordinator._stopping = True
    step.coordinator._work()


def test_engines_end_each_once(house: House) -> None:
    selecting = Held(1)
    apart = Steps(house, selector=Engine(lambda: selecting))
    apart.coordinator._selector.window()
    apart.coordinator._engine.window()
    apart.coordinator._end_engines()
    assert (apart.running.ends, selecting.ends) == (1, 1)


@pytest.mark.parametrize(
    ("error", "marked"),
    [(DatabaseUnavailable("it is locked"), False), (DatabaseUnavailable("it is full", full=True), True)],
)
def test_pauses_grow_while_the_database_is_away(
    house: House, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture, error: Exception, marked: bool
) -> None:
    job = house.submit(total=4, chunk_rows=2)
    step, pauses = Steps(house), list[float]()
    step()
    coordinator, active = step.coordinator, house.leases.active

    def answers() -> set[str]:
        if len(pauses) in (0, 1, 2, 3, 4):
            raise error
        return active()

    def wait(pause: float) -> bool:
        pauses.append(round(pause, 9))
        coordinator._stopping = len(pauses) == 6
        return True

    monkeypatch.setattr(house.leases, "active", answers)
    monkeypatch.setattr(coordinator._wake, "wait", wait)
    coordinator._work()
    # twice as long each time, up to the longest, and soon again when it is there
    assert pauses == [0.2, 0.4, 0.5, 0.5, 0.5, 0.1]
    # it is said once, and what lacked room fails when the database can be told
    assert sum(str(error) in record.getMessage() for record in caplog.records) == 1
    assert house.store.get(job).state == ("failed" if marked else "running")
    # the leases are given back: a service that comes next starts at once
    assert len(house.leases.claim_chunks("another", PACE.lease_s, 5)) == (0 if marked else 2)


def test_an_engine_that_is_away_is_asked_again_later(house: House, monkeypatch: pytest.MonkeyPatch) -> None:
    house.submit(total=4, chunk_rows=2)
    step = Steps(house)

    def window() -> int:
        raise EngineUnavailable("nobody there")

    monkeypatch.setattr(step.running, "window", window)
    assert step.pauses(monkeypatch, 4) == [0.2, 0.4, 0.5, 0.5]


def test_what_nobody_foresaw_ends_no_thread(
    house: House, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    step = Steps(house)

    def stumbles() -> set[str]:
        raise RuntimeError("so it is")

    monkeypatch.setattr(house.leases, "active", stumbles)
    assert step.pauses(monkeypatch, 4) == [0.2, 0.4, 0.5, 0.5]
    assert sum("stumbled" in record.getMessage() for record in caplog.records) == 4


def test_a_disk_without_room_for_a_lease_fails_what_waits(house: House, monkeypatch: pytest.MonkeyPatch) -> None:
    job = house.submit(total=4)
    step = Steps(house, window=0)
    step()

    def full() -> set[str]:
        raise DatabaseUnavailable("no room", full=True)

    monkeypatch.setattr(house.leases, "active", full)
    step.pauses(monkeypatch, 2)
    # none of its chunks was on its way
    assert step.running.sent == []
    record = house.store.get(job)
    assert (record.state, record.error) == ("failed", "no room")
