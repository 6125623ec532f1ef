"""Files that cannot be written, full disks, locked databases: no row is lost, and none is wrong."""

import errno
import os
import sqlite3
import time
from pathlib import Path

import pytest

from service.jobs.files import JobFiles
from service.jobs.job import Record
from tests.jobs import synthetic
from tests.jobs.house import QUICK, House
from tests.jobs.threads import threads
from tests.jobs.tiny_disk import tiny_disk


def test_what_was_written_but_not_told_is_written_again(house: House) -> None:
    job = house.submit(total=20, chunk_rows=10)
    # a crash between the file and the database, and one before the file had its name
    house.files.keep(job, 0, 10, b"whatever")
    (house.files.folder(job) / ".000000010-000000020.99").write_bytes(b"half")
    with house.coordinator(threads()):
        assert house.wait(job).state == "done"
        house.wait_until_tidy(job)
    assert house.rows(job).equals(synthetic.rows(0, 20))


@pytest.mark.parametrize("code", [errno.ENOSPC, errno.EIO])
def test_a_file_that_cannot_be_written_fails_the_job(house: House, monkeypatch: pytest.MonkeyPatch, code: int) -> None:
    job = house.submit(total=40, chunk_rows=10)
    keep = JobFiles.keep

    def breaks(self: JobFiles, job: str, start: int, stop: int, content: bytes) -> Record:
        if start == 20:
            raise OSError(code, os.strerror(code))
        return keep(self, job, start, stop, content)

    monkeypatch.setattr(JobFiles, "keep", breaks)
    with house.coordinator(threads(1)):
        outcome = house.wait(job)
    assert (outcome.state, outcome.error) == ("failed", f"rows 20 to 29 cannot be written: {os.strerror(code)}")
    assert house.rows(job).equals(synthetic.rows(0, 20))
    monkeypatch.undo()


def test_a_disk_that_is_really_full(tmp_path: Path, synthetic_kind: None) -> None:
    with tiny_disk(tmp_path / "disk", "400k"):
        house = House(tmp_path / "disk")
        job = house.submit(total=100_000, chunk_rows=500)
        with house.coordinator(threads(1)) as coordinator:
            deadline = time.monotonic() + 240
            while house.store.get(job).active and coordinator.verdict(job) is None:
                assert time.monotonic() < deadline
                time.sleep(0.02)
            record = house.store.get(job)
            reason = record.error or coordinator.verdict(job) or ""
        assert "No space left" in reason or "full" in reason
        assert 0 < record.done < 100_000
        assert house.rows(job).equals(synthetic.rows(0, record.done))
        house.database.close()


def test_a_locked_database_fails_nothing(tmp_path: Path) -> None:
    house = House(tmp_path, busy_s=0.1)
    go = tmp_path / "go"
    job = house.submit(total=200, chunk_rows=2, sleep_s=0.02, held_from=100, held_until=str(go))
    with house.coordinator(threads()) as coordinator:
        house.wait_for_rows(job)
        connection = sqlite3.connect(tmp_path / "jobs.sqlite", timeout=180, isolation_level=None)
        connection.execute("BEGIN IMMEDIATE")
        # longer than leases and attempts last
        time.sleep(3)
        assert (coordinator.verdict(job), house.store.get(job).state) == (None, "running")
        connection.execute("ROLLBACK")
        connection.close()
        go.touch()
        assert house.wait(job).state == "done"
    assert house.rows(job).equals(synthetic.rows(0, 200))
    house.database.close()


def test_a_database_that_is_locked_for_a_moment_costs_nothing(tmp_path: Path) -> None:
    house = House(tmp_path, busy_s=0.05)
    job = house.submit(total=50, chunk_rows=2, sleep_s=0.02)
    with house.coordinator(threads(), QUICK):
        for _ in range(3):
            house.wait_for_rows(job)
            with sqlite3.connect(tmp_path / "jobs.sqlite", timeout=180, isolation_level=None) as connection:
                connection.execute("BEGIN IMMEDIATE")
                time.sleep(0.3)
                connection.execute("ROLLBACK")
            connection.close()
        assert house.wait(job).state == "done"
    assert house.rows(job).equals(synthetic.rows(0, 50))
    house.database.close()
