"""The command line: exit codes, tables, the exact answer of the service."""

import json
import os
import subprocess
import sys
from importlib import import_module
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result
from starlette.testclient import TestClient
from typer.testing import CliRunner

from schemas.answer.answers import AnalyzeAnswer, OptimizeAnswer
from schemas.base.version import DISTRIBUTION
from service.cli import app
from service.common.examples import directory
from service.documents.examples import catalogue, load, names
from service.routes.version import processor
from tests.night import part

ROOT = Path(__file__).parents[2]


def run(*arguments: str, stdin: bytes | None = None) -> Result:
    return CliRunner().invoke(app, arguments, input=stdin)


def refused(result: Result) -> list[str]:
    assert result.exit_code == 2
    assert result.stdout == ""
    assert "Traceback" not in result.stderr
    return result.stderr.splitlines()


@pytest.fixture
def file(tmp_path: Path, body: dict[str, Any]) -> Path:
    path = tmp_path / "machine.json"
    path.write_text(json.dumps(body))
    return path


def test_optimize_prints_tables(file: Path) -> None:
    result = run("optimize", str(file))
    assert result.exit_code == 0
    for text in ("2D12-90/2-20: optimal", "Counterweights", "mass times radius, kg m", "1a", "peak force, N", "floor"):
        assert text in result.stdout
    assert "no counterweights within these limits bring the objective below 41250.2" in result.stdout
    assert "none weigh less than 232.699 kg together" in result.stdout
    assert "total mass of the counterweights, kg" in result.stdout
    assert "largest mass" in result.stdout


def test_a_web_without_a_counterweight_has_none(tmp_path: Path) -> None:
    body = json.loads(load("2d12"))
    body["machine"]["webs"][1]["max_mass_kg"] = 0
    file = tmp_path / "machine.json"
    file.write_text(json.dumps(body))
    result = run("optimize", str(file))
    assert result.exit_code == 0
    (row,) = (line for line in result.stdout.splitlines() if "1b" in line and "none" in line)
    cells = [cell.strip() for cell in row.strip("│").split("│")]
    assert cells == ["1b", "none", *5 * ["–"], "largest mass"]


def without_times(answer: Any) -> Any:
    if isinstance(answer, dict):
        return {key: without_times(value) for key, value in answer.items() if not key.endswith("_ms")}
    return [without_times(value) for value in answer] if isinstance(answer, list) else answer


@pytest.mark.parametrize("command", ["optimize", "analyze"])
def test_json_is_the_answer_of_the_service(client: TestClient, file: Path, command: str) -> None:
    result = run(command, str(file), "--json")
    assert result.exit_code == 0
    headers = {"Content-Type": "application/json"}
    answer = client.post(f"/v1/{command}", content=file.read_bytes(), headers=headers)
    assert without_times(json.loads(result.stdout)) == without_times(answer.json())
    # byte for byte as the service writes it, key order and all
    model = OptimizeAnswer if command == "optimize" else AnalyzeAnswer
    assert result.stdout == model.model_validate_json(result.stdout).model_dump_json() + "\n"


def test_standard_input(body: dict[str, Any]) -> None:
    assert run("optimize", "-", stdin=json.dumps(body).encode()).exit_code == 0
    assert run("analyze", "-", stdin=b"\xef\xbb\xbf" + json.dumps(body).encode()).exit_code == 0


def test_infeasible(body: dict[str, Any]) -> None:
    body["objective"] = {"force_ceiling_N": 1}
    result = run("optimize", "-", stdin=json.dumps(body).encode())
    assert result.exit_code == 1
    for text in (
        "infeasible",
        "the ceiling of the force cannot be met",
        "Smallest feasible peaks",
        "certified not below",
        "best compromise",
    ):
        assert text in result.stdout
    assert json.loads(run("optimize", "-", "--json", stdin=json.dumps(body).encode()).stdout)["status"] == "infeasible"


def test_inaccurate(monkeypatch: pytest.MonkeyPatch, file: Path) -> None:
    home = import_module("optimizer.optimize")
    real = home.optimize

    def inaccurate(request: Any) -> OptimizeAnswer:
        return real(request).model_copy(update={"status": "inaccurate"})

    monkeypatch.setattr(home, "optimize", inaccurate)
    result = run("optimize", str(file))
    assert result.exit_code == 1
    assert "Inaccurate: the counterweights below keep the limits" in result.stdout


def test_outputs_replace_those_of_the_file(body: dict[str, Any]) -> None:
    passage = json.dumps({**body, "outputs": ["orders"]}).encode()
    first = run("analyze", "-", stdin=passage)
    assert "Orders" in first.stdout
    assert "First order" not in first.stdout
    second = run("analyze", "-", "--output", "residual", "--output", "stages", "--output", "hodograph", stdin=passage)
    assert second.exit_code == 0
    for text in ("First order", "balancing stages", "VIII", "Over 360 shaft angles", "largest force, N"):
        assert text in second.stdout
    assert "order 4" not in second.stdout
    assert "Orders" in run("optimize", "-", "--output", "orders", stdin=passage).stdout


def test_analyze_prints_what_is_fitted(body: dict[str, Any]) -> None:
    body["counterweights"] = [{"web": "1a", "mass_kg": 12.5, "angle_deg": 180}]
    result = run("analyze", "-", stdin=json.dumps(body).encode())
    assert result.exit_code == 0
    assert "12.5" in result.stdout
    assert "total mass of the counterweights, kg │ 12.5" in result.stdout
    del body["counterweights"]
    assert "total mass" not in run("analyze", "-", stdin=json.dumps(body).encode()).stdout


@pytest.mark.parametrize("name", part(3, names()))
def test_every_example_has_tables(name: str) -> None:
    every = ("--output", "residual", "--output", "stages", "--output", "orders", "--output", "hodograph")
    assert run("optimize", str(directory() / f"{name}.json"), *every).exit_code == 0


def test_names_are_no_markup(body: dict[str, Any]) -> None:
    body["machine"]["name"] = "[red]machine[/red]"
    body["machine"]["webs"][0]["name"] = "[bold]a[/]"
    result = run("optimize", "-", stdin=json.dumps(body).encode())
    assert "[red]machine[/red]: optimal" in result.stdout
    assert "[bold]a[/]" in result.stdout


@pytest.mark.parametrize("command", ["optimize", "analyze"])
def test_bad_input(tmp_path: Path, body: dict[str, Any], command: str) -> None:
    assert refused(run(command, str(tmp_path / "nothing.json")))[0].endswith("No such file or directory")
    assert refused(run(command, str(tmp_path)))[0].endswith("Is a directory")
    assert refused(run(command, "-", stdin=b"")) == ["standard input is not JSON: there is no JSON"]
    assert refused(run(command, "-", stdin=b"\xff")) == ["standard input is not JSON: not UTF-8 at byte 0"]
    assert refused(run(command, "-", stdin=b"[" * 100_000)) == ["standard input is not JSON: nested too deeply"]
    (line,) = refused(run(command, "-", stdin=b"{\n  nonsense"))
    assert "line 2, column 3" in line
    assert refused(run(command, "-", stdin=b"[]")) == ["the request: must be an object"]
    body["machine"]["throws"][0]["crank_radius_m"] = -1
    del body["machine"]["webs"][0]["name"]
    assert refused(run(command, "-", stdin=json.dumps(body).encode())) == [
        "/machine/webs/0/name: this field is required",
        "/machine/throws/0/crank_radius_m: must be at least 1e-12",
    ]


def test_the_wording_is_that_of_the_service(client: TestClient, body: dict[str, Any]) -> None:
    body["machine"]["kind"] = "turbine"
    body["angles"] = {"step_deg": "7 deg"}
    errors = client.post("/v1/optimize", json=body).json()["errors"]
    lines = refused(run("optimize", "-", stdin=json.dumps(body).encode()))
    assert lines == [f"{error['pointer']}: {error['message']}" for error in errors]


def test_many_errors_end_with_a_note(body: dict[str, Any]) -> None:
    lines = refused(run("optimize", "-", stdin=json.dumps({**body, **{f"x{k}": 0 for k in range(99)}}).encode()))
    assert (len(lines), lines[-1]) == (51, "... and more")


@pytest.mark.parametrize("command", ["optimize", "analyze"])
def test_an_input_that_an_output_needs(body: dict[str, Any], command: str) -> None:
    del body["machine"]["throws"][0]["rows"][0]["connecting_rod"]
    (line,) = refused(run(command, "-", "--output", "stages", stdin=json.dumps(body).encode()))
    assert line.startswith("/machine/throws/0/rows/0/connecting_rod: ")
    (line,) = refused(run(command, "-", "--output", "smell", stdin=json.dumps(body).encode()))
    assert line.startswith("/outputs/0: must be 'residual'")


@pytest.mark.parametrize(
    "arguments", [["optimize"], ["optimise", "-"], ["optimize", "-", "--jason"], ["serve", "--port", "x"]]
)
def test_wrong_usage(arguments: list[str]) -> None:
    assert run(*arguments).exit_code == 2


def test_examples() -> None:
    listed = run("examples")
    assert listed.exit_code == 0
    assert all(name in listed.stdout for name in names())
    assert run("examples", "--json").stdout == catalogue().model_dump_json() + "\n"
    printed = run("examples", "2d12")
    assert json.loads(printed.stdout) == json.loads(load("2d12"))
    assert run("optimize", "-", stdin=printed.stdout_bytes).exit_code == 0
    assert "no example of this name" in refused(run("examples", "../pyproject"))[0]


def test_schema() -> None:
    assert "optimize-answer" in run("schema").stdout
    assert json.loads(run("schema", "optimize").stdout)["title"] == "Optimize request"
    answer = json.loads(run("schema", "optimize-answer").stdout)
    assert answer["title"] == "Optimize answer"
    assert answer["$defs"]["Counterweight"]["properties"]["mass_kg"]["x-unit"] == "kg"
    assert "no document of this name" in refused(run("schema", "nothing"))[0]


def start(*arguments: str, **options: Any) -> "subprocess.Popen[bytes]":
    return subprocess.Popen([sys.executable, "-m", "service", *arguments], cwd=ROOT, **options)


def test_a_real_process() -> None:
    pipe = subprocess.PIPE
    with start("optimize", "-", stdin=pipe, stdout=pipe, stderr=pipe) as process:
        out, err = process.communicate(load("v90-equal"), timeout=180)
    assert (process.returncode, err) == (0, b"")
    assert "V 90 degrees, equal rows: optimal" in out.decode()


def test_a_closed_pipe_is_said_without_a_traceback() -> None:
    with start("examples", "2d12", stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.close()
        content = process.stderr.read().decode()
    assert process.returncode == 2
    assert content.splitlines() == ["cannot write to standard output: Broken pipe"]


@pytest.mark.parametrize("level", part(2, [None, "debug"]))
def test_a_fault_of_the_program_is_no_infeasible_answer(level: str | None) -> None:
    code = (
        "import sys, optimizer.optimize, service.cli\n"
        "def broken(*_): raise ZeroDivisionError('as a fault\\nwould')\n"
        "sys.modules['optimizer.optimize'].prepare = broken\n"
        "service.cli.main()"
    )
    fields = {name: value for name, value in os.environ.items() if name != "COUNTERWEIGHT_LOG_LEVEL"}
    environment = fields if level is None else {**fields, "COUNTERWEIGHT_LOG_LEVEL": level}
    process = subprocess.run(
        [sys.executable, "-c", code, "optimize", "-"],
        input=load("v90-equal"), cwd=ROOT, timeout=180, capture_output=True, env=environment, check=False,
    )  # fmt: skip
    assert (process.returncode, process.stdout) == (70, b"")
    *before, last = process.stderr.decode().splitlines()
    assert last.startswith("internal fault, not of the input: ZeroDivisionError: as a fault (")
    assert bool(before) == (level == "debug")
    assert not before or before[0].startswith("Traceback")


def test_help_does_not_load_the_optimiser() -> None:
    code = (
        "import sys, service.cli\n"
        "loaded = {'cvxpy', 'numpy', 'uvicorn', 'fastapi', 'pydantic', 'optimizer'} & set(sys.modules)\n"
        "sys.exit(str(loaded) if loaded else 0)"
    )
    assert subprocess.run([sys.executable, "-c", code], cwd=ROOT, timeout=180).returncode == 0
    assert "optimize" in run("--help").stdout


def test_a_first_answer_loads_nothing_that_no_terminal_shows() -> None:
    code = (
        "import os, sys, service.cli\n"
        "sys.argv[1:] = ['optimize', '-']\n"
        "try:\n"
        "    service.cli.main()\n"
        "except SystemExit:\n"
        "    threads = len(os.listdir('/proc/self/task'))\n"
        "    plugins = sys.modules['pydantic.plugin._loader']._plugins\n"
        "    drawings = [name for name in sys.modules if name.startswith('service.drawings.')]\n"
        "    print(threads, plugins, *drawings, file=sys.stderr)"
    )
    fields = {name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"}
    process = subprocess.run(
        [sys.executable, "-c", code], input=load("v90-equal"), cwd=ROOT, timeout=180, capture_output=True, env=fields,
        check=True,
    )  # fmt: skip
    assert "V 90 degrees, equal rows: optimal" in process.stdout.decode()
    # pens and paper; no machine is drawn with them
    assert process.stderr.decode().split() == ["1", "None", "service.drawings.svg"]


def test_version(client: TestClient) -> None:
    process = run("--version")
    assert (process.exit_code, process.stdout) == (0, f"{version(DISTRIBUTION)}\n")
    answer = client.get("/v1/version").json()
    assert answer == {"version": version(DISTRIBUTION), "processor": processor()}
