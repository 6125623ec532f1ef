"""A store, files and coordinators on an engine, as a service has them."""

import io
import json
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from service.jobs.coordinator import Coordinator
from service.jobs.database import Database
from service.jobs.engines import Engine
from service.jobs.files import JobFiles
from service.jobs.fingerprints import fingerprint
from service.jobs.housekeeping import Housekeeping
from service.jobs.job import Job, Order, Record
from service.jobs.leases import Leases
from service.jobs.pace import Pace
from service.jobs.piece import Run
from service.jobs.retention import Retention
from service.jobs.rows import Limits
from service.jobs.store import Store
from tests.jobs import synthetic

QUICK = Pace(poll_s=0.05, lease_s=2.0, tidy_s=0.2, longest_pause_s=0.5)


class House:
    """What services share."""

    def __init__(
        self, root: Path, url: str | Path | None = None, busy_s: float = 60.0, limits: Limits | None = None
    ) -> None:
        self.database = Database(url or root / "jobs.sqlite", busy_s)
        self.store, self.leases = Store(self.database, limits), Leases(self.database, limits)
        self.retention, self.files = Retention(self.database), JobFiles(root / "results")

    def submit(self, total: int = 100, chunk_rows: int = 10, owner: str | None = None, **options: Any) -> str:
        request = json.dumps(options).encode()
        columns = synthetic.SCHEMA.serialize().to_pybytes()
        job, new = self.store.submit(
            Order("synthetic", request, fingerprint("synthetic", request), total, chunk_rows, columns, owner=owner)
        )
        assert new
        return job.id

    def coordinator_on(self, engine: Engine, pace: Pace = QUICK, run: Run = synthetic.run) -> Coordinator:
        housekeeping = Housekeeping(self.store, self.retention, self.files)
        return Coordinator(self.store, self.leases, self.files, housekeeping, engine, pace=pace, run=run)

    @contextmanager
    def coordinator(self, engine: Engine, pace: Pace = QUICK) -> Iterator[Coordinator]:
        coordinator = self.coordinator_on(engine, pace)
        coordinator.start()
        try:
            yield coordinator
        finally:
            coordinator.stop()

    def wait(self, job: str, timeout: float = 180) -> Job:
        """The job when it has ended."""
        deadline = time.monotonic() + timeout
        while (record := self.store.get(job)).active:
            assert time.monotonic() < deadline, record
            time.sleep(0.02)
        return record

    def wait_for_rows(self, job: str, least: int = 1) -> None:
        deadline = time.monotonic() + 180
        while self.store.get(job).done < least:
            assert time.monotonic() < deadline
            time.sleep(0.01)

    def read(self, job: str, record: Record) -> bytes:
        with self.files.opened(job, record) as file:
            return file.read()

    def row_count(self, job: str) -> int:
        """Rows of the files that the database knows, all of which can be read."""
        return sum(piece.rows for piece in self.store.pieces(job) if self.read(job, piece))

    def wait_until_tidy(self, job: str) -> None:
        """Until the folder of a job holds its files and nothing else."""
        deadline = time.monotonic() + 180
        while set(self.files.names(job)) != {self.files.piece(job, piece).name for piece in self.store.pieces(job)}:
            assert time.monotonic() < deadline, self.files.names(job)
            time.sleep(0.02)

    def rows(self, job: str) -> pa.Table:
        """What is on disk of the chunks that are done."""
        # no threads of Arrow (read_table has some): one that still holds Python's bytes when the interpreter ends
        # aborts the process
        pieces = [
            pq.ParquetFile(io.BytesIO(self.read(job, piece))).read(use_threads=False)
            for piece in self.store.pieces(job)
        ]
        return pa.concat_tables(pieces) if pieces else synthetic.SCHEMA.empty_table()
