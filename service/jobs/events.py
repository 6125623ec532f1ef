"""Progress as server-sent events: the last state first, then every change, and at last the end."""

import time
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping
from dataclasses import dataclass, field

from anyio import CapacityLimiter, Event, sleep, to_thread

from service.jobs.database import DatabaseUnavailable
from service.jobs.job import Job
from service.jobs.owner_jobs import OwnerJobs
from service.jobs.rows import UnknownJob

_POLL_S = 0.5
#: proxies close what is silent for longer
_HEARTBEAT_S = 15.0


@dataclass(frozen=True)
class News:
    """A job as it is now, and the event that tells of it."""

    job: Job
    event: bytes


def news(jobs: OwnerJobs, job: Job, prefix: str) -> News:
    """The event with the state of a job; ``prefix`` is the path that a proxy strips."""
    name = "progress" if job.active else "end"
    state = jobs.state(job, prefix).model_dump_json()
    return News(job, f"id: {job.version}\nevent: {name}\ndata: {state}\n\n".encode())


@dataclass
class _Look:
    """A look at some jobs, each with the prefix of who watches it, that is yet to be taken, or has been."""

    keys: set[tuple[str, str]] = field(default_factory=set)
    call: Event = field(default_factory=Event)
    begun: Event = field(default_factory=Event)
    news: Mapping[tuple[str, str], News] = field(default_factory=dict)
    failure: Exception | None = None


class Watch:
    """Looks at all jobs that are watched at once, in one thread: another stream of the same job costs no look."""

    def __init__(self, jobs: OwnerJobs) -> None:
        self._jobs = jobs
        self._next = _Look()
        self._thread = CapacityLimiter(1)

    async def run(self) -> None:
        """Look again and again while anybody watches, until cancelled."""
        latest: Mapping[tuple[str, str], News] = {}
        while True:
            await self._next.call.wait()
            await sleep(_POLL_S)
            look, self._next = self._next, _Look()
            try:
                latest = look.news = await to_thread.run_sync(self._news, look.keys, latest, limiter=self._thread)
            except Exception as error:
                # for the streams to judge; the next look may succeed
                look.failure = error
            look.begun.set()

    async def next(self, job: str, prefix: str) -> News:
        """The state of a job after the next look.

        Raises
        ------
        UnknownJob, DatabaseUnavailable
        """
        look = self._next
        look.keys.add((job, prefix))
        look.call.set()
        await look.begun.wait()
        if look.failure is not None:
            raise look.failure
        if (job, prefix) not in look.news:
            raise UnknownJob(job)
        return look.news[job, prefix]

    def _news(
        self, keys: set[tuple[str, str]], before: Mapping[tuple[str, str], News]
    ) -> Mapping[tuple[str, str], News]:
        there = {job.id: job for job in self._jobs.by_ids({job for job, _ in keys})}
        result = {}
        for name, prefix in keys:
            job, old = there.get(name), before.get((name, prefix))
            if job is not None:
                unchanged = old is not None and old.job.version == job.version
                result[name, prefix] = old if old is not None and unchanged else news(self._jobs, job, prefix)
        return result


async def events(
    first: News, look: Callable[[], Awaitable[News]], last: int | None, closing: Callable[[], bool]
) -> AsyncIterator[bytes]:
    """The states of a job as it changes, until it has ended.

    Parameters
    ----------
    first : the job as it is now.
    look : waits for the next state.
    last : id of the last event that the client has seen; it is not sent again.
    closing : whether the service is about to stop.
    """
    yield b"retry: 2000\n\n"
    now, version, beat = first, last, time.monotonic()
    while not closing():
        if now.job.version != version:
            yield now.event
            version, beat = now.job.version, time.monotonic()
        elif time.monotonic() - beat > _HEARTBEAT_S:
            yield b": nothing new\n\n"
            beat = time.monotonic()
        if not now.job.active:
            return
        try:
            now = await look()
        except UnknownJob:
            return
        except DatabaseUnavailable:
            yield b": the job database does not answer\n\n"
            await sleep(_HEARTBEAT_S / 5)
