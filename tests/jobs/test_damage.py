"""Files that are not what was written, quotas, leftovers, clocks. The value of row i is i / 7 (analytic)."""

import fcntl
import http.client
import json
import os
import subprocess
import sys
import time
from contextlib import closing, suppress
from pathlib import Path
from threading import Event

import pytest

from optimizer.studies.sweep import run_chunk
from schemas.sweep.request import SweepRequest
from service.jobs import room, selection, spool
from service.jobs.database import Database, DatabaseUnavailable
from service.jobs.files import FilesUnavailable
from service.jobs.housekeeping import Housekeeping
from service.jobs.job import Order
from service.jobs.kinds import table_bytes
from service.jobs.leases import Leases
from service.jobs.owner_jobs import OwnerJobs, Parts, RowsDamaged
from service.jobs.piece import Unanswerable
from service.jobs.retention import Retention
from service.jobs.rows import Limits
from service.jobs.store import QuotaExceeded, Store
from tests.commands import ROOT, run
from tests.jobs import synthetic
from tests.jobs.flips import flip
from tests.jobs.house import House
from tests.jobs.process import service
from tests.jobs.sweeps import analyses
from tests.jobs.test_kills import SWEEP, expected
from tests.jobs.threads import threads
from tests.jobs.tiny_disk import tiny_disk


def test_flips_are_refused_and_repaired(tmp_path: Path) -> None:
    # three hundred: python -m tests.jobs.flips
    assert flip(tmp_path, flips=4, seed=1) == (4, 4)


@pytest.mark.parametrize(("name", "points"), [("crashes", 5), ("statements", 2)])
def test_crashes_lose_nothing_and_leave_nothing(name: str, points: int) -> None:
    # a process of its own, as it forks; at all two thousand system calls and seven hundred statements: without --points
    process = run(f"tests.jobs.{name}", "--points", str(points))
    if process.returncode == 2:
        pytest.skip(process.stderr)
    assert process.returncode == 0, process.stderr
    front = json.loads(process.stdout)
    assert front["of"] > 500
    assert front["points"] > 0.8 * points
    assert (front["rows_lost"], front["orphans"]) == (0, 0)


def test_damage_over_http_is_an_error_or_a_broken_answer(tmp_path: Path) -> None:
    with service(tmp_path, delay_s=0) as running:
        path = running.send("POST", "/v1/sweeps", SWEEP)[1]["location"]
        assert running.ended(path)["repaired"] == 0
        files = sorted((tmp_path / "results" / path.rsplit("/", 1)[1]).glob("0*"))
        assert len(files) > 2
        # damaged in the middle of the answer: the client sees that it is cut
        content = bytearray(files[-1].read_bytes())
        content[len(content) // 2] ^= 1
        files[-1].write_bytes(content)
        with closing(http.client.HTTPConnection(*running.where, timeout=180)) as connection:
            connection.request("GET", f"{path}/results?format=ndjson")
            answer = connection.getresponse()
            with pytest.raises(http.client.IncompleteRead):
                answer.read()
        assert running.ended(path)["repaired"] == 1
        # missing: said before the body
        files[1].unlink()
        status, headers, body = running.send("GET", f"{path}/results")
        assert (status, headers["retry-after"], json.loads(body)["title"]) == (503, "2", "Rows damaged")
        state = running.ended(path)
        assert (state["state"], state["done"], state["repaired"]) == ("done", 1000, 2)
        assert running.rows(path).equals(expected())


def jobs_of(house: House, coordinator: object) -> OwnerJobs:
    parts = Parts(house.store, house.leases, house.retention, house.files, coordinator, Event())  # type: ignore[arg-type]
    return OwnerJobs(parts, None, True)


def test_a_cancelled_job_repairs_when_it_goes_on(house: House, tmp_path: Path) -> None:
    go = tmp_path / "go"
    job = house.submit(total=40, chunk_rows=10, held_from=10, held_until=str(go))
    with house.coordinator(threads(1)) as coordinator:
        house.wait_for_rows(job, 10)
        house.store.cancel(job)
        jobs = jobs_of(house, coordinator)
        house.files.piece(job, house.store.pieces(job)[0]).unlink()
        with pytest.raises(RowsDamaged, match="rows 0 to 9 is missing"):
            jobs.rows(house.store.get(job), synthetic.SCHEMA)
        record = house.store.get(job)
        assert (record.state, record.done, record.repaired) == ("cancelled", 0, 1)
        house.store.resume(job)
        go.touch()
        assert house.wait(job).state == "done"
    assert house.rows(job).equals(synthetic.rows(0, 40))


def test_a_disk_that_cannot_be_read_now_damages_nothing(house: House, monkeypatch: pytest.MonkeyPatch) -> None:
    job = house.submit(total=10)
    with house.coordinator(threads(1)) as coordinator:
        house.wait(job)
        monkeypatch.setattr(os, "open", lambda *_: (_ for _ in ()).throw(OSError(24, "Too many open files")))
        with pytest.raises(FilesUnavailable, match="Too many open files"):
            list(jobs_of(house, coordinator).rows(house.store.get(job), synthetic.SCHEMA).batches)
        monkeypatch.undo()
        assert house.store.get(job).repaired == 0


# ---- room on disk


def test_a_quota(tmp_path: Path) -> None:
    # the write-ahead log alone may take 4 MB
    house = House(tmp_path, limits=Limits(quota_bytes=6_000_000))
    first = house.submit(total=40, chunk_rows=10, owner="one")
    with house.coordinator(threads(1)):
        # four files of a block each, besides the request
        assert 4 * 4096 < house.wait(first).bytes < 6 * 4096
        large = house.submit(total=4_000_000, chunk_rows=40_000, owner="one")
        job = house.wait(large)
        assert (job.state, job.error) == (
            "failed",
            "the 6.0 MB of its owner on disk are used up; remove sweeps, then resume this one",
        )
        assert house.rows(large).num_rows == job.done > 0
        # others are not concerned
        assert house.wait(house.submit(total=100, chunk_rows=10, owner="two")).state == "done"
        house.retention.mark_removed(first)
        house.files.remove(first)
        house.retention.forget(first)
    order = Order("k", b"{}", "d", owner="one", expected_bytes=5_900_000)
    with pytest.raises(QuotaExceeded, match=r"5\.9 MB on disk; of 6\.0 MB"):
        house.store.submit(order)
    house.database.close()


def test_a_quota_counts_what_the_database_keeps(tmp_path: Path) -> None:
    house = House(tmp_path)
    for owner, size in (("one", 600_000), ("two", 300_000), ("two", 1)):
        house.submit(owner=owner, padding="x" * size)
    with house.database.read() as connection:
        # what is in the log alone so far is written to the file as well
        connection.exec_driver_sql("PRAGMA wal_checkpoint")
        parts = [room.usage(connection, owner) for owner in ("one", "two", "three")]
    beside = [path.stat().st_size for path in tmp_path.glob("jobs.sqlite*")]
    # the file, its write-ahead log and the index of that
    assert len(beside) == 3
    assert sum(beside) > 2_000_000
    # nothing is free in it, and each part is rounded up
    assert 0 <= sum(parts) - sum(beside) <= 2
    assert 1.9 < parts[0] / parts[1] < 2.0
    assert parts[2] == 0
    house.database.close()


def fill(path: Path) -> None:
    with path.open("wb", buffering=0) as file, suppress(OSError):
        while True:
            file.write(bytes(4096))


def test_delete_makes_room_on_a_full_disk(tmp_path: Path) -> None:
    with tiny_disk(tmp_path / "disk", "3m"):
        house = House(tmp_path / "disk")
        job = house.submit(total=60_000, chunk_rows=10_000)
        with house.coordinator(threads(1)) as coordinator:
            house.wait(job)
            jobs = jobs_of(house, coordinator)
        filler = tmp_path / "disk" / "filler"
        fill(filler)
        with pytest.raises(DatabaseUnavailable, match="full"):
            house.store.resume(house.submit())
        assert jobs.end(job) is None
        assert house.retention.job_ids() == set()
        assert not house.files.folder(job).exists()
        house.database.close()


# ---- leftovers


def test_folders_of_nobody_are_removed_but_not_those_of_another_database(house: House, tmp_path: Path) -> None:
    job = house.submit(total=10)
    with house.coordinator(threads(1)):
        house.wait(job)
    housekeeping = Housekeeping(house.store, house.retention, house.files)
    (house.files.folder("0" * 32)).mkdir()
    housekeeping.tidy()
    assert house.files.folders() == [job]
    database = Database(tmp_path / "other.sqlite")
    Housekeeping(Store(database), Retention(database), house.files).tidy()
    database.close()
    assert house.files.folders() == [job]


def test_messages_of_a_killed_service_are_removed(tmp_path: Path) -> None:
    script = (
        "import time; from concurrent.futures import ThreadPoolExecutor; from service.jobs.spool import Spool;"
        "spool = Spool(ThreadPoolExecutor(1)); print('made', flush=True); time.sleep(600)"
    )
    environment = {**os.environ, "TMPDIR": str(tmp_path)}
    command = [sys.executable, "-c", script]
    with subprocess.Popen(command, cwd=ROOT, env=environment, stdout=subprocess.PIPE, text=True) as killed:
        assert killed.stdout is not None
        assert killed.stdout.readline() == "made\n"
        (folder,) = tmp_path.glob("counterweight-spool-*")
        assert spool.remove_leftovers(tmp_path) == 0
        killed.kill()
        killed.wait(180)
    young = tmp_path / "counterweight-spool-young"
    young.mkdir()
    assert spool.remove_leftovers(tmp_path) == 1
    assert not folder.exists()
    # its lock may be about to be made
    assert young.exists()
    os.utime(young, (time.time() - 3600,) * 2)
    assert spool.remove_leftovers(tmp_path) == 1


def test_a_lock_is_held_by_its_process_alone(tmp_path: Path) -> None:
    folder = tmp_path / "counterweight-spool-mine"
    folder.mkdir()
    with (folder / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        assert spool.remove_leftovers(tmp_path) == 0
    assert spool.remove_leftovers(tmp_path) == 1


# ---- clocks


@pytest.mark.parametrize("jump", [86_400.0, 31 * 86_400.0, -86_400.0, -31 * 86_400.0])
def test_a_clock_that_jumps_delays_nothing_and_ends_nothing(house: House, jump: float) -> None:
    wall, monotonic = 1e9, 50.0
    limits = Limits(keep_s=30 * 86_400.0)
    leases = Leases(house.database, limits, clock=lambda: wall)
    retention = Retention(house.database, clock=lambda: monotonic)
    retention.mark_expired()
    future = house.submit(total=1)
    house.store.cancel(future)
    job = house.submit(total=1)
    wall += jump
    held = leases.claim("one", 15.0)
    assert held is not None
    # and back: what was leased meanwhile is free at the end of a lease at the latest
    wall -= jump
    wall, monotonic = wall + 31, monotonic + 31
    again = leases.claim("two", 15.0)
    assert again is not None
    assert again.job == job
    retention.mark_expired()
    assert retention.removed() == []


def test_time_is_lived_once_by_all_services(house: House) -> None:
    now = 0.0
    retention, two = (Retention(house.database, clock=lambda: now) for _ in range(2))
    store = Store(house.database, Limits(keep_s=100.0))
    job = house.submit()
    store.cancel(job)
    for moment in (0.0, 40.0, 80.0, 100.0):
        now = moment
        retention.mark_expired()
        two.mark_expired()
        assert retention.removed() == []
    now = 101.0
    two.mark_expired()
    assert retention.removed() == [job]


# ---- selections


def test_a_selection_is_bounded_in_size_and_time(house: House, monkeypatch: pytest.MonkeyPatch) -> None:
    request = SweepRequest.model_validate(analyses(top={"by": "force_peak_N", "count": 3}))
    data = request.model_dump_json().encode()
    rows = run_chunk(data, 0, 400)
    record = house.files.keep("a" * 32, 0, 400, table_bytes(rows))
    files = [(house.files.piece("a" * 32, record), record)]
    columns = rows.schema.serialize().to_pybytes()
    piece = selection.select(data, columns, files, "/nowhere")
    assert piece.selection_rows == 3
    with pytest.raises(Unanswerable, match="takes longer than 0 s"):
        selection.select(data, columns, files, "/nowhere", 0.0)
    monkeypatch.setattr(selection, "_CELLS", len(rows.schema))
    with pytest.raises(Unanswerable, match="more than 1 rows would be kept"):
        selection.select(data, columns, files, "/nowhere")


def test_a_sweep_is_planned_in_pieces(house: House) -> None:
    job, _ = house.store.submit(Order("synthetic", b"{}", "d", total=10_000_000, chunk_rows=1000, expected_bytes=1))
    first = house.leases.claim("a", 60.0)
    assert first is not None
    assert (first.start, first.stop) == (0, 1000)
    # as many as fit in a short transaction, not ten thousand
    assert house.store.get(job.id).planned == 250_000
