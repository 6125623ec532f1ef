"""How long the chunks of a service that is killed wait for another one.

Two services with the settings that they have by default share a folder and a database. One of them is ended by SIGKILL
in the middle of its chunks, again and again, in turn. Its time is over when each chunk that it had is another one's, or
done.

``python -m tests.jobs.failover --kills 10`` uses a PostgreSQL server, with ``--sqlite`` a file.
"""

import argparse
import json
import sys
import tempfile
import time
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

#: a sweep that outlives the kills, of chunks that take so long at least [s]
BODY, CHUNK_S = analyses(500, 1000), 0.5
#: most that is waited for a service to have a chunk, or to lose it [s]
PATIENCE_S = 300.0
#: what was asked of a failover [s]
MOST_S = 15.0

Chunks = dict[tuple[str, int], str]


class Leases:
    """Who has which chunks, as the database knows it."""

    def __init__(self, house: House) -> None:
        self._house = house

    def now(self) -> Chunks:
        """Owners of the chunks that are in work, by job and first row."""
        leased = select(chunks.c.job, chunks.c.start, chunks.c.lease_owner).where(chunks.c.state == "leased")
        with self._house.database.read() as connection:
            return {(job, start): owner for job, start, owner in connection.execute(leased)}

    def stranger(self, known: set[str]) -> str:
        """An owner that is not known, once it has a chunk."""
        until = time.monotonic() + PATIENCE_S
        while not (owners := {*self.now().values()} - known):
            assert time.monotonic() < until, "a service takes no chunk"
            time.sleep(0.05)
        (owner,) = owners
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
        leases, owners = Leases(house), list[str]()
        services: list[Service] = []
        stack.callback(lambda: [each.kill() for each in services])
        for _ in range(2):
            services.append(begin())
            services[-1].wait()
            if not owners:
                services[0].send("POST", "/v1/sweeps", BODY)
            owners.append(leases.stranger({*owners}))
        found = []
        for number in range(kills):
            which, gone = number % 2, owners[number % 2]
            # it has one chunk or the other nearly always
            while gone not in leases.now().values():
                time.sleep(0.02)
            services[which].kill()
            found.append(leases.until_lost(gone))
            services[which] = begin()
            services[which].wait()
            owners[which] = leases.stranger({*owners})
        return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=10)
    parser.add_argument("--sqlite", action="store_true")
    asked = parser.parse_args()
    try:
        with tempfile.TemporaryDirectory() as folder:
            found = sorted(failovers(Path(folder), asked.kills, asked.sqlite))
    except postgres.Missing as missing:
        print(missing, file=sys.stderr)
        sys.exit(2)
    lease_s, middle = Settings().lease_s, found[len(found) // 2]
    print(
        json.dumps(
            {"kills": len(found), "lease_s": lease_s, "median_s": round(middle, 1), "most_s": round(found[-1], 1)}
        )
    )
    sys.exit(1 if found[-1] > MOST_S else 0)


if __name__ == "__main__":
    main()
