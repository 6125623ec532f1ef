"""How long the chunks of a service that is killed wait for another one.

Two services with the settings that they have by default share a folder and a database. One of them is ended by SIGKILL
while it has some of the last chunks of a sweep, again and again, in turn. The time is over when each of them is another
one's, or done.

``python -m tests.jobs.failover --kills 10`` uses a PostgreSQL server, with ``--sqlite`` a file.
"""

import argparse
import json
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path

from sqlalchemy import select

from service.jobs.tables import chunks
from service.settings import Settings
from tests.jobs import postgres
from tests.jobs.history import database
from tests.jobs.house import House
from tests.jobs.process import Service
from tests.jobs.sweeps import analyses

#: a sweep of few chunks, which take so long at least [s]
BODY, CHUNK_S = analyses(10, 20), 1.0
#: most that is waited for a service to have a chunk, or to lose it [s]
PATIENCE_S = 300.0
#: what was asked of a failover [s]
MOST_S = 15.0

Chunks = dict[tuple[str, int], str]


class Leases:
    """Who has which chunks, as the database knows it."""

    def __init__(self, house: House, submit: Callable[[], object]) -> None:
        self._house, self._submit = house, submit

    def now(self) -> Chunks:
        """Owners of the chunks that are in work, by job and first row."""
        leased = select(chunks.c.job, chunks.c.start, chunks.c.lease_owner).where(chunks.c.state == "leased")
        with self._house.database.read() as connection:
            return {(job, start): owner for job, start, owner in connection.execute(leased)}

    def until(self, function: Callable[[str], bool]) -> str:
        """An owner that is one of those, once it has a chunk; there is something to do until then."""
        until = time.monotonic() + PATIENCE_S
        while not (texts := {*filter(function, owners := {*self.now().values()})}):
            assert time.monotonic() < until, "a service takes no chunk"
            if not owners:
                self._submit()
            time.sleep(0.02)
        (owner,) = texts
        return owner

    def until_lost(self, owner: str) -> float:
        """Seconds until an owner has none any more."""
        since = time.monotonic()
        while owner in self.now().values():
            assert time.monotonic() < since + PATIENCE_S, "nobody takes the chunks of a service that is gone"
            time.sleep(0.02)
        return time.monotonic() - since


def failovers(folder: Path, kills: int, sqlite: bool = False, lease_s: float | None = None) -> list[float]:
    """Seconds from each kill until the chunks are another one's.

    Raises
    ------
    postgres.Missing
    """
    with ExitStack() as stack:
        where, settings, _ = stack.enter_context(database(folder, sqlite))
        settings |= {"lease_s": str(Settings().lease_s if lease_s is None else lease_s), "rate_limit": ""}

        def begin() -> Service:
            return Service(folder, CHUNK_S, sweep_workers="1", **settings)

        house = House(folder, where)
        stack.callback(house.database.close)
        services, owners = list[Service](), list[str]()
        leases = Leases(house, lambda: services[-1].send("POST", "/v1/sweeps", BODY))
        stack.callback(lambda: [service.kill() for service in services])
        for _ in range(2):
            services.append(begin())
            services[-1].wait()
            owners.append(leases.until(lambda owner: owner not in owners))
        values = []
        for _ in range(kills):
            # the last one submits
            services.append(services.pop(0))
            owners.append(gone := owners.pop(0))
            leases.until(lambda owner, gone=gone: owner == gone)  # type: ignore[misc]
            services.pop().kill()
            values.append(leases.until_lost(gone))
            services.append(begin())
            services[-1].wait()
            owners[-1] = leases.until(lambda owner: owner not in owners)
        return values


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=10)
    parser.add_argument("--sqlite", action="store_true")
    arguments = parser.parse_args()
    try:
        with tempfile.TemporaryDirectory() as folder:
            actual_failovers = sorted(failovers(Path(folder), arguments.kills, arguments.sqlite))
    except postgres.Missing as missing:
        print(missing, file=sys.stderr)
        sys.exit(2)
    lease_s, middle = Settings().lease_s, actual_failovers[len(actual_failovers) // 2]
    print(
        json.dumps(
            {
                "kills": len(actual_failovers),
                "lease_s": lease_s,
                "median_s": round(middle, 1),
                "most_s": round(actual_failovers[-1], 1),
            }
        )
    )
    sys.exit(1 if actual_failovers[-1] > MOST_S else 0)


if __name__ == "__main__":
    main()
