"""The command `counterweight sweep`, as a process."""

import json
import os
import signal
import subprocess
import time
from importlib import import_module
from operator import attrgetter
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.csv as pa_csv
import pyarrow.parquet as pq
import pytest
from typer.testing import CliRunner, Result

from optimizer.studies.sweep import run_chunk
from schemas.sweep.request import SweepRequest
from service.cli import app
from tests.commands import Command
from tests.commands import run as run_command
from tests.jobs.sweeps import analyses, optimisations


def expected(body: dict[str, Any]) -> pa.Table:
    request = SweepRequest.model_validate(body)
    return run_chunk(request.model_dump_json().encode(), 0, request.total)


def written(folder: Path, body: dict[str, Any]) -> str:
    (folder / "sweep.json").write_text(json.dumps(body))
    return str(folder / "sweep.json")


def run(*arguments: str) -> "subprocess.CompletedProcess[str]":
    env = {**os.environ, "COUNTERWEIGHT_DATABASE_URL": "postgresql://nobody@127.0.0.1:1/of-the-service"}
    process = run_command("service", "sweep", *arguments, environment=env)
    assert "Traceback" not in process.stderr
    return process


def here(*arguments: str) -> Result:
    """The command in this process, for what ends before anything is computed."""
    return CliRunner().invoke(app, ["sweep", *arguments])


def test_a_table_and_a_file(tmp_path: Path) -> None:
    out = tmp_path / "rows.parquet"
    process = run(written(tmp_path, optimisations()), "-o", str(out), "--workers", "1")
    assert process.returncode == 0, process.stderr
    assert pq.read_table(out).equals(expected(optimisations()))
    assert "optimal" in process.stdout
    assert "Smallest peak force" in process.stdout
    assert f"{out.name}: 6 rows" in process.stdout.replace("\n", "")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["rows.parquet", "sweep.json"]


def test_designs_without_a_certified_answer_give_1(tmp_path: Path) -> None:
    out = tmp_path / "rows.csv"
    process = run(written(tmp_path, analyses(4, 10)), "-o", str(out), "--json", "--folder", str(tmp_path / "work"))
    state = json.loads(process.stdout)
    assert (process.returncode, state["state"], state["done"]) == (1, "done", 40)
    assert (state["failed"], state["invalid"]) == (0, 4)
    assert pa_csv.read_csv(out).num_rows == 40
    assert json.loads((tmp_path / "rows.csv-metadata.json").read_text())["request"]["task"] == "analyze"
    # kept where it was asked for: the same command computes nothing again
    again = run(
        written(tmp_path, analyses(4, 10)), "-o", str(tmp_path / "rows.arrow"), "--folder", str(tmp_path / "work")
    )
    assert "40 of 40 designs are there" in again.stderr
    assert pa.ipc.open_file(tmp_path / "rows.arrow").read_all().equals(expected(analyses(4, 10)))


@pytest.mark.parametrize("ending", [signal.SIGINT, signal.SIGKILL])
def test_an_interrupted_sweep_goes_on(tmp_path: Path, ending: signal.Signals) -> None:
    # two chunks
    body, out = analyses(10, 10), tmp_path / "rows.parquet"
    arguments = [written(tmp_path, body), "-o", str(out), "--workers", "1"]
    # it stays at its second chunk, however late the signal comes
    with Command("tests.jobs.held", "sweep", *arguments, stderr=subprocess.PIPE, text=True) as first:
        results = tmp_path / "rows.parquet.sweep" / "results"
        deadline = time.monotonic() + 180
        while not any(path.is_file() for path in results.glob("*/0*")):
            assert time.monotonic() < deadline
            time.sleep(0.01)
        first.send_signal(ending)
        _, printed = first.communicate(timeout=180)
    assert not out.exists()
    if ending == signal.SIGINT:
        assert first.returncode == 130
        assert "the same command goes on from there" in printed
    process = here(written(tmp_path, optimisations()), "-o", str(out))
    assert (process.exit_code, "another sweep" in process.stderr) == (2, True)
    command = run(written(tmp_path, body), "-o", str(out), "--workers", "2")
    assert command.returncode == 1
    assert "going on with the sweep" in command.stderr
    assert pq.read_table(out, columns=["index"])["index"].to_pylist() == list(range(100))


@pytest.mark.parametrize(
    ("where", "during"),
    [
        pytest.param("service.jobs.desk", "JobService", marks=pytest.mark.nightly),
        ("service.jobs.owner_jobs", "OwnerJobs.sweep"),
        pytest.param("service.cli.sweep", "_watch", marks=pytest.mark.nightly),
        ("service.jobs.export", "export"),
        pytest.param("service.cli.sweep", "put", marks=pytest.mark.nightly),
    ],
)
def test_whenever_it_is_interrupted_it_says_so_and_goes_on(
    where: str, during: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*arguments: object, **_more: object) -> None:
        raise KeyboardInterrupt

    out = tmp_path / "rows.parquet"
    command = (written(tmp_path, optimisations()), "-o", str(out), "--workers", "1")
    with monkeypatch.context() as patch:
        # the package has a command of the name of its module
        *inside, name = during.split(".")
        patch.setattr(attrgetter(*inside)(import_module(where)) if inside else import_module(where), name, interrupted)
        process = here(*command)
    assert process.exit_code == 130
    assert "the same command goes on from there" in process.stderr
    assert here(*command).exit_code == 0
    assert pq.read_table(out).equals(expected(optimisations()))


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ((), "--output"),
        (("-o", "rows.ods"), "the name must end in"),
        (("-o", "nowhere/rows.csv"), "there is no folder"),
        (("-o", "rows.csv", "--engine", "abacus"), "there is no engine"),
        (("-o", "rows.csv", "--folder", "/dev/null/x"), "cannot work in"),
    ],
)
def test_what_cannot_be_done(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, arguments: tuple[str, ...], text: str
) -> None:
    monkeypatch.chdir(tmp_path)
    process = here(written(tmp_path, optimisations()), *arguments)
    assert (process.exit_code, process.stdout) == (2, "")
    assert text in process.stderr


@pytest.mark.parametrize(
    ("counts", "code"),
    [
        pytest.param({"optimal": 6}, 0, marks=pytest.mark.nightly),
        ({"optimal": 5, "infeasible": 1}, 1),
        ({"optimal": 5, "failed": 1}, 70),
    ],
)
def test_a_row_that_broke_down_is_no_infeasible_one(
    counts: dict[str, int], code: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(import_module("service.cli.sweep"), "_counts", lambda *_: counts)
    assert here(written(tmp_path, optimisations()), "-o", str(tmp_path / "rows.csv")).exit_code == code


def test_a_bad_sweep_names_the_field(tmp_path: Path) -> None:
    process = here(written(tmp_path, optimisations(axes=[{"path": "/machine/nothing", "values": [1]}])), "-o", "x.csv")
    assert process.exit_code == 2
    assert "/axes/0/path" in process.stderr


def test_a_dry_run(tmp_path: Path) -> None:
    file = written(tmp_path, optimisations())
    assert json.loads(here(file, "--dry-run", "--json").stdout)["total"] == 6
    assert json.loads(here(file, "--dry-run", "--json", "--workers", "3").stdout)["workers"] == 3
    process = here(file, "--dry-run", "--workers", "3")
    assert "until it is done, 3 workers, about s" in process.stdout
    assert "The time assumes 3 worker(s) with a core each" in process.stdout
    assert process.exit_code == 0
    assert "force_peak_N" in process.stdout
    assert [path.name for path in tmp_path.iterdir()] == ["sweep.json"]
