"""A store, files and coordinators on an engine, as a service has them."""

import json
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from service.jobs.coordinator import Coordinator, Pace
from service.jobs.database import Database
from service.jobs.engines import Engine
from service.jobs.files import JobFiles
from service.jobs.job import Job
from service.jobs.store import Store, digest
from tests.jobs import synthetic

QUICK = Pace(poll_s=0.05, lease_s=2.0, patience_s=0.5, expiry_s=0.2)


class House:
    """What services share."""

    def __init__(self, root: Path, url: str | Path | None = None, busy_s: float = 5.0) -> None:
        self.database = Database(url or root / "jobs.sqlite", busy_s)
        self.store = Store(self.database)
        self.files = JobFiles(root / "results")

    def submit(self, total: int = 100, chunk_rows: int = 10, **asked: Any) -> str:
        request = json.dumps(asked).encode()
        columns = synthetic.SCHEMA.serialize().to_pybytes()
        job, new = self.store.submit("synthetic", request, digest("synthetic", asked), total, chunk_rows, columns)
        assert new
        return job.id

    @contextmanager
    def coordinator(self, engine: Engine, pace: Pace = QUICK) -> Iterator[Coordinator]:
        found = Coordinator(self.store, self.files, engine, pace, synthetic.run)
        found.start()
        try:
            yield found
        finally:
            found.stop()

    def wait(self, job: str, timeout: float = 180) -> Job:
        """The job when it has ended."""
        deadline = time.monotonic() + timeout
        while (found := self.store.get(job)).active:
            assert time.monotonic() < deadline, found
            time.sleep(0.02)
        return found

    def wait_for_rows(self, job: str, least: int = 1) -> None:
        deadline = time.monotonic() + 180
        while self.store.get(job).done < least:
            assert time.monotonic() < deadline
            time.sleep(0.01)

    def rows(self, job: str) -> pa.Table:
        """What is on disk of the chunks that are done."""
        pieces = [pq.read_table(self.files.piece(job, *piece)) for piece in self.store.pieces(job)]
        return pa.concat_tables(pieces) if pieces else synthetic.SCHEMA.empty_table()
