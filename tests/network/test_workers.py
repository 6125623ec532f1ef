"""The pool of workers: what becomes of tasks that are slow, hungry, faulty, deadly, or nobody's any more."""

import os
import signal
import stat
import time
from dataclasses import replace
from multiprocessing import forkserver
from pathlib import Path
from tempfile import TemporaryDirectory

import anyio
import psutil
import pytest

from service.fairness.faults import Busy
from service.workers.pool import Pool, TooSlow, WorkerDied
from service.workers.process import WorkersFailed
from service.workers.worker import Answer, Crashed, NoRoom, OutOfMemory, Refused
from tests.mould import FORK_SERVER
from tests.network import tasks
from tests.network.pools import close, pool_of, run
from tests.network.tasks import task
from tests.network.test_length import SAMPLED


def test_it_answers(pool: Pool) -> None:
    [answer] = run(pool, task(tasks.quick))
    assert isinstance(answer, Answer)
    assert b'"title":"t"' in answer.content
    assert answer.certified is None
    assert answer.resident > 10_000_000


def test_a_turn_counts_for_what_its_worker_computed(pool: Pool) -> None:
    # it sleeps for a second, and computes for longer than a busy machine may take between two looks at the clock
    assert isinstance(run(pool, task(tasks.mostly_idle))[0], Answer)
    assert 0 < pool._short._loads.of("one") < 0.3


def test_what_turns_out_to_be_long_gives_its_turn_back(pool: Pool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("service.fairness.length.BRIEF_S", 0.1)
    # it goes on where it is, as nobody else is long
    [answer] = run(pool, task(tasks.slow))
    assert isinstance(answer, Answer)
    assert (pool.counts.moved_long, pool.counts.begun_anew) == (1, 0)
    assert (pool.running, pool.queued) == (0, 0)


def test_what_is_long_is_begun_anew_where_others_wait(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("service.fairness.length.BRIEF_S", 0.1)
    pool = pool_of(1, 8)

    async def more_than_there_are_turns() -> None:
        async with anyio.create_task_group() as group:
            # the only turn of the long ones
            group.start_soon(pool.run, task(tasks.endless, long=True), "one")
            group.start_soon(pool.run, task(tasks.slow), "one")
            await anyio.wait_all_tasks_blocked()
            # of the same client, so that it waits for the same turn
            assert isinstance(await pool.run(task(tasks.quick), "one"), Answer)
            assert (pool.counts.moved_long, pool.counts.begun_anew) == (0, 1)
            assert (pool.running, pool.queued) == (1, 1)
            group.cancel_scope.cancel()

    try:
        anyio.run(more_than_there_are_turns)
    finally:
        close(pool)


def test_no_number_of_long_ones_keeps_another_client_waiting(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("service.fairness.length.BRIEF_S", 0.1)
    pool = pool_of(2, 64)

    async def beside_six_clients() -> None:
        async with anyio.create_task_group() as group:
            for owner in "abcdef" * 2:
                group.start_soon(pool.run, task(tasks.endless), owner)
            await anyio.wait_all_tasks_blocked()
            with anyio.fail_after(600):
                for _ in range(10):
                    assert isinstance(await pool.run(task(tasks.quick), "bystander"), Answer)
            group.cancel_scope.cancel()

    try:
        anyio.run(beside_six_clients)
    finally:
        close(pool)


def test_what_a_worker_finds_to_be_long_waits_for_the_long_ones(pool: Pool) -> None:
    handed_back = replace(task(tasks.quick), body=SAMPLED)

    async def beside_a_long_task() -> None:
        async with anyio.create_task_group() as group:
            group.start_soon(pool.run, task(tasks.endless, long=True), "one")
            group.start_soon(pool.run, handed_back, "two")
            with anyio.fail_after(180):
                while not pool.queued:
                    await anyio.sleep(0.01)
            assert isinstance(await pool.run(task(tasks.quick), "two"), Answer)
            assert pool.queued == 1
            group.cancel_scope.cancel()

    anyio.run(beside_a_long_task)
    [answer] = run(pool, handed_back)
    assert isinstance(answer, Answer)


@pytest.mark.parametrize("waits", [False, True])
def test_more_long_ones_than_may_wait_are_refused(waits: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    # those that turn out to be long too, whose computation ends with that
    monkeypatch.setattr("service.fairness.length.BRIEF_S", 0.1)
    pool = pool_of(1, 0)
    try:
        first, second = run(pool, task(tasks.slow, long=True), task(tasks.slow, long=not waits))
        assert isinstance(first, Answer)
        assert isinstance(second, Busy)
        assert (pool.running, pool.queued, pool.counts.refused_busy) == (0, 0, 1)
    finally:
        pool.close()


def test_a_task_that_takes_too_long_is_ended_with_its_worker(pool: Pool) -> None:
    run(pool, task(tasks.quick))
    before = pool.pids
    pool.timeout_s = 0.5
    answers = run(pool, task(tasks.endless), task(tasks.endless))
    assert [answer.computing for answer in answers if isinstance(answer, TooSlow)] == [True, True]
    assert not set(before) & set(pool.pids)
    assert pool.counts.ended_late == 2
    pool.timeout_s = 180
    assert isinstance(run(pool, task(tasks.quick))[0], Answer)


def test_a_task_that_waits_too_long_is_not_begun(pool: Pool) -> None:
    async def third() -> None:
        async with anyio.create_task_group() as group:
            for _ in range(2):
                group.start_soon(pool.run, task(tasks.endless), "one")
            await anyio.wait_all_tasks_blocked()
            pool.timeout_s = 0.1
            with pytest.raises(TooSlow) as late:
                await pool.run(task(tasks.quick), "one")
            assert not late.value.computing
            group.cancel_scope.cancel()

    anyio.run(third)
    assert pool.counts.ended_late == 1


def test_more_than_may_wait_are_refused_at_once(pool: Pool) -> None:
    run(pool, task(tasks.quick), task(tasks.quick))
    answers = run(pool, *[task(tasks.slow)] * 6)
    refused = [answer for answer in answers if isinstance(answer, Busy)]
    assert len(refused) == 2
    assert all(busy.retry_after_s >= 1 for busy in refused)
    assert sum(isinstance(answer, Answer) for answer in answers) == 4
    assert (pool.running, pool.queued) == (0, 0)


def test_long_tasks_leave_a_worker_to_the_others(pool: Pool) -> None:
    run(pool, task(tasks.quick), task(tasks.quick))

    async def three_at_once() -> None:
        async with anyio.create_task_group() as group:
            for _ in range(2):
                group.start_soon(pool.run, task(tasks.endless, long=True), "one")
            await anyio.wait_all_tasks_blocked()
            assert (pool.running, pool.queued) == (1, 1)
            assert isinstance(await pool.run(task(tasks.quick), "one"), Answer)
            group.cancel_scope.cancel()

    anyio.run(three_at_once)


def test_who_has_no_turn_finds_a_worker_that_has_been_started(pool: Pool) -> None:
    pool.open()
    begun = pool.counts.started

    async def another_beside_all() -> None:
        async with anyio.create_task_group() as group:
            for _ in range(2):
                group.start_soon(pool.run, task(tasks.endless), "one")
            await anyio.wait_all_tasks_blocked()
            assert isinstance(await pool.run(task(tasks.quick), "another"), Answer)
            assert (pool.running, pool.counts.started) == (2, begun)
            group.cancel_scope.cancel()

    anyio.run(another_beside_all)


def test_a_worker_that_was_ended_is_replaced_before_anybody_needs_it(pool: Pool) -> None:
    pool.open()
    begun = pool.counts.started

    async def leave() -> None:
        with anyio.move_on_after(0.3):
            await pool.run(task(tasks.endless), "one")
        with anyio.fail_after(60):
            while len(pool.pids) < begun:
                await anyio.sleep(0.01)

    anyio.run(leave)
    assert (pool.running, pool.counts.ended_gone, pool.counts.started) == (0, 1, begun + 1)


def test_a_task_that_takes_too_much_memory_is_refused_alone(pool: Pool) -> None:
    hungry, answer = run(pool, task(tasks.hungry), task(tasks.slow))
    assert isinstance(hungry, Refused)
    assert isinstance(hungry.error, OutOfMemory)
    assert isinstance(answer, Answer)


def test_a_fault_says_where_and_apart_what(pool: Pool) -> None:
    [answer] = run(pool, task(tasks.faulty, "7021962"))
    assert isinstance(answer, Crashed)
    assert "tasks.py" in answer.trace
    assert "RuntimeError" in answer.trace
    assert "7021962" not in answer.trace
    assert "7021962" in answer.message


def test_a_worker_that_dies_is_replaced_and_its_task_done_again(pool: Pool) -> None:
    # a name of a machine is shorter than pytest's own folders
    with TemporaryDirectory() as folder:
        [answer] = run(pool, task(tasks.deadly_once, f"{folder}/x"))
    assert isinstance(answer, Answer)
    assert pool.counts.died == 1


def test_a_task_that_kills_its_workers_is_given_up(pool: Pool) -> None:
    deadly, answer = run(pool, task(tasks.deadly), task(tasks.slow))
    assert isinstance(deadly, WorkerDied)
    assert isinstance(answer, Answer)
    assert pool.counts.died == 2


def test_a_task_whose_caller_is_gone_is_ended(pool: Pool) -> None:
    run(pool, task(tasks.quick), task(tasks.quick))

    async def leave() -> None:
        with anyio.move_on_after(0.3):
            await pool.run(task(tasks.endless), "one")
        assert pool.running == 0
        assert isinstance(await pool.run(task(tasks.quick), "one"), Answer)

    anyio.run(leave)
    assert pool.counts.ended_gone == 1


def test_a_large_answer_comes_in_a_file_that_is_gone_when_it_is_read(pool: Pool, tmp_path: Path) -> None:
    pool.folder = tmp_path / "data"
    large, small = run(pool, task(tasks.large), task(tasks.quick))
    assert isinstance(large, Answer)
    assert isinstance(small, Answer)
    assert large.file is not None
    assert small.file is None
    assert list(pool.folder.iterdir()) == []
    # nor does anybody else look into it
    assert stat.S_IMODE(pool.folder.stat().st_mode) == 0o700
    with large.file as file:
        content = file.read()
    assert (len(content), content.count(b"x")) == (large.size, 5_000_000)


def test_a_large_answer_that_finds_no_room_is_refused(pool: Pool, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    pool.folder = tmp_path / "file" / "folder"
    [answer] = run(pool, task(tasks.large))
    assert isinstance(answer, Refused)
    assert isinstance(answer.error, NoRoom)
    assert isinstance(run(pool, task(tasks.quick))[0], Answer)


def stopped(pid: int) -> None:
    """Stop a process, and wait until no thread of it runs any longer: until then it may take a task."""
    os.kill(pid, signal.SIGSTOP)
    end = time.monotonic() + 60
    threads = [psutil.Process(thread.id) for thread in psutil.Process(pid).threads()]
    while any(thread.status() != psutil.STATUS_STOPPED for thread in threads):
        assert time.monotonic() < end
        time.sleep(0.001)


def fork_server() -> int:
    # no child of this process: see tests/fork_server.py
    pid: int = forkserver._forkserver._forkserver_pid  # type: ignore[attr-defined]
    assert psutil.Process(pid).name() == FORK_SERVER
    return pid


def test_a_worker_that_has_stopped_is_given_up_at_the_time_limit(pool: Pool) -> None:
    run(pool, task(tasks.quick))
    pool.timeout_s = 1
    stopped(*pool.pids)
    assert isinstance(run(pool, task(tasks.quick))[0], TooSlow)
    pool.timeout_s = 180
    assert isinstance(run(pool, task(tasks.quick))[0], Answer)


def test_a_process_to_fork_from_that_has_stopped_is_given_up_and_replaced(
    pool: Pool, monkeypatch: pytest.MonkeyPatch
) -> None:
    # longer than the test takes: the time limit does not wait for it
    monkeypatch.setattr("service.workers.process._START_S", 3600.0)
    run(pool, task(tasks.quick))
    pool.close()
    pool._closed = False
    stopped(fork_server())
    pool.timeout_s = 1
    assert isinstance(run(pool, task(tasks.quick))[0], TooSlow)
    # the next one finds out, and has it replaced
    monkeypatch.setattr("service.workers.process._START_S", 0.5)
    pool.timeout_s = 60
    assert not isinstance(run(pool, task(tasks.quick))[0], Answer)
    # and no start that is only slow is ended
    monkeypatch.setattr("service.workers.process._START_S", 3600.0)
    deadline = time.monotonic() + 180
    while not isinstance(run(pool, task(tasks.quick))[0], Answer):
        assert time.monotonic() < deadline


def test_a_pool_that_is_closed_while_it_opens_is_no_fault(pool: Pool, monkeypatch: pytest.MonkeyPatch) -> None:
    def late(*_: object, **__: object) -> None:
        pool.close()
        raise WorkersFailed("The service ends.")

    monkeypatch.setattr("service.workers.pool.forked", late)
    pool.open()
    assert pool.pids == ()


def test_a_closed_pool_starts_nothing(pool: Pool) -> None:
    run(pool, task(tasks.quick))
    pool.close()
    assert pool.pids == ()
    assert isinstance(run(pool, task(tasks.quick))[0], WorkersFailed)
