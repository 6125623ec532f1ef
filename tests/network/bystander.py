"""Legal traffic that costs as much as it can, beside a client who only wants his answers.

``python -m tests.network.bystander`` prints, for each kind of traffic, what became of the bystander's requests and how
much memory the service took above rest. It fails if one of his was refused or the memory is over its limit. All clients
are on this machine: the bystander has an address of his own (127.0.0.2), those who press the service share another, or
four or six of them. Those are a process of their own, of low priority: what they compute is not what the service costs,
and other machines would compute it.
"""

import argparse
import asyncio
import json
import multiprocessing
import os
import sys
import time
from collections import Counter
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager, suppress
from dataclasses import dataclass, field
from functools import cache
from multiprocessing.synchronize import Event
from pathlib import Path
from random import Random
from typing import Any

import psutil

from schemas.request.requests import OptimizeRequest
from service.computations.computation import XLSX
from service.documents.examples import bodies
from service.workbook.answers import requested
from tests.network.load import start_sweep
from tests.network.serving import Service, read, request, service

#: most that all processes of the service may hold above rest [MB]; computations apart, which have a limit of their own
CEILING_MB = 150.0
_BYSTANDER = "127.0.0.2"
#: of those who press
_NICENESS = 10
_MB = 1e6
MACHINES = bodies()
ORDINARY = (
    request("POST", "/v1/optimize", json.dumps(MACHINES["w60"]).encode()),
    request("GET", "/healthz"),
    request("GET", "/readyz"),
    request("GET", "/v1/examples"),
    request("GET", "/v1/sweeps"),
)


@dataclass(frozen=True)
class Aim:
    """Whom to press: the port of a service, and the path of a sweep that runs there; from how many addresses."""

    port: int
    sweep: str
    addresses: int = 1

    def address(self, number: int) -> str:
        """That of a client."""
        return f"127.0.0.{3 + number % self.addresses}"


@dataclass
class Outcome:
    """What became of the bystander, by path [s], and what the service held above rest [MB].

    work_s : what the service computed, for him or others, from each of his questions to its answer; unlike his time it
        does not depend on what else the machine does.
    """

    statuses: Counter[int] = field(default_factory=Counter)
    seconds: dict[str, list[float]] = field(default_factory=dict)
    work_s: list[float] = field(default_factory=list)
    held_mb: float = 0.0

    @property
    def refused(self) -> int:
        """Requests of his that were not answered with what he asked for."""
        return self.statuses.total() - self.statuses[200]


@asynccontextmanager
async def connected(port: int, address: str) -> AsyncIterator[tuple[asyncio.StreamReader, asyncio.StreamWriter]]:
    """A connection from an address of this machine."""
    reader, writer = await asyncio.open_connection("127.0.0.1", port, local_addr=(address, 0))
    try:
        yield reader, writer
    finally:
        writer.transport.abort()


def largest(throws: int) -> bytes:
    """A machine with as many throws and webs as asked for, as large as is legal at 500."""
    body: dict[str, Any] = json.loads(json.dumps(MACHINES["2d12"]))
    machine = body["machine"]
    # one value for each row of the machine as it was
    del machine["friction"]["indicated_power_W"]
    throw, web = machine["throws"][0], machine["webs"][0]
    machine["throws"] = [
        {**throw, "name": str(k), "position_m": 0.1 * k, "crank_angle_deg": 7.0 * k, "rows": throw["rows"][:1]}
        for k in range(throws)
    ]
    machine["webs"] = [{**web, "name": f"w{k}", "position_m": 0.1 * k + 0.05} for k in range(throws)]
    return json.dumps(body).encode()


#: megabytes of torque
TORQUE = json.dumps(
    {"machine": MACHINES["2d12"]["machine"], "outputs": ["torque"], "angles": {"step_deg": 0.05}}
).encode()


def search(throws: int = 30) -> bytes:
    """Choices among castings that cannot be proven to be best within the longest time that may be asked for."""
    body: dict[str, Any] = json.loads(largest(throws))
    machine = body["machine"]
    random = Random(20261123)
    for number, (throw, web) in enumerate(zip(machine["throws"], machine["webs"], strict=True)):
        throw["crank_angle_deg"] = random.uniform(0, 360)
        web |= {"max_mass_kg": 50, "throw": number}
    machine["catalogue"] = {"masses_kg": sorted(random.uniform(5, 50) for _ in range(12)), "angle_step_deg": 10}
    body["accuracy"] = {"relative_gap": 1e-9, "time_limit_s": 30}
    return json.dumps(body).encode()


@cache
def book() -> bytes:
    """The largest machine as a workbook."""
    return requested(OptimizeRequest.model_validate_json(largest(500)), None)


Press = Callable[[Aim, int], Awaitable[None]]


async def again(target: Aim, number: int, content: bytes) -> None:
    """Asks for the same again and again, each time on a connection of its own."""
    while True:
        async with connected(target.port, target.address(number)) as (reader, writer):
            writer.write(content)
            with suppress(ConnectionError):
                await writer.drain()
            await read(reader)
        await asyncio.sleep(0.2)


async def stalled_body(target: Aim, number: int) -> None:
    """Announces a body, sends all of it but the end, and waits."""
    async with connected(target.port, target.address(number)) as (reader, writer):
        writer.write(request("POST", "/v1/optimize", headers={"Content-Length": "1000000"}) + b" " * 999_000)
        with suppress(ConnectionError):
            await writer.drain()
        await read(reader)


async def stopped_reader(target: Aim, number: int) -> None:
    """Asks for answers of megabytes, again and again on one connection, and reads nothing."""
    body = request("GET", "/openapi.json") if number % 4 else request("POST", "/v1/analyze", TORQUE)
    async with connected(target.port, target.address(number)) as (reader, writer):
        reader._transport.pause_reading()  # type: ignore[attr-defined]
        writer.write(body.replace(b"Connection: close", b"Connection: keep-alive") * 5)
        await asyncio.sleep(600)


async def largest_machine(target: Aim, number: int) -> None:
    """Asks for the optimum of a machine of hundreds of webs."""
    await again(target, number, request("POST", "/v1/optimize", largest(300)))


async def catalogue(target: Aim, number: int) -> None:
    """Asks for a search of half a minute."""
    await again(target, number, request("POST", "/v1/optimize", search()))


async def workbooks(target: Aim, number: int) -> None:
    """Sends the largest machine as a workbook, and asks for one."""
    await again(target, number, request("POST", "/v1/optimize", book(), {"Content-Type": XLSX, "Accept": XLSX}))


async def documents(target: Aim, number: int) -> None:
    """Asks for a document on the largest machine."""
    await again(target, number, request("POST", "/v1/report", largest(500), {"Accept": "application/pdf"}))


async def stream(target: Aim, number: int) -> None:
    """Watches a sweep."""
    async with connected(target.port, target.address(number)) as (reader, writer):
        writer.write(request("GET", f"{target.sweep}/events"))
        while await reader.read(1000):
            pass


async def silent(target: Aim, number: int) -> None:
    """Says nothing."""
    while True:
        async with connected(target.port, target.address(number)) as (reader, _):
            await reader.read()
        await asyncio.sleep(0.2)


async def state(target: Aim, number: int) -> None:
    """Asks for the state of a sweep, again and again."""
    while True:
        async with connected(target.port, target.address(number)) as (reader, writer):
            writer.write(request("GET", target.sweep))
            await read(reader)


PRESSES: dict[str, Press] = {
    "stalled bodies": stalled_body,
    "stopped readers": stopped_reader,
    "largest machines": largest_machine,
    "streams of events": stream,
    "silent connections": silent,
    "states of a sweep": state,
}

#: one from each address takes all that the service computes at a time, where it may
COSTLY: dict[str, Press] = {"catalogue": catalogue, "workbooks": workbooks, "PDF": documents}


async def mixed(target: Aim, number: int) -> None:
    """One of all, by chance."""
    await Random(number).choice(list(PRESSES.values()))(target, number)


def held_mb(target: Service) -> float:
    """Memory of the service itself [MB]: what clients make it hold; workers have limits of their own."""
    return psutil.Process(target.process.pid).memory_info().rss / _MB


def computed_s(target: Service) -> float:
    """Time for which the threads of the service itself have computed so far [s]."""
    nanoseconds = 0
    for thread in Path(f"/proc/{target.process.pid}/task").iterdir():
        # it may have ended
        with suppress(OSError):
            nanoseconds += int((thread / "schedstat").read_text().split()[0])
    return nanoseconds / 1e9


async def beside(target: Service, press: Press, clients: int, seconds: float, addresses: int = 1) -> Outcome:
    """What becomes of a bystander while so many clients, of so many addresses, press the service."""
    outcome = Outcome()
    rest = held_mb(target)

    async def watching() -> None:
        while True:
            outcome.held_mb = max(outcome.held_mb, await asyncio.to_thread(held_mb, target) - rest)
            await asyncio.sleep(0.1)

    watch = asyncio.create_task(watching())
    aim = Aim(target.port, target.sweep, addresses)  # type: ignore[attr-defined]
    spawn = multiprocessing.get_context("spawn")
    begun = spawn.Event()
    pressed = spawn.Process(target=_pressing, args=(aim, press, clients, begun), daemon=True)
    pressed.start()
    try:
        assert await asyncio.to_thread(begun.wait, 600)
        await asyncio.sleep(min(2.0, seconds / 2))
        end = time.monotonic() + seconds
        while time.monotonic() < end or not outcome.statuses:
            for content in ORDINARY:
                time_s, before_s = time.perf_counter(), computed_s(target)
                async with asyncio.timeout(600), connected(target.port, _BYSTANDER) as (reader, writer):
                    writer.write(content)
                    outcome.statuses[(await read(reader)).status] += 1
                outcome.work_s.append(computed_s(target) - before_s)
                outcome.seconds.setdefault(content.split(b" ", 2)[1].decode(), []).append(time.perf_counter() - time_s)
            await asyncio.sleep(0.05)
    finally:
        pressed.kill()
        pressed.join()
        watch.cancel()
        await asyncio.gather(watch, return_exceptions=True)
    return outcome


def _pressing(target: Aim, press: Press, clients: int, begun: Event) -> None:
    """So many clients, until they are killed."""
    os.nice(_NICENESS)
    begun.set()

    async def client(number: int) -> None:
        while True:
            with suppress(OSError):
                await press(target, number)
            await asyncio.sleep(0.5)

    async def every_weight() -> None:
        await asyncio.gather(*(client(number) for number in range(clients)))

    asyncio.run(every_weight())


def quantile_ms(seconds: list[float], share: float) -> float:
    """The time that a share of the answers took at most [ms]."""
    ordered = sorted(seconds)
    return 1000 * ordered[min(len(ordered) - 1, int(share * len(ordered)))]


def main() -> int:
    """Every kind of traffic, at full length unless told otherwise."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--clients", type=int, default=1000)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--only", help="kinds of traffic whose name begins so, besides none")
    arguments = parser.parse_args()
    failures, quiet, quiet_work = 0, 0.0, 0.0
    presses: dict[str, tuple[Press, int, int]] = {
        "nobody": (silent, 0, 1),
        **{name: (press, min(300, arguments.clients), 1) for name, press in PRESSES.items()},
        "a mix of all": (mixed, arguments.clients, 1),
        "a mix of four": (mixed, arguments.clients, 4),
        "a mix of six": (mixed, arguments.clients, 6),
        **{f"{name}, {n}": (press, n, n) for name, press in COSTLY.items() for n in (1, 4, 6)},
    }
    if arguments.only is not None:
        presses = {
            name: press for name, press in presses.items() if name == "nobody" or name.startswith(arguments.only)
        }
    with service(fresh=True, log_level="warning", rate_limit="") as target:
        target.sweep = asyncio.run(start_sweep(target))  # type: ignore[attr-defined]
        print(f"at rest: {held_mb(target):.0f} MB")
        for name, (press, clients, addresses) in presses.items():
            outcome = asyncio.run(beside(target, press, clients, arguments.seconds, addresses))
            together = [single_time for times in outcome.seconds.values() for single_time in times]
            p50, p99 = (quantile_ms(together, share) for share in (0.5, 0.99))
            work = quantile_ms(outcome.work_s, 0.99)
            quiet, quiet_work = quiet or p99, quiet_work or work
            print(
                f"{name:<20}{clients:>5} clients  bystander: {outcome.statuses.total():>5} requests, {outcome.refused} "
                f"refused, p50 {p50:6.1f} ms, p99 {p99:7.1f} ms, {p99 / quiet:5.1f} of quiet  work p99 {work:6.1f} ms, "
                f"{work / quiet_work:5.1f} of quiet  above rest: {outcome.held_mb:5.0f} MB",
                flush=True,
            )
            texts = (f"{path} {quantile_ms(times, 0.99):.0f}" for path, times in outcome.seconds.items())
            print(f"    p99 [ms]: {', '.join(texts)}", flush=True)
            failures += outcome.refused + (outcome.held_mb > CEILING_MB)
        faults = target.faults()
        asyncio.run(target.ask("DELETE", target.sweep))  # type: ignore[attr-defined]
    print(f"{failures} refused or over {CEILING_MB:g} MB, {len(faults)} faults logged", *faults, sep="\n")
    return 1 if failures or faults else 0


if __name__ == "__main__":
    sys.exit(main())
