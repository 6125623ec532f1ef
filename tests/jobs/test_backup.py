"""Backup and restore as the operation guide has them, of a sweep that runs meanwhile: no row is lost or doubled.

The value of row i is i / 7 (analytic).
"""

import os
import re
import shlex
import subprocess
import sys
import time
from contextlib import closing
from pathlib import Path

import psycopg
import pytest

from service.jobs.job import Job
from tests.docs.reading import ROOT
from tests.jobs import postgres, synthetic
from tests.jobs.house import House
from tests.jobs.threads import threads
from tests.night import at_night

TEXT = (ROOT / "docs/operation.md").read_text()
SECTION = TEXT[TEXT.index("## Backup") : TEXT.index("## Upgrade")]
ROWS = 400


def command(pattern: str, *replaced: tuple[str, str]) -> list[str]:
    """A command of the guide, with places of the test in it."""
    match = re.search(pattern, SECTION)
    assert match is not None, pattern
    line = match[0]
    for old, new in replaced:
        assert old in line, line
        line = line.replace(old, new)
    return shlex.split(line)


def piped(data: Path) -> list[str]:
    """The guide's copy of the files of a folder."""
    match = re.search(r"tar --create .+", SECTION)
    assert match is not None
    assert "/data " in match[0]
    return ["bash", "-o", "pipefail", "-c", match[0].replace("/data ", f"{data} ")]


def run(arguments: list[str], folder: Path, programs: Path | None = None) -> None:
    path = f"{programs or ''}{os.pathsep}{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    process = subprocess.run(
        arguments, cwd=folder, env={**os.environ, "PATH": path}, capture_output=True, text=True, check=False
    )
    # a sweep that goes on puts files into its folder, and the service its mark beside them: no fault by the guide
    grown = all(
        re.fullmatch(r"tar: results(/\w+)?: file changed as we read it", line) for line in process.stderr.splitlines()
    )
    assert process.returncode == 0 or (process.returncode == 1 and process.stderr and grown), process.stderr


def interrupted(house: House, while_running: list[tuple[list[str], Path, Path | None]]) -> tuple[str, int]:
    """A job, and how many of its rows there were before it was copied while it ran on."""
    job = house.submit(total=ROWS, chunk_rows=10, sleep_s=0.02)
    with house.coordinator(threads()):
        house.wait_for_rows(job, ROWS // 4)
        before = house.store.get(job).done
        for arguments, folder, programs in while_running:
            run(arguments, folder, programs)
        # it goes on, so that the copy and what was copied are not the same
        house.wait_for_rows(job, min(ROWS, house.store.get(job).done + 10))
    return job, before


def finished(house: House, job: str, before: int) -> Job:
    """The job in the restored house, at its end; its rows are all there, once."""
    there = house.store.get(job)
    assert there.done >= before
    if there.active:
        with house.coordinator(threads()):
            house.wait(job)
    assert house.rows(job).equals(synthetic.rows(0, ROWS))
    return house.store.get(job)


def test_sqlite(tmp_path: Path) -> None:
    data, copy, again = (tmp_path / name for name in ("data", "copy", "again"))
    for folder in (data, copy, again):
        folder.mkdir()
    database = command(r"python3 -c '.+jobs\.sqlite.+'", ("/data/", f"{data}/"))
    files = piped(data)
    house = House(data)
    with closing(house.database):
        job, before = interrupted(house, [(database, copy, None), (files, copy, None)])
    run(["cp", "--archive", "jobs.sqlite", "results", str(again)], copy)
    restored = House(again)
    with closing(restored.database):
        assert finished(restored, job, before).state == "done"


@at_night
def test_postgresql(tmp_path: Path) -> None:
    data, copy, again = (tmp_path / name for name in ("data", "copy", "again"))
    for folder in (data, copy, again):
        folder.mkdir()
    try:
        programs = postgres.programs(tmp_path)
        with postgres.server() as first, postgres.server() as second:
            database = command(r"pg_dump .+", ("dump counterweight", f"dump {first.url}"))
            files = piped(data)
            house = House(data, first.url)
            with closing(house.database):
                job, before = interrupted(house, [(database, copy, programs), (files, copy, None)])
            restore = command(r"pg_restore [^`]+", ("--dbname=counterweight", f"--dbname={second.url}"))
            run(restore, copy, programs)
            run(["cp", "--archive", "results", str(again)], copy)
            restored = House(again, second.url)
            with closing(restored.database):
                assert finished(restored, job, before).state == "done"
    except postgres.Missing as missing:
        pytest.skip(str(missing))


ARCHIVED = " -c archive_mode=on -c 'archive_command=cp %p HOME/archive-%f'"


@pytest.mark.nightly
def test_postgresql_to_a_point_in_time(tmp_path: Path) -> None:
    """A base backup and the write-ahead log: the database as it was before a sweep was deleted."""
    try:
        with postgres.server(options=ARCHIVED) as first:
            house = House(tmp_path, first.url)
            with closing(house.database):
                first.call("pg_basebackup", f"--pgdata={first.home}/base", "--checkpoint=fast")
                job = house.submit(total=ROWS, chunk_rows=10)
                with house.coordinator(threads()):
                    house.wait(job)
                with psycopg.connect(first.url, autocommit=True) as connection:
                    (moment,) = connection.execute("select clock_timestamp()::text").fetchone() or ("",)
                    time.sleep(0.2)
                    house.retention.mark_removed(job)
                    (segment,) = connection.execute("select pg_walfile_name(pg_switch_wal())").fetchone() or ("",)
                until = time.monotonic() + 120
                while not (first.home / f"archive-{segment}").exists():
                    assert time.monotonic() < until
                    time.sleep(0.05)
            recovery = (
                f"restore_command = 'cp {first.home}/archive-%f %p'\nrecovery_target_time = '{moment}'\n"
                "recovery_target_action = 'promote'\narchive_mode = off\n"
            )
            with first.restored(first.home / "base", recovery) as second:
                restored = House(tmp_path, second.url)
                with closing(restored.database):
                    assert finished(restored, job, ROWS).state == "done"
    except postgres.Missing as missing:
        pytest.skip(str(missing))
