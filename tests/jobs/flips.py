"""Flip single bits in the files of a sweep, and see that no wrong row is answered and every one is made again.

``python -m tests.jobs.flips --flips 300`` flips as many as wanted; the tests flip a few.
"""

import argparse
import json
import random
import tempfile
import time
from pathlib import Path
from threading import Event

import pyarrow as pa

from service.jobs.engines import engine
from service.jobs.owner_jobs import OwnerJobs, Parts, RowsDamaged
from tests.jobs import synthetic
from tests.jobs.house import House


def flip(folder: Path, flips: int, seed: int) -> tuple[int, int]:
    """Flip a bit, read everything, wait until it is repaired, so many times.

    Returns
    -------
    number of flips that were refused, and of those after which the rows were right again without being asked for more.
    """
    house, chance = House(folder), random.Random(seed)
    synthetic.register()
    job = house.submit(total=600, chunk_rows=60)
    expected = synthetic.rows(0, 600)
    refused = repaired = 0
    with house.coordinator(engine("processes", 1)) as coordinator:
        jobs = OwnerJobs(
            Parts(house.store, house.leases, house.retention, house.files, coordinator, Event()), None, True
        )
        house.wait(job)
        for number in range(flips):
            path = house.files.piece(job, chance.choice(house.store.pieces(job)))
            content = bytearray(path.read_bytes())
            content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
            path.write_bytes(content)
            try:
                pa.Table.from_batches(jobs.rows(jobs.get(job), synthetic.SCHEMA).batches)
            except RowsDamaged:
                refused += 1
            outcome = house.wait(job)
            rows = jobs.rows(outcome, synthetic.SCHEMA)
            right = pa.Table.from_batches(rows.batches).equals(expected)
            repaired += right and rows.complete and outcome.repaired == number + 1
    house.database.close()
    return refused, repaired


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--flips", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        began = time.monotonic()
        refused, repaired = flip(Path(folder), arguments.flips, arguments.seed)
    print(
        json.dumps({"flips": arguments.flips, "refused": refused, "repaired": repaired, "s": time.monotonic() - began})
    )


if __name__ == "__main__":
    main()
