"""What large answers took of memory is given back when their clients have gone."""

import asyncio
import json
from contextlib import AsyncExitStack

import anyio
import pytest

from service.documents.examples import load
from service.watch import memory
from tests.network.bystander import connected
from tests.network.serving import Service, request, service

_FORMATS = ("ndjson", "csv", "parquet", "arrow", "xlsx")
#: streams, of so many addresses; rows of the sweep
_STREAMS, _ADDRESSES, _ROWS = 24, 4, 40_000
#: above rest, measured: 21 MB; without giving back 70 MB stay [MB]
_ABOVE_MB = 40.0


async def _swept(target: Service) -> str:
    axes = [{"path": "/machine/speed_rpm", "start": 300, "stop": 900, "count": _ROWS}]
    body = json.dumps({"base": json.loads(load("2d12")), "axes": axes}).encode()
    path = (await target.ask("POST", "/v1/sweeps", body)).headers["location"]
    async with asyncio.timeout(600):
        while json.loads((await target.ask("GET", path)).body)["state"] != "done":
            await asyncio.sleep(0.2)
    return path


async def _stopped_readers(target: Service, path: str, least_mb: float) -> None:
    """Clients who have begun to read rows, and read no more, until the service holds so much."""
    async with AsyncExitStack() as every_weight:
        for number in range(_STREAMS):
            address = f"127.0.0.{2 + number % _ADDRESSES}"
            reader, writer = await every_weight.enter_async_context(connected(target.port, address))
            writer.write(request("GET", f"{path}/results?format={_FORMATS[number % len(_FORMATS)]}"))
            await reader.readexactly(100_000)
            writer.transport.pause_reading()
        async with asyncio.timeout(180):
            while target.memory_mb()[0] <= least_mb:
                await asyncio.sleep(0.1)


async def _wait_for_memory(target: Service, rest_mb: float) -> None:
    async with asyncio.timeout(180):
        while target.memory_mb()[0] > rest_mb + _ABOVE_MB:
            await asyncio.sleep(0.5)


@pytest.mark.nightly
def test_memory_of_stopped_readers_is_given_back() -> None:
    with service(fresh=True) as target:
        path = asyncio.run(_swept(target))
        rest_mb = target.memory_mb()[0]
        for _ in range(3):
            asyncio.run(_stopped_readers(target, path, rest_mb + _ABOVE_MB))
            asyncio.run(_wait_for_memory(target, rest_mb))


class _Clock:
    """Time that passes in sleeps alone, of which a share is computed."""

    def __init__(self, shares: list[float]) -> None:
        self._shares, self._now, self._computed = shares, 0.0, 0.0

    def monotonic(self) -> float:
        return self._now

    def process_time(self) -> float:
        return self._computed

    async def sleep(self, seconds: float) -> None:
        self._now += seconds
        self._computed += seconds * (self._shares.pop(0) if len(self._shares) > 1 else self._shares[0])


@pytest.mark.parametrize(
    ("shares", "seconds"),
    [([0.0], 1.0), ([0.9, 0.5, 0.3, 0.1], 4.0), ([0.9], 300.0)],
    ids=["calm", "calm after a while", "never calm"],
)
def test_it_waits_for_a_calm_moment_but_not_for_ever(
    shares: list[float], seconds: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    clock = _Clock(shares)
    monkeypatch.setattr(memory, "time", clock)
    monkeypatch.setattr(memory, "sleep", clock.sleep)
    anyio.run(memory._calm)
    assert clock.monotonic() == seconds
