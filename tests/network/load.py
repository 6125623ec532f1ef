"""64 clients at once for two minutes, alone and while a sweep runs, and a worker that is killed.

``python -m tests.network.load`` prints the times of the answers [ms] and fails if one of them is an error; the times
are for the reader to judge, as they are those of the machine too.
"""

import argparse
import asyncio
import json
import sys
import time
from collections import Counter
from contextlib import suppress
from dataclasses import dataclass, field
from random import Random

import psutil

from service.documents.examples import bodies
from tests.network.serving import Service, read, request, service

MACHINES = bodies()
#: route, body, and how often it is asked
MIX: tuple[tuple[str, str, bytes, int], ...] = (
    ("POST", "/v1/optimize", json.dumps(MACHINES["2d12"]).encode(), 6),
    ("POST", "/v1/analyze", json.dumps({"machine": MACHINES["2d12"]["machine"], "outputs": ["stages"]}).encode(), 3),
    ("GET", "/v1/examples", b"", 1),
)


@dataclass
class Times:
    """Times of answers by path [s], and their statuses."""

    seconds: dict[str, list[float]] = field(default_factory=dict)
    statuses: Counter[int] = field(default_factory=Counter)

    def add(self, path: str, seconds: float, status: int) -> None:
        self.seconds.setdefault(path, []).append(seconds)
        self.statuses[status] += 1

    def quantile(self, path: str, share: float) -> float:
        """The time that a share of the answers took at most [ms]."""
        ordered = sorted(self.seconds[path])
        return 1000 * ordered[min(len(ordered) - 1, int(share * len(ordered)))]


async def load(target: Service, clients: int, seconds: float) -> Times:
    """Clients that ask one thing after the other, each on its connection, and one that asks for the health."""
    times = Times()
    end = time.monotonic() + seconds
    choices = [(method, path, body) for method, path, body, share in MIX for _ in range(share)]

    async def client(number: int) -> None:
        random = Random(number)
        async with target.connection() as (reader, writer):
            while time.monotonic() < end:
                method, path, body = random.choice(choices)
                writer.write(request(method, path, body, {"Connection": "keep-alive"}))
                begun = time.perf_counter()
                reply = await read(reader)
                times.add(path, time.perf_counter() - begun, reply.status)

    async def probe() -> None:
        while time.monotonic() < end:
            begun = time.perf_counter()
            reply = await target.ask("GET", "/healthz")
            times.add("/healthz", time.perf_counter() - begun, reply.status)
            await asyncio.sleep(0.1)

    await asyncio.gather(probe(), *(client(number) for number in range(clients)))
    return times


async def start_sweep(target: Service) -> str:
    """A sweep that takes longer than any test; its path."""
    path = "/machine/throws/0/rows/0/reciprocating_mass_kg"
    text = "/machine/throws/1/rows/0/reciprocating_mass_kg"
    axes = [{"path": text, "start": 100, "stop": 300, "count": 3000} for text in (path, text)]
    body = json.dumps({"base": MACHINES["2d12"], "axes": axes, "design": "grid"}).encode()
    reply = await target.ask("POST", "/v1/sweeps", body)
    assert reply.status == 202, reply.body
    return reply.headers["location"]


async def killed(target: Service) -> float:
    """Kill every worker in the middle of its work; seconds until all that was asked is answered, and without an error.

    A worker that dies is replaced and its work is done once more, so that no client is told.
    """
    tasks = [asyncio.create_task(target.ask("POST", "/v1/optimize", MIX[0][2])) for _ in range(8)]
    await asyncio.sleep(0.005)
    begun = time.perf_counter()
    for worker in target.workers():
        with suppress(psutil.NoSuchProcess):
            worker.kill()
    replies = [*await asyncio.gather(*tasks), await target.ask("POST", "/v1/optimize", MIX[0][2])]
    statuses = [reply.status for reply in replies]
    assert set(statuses) == {200}, statuses
    return time.perf_counter() - begun


def _show(title: str, times: Times, seconds: float) -> int:
    print(f"{title}: {times.statuses.total() / seconds:.0f} answers a second, {dict(times.statuses)}")
    for path in sorted(times.seconds):
        p50, p99, slowest = (times.quantile(path, share) for share in (0.5, 0.99, 1.0))
        count = len(times.seconds[path])
        print(f"    {path:<16}{count:>7} answers, p50 {p50:7.1f} ms, p99 {p99:7.1f} ms, slowest {slowest:7.1f} ms")
    return times.statuses.total() - times.statuses[200]


def main() -> int:
    """Everything, at full length unless told otherwise."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--clients", type=int, default=64)
    parser.add_argument("--seconds", type=float, default=120.0)
    arguments = parser.parse_args()
    with service(fresh=True, log_level="warning") as target:
        errors = _show("alone", asyncio.run(load(target, arguments.clients, arguments.seconds)), arguments.seconds)
        sweep = asyncio.run(start_sweep(target))
        errors += _show(
            "with a sweep", asyncio.run(load(target, arguments.clients, arguments.seconds)), arguments.seconds
        )
        count = json.loads(asyncio.run(target.ask("GET", sweep)).body)["done"]
        asyncio.run(target.ask("DELETE", sweep))
        print(f"    {count} designs of the sweep meanwhile")
        times = [asyncio.run(killed(target)) for _ in range(10)]
        print(f"workers killed 10 times: answered again within {1000 * max(times):.0f} ms")
        own, worker = target.memory_mb()
        print(f"memory: service {own:.0f} MB, largest worker {worker:.0f} MB")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
