"""What a client waits for, and what an answer costs, on the wire: ``python -m tests.benchmarks.wire``.

Kept and new connections, few and many clients; beside it, in the same run, the bare framework that answers with the
bytes it was sent. The clients run on the same cores.
"""

import argparse
import asyncio
import json
import re
import socket
import statistics
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field

import psutil
from rich.console import Console
from rich.table import Table

from service.documents.examples import bodies
from tests.benchmarks.exchange import Exchange
from tests.commands import ROOT
from tests.network.serving import request, service

BODY = json.dumps(bodies()["2d12"]).encode()
CLIENTS = (1, 4, 16, 64)
_WITHIN_S = 600
#: time of the optimum in an answer [ms]
_OPTIMUM = re.compile(rb'"total_ms":([0-9.e+-]+)')


@dataclass(frozen=True)
class Target:
    """Who is asked, and what.

    pid : of the process that holds the connections; what it has started computes.
    """

    name: str
    pid: int
    port: int
    path: str

    def cpu_s(self) -> tuple[float, float]:
        """CPU time so far of the process itself, and of all that it has started [s]."""
        front = psutil.Process(self.pid)
        total = 0.0
        for child in front.children(recursive=True):
            # it may have just ended
            with suppress(psutil.NoSuchProcess):
                total += sum(child.cpu_times()[:2])
        return sum(front.cpu_times()[:2]), total


@dataclass
class Timings:
    """Answers of one run, what they took [s], and what they cost clients, front and workers [s of CPU]."""

    seconds: list[float] = field(default_factory=list)
    optima_ms: list[float] = field(default_factory=list)
    wall_s: float = 0.0
    clients_s: float = 0.0
    front_s: float = 0.0
    workers_s: float = 0.0

    def quantile_ms(self, share: float) -> float:
        """What a share of the answers took at most."""
        ordered = sorted(self.seconds)
        return 1e3 * ordered[min(len(ordered) - 1, int(share * len(ordered)))]

    @property
    def per_second(self) -> float:
        return len(self.seconds) / self.wall_s

    def answer_ms(self, seconds: float) -> float:
        """So much of the whole for each answer."""
        return 1e3 * seconds / len(self.seconds)


async def client_timings(target: Target, clients: int, lasting: bool, seconds: float) -> Timings:
    """Clients that ask for the same again and again, each on one connection or each time on a new one.

    Raises
    ------
    AssertionError
        if anything but 200 comes.
    """
    timings = Timings()
    raw = request("POST", target.path, BODY, {"Connection": "keep-alive" if lasting else "close"})
    begun, own, before = time.perf_counter(), time.process_time(), target.cpu_s()
    end = begun + seconds

    loop = asyncio.get_running_loop()

    async def client() -> None:
        _, connection = await loop.create_connection(Exchange, "127.0.0.1", target.port)
        while True:
            at = time.perf_counter()
            if not lasting:
                connection.close()
                _, connection = await loop.create_connection(Exchange, "127.0.0.1", target.port)
            body = await connection.reply(raw)
            timings.seconds.append(time.perf_counter() - at)
            if (optimum := _OPTIMUM.search(body)) is not None:
                timings.optima_ms.append(float(optimum[1]))
            if time.perf_counter() > end:
                connection.close()
                return

    async with asyncio.timeout(seconds + _WITHIN_S):
        await asyncio.gather(*(client() for _ in range(clients)))
    timings.wall_s, timings.clients_s = time.perf_counter() - begun, time.process_time() - own
    after = target.cpu_s()
    timings.front_s, timings.workers_s = (now - then for now, then in zip(after, before, strict=True))
    return timings


@contextmanager
def echoing() -> Iterator[Target]:
    """The bare framework."""
    with socket.create_server(("127.0.0.1", 0)) as listening:
        # of a socket that is handed over asyncio sets nothing: heads and bodies would wait 40 ms for one another
        listening.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        command = [sys.executable, "-m", "uvicorn", "tests.benchmarks.echo:app", "--log-level", "warning"]
        process = subprocess.Popen([*command, "--fd", str(listening.fileno())], cwd=ROOT, pass_fds=[listening.fileno()])
        try:
            yield Target("echo", process.pid, listening.getsockname()[1], "/echo")
        finally:
            process.terminate()
            process.wait(180)


def measure(clients: Sequence[int], seconds: float) -> Iterator[tuple[Target, int, bool, Timings]]:
    """Every number of clients on kept and on new connections; service and echo take turns."""
    with service(fresh=True, log_level="warning", rate_limit="") as running, echoing() as echo:
        ours = Target("service", running.process.pid, running.port, "/v1/optimize")
        for target in (ours, echo):
            asyncio.run(client_timings(target, 2, lasting=True, seconds=min(1.0, seconds)))
        for count in clients:
            for lasting in (True, False):
                for target in (ours, echo):
                    yield target, count, lasting, asyncio.run(client_timings(target, count, lasting, seconds))


def show(console: Console, clients: Sequence[int], seconds: float) -> None:
    """The table, and how kept connections compare with new ones."""
    table = Table(title=f"POST /v1/optimize of the 2D12 on the wire, {seconds:g} s each; milliseconds, CPU an answer")
    for heading in (
        "",
        "clients",
        "connections",
        "answers/s",
        "p50",
        "p99",
        "p99/p50",
        "client",
        "front",
        "workers",
        "optimum",
    ):
        table.add_column(heading, justify="left" if heading in ("", "connections") else "right")
    p50s: dict[tuple[str, int], float] = {}
    ratios = []
    for target, count, lasting, timings in measure(clients, seconds):
        p50, p99 = timings.quantile_ms(0.5), timings.quantile_ms(0.99)
        if lasting:
            p50s[target.name, count] = p50
        elif target.name == "service":
            ratios.append(f"{count}: {p50s[target.name, count] / p50:.2f}")
        optimum = f"{statistics.median(timings.optima_ms):.2f}" if timings.optima_ms else ""
        table.add_row(
            target.name,
            str(count),
            "kept" if lasting else "new",
            f"{timings.per_second:.0f}",
            *(f"{latency:.2f}" for latency in (p50, p99, p99 / p50)),
            *(f"{timings.answer_ms(s):.2f}" for s in (timings.clients_s, timings.front_s, timings.workers_s)),
            optimum,
        )
    console.print(table)
    console.print(f"median on kept connections over that on new ones, by clients: {', '.join(ratios)}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=5.0, help="for every number of clients and kind of connection")
    show(Console(width=120), CLIENTS, parser.parse_args().seconds)


if __name__ == "__main__":
    main()
