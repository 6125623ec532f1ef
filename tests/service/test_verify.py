"""The checker as a file, as a command and behind its route: one and the same."""

import json
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result
from starlette.testclient import TestClient
from typer.testing import CliRunner

from optimizer.optimize import optimize
from schemas.base.version import package_version
from schemas.request.requests import OptimizeRequest
from service.cli import app
from service.documents.examples import bodies
from service.verification import checker

CLIENT = Path(__file__).parents[2] / "examples" / "client"
#: what has to lie beside one another
FILES = sorted(CLIENT.glob("verify*.py"))
BODY = bodies("")["2d12"]


@pytest.fixture(scope="module")
def answer() -> dict[str, Any]:
    fields: dict[str, Any] = optimize(OptimizeRequest.model_validate(BODY)).model_dump(mode="json")
    return fields


@pytest.fixture
def files(answer: dict[str, Any], tmp_path: Path) -> tuple[Path, Path]:
    request, path = tmp_path / "request.json", tmp_path / "answer.json"
    request.write_text(json.dumps(BODY))
    path.write_text(json.dumps(answer))
    return request, path


def alone(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """The files by themselves, far from the project, with nothing but the standard library."""
    for file in FILES:
        shutil.copy(file, folder)
    command = [sys.executable, "-E", "-s", "-S", "-W", "error", "verify.py", *arguments]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=180, check=False)


def command(*arguments: str) -> Result:
    return CliRunner().invoke(app, ["verify", *arguments])


def test_the_file_alone(files: tuple[Path, Path]) -> None:
    ran = alone(files[0].parent, *map(str, files))
    assert ran.returncode == 0, ran.stderr
    assert "objective" in ran.stdout
    assert "broken" not in ran.stdout


def test_what_clients_copy_needs_python_3_8() -> None:
    """As far as the grammar tells; the linter looks at the names for that version."""
    import ast

    files = sorted(CLIENT.glob("*.py"))
    for file in files:
        tree = ast.parse(file.read_text(), feature_version=(3, 8))
        names = {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
        names |= {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module}
        assert {name.partition(".")[0] for name in names} <= {*sys.stdlib_module_names, *(file.stem for file in files)}


def test_a_broken_claim_has_an_exit_code(files: tuple[Path, Path], answer: dict[str, Any]) -> None:
    wrong = {**answer, "total_mass_kg": answer["total_mass_kg"] * (1 + 1e-6)}
    files[1].write_text(json.dumps(wrong))
    assert alone(files[0].parent, *map(str, files)).returncode == 1
    ran = command(*map(str, files))
    assert ran.exit_code == 1
    assert "broken" in ran.stdout
    assert "/answer/total_mass_kg" in ran.stdout


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("{", "not JSON"),
        ("[" * 100_000, "nested"),
        ("[]", "/answer: must be an object"),
        ('{"status": "perfect"}', "/answer/status: must be one of"),
        ('{"status": "optimal", "counterweights": [{"web": "1a", "mass_kg": 1e999}]}', "mass_kg"),
        ("1" * 5000, ""),
    ],
)
def test_what_cannot_be_read_is_said(files: tuple[Path, Path], text: str, words: str) -> None:
    files[1].write_text(text)
    by_itself, by_command = alone(files[0].parent, *map(str, files)), command(*map(str, files))
    for code, stderr in ((by_itself.returncode, by_itself.stderr), (by_command.exit_code, by_command.stderr)):
        assert code == 2
        assert words in stderr
        assert "Traceback" not in stderr


def test_files_that_are_not_there(files: tuple[Path, Path]) -> None:
    assert alone(files[0].parent, str(files[0]), "nowhere.json").returncode == 2
    assert alone(files[0].parent).returncode == 2
    assert command(str(files[0]), "nowhere.json").exit_code == 2


def test_what_is_not_covered_has_an_exit_code_of_its_own(tmp_path: Path) -> None:
    """Nothing is broken, and what nobody looked at is named."""
    body = bodies("")["catalogue-twin"]
    answer = optimize(OptimizeRequest.model_validate(body)).model_dump(mode="json")
    # of a choice no tree is searched again
    unproven = "/answer/certificate/lower_bound"
    files = tmp_path / "request.json", tmp_path / "answer.json"
    for file, held in zip(files, (body, answer), strict=True):
        file.write_text(json.dumps(held))
    by_file, by_command = alone(tmp_path, *map(str, files)), command(*map(str, files))
    assert (by_file.returncode, by_command.exit_code) == (3, 3)
    verdict = json.loads(command(*map(str, files), "--json").stdout)
    assert verdict["verdict"] == "not covered"
    assert verdict["not_covered"] == [unproven]
    assert verdict["checked"] < verdict["leaves"]
    for stdout in (by_file.stdout, by_command.stdout):
        assert unproven in stdout
        assert f"{verdict['checked']} of {verdict['leaves']}" in stdout


def test_every_claim_of_an_answer_is_counted(answer: dict[str, Any]) -> None:
    verdict = checker().verify(BODY, answer)
    assert verdict["checked"] == verdict["leaves"] > 150
    assert verdict["not_covered"] == []


def test_file_command_and_route_say_the_same(client: TestClient, files: tuple[Path, Path], answer: Any) -> None:
    posted = client.post("/v1/verify", json={"request": BODY, "answer": answer})
    assert posted.status_code == 200
    # the file belongs to no version; the service says its own
    assert posted.json() == {"version": package_version(), **checker().verify(BODY, answer)}
    assert json.loads(command(*map(str, files), "--json").stdout) == posted.json()


@pytest.mark.parametrize(
    ("body", "pointer"),
    [
        ({"request": BODY}, "/answer"),
        ({"request": BODY, "answer": {}}, "/answer/status"),
        ({"request": {}, "answer": {"status": "optimal"}}, "/request/machine/kind"),
        ({"request": {"machine": {**BODY["machine"], "speed_rpm": "9 kg"}}, "answer": {"status": "optimal"}},
         "/request/machine/speed_rpm"),
        ({"request": {"base": BODY, "axes": []}, "answer": [{"status": 5}]}, "/answer/0/status"),
    ],
)  # fmt: skip
def test_bad_input_is_named(client: TestClient, body: dict[str, Any], pointer: str) -> None:
    refused = client.post("/v1/verify", json=body)
    assert refused.status_code == 422
    assert pointer in [error["pointer"] for error in refused.json()["errors"]]


def test_the_work_of_one_request_is_bounded(client: TestClient) -> None:
    rows = [{"status": "infeasible"}] * 30_000
    refused = client.post("/v1/verify", json={"request": {"base": BODY, "axes": []}, "answer": rows})
    assert refused.status_code == 422, refused.text
    assert "more than is checked" in refused.text
