"""Processes that compute and are stopped, by a debugger or a container that is frozen in part."""

import asyncio
import json
import signal

import psutil

from service.fairness.table import shares
from service.settings import Settings
from tests.network.serving import Reply, Service, service


async def _until(target: Service, status: int) -> Reply:
    async with asyncio.timeout(180):
        while (reply := await target.ask("GET", "/readyz")).status != status:
            await asyncio.sleep(0.1)
    return reply


def test_a_service_whose_workers_are_all_stopped_is_not_ready() -> None:
    # one of its own: after other tests processes may be starting, which nobody would wait for
    with service(concurrent_solves=1, log_level="warning") as target:
        asyncio.run(_until(target, 200))
        workers = target.workers()
        # a short one, those above, a long one
        assert len(workers) == 1 + shares(Settings())["short"].reserve + 1
        _stopped(target, workers)


def _stopped(target: Service, workers: list[psutil.Process]) -> None:
    try:
        for worker in workers:
            worker.suspend()
        reply = asyncio.run(_until(target, 503))
        assert asyncio.run(target.ask("GET", "/healthz")).status == 200
    finally:
        for worker in workers:
            worker.send_signal(signal.SIGCONT)
    assert json.loads(reply.body)["detail"] == "All processes that compute have been stopped."
    assert "retry-after" in reply.headers
    asyncio.run(_until(target, 200))
