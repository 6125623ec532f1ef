"""Machines and answers on disk are for the user of the service alone, whatever the umask says."""

import io
import os
import stat
from collections.abc import Iterator
from pathlib import Path

import pyarrow.parquet as pq
import pytest

from schemas.sweep.request import SweepRequest
from service.common.private import close, make_folder
from service.jobs import worker
from service.jobs.database import Database
from service.jobs.desk import JobService
from service.jobs.files import JobFiles
from service.settings import Settings
from tests.jobs.routes import finished, ready
from tests.jobs.sweeps import analyses


@pytest.fixture(autouse=True)
def generous() -> Iterator[None]:
    """The umask of most machines, by which others may read."""
    before = os.umask(0o022)
    yield
    os.umask(before)


def mode(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


def open_to_others(folder: Path) -> list[str]:
    """What is in a folder, and the folder itself, that others have a right to."""
    return sorted(str(path) for path in (folder, *folder.rglob("*")) if mode(path) & 0o077)


@pytest.mark.parametrize("there", [False, True])
def test_nobody_else_reads_a_sweep(tmp_path: Path, there: bool) -> None:
    data = tmp_path / "data"
    if there:
        data.mkdir()
        assert mode(data) == 0o755
    with ready(data) as client:
        finished(client)
        names = {path.name for path in data.rglob("*")}
        assert names > {"jobs.sqlite", "jobs.sqlite-wal", "jobs.sqlite-shm", "results"}
        assert open_to_others(data) == []


def test_what_an_earlier_version_left_open_is_closed(tmp_path: Path) -> None:
    data = tmp_path / "data"
    files = JobFiles(data / "results")
    files.keep("job", 0, 1, b"rows")
    for ending in ("", "-wal", "-shm"):
        (data / f"jobs.sqlite{ending}").touch()
    (data / "keys.jsonl").touch()
    for path in (data, data / "results", data / "results" / "job"):
        path.chmod(0o755)
    JobService(Settings(data_dir=data)).close()
    assert (mode(data), mode(data / "results"), mode(data / "jobs.sqlite")) == (0o700, 0o700, 0o600)
    # what this user wrote beside it is his
    assert mode(data / "keys.jsonl") == 0o644


def test_a_folder_for_other_things_too_stays_as_it_is(tmp_path: Path) -> None:
    (tmp_path / "site").mkdir()
    (tmp_path / "results").mkdir()
    tmp_path.chmod(0o755)
    JobService(Settings(data_dir=tmp_path)).close()
    database = Database(tmp_path / "jobs.sqlite")
    database.check()
    database.close()
    assert (mode(tmp_path), mode(tmp_path / "site")) == (0o755, 0o755)
    assert open_to_others(tmp_path / "results") == open_to_others(tmp_path / "jobs.sqlite") == []


def test_a_database_that_is_named_is_closed_and_its_folder_is_not(tmp_path: Path) -> None:
    tmp_path.chmod(0o755)
    database = Database(f"sqlite:///{tmp_path}/named.sqlite")
    database.check()
    database.close()
    assert (mode(tmp_path), mode(tmp_path / "named.sqlite")) == (0o755, 0o600)


def test_folders_of_others_and_of_everybody_stay_as_they_are(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    common, mounted = tmp_path / "common", tmp_path / "mounted"
    for folder, rights in ((common, 0o1777), (mounted, 0o775)):
        folder.mkdir()
        folder.chmod(rights)
    close(common)
    monkeypatch.setattr(os, "geteuid", lambda: os.getuid() + 1)
    close(mounted)
    assert (mode(common), mode(mounted)) == (0o1777, 0o775)
    # nor is there anything wrong with one that is not there
    close(tmp_path / "nothing")


def test_a_worker_that_may_not_look_for_the_flag_computes_to_the_end() -> None:
    """A path that no system looks up stands for a folder of another user."""
    request = SweepRequest.model_validate(analyses()).model_dump_json().encode()
    piece = worker.run("sweep", request, 0, 3, "/" + "x" * 5000)
    assert pq.read_table(io.BytesIO(piece.content)).num_rows == 3


def test_what_is_above_a_folder_is_made_as_the_umask_says(tmp_path: Path) -> None:
    make_folder(tmp_path / "above" / "data")
    assert (mode(tmp_path / "above"), mode(tmp_path / "above" / "data")) == (0o755, 0o700)
