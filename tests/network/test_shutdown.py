"""SIGTERM: what runs is finished or parked within the grace time, and nothing is left behind."""

import asyncio
import json
import signal
from collections.abc import Iterator

import psutil
import pytest

from service.documents.examples import load
from tests.network.load import killed, start_sweep
from tests.network.serving import Reply, Service, read, request, service

#: work for longer than the grace time
LONG = json.dumps({"machine": json.loads(load("2d12"))["machine"], "repeats": 20}).encode()
GRACE_S = 3


@pytest.fixture
def ending() -> Iterator[Service]:
    with service(graceful_shutdown_s=GRACE_S) as server:
        yield server


async def end(target: Service) -> None:
    target.process.send_signal(signal.SIGTERM)
    await asyncio.to_thread(target.process.wait, 180)


def test_requests_are_finished_streams_are_ended_sweeps_are_parked(ending: Service) -> None:
    family = psutil.Process(ending.process.pid).children(recursive=True)

    async def everything() -> tuple[Reply, bytes]:
        sweep = await start_sweep(ending)
        async with ending.connection() as (events, writer):
            writer.write(request("GET", f"{sweep}/events"))
            await events.readuntil(b"event: progress")
            async with ending.connection() as (answers, asking):
                body = load("w60")
                asking.write(request("POST", "/v1/optimize", body, {"Expect": "100-continue"}).removesuffix(body))
                # it has begun when it asks for the body
                await answers.readuntil(b"100 Continue\r\n\r\n")
                family.extend(psutil.Process(ending.process.pid).children(recursive=True))
                ended = asyncio.create_task(end(ending))
                asking.write(body)
                quick = await read(answers)
            await ended
            return quick, await events.read()

    quick, rest = asyncio.run(everything())
    assert quick.status == 200
    assert rest.endswith(b"0\r\n\r\n")
    gone, alive = psutil.wait_procs(family, timeout=180)
    assert gone
    # whose parent has ended may stay unburied where the first process of a container buries nobody
    assert [process for process in alive if process.is_running() and process.status() != psutil.STATUS_ZOMBIE] == []


def test_work_that_does_not_end_is_answered_503_in_time(ending: Service) -> None:
    async def everything() -> Reply:
        async with ending.connection() as (reader, writer):
            writer.write(request("POST", "/v1/accuracy", LONG))
            await ending.computing(1)
            stopping = asyncio.create_task(end(ending))
            reply = await read(reader)
            await stopping
            return reply

    response = asyncio.run(everything())
    assert (response.status, json.loads(response.body)["title"]) == (503, "Workers failed")
    assert int(response.headers["retry-after"]) > 0
    assert ending.faults() == []


def test_a_worker_that_is_killed_is_replaced(target: Service) -> None:
    # within a second: python -m tests.network.load
    for _ in range(3):
        asyncio.run(killed(target))
