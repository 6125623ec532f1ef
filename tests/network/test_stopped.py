"""Processes that compute and are stopped, by a debugger or a container that is frozen in part."""

import asyncio
import json
import signal

from tests.network.serving import Reply, Service


async def _until(target: Service, status: int) -> Reply:
    async with asyncio.timeout(180):
        while (reply := await target.ask("GET", "/readyz")).status != status:
            await asyncio.sleep(0.1)
    return reply


def test_a_service_whose_workers_are_all_stopped_is_not_ready(target: Service) -> None:
    asyncio.run(_until(target, 200))
    workers = target.workers()
    assert workers
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
