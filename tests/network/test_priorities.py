"""Before whom a task is computed: niceness and time slices of the threads of workers."""

import json
import os
import socket
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import BinaryIO

import anyio
import pytest

from schemas.answer.problem import Problem
from service.workers import lanes
from service.workers.pool import Pool
from service.workers.task import Priority, Task
from service.workers.worker import Answer
from tests.network import tasks
from tests.network.pools import run
from tests.network.tasks import task


def test_who_asks_for_more_is_computed_behind_the_others(pool: Pool) -> None:
    def numbers(*arguments: object) -> list[list[int]]:
        return [
            [int(part) for part in json.loads(argument.content)["title"].split()]
            for argument in arguments
            if isinstance(argument, Answer)
        ]

    here = os.getpriority(os.PRIO_PROCESS, 0)
    first, behind = (min(19, here + nicer) for nicer in (2, 10))
    assert numbers(*run(pool, task(tasks.niceness))) == [[first, first]]
    many = numbers(*run(pool, *[task(tasks.niceness)] * 4))
    assert len(many) == 4
    # the first is alone when it begins, and the last may be
    assert [own for own, _ in many[:3]] == [first, behind, behind]
    assert {process for _, process in many} == {first}
    # and whoever is alone again is not behind anybody
    assert numbers(*run(pool, task(tasks.niceness))) == [[first, first]]


def test_who_asks_without_end_gives_way_to_who_asks_now_and_then(pool: Pool, monkeypatch: pytest.MonkeyPatch) -> None:
    # nothing else lowers it
    monkeypatch.setattr("service.workers.process.QUICK_S", 60.0)
    here = os.getpriority(os.PRIO_PROCESS, 0)
    first, behind = (min(19, here + nicer) for nicer in (2, 10))
    # a second of work, on end
    assert isinstance(run(pool, task(tasks.slow))[0], Answer)
    titles: dict[str, list[int]] = {}

    async def niceness(name: str, computation: Callable[..., Problem], owner: str) -> None:
        answer = await pool.run(task(computation), owner)
        assert isinstance(answer, Answer)
        titles[name] = [int(number) for number in json.loads(answer.content)["title"].split()]

    async def two_owners() -> None:
        async with anyio.create_task_group() as group:
            # it computes until its niceness changes
            group.start_soon(niceness, "before", tasks.lowered, "one")
            with anyio.fail_after(60):
                while not any(worker.computing_s > 0 for worker in pool._busy):
                    await anyio.sleep(0.01)
            group.start_soon(niceness, "now and then", tasks.niceness, "another")
        async with anyio.create_task_group() as group:
            group.start_soon(niceness, "again", tasks.niceness, "another")
            await anyio.wait_all_tasks_blocked()
            group.start_soon(niceness, "beside", tasks.niceness, "one")

    anyio.run(two_owners)
    assert titles["now and then"] == titles["again"] == [first, first]
    # what had begun before goes on behind, and what begins meanwhile is behind from the first
    assert titles["before"] == [first, behind]
    assert titles["beside"] == [behind, first]


@pytest.mark.parametrize(
    ("lane", "behind"), [(lanes.FIRST, Priority.FURTHER), (lanes.FIRST, Priority.LONG), (lanes.FURTHER, Priority.LONG)]
)
def test_a_thread_that_is_behind_others_reads_no_task(lane: lanes.Lane, behind: Priority) -> None:
    """It would wake late for one that is not, as everything else comes before it."""
    if os.getpriority(os.PRIO_PROCESS, 0) == 19:
        pytest.skip("the tests run behind all others, and no thread can be behind them")
    with following(lane.foremost) as stream, ThreadPoolExecutor(1) as thread:
        order = lanes.answer_all, lane, stream, _nothing, task(tasks.quick), behind
        assert thread.submit(*order).result(60) is None
        assert Task.receive(stream)[1] is lane.foremost


@pytest.mark.parametrize("lane", lanes.LANES)
def test_a_thread_reads_the_foremost_tasks_of_its_lane_one_after_the_other(lane: lanes.Lane) -> None:
    answered: list[Task] = []
    with following(lane.foremost) as stream, ThreadPoolExecutor(1) as thread:
        order = lanes.answer_all, lane, stream, answered.append, task(tasks.quick), lane.foremost
        with pytest.raises(EOFError):
            thread.submit(*order).result(60)
    assert len(answered) == 2


@contextmanager
def following(priority: Priority) -> Iterator[BinaryIO]:
    """A task that comes, and nothing after it."""
    ours, theirs = socket.socketpair()
    with theirs, theirs.makefile("rb") as stream:
        with ours:
            ours.sendall(task(tasks.quick).serialize(priority))
        yield stream


def _nothing(_: Task) -> None:
    pass


def test_long_tasks_are_computed_behind_all_others(pool: Pool) -> None:
    [answer] = run(pool, task(tasks.niceness, long=True))
    assert isinstance(answer, Answer)
    own, process = (int(part) for part in json.loads(answer.content)["title"].split())
    here = os.getpriority(os.PRIO_PROCESS, 0)
    assert (own, process) == (min(19, here + 13), min(19, here + 2))


def test_what_computes_for_longer_goes_on_behind_the_others(pool: Pool) -> None:
    here = os.getpriority(os.PRIO_PROCESS, 0)
    first, last = (min(19, here + nicer) for nicer in (2, 13))
    [answer] = run(pool, task(tasks.lowered))
    assert isinstance(answer, Answer)
    assert [int(part) for part in json.loads(answer.content)["title"].split()] == [first, last]
    # in the same process the next is not behind anybody; nor is one that waits for something and computes nothing
    [waits] = run(pool, task(tasks.niceness))
    assert isinstance(waits, Answer)
    assert json.loads(waits.content)["title"] == f"{first} {first}"
    assert pool.counts.started == 1


def test_first_tasks_have_short_time_slices_and_others_those_of_the_system(pool: Pool) -> None:
    [first, long] = (run(pool, task(tasks.slices, long=long))[0] for long in (False, True))
    assert isinstance(first, Answer)
    assert isinstance(long, Answer)
    short_ns, of_the_system_ns = (int(json.loads(answer.content)["title"]) for answer in (first, long))
    # before 6.12 Linux heeds none, and says 0
    heeds = tuple(map(int, os.uname().release.split("-")[0].split(".")[:2])) >= (6, 12)
    assert short_ns == (100_000 if heeds else 0)
    assert of_the_system_ns == short_ns == 0 or of_the_system_ns > short_ns
