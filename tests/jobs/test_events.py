"""Events of jobs: told once each, and looked up together for all who watch."""

from collections.abc import Collection
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import anyio
import pytest

from service.jobs import events as module
from service.jobs.database import DatabaseUnavailable
from service.jobs.events import Watch, events, news
from service.jobs.job import Job
from service.jobs.rows import UnknownJob

JOB = Job(
    id="a" * 32, kind="sweep", owner=None, state="running", total=10, done=0, failed=0, invalid=0, infeasible=0,
    version=1,
    created=0.0, started=None, ended=None, error=None, seed=0, chunk_rows=1, planned=10, selects=False, selected=0,
    kept=0, repaired=0, bytes=0,
)  # fmt: skip


class Jobs:
    """Two jobs that change with every look."""

    def __init__(self, last: int = 3) -> None:
        self.last, self.looks, self.states = last, 0, 0
        self.away = False

    def by_ids(self, ids: Collection[str]) -> list[Job]:
        self.looks += 1
        if self.away:
            raise DatabaseUnavailable("it does not answer")
        version = min(self.last, 1 + self.looks)
        state: Any = "done" if version == self.last else "running"
        there = (JOB, replace(JOB, id="b" * 32))
        return [replace(job, version=version, state=state) for job in there if job.id in ids]

    def state(self, job: Job, prefix: str) -> Any:
        self.states += 1
        return SimpleNamespace(model_dump_json=lambda: f'"{prefix} {job.version}"')


@pytest.fixture(autouse=True)
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_POLL_S", 0.01)
    monkeypatch.setattr(module, "_HEARTBEAT_S", 0.05)


def streams(jobs: Jobs, ids: list[str]) -> list[bytes]:
    """What each of some streams tells from the first event to its end."""
    texts = [b""] * len(ids)

    async def every_weight() -> None:
        watch = Watch(jobs)  # type: ignore[arg-type]

        async def stream(number: int, id: str) -> None:  # noqa: A002
            first = news(jobs, replace(JOB, id=id), "/x")  # type: ignore[arg-type]
            async for piece in events(first, lambda: watch.next(id, "/x"), None, lambda: False):
                texts[number] += piece

        async with anyio.create_task_group() as tasks:
            tasks.start_soon(watch.run)
            async with anyio.create_task_group() as streams:
                for number, id in enumerate(ids):  # noqa: A001
                    streams.start_soon(stream, number, id)
            tasks.cancel_scope.cancel()

    anyio.run(every_weight)
    return texts


def test_every_change_is_told_to_all_who_watch_at_the_cost_of_one_look() -> None:
    jobs = Jobs()
    text = streams(jobs, [JOB.id] * 50 + ["b" * 32] * 50)
    expected = b"retry: 2000\n\n" + b"".join(
        f'id: {version}\nevent: {name}\ndata: "/x {version}"\n\n'.encode()
        for version, name in ((1, "progress"), (2, "progress"), (3, "end"))
    )
    assert text == [expected] * 100
    assert jobs.looks == 2
    # the first of each stream by itself, then one for each change of each job
    assert jobs.states == 100 + 4


def test_a_stream_outlives_a_database_that_is_away() -> None:
    jobs = Jobs()
    jobs.away = True

    async def comes_back() -> bytes:
        watch, text = Watch(jobs), b""  # type: ignore[arg-type]
        async with anyio.create_task_group() as tasks:
            tasks.start_soon(watch.run)
            first = news(jobs, JOB, "")  # type: ignore[arg-type]
            async for piece in events(first, lambda: watch.next(JOB.id, ""), None, lambda: False):
                text += piece
                jobs.away = b"does not answer" not in text
            tasks.cancel_scope.cancel()
        return text

    content = anyio.run(comes_back)
    assert content.count(b": the job database does not answer\n\n") == 1
    assert content.endswith(b'event: end\ndata: " 3"\n\n')


def test_a_job_that_is_gone_is_unknown() -> None:
    async def gone() -> None:
        watch = Watch(Jobs())  # type: ignore[arg-type]
        async with anyio.create_task_group() as tasks:
            tasks.start_soon(watch.run)
            with pytest.raises(UnknownJob):
                await watch.next("c" * 32, "")
            tasks.cancel_scope.cancel()

    anyio.run(gone)
