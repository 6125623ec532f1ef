"""What stands in place of a file of a sweep and is none: set aside or replaced, and the rows computed again."""

import logging
import os
import socket
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from threading import Event

import pyarrow as pa
import pytest

from service.jobs.files import Damaged
from service.jobs.job import Record
from service.jobs.owner_jobs import OwnerJobs, Parts, RowsDamaged
from tests.jobs import synthetic
from tests.jobs.house import House
from tests.jobs.threads import threads
from tests.night import part


def folder(path: Path) -> None:
    path.mkdir()
    (path / "letter").write_text("of somebody")


def listening(path: Path) -> None:
    with closing(socket.socket(socket.AF_UNIX)) as actual_socket:
        # the whole path is longer than the address of a socket may be
        before = os.open(".", os.O_RDONLY)
        os.chdir(path.parent)
        try:
            actual_socket.bind(path.name)
        finally:
            os.fchdir(before)
            os.close(before)


KINDS: dict[str, Callable[[Path], None]] = {
    "folder": folder,
    "pipe": os.mkfifo,
    "socket": listening,
    "loop": lambda path: path.symlink_to(path),
    "device": lambda path: path.symlink_to("/dev/zero"),
    "part": lambda path: path.write_bytes(b"PAR1") and None,  # type: ignore[func-returns-value]
}


def read(house: House, job: str, jobs: OwnerJobs) -> pa.Table:
    return pa.Table.from_batches(jobs.rows(house.store.get(job), synthetic.SCHEMA).batches)


@pytest.mark.parametrize("kind", part(2, KINDS))
def test_what_is_no_file_of_rows_is_computed_again(house: House, kind: str, caplog: pytest.LogCaptureFixture) -> None:
    job = house.submit(total=40, chunk_rows=10)
    with house.coordinator(threads(1)) as coordinator:
        house.wait(job)
        parts = Parts(house.store, house.leases, house.retention, house.files, coordinator, Event())
        jobs = OwnerJobs(parts, None, True)
        path = house.files.piece(job, house.store.pieces(job)[1])
        path.unlink()
        KINDS[kind](path)
        with pytest.raises(RowsDamaged, match="rows 10 to 19"):
            read(house, job, jobs)
        outcome = house.wait(job)
        assert (outcome.state, outcome.error, outcome.repaired) == ("done", None, 1)
        assert read(house, job, jobs).equals(synthetic.rows(0, 40))
    aside = sorted(path.parent.glob("*.aside-*"))
    moved = [record.getMessage() for record in caplog.records if "set aside" in record.getMessage()]
    if kind == "folder":
        # nobody knows whose it is
        assert [(file / "letter").read_text() for file in aside] == ["of somebody"]
        assert moved == [f"{path} was a folder; it is set aside as {aside[0].name}"]
    else:
        assert (aside, moved) == ([], [])
    assert not [record for record in caplog.records if record.exc_info]


def test_a_file_in_place_of_the_folder_of_a_job(house: House) -> None:
    job = house.submit(total=20, chunk_rows=10)
    home = house.files.folder(job)
    home.parent.mkdir()
    home.write_text("of somebody")
    with house.coordinator(threads(1)):
        assert house.wait(job).state == "done"
    assert house.rows(job).equals(synthetic.rows(0, 20))
    assert [path.read_text() for path in home.parent.glob(f"{job}.aside-*")] == ["of somebody"]


def test_a_folder_in_place_of_the_flag_stops_nothing(house: House, caplog: pytest.LogCaptureFixture) -> None:
    job = house.submit(total=20, chunk_rows=10, sleep_s=0.05)
    folder_of_flag = house.files.flag(job)
    folder_of_flag.mkdir(parents=True)
    caplog.set_level(logging.WARNING)
    with house.coordinator(threads(1)):
        assert house.wait(job).state == "done"
    assert not [record for record in caplog.records if record.exc_info]


def test_a_file_without_rights_is_damaged_where_it_is_ones_own(house: House, monkeypatch: pytest.MonkeyPatch) -> None:
    record = house.files.keep("a" * 32, 0, 10, b"rows")

    def refused(*_: object, **__: object) -> int:
        raise PermissionError(13, "Permission denied")

    # root reads whatever the rights are
    monkeypatch.setattr(os, "open", refused)
    with pytest.raises(Damaged, match="unreadable"):
        house.files.opened("a" * 32, Record(record.start, record.stop, record.digest, record.bytes))
