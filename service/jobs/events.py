"""Progress as server-sent events: the last state first, then every change, and at last the end."""

import time
from collections.abc import AsyncIterator, Callable

from anyio import sleep, to_thread

from schemas.sweep import SweepState
from service.jobs.database import DatabaseUnavailable
from service.jobs.job import Job
from service.jobs.rows import UnknownJob

_POLL_S = 0.5
#: proxies close what is silent for longer
_HEARTBEAT_S = 15.0


async def events(
    read: Callable[[], Job], state: Callable[[Job], SweepState], last: int | None, closing: Callable[[], bool]
) -> AsyncIterator[bytes]:
    """The states of a job as it changes, until it has ended.

    Parameters
    ----------
    read : the job as it is now.
    state : what is told about it.
    last : id of the last event that the client has seen; it is not told again.
    closing : whether the service is about to stop.
    """
    yield b"retry: 2000\n\n"
    told, heard = last, time.monotonic()

    def look() -> tuple[Job, SweepState | None]:
        job = read()
        return job, None if job.version == told else state(job)

    while not closing():
        try:
            job, news = await to_thread.run_sync(look)
        except UnknownJob:
            return
        except DatabaseUnavailable:
            yield b": the job database does not answer\n\n"
            await sleep(_HEARTBEAT_S / 5)
            continue
        if news is not None:
            name = "progress" if job.active else "end"
            yield f"id: {job.version}\nevent: {name}\ndata: {news.model_dump_json()}\n\n".encode()
            told, heard = job.version, time.monotonic()
        elif time.monotonic() - heard > _HEARTBEAT_S:
            yield b": nothing new\n\n"
            heard = time.monotonic()
        if not job.active:
            return
        await sleep(_POLL_S)
