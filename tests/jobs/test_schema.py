"""Databases of older, newer and other schemas."""

import json
import sqlite3
import time
from pathlib import Path
from typing import Any

import pyarrow as pa
import pytest
from sqlalchemy import create_engine, insert, text
from typer.testing import CliRunner

from optimizer.studies.sweep import run_chunk
from schemas.sweep.request import SweepRequest
from service.cli import app
from service.jobs.database import Database, DatabaseUnavailable
from service.jobs.desk import JobService
from service.jobs.housekeeping import Housekeeping
from service.jobs.kinds import table_bytes
from service.jobs.pace import Pace
from service.jobs.schema import NUMBER, WrongSchema
from service.settings import Settings
from tests.jobs import schema_1
from tests.jobs.sweeps import analyses

DONE, RUNNING, BEST = ("a" * 32, "b" * 32, "c" * 32)


@pytest.fixture(params=["sqlite", "postgresql"])
def settings(request: pytest.FixtureRequest, tmp_path: Path) -> Settings:
    fields: dict[str, Any] = {"data_dir": tmp_path, "sweep_workers": 1}
    if request.param == "postgresql":
        fields["database_url"] = request.getfixturevalue("postgres_url")
    return Settings(**fields)


def engine_of(settings: Settings) -> Any:
    url = (settings.database_url or f"sqlite:///{settings.data_dir}/jobs.sqlite").replace(
        "postgresql:", "postgresql+psycopg:"
    )
    return create_engine(url)


def job(id: str, state: str, body: dict[str, Any], count: int) -> dict[str, Any]:  # noqa: A002
    request = SweepRequest.model_validate(body)
    data = request.model_dump_json().encode()
    columns = run_chunk(data, 0, 1).schema.serialize().to_pybytes()
    ended = None if state == "running" else 2000.0
    about = {"digest": "d", "columns": columns, "faults": 0, "failed": 0, "version": 3, "created": 1000.0}
    return {
        **{"id": id, "kind": "sweep", "request": data, "state": state, "total": 400, "done": count, **about},
        **{"ended": ended, "expires": None if ended is None else ended + 100.0},
    }


def write_1(settings: Settings) -> None:
    """A database and files of the first release: a sweep that is done, one half done, and one with its best rows."""
    engine = engine_of(settings)
    with engine.begin() as connection:
        schema_1.metadata.create_all(connection)
        for id, state, more, count in (  # noqa: A001
            (DONE, "done", {}, 400),
            (RUNNING, "running", {}, 200),
            (BEST, "done", {"top": {"by": "force_peak_N", "count": 3}}, 400),
        ):
            about = job(id, state, analyses(**more), count)
            connection.execute(insert(schema_1.jobs).values(about))
            for start in (0, 200):
                finished = start < count
                chunk = {"job": id, "start": start, "stop": start + 200, "state": "done" if finished else "pending"}
                connection.execute(insert(schema_1.chunks).values(chunk))
                if finished:
                    path = settings.data_dir / "results" / id / f"{start:09d}-{start + 200:09d}"
                    path.parent.mkdir(parents=True, exist_ok=True)
                    path.write_bytes(table_bytes(run_chunk(about["request"], start, start + 200)))
    engine.dispose()


def test_a_database_of_the_first_release_goes_on(settings: Settings) -> None:
    write_1(settings)
    desk = JobService(settings, Pace(poll_s=0.05))
    desk.open()
    try:
        jobs = desk.of()
        expected = run_chunk(SweepRequest.model_validate(analyses()).model_dump_json().encode(), 0, 400)
        for id in (DONE, RUNNING, BEST):  # noqa: A001
            while (task := jobs.get(id)).active:
                time.sleep(0.02)
            assert (task.state, task.done, task.error) == ("done", 400, None)
            for _ in range(2):
                rows = jobs.rows(task, jobs.schema(task))
                assert rows.complete
                # independent: computed here
                assert pa.Table.from_batches(rows.batches).equals(expected)
        best = jobs.get(BEST)
        assert (best.selected, best.kept) == (400, 3)
        selection = pa.Table.from_batches(jobs.selection(best, jobs.schema(best)).batches)
        values = sorted(peak for peak in expected["force_peak_N"].to_pylist() if peak is not None)
        assert selection["force_peak_N"].to_pylist() == values[:3]
        # what was read has a digest now, and is verified from now on
        assert all(piece.digest for piece in desk._parts.store.pieces(DONE))
        assert json.loads(jobs.schema(best).metadata[b"counterweight.request"])["top"]["count"] == 3
    finally:
        desk.close()
    # and once more, as of today's schema
    again = JobService(settings)
    assert again.of().get(DONE).done == 400
    again.close()


@pytest.mark.parametrize(
    ("number", "columns", "counts"),
    # what was counted together stays so
    [(2, ("invalid", "infeasible"), {"failed": 7}), (3, ("infeasible",), {"failed": 7, "invalid": 2})],
)
def test_a_database_without_counts_of_some_rows_goes_on(
    settings: Settings, number: int, columns: tuple[str, ...], counts: dict[str, int]
) -> None:
    write_1(settings)
    old = JobService(settings)
    old.of().get(DONE)
    old.close()
    engine = engine_of(settings)
    with engine.begin() as connection:
        for table in ("jobs", "chunks"):
            for column in columns:
                connection.execute(text(f"ALTER TABLE {table} DROP COLUMN {column}"))
        connection.execute(text(f"UPDATE schema SET number = {number}"))
        connection.execute(text("UPDATE jobs SET " + ", ".join(f"{name} = {count}" for name, count in counts.items())))
    desk = JobService(settings)
    task = desk.of().get(DONE)
    desk.close()
    expected = (400, counts["failed"], counts.get("invalid", 0), 0)
    assert (task.done, task.failed, task.invalid, task.infeasible) == expected
    with engine.connect() as connection:
        assert connection.scalar(text("SELECT number FROM schema")) == NUMBER
    engine.dispose()


def test_a_file_is_named_while_others_read_and_tidy(settings: Settings, monkeypatch: pytest.MonkeyPatch) -> None:
    write_1(settings)
    # not opened, so that only what is called here runs
    desk = JobService(settings)
    jobs, parts = desk.of(), desk._parts
    task = jobs.get(DONE)
    schema = jobs.schema(task)
    house = Housekeeping(parts.store, parts.retention, parts.files)
    adopt = parts.leases.adopt

    def late(*about: Any) -> None:
        # the moment between the file's name and the database's knowledge of it
        house.tidy()
        assert not parts.files.absent(DONE, parts.store.pieces(DONE))
        adopt(*about)

    rename = Path.replace

    def renamed(half: Path, whole: Path) -> Path:
        # the moment between the file that is being written and its name
        if half.parent == parts.files.folder(DONE):
            house.tidy()
        return rename(half, whole)

    before = jobs.rows(task, schema)
    monkeypatch.setattr(parts.leases, "adopt", late)
    monkeypatch.setattr(Path, "replace", renamed)
    first = pa.Table.from_batches(jobs.rows(task, schema).batches)
    # who has asked before the names were given still reads
    assert pa.Table.from_batches(before.batches).equals(first)
    assert jobs.get(DONE).repaired == 0
    expected = {parts.files.piece(DONE, piece).name for piece in parts.store.pieces(DONE)}
    assert set(parts.files.names(DONE)) == expected
    assert all(name.count("-") == 2 for name in expected)
    desk.close()


def test_a_crash_between_a_name_and_its_record_costs_nothing(settings: Settings) -> None:
    write_1(settings)
    desk = JobService(settings)
    jobs, parts = desk.of(), desk._parts
    task = jobs.get(DONE)
    for piece in parts.store.pieces(DONE):
        parts.files.renamed_file(DONE, piece)
    Housekeeping(parts.store, parts.retention, parts.files).tidy()
    assert pa.Table.from_batches(jobs.rows(task, jobs.schema(task)).batches).num_rows == 400
    assert jobs.get(DONE).repaired == 0
    assert len(parts.files.names(DONE)) == 2
    desk.close()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (f"UPDATE schema SET number = {NUMBER + 1}", f"has schema {NUMBER + 1}; this service knows {NUMBER}"),
        ("ALTER TABLE jobs DROP COLUMN repaired", "the table jobs of the job database lacks repaired"),
        ("DELETE FROM schema", "has schema None"),
    ],
)
def test_another_schema_refuses_to_start(settings: Settings, change: str, words: str) -> None:
    desk = JobService(settings)
    desk.of().page(1, None)
    desk.close()
    engine = engine_of(settings)
    with engine.begin() as connection:
        connection.execute(text(change))
    engine.dispose()
    with pytest.raises(ValueError, match=words):
        JobService(settings)


def test_tables_that_are_changed_while_it_runs(settings: Settings) -> None:
    desk = JobService(settings)
    desk.of().page(1, None)
    assert desk.counts() == {}
    engine = engine_of(settings)
    with engine.begin() as connection:
        connection.execute(text("ALTER TABLE jobs DROP COLUMN repaired"))
    engine.dispose()
    with pytest.raises(DatabaseUnavailable, match="repaired"):
        desk.of().page(1, None)
    # from then on everybody is told, and the service is not ready
    with pytest.raises(WrongSchema, match="the table jobs of the job database lacks repaired"):
        desk.of().page(1, None)
    assert desk.counts() is None
    desk.close()


def test_tables_of_somebody_else(tmp_path: Path) -> None:
    with sqlite3.connect(tmp_path / "jobs.sqlite") as connection:
        connection.execute("CREATE TABLE jobs (id, salary)")
    connection.close()
    database = Database(tmp_path / "jobs.sqlite")
    with pytest.raises(WrongSchema, match=r"no known schema: .*salary"), database.read():
        pass
    database.close()
    process = CliRunner().invoke(
        app, ["serve"], env={"COUNTERWEIGHT_DATA_DIR": str(tmp_path), "COUNTERWEIGHT_PORT": "0"}
    )
    assert process.exit_code == 2
    assert "no known schema" in process.stderr
