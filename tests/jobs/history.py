"""Kill services and their database at random moments, and prove from what clients were told that nothing went wrong.

Three services share a folder and a database, a PostgreSQL server or a file of SQLite. Clients submit, look, read,
cancel, resume and delete, and write down every answer. Meanwhile services, and the server with all of its processes,
are ended by SIGKILL and started again, and the network before each service delays, drops and duplicates
(:mod:`tests.jobs.wire`). Then every sweep is computed to its end, and :mod:`tests.jobs.judge` looks for answers that
contradict each other.

``python -m tests.jobs.history --kills 300`` kills as often as wanted, with ``--sqlite`` in a file; the tests kill a few
times.
"""

import argparse
import json
import random
import sys
import tempfile
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Protocol

from tests.jobs import postgres
from tests.jobs.calls import Call, Client
from tests.jobs.house import House
from tests.jobs.judge import contradictions
from tests.jobs.process import Service
from tests.jobs.serving import TIDY
from tests.jobs.wire import Wire

CLIENTS = 3
#: how long a chunk takes at least [s]
CHUNK_S = 0.1
#: how long sweeps may take to their end when all is well again, on a machine that is busy [s]
PATIENCE_S = 600.0


class Mortal(Protocol):
    """Something that can be killed, and started again."""

    def kill(self) -> None: ...

    def start(self) -> None: ...

    def wait(self) -> None: ...


class Replica:
    """A service that is started anew after each end."""

    def __init__(self, begin: Callable[[], Service]) -> None:
        self._begin = begin
        #: that listens
        self.living: Service | None = None
        self.start()
        self.wait()

    def start(self) -> None:
        self._service = self._begin()

    def wait(self) -> None:
        self.living = self._service.wait()

    def where(self) -> tuple[str, int] | None:
        """Where it listens; None while it does not."""
        living = self.living
        return None if living is None else living.where

    def kill(self) -> None:
        self.living = None
        self._service.kill()

    def end(self) -> None:
        self._service.process.terminate()
        self._service.close()


class Database:
    """A server that is started anew after each end."""

    def __init__(self, server: postgres.Server) -> None:
        self.kill, self.start = server.kill, server.start

    def wait(self) -> None:
        """It takes connections when it has been started."""


class Killings:
    """So many kills, of any of some mortals, and when those were away."""

    def __init__(self, kills: int, mortals: dict[str, Mortal], chance: random.Random) -> None:
        self.outages: dict[str, list[tuple[float, float]]] = {name: [] for name in mortals}
        self.counts: Counter[str] = Counter()
        self._left, self._mortals, self._lock = kills, mortals, threading.Lock()
        self._chances = {name: random.Random(chance.random()) for name in mortals}

    def _next(self, name: str) -> bool:
        with self._lock:
            if self._left == 0:
                return False
            self._left -= 1
            self.counts[name] += 1
            return True

    def run(self, name: str) -> None:
        """Kill one of them again and again, now and then while it starts."""
        mortal, chance = self._mortals[name], self._chances[name]
        while self._next(name):
            # a server starts ten times as fast
            time.sleep(chance.uniform(0.2, 9.0 if name == "database" else 3.0))
            since = time.monotonic()
            mortal.kill()
            while name != "database" and chance.random() < 0.2 and self._next(name):
                mortal.start()
                time.sleep(chance.uniform(0.0, 3.0))
                mortal.kill()
            time.sleep(chance.uniform(0.0, 1.0))
            mortal.start()
            mortal.wait()
            self.outages[name].append((since, time.monotonic()))


@contextmanager
def database(folder: Path, sqlite: bool) -> Iterator[tuple[str | Path, dict[str, str], dict[str, Mortal]]]:
    """Where the jobs are, what services are told of it, and what of it can be killed.

    Raises
    ------
    postgres.Missing
    """
    if sqlite:
        yield folder / "jobs.sqlite", {}, {}
    else:
        with postgres.server() as server:
            yield server.url, {"database_url": server.url}, {"database": Database(server)}


def run(
    folder: Path, kills: int, seed: int, sqlite: bool = False, most: int = 40
) -> tuple[list[str], dict[str, object]]:
    """Kill so often: what contradicts itself, and what was done.

    Parameters
    ----------
    most : sweeps that there are at a time.

    Raises
    ------
    postgres.Missing
    """
    chance = random.Random(seed)
    messages = folder / "tmp"
    messages.mkdir()
    with ExitStack() as stack:
        where, settings, mortals = stack.enter_context(database(folder, sqlite))
        environment = {"TMPDIR": str(messages), TIDY: "1"}
        # a machine that is busy is no database that is away
        settings |= {"database_busy_s": "60", "rate_limit": ""}

        def begin() -> Service:
            return Service(folder, CHUNK_S, environment, sweep_workers="1", **settings)

        replicas = {name: Replica(begin) for name in ("one", "two", "three")}
        for replica in replicas.values():
            stack.callback(replica.end)
        wires = {name: Wire(replica.where, chance.random()) for name, replica in replicas.items()}
        for wire in wires.values():
            stack.callback(wire.close)
        killings = Killings(kills, {**mortals, **replicas}, chance)
        clients = _clients(
            lambda: {name: it.living for name, it in replicas.items() if it.living is not None}, wires, chance, most
        )
        _call_while_killed(clients, killings)
        for wire in wires.values():
            wire.calm()
        finish = _finish(clients[0], clients)
        finish += contradictions(clients[0].calls, killings.outages)
        finish += _leftovers(House(folder, where), clients[0])
    finish += [f"messages of nobody: {left.name}" for left in messages.glob("*/lock")]
    return finish, _summary(clients[0], killings, wires)


def _clients(
    services: Callable[[], dict[str, Service]], wires: dict[str, Wire], chance: random.Random, most: int
) -> list[Client]:
    calls: list[Call] = []
    fields, gone = {}, set()
    return [
        Client(f"client-{number}", services, wires, random.Random(chance.random()), calls, fields, gone, most)
        for number in range(CLIENTS)
    ]


def _call_while_killed(clients: list[Client], killings: Killings) -> None:
    over = threading.Event()

    def call(client: Client) -> None:
        while not over.is_set():
            client.something()
            time.sleep(client.chance.uniform(0.0, 0.2))

    with ThreadPoolExecutor(len(clients) + len(killings.outages)) as threads:
        callers = [threads.submit(call, client) for client in clients]
        try:
            for killer in [threads.submit(killings.run, name) for name in killings.outages]:
                killer.result()
        finally:
            over.set()
        for caller in callers:
            caller.result()


def _finish(client: Client, clients: list[Client]) -> list[str]:
    """Have everything answered that was asked, and computed to its end; what does not come to one."""
    until = time.monotonic() + PATIENCE_S
    for browser in clients:
        while browser.open:
            browser.submit()
    # and a new one, as if nothing had happened
    client.submit()
    there = [job for job in client.sweeps if job not in client.gone]
    for job in there:
        client.resume(job)
    for job in there:
        while job not in client.gone and (client.state(job).document or {})["state"] != "done":
            if time.monotonic() > until:
                return [f"{job}: does not come to an end"]
            time.sleep(0.2)
        if job not in client.gone:
            client.rows(job)
            client.table(job)
    client.all()
    return []


def _leftovers(house: House, client: Client) -> list[str]:
    """Files that are not those of a sweep that there is, once services have had the time to tidy up."""
    until = time.monotonic() + PATIENCE_S
    try:
        while left := _files_of_nobody(house):
            if time.monotonic() > until:
                return [f"file of nobody: {name}" for name in left]
            time.sleep(0.5)
        jobs = house.retention.job_ids()
    finally:
        house.database.close()
    return [f"{job}: the database knows it alone" for job in jobs - (client.sweeps.keys() - client.gone)]


def _files_of_nobody(house: House) -> list[str]:
    jobs = house.retention.job_ids()
    left = [f"folder {job}" for job in set(house.files.folders()) - jobs]
    for job in jobs:
        expected = {house.files.piece(job, record).name for record in house.store.pieces(job)}
        selection = house.store.selection(job)
        expected |= set() if selection is None else {house.files.piece(job, selection).name}
        left += [f"{job}/{name}" for name in set(house.files.names(job)) - expected - {"stop"}]
    return left


def _summary(client: Client, killings: Killings, wires: dict[str, Wire]) -> dict[str, object]:
    calls = client.calls
    away = sum(until - since for times in killings.outages.values() for since, until in times)
    network = sum((wire.counts for wire in wires.values()), Counter[str]())
    return {
        "faults": killings.counts.total() + network.total(),
        "kills": dict(killings.counts),
        "network": dict(network),
        "away_s": round(away, 1),
        "sweeps": len(client.sweeps),
        "deleted": len(client.gone),
        "rows_read": sum(len(call.rows) for call in calls),
        "calls": dict(Counter(call.action for call in calls)),
        "answers": dict(Counter(str(call.status) for call in calls)),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--sqlite", action="store_true")
    began, arguments = time.monotonic(), parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        texts, fields = run(Path(folder), arguments.kills, arguments.seed, arguments.sqlite)
    print(json.dumps({**fields, "contradictions": len(texts), "s": round(time.monotonic() - began)}))
    for text in texts:
        print(text, file=sys.stderr)
    sys.exit(1 if texts else 0)


if __name__ == "__main__":
    main()
