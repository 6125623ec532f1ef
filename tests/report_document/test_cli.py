"""The command that writes the document to a file."""

import json
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner, Result

from service.cli import app
from service.documents.examples import load


@pytest.fixture
def machine(tmp_path: Path) -> Path:
    file = tmp_path / "machine.json"
    file.write_bytes(load("2d12"))
    return file


def run(*words: object) -> Result:
    return CliRunner().invoke(app, ["report", *map(str, words)])


@pytest.mark.parametrize(("name", "begins"), [("report.html", b"<!DOCTYPE html>"), ("report.PDF", b"%PDF-")])
def test_the_document_is_as_its_name_says(machine: Path, tmp_path: Path, name: str, begins: bytes) -> None:
    process = run(machine, "-o", tmp_path / name)
    assert process.exit_code == 0, process.output
    assert (tmp_path / name).read_bytes().startswith(begins)


def test_outputs_asked_for_on_the_command_line(machine: Path, tmp_path: Path) -> None:
    assert run(machine, "-o", tmp_path / "report.html", "--output", "flywheel").exit_code == 0
    assert "polar moment of inertia J" in (tmp_path / "report.html").read_text()


def test_an_infeasible_machine_is_reported_and_told_by_the_exit_code(machine: Path, tmp_path: Path) -> None:
    body: dict[str, Any] = json.loads(machine.read_bytes())
    machine.write_text(json.dumps({**body, "objective": {"moment_ceiling_Nm": 1}}))
    assert run(machine, "-o", tmp_path / "report.html").exit_code == 1
    assert "Proven infeasible" in (tmp_path / "report.html").read_text()


@pytest.mark.parametrize(
    ("to", "text"),
    [("report.doc", "must end in .html or .pdf"), ("missing/report.pdf", "cannot write")],
)
def test_a_document_that_cannot_be_written(machine: Path, tmp_path: Path, to: str, text: str) -> None:
    process = run(machine, "-o", tmp_path / to)
    assert process.exit_code == 2
    assert text in process.output


def test_what_the_machine_lacks(machine: Path, tmp_path: Path) -> None:
    body: dict[str, Any] = json.loads(machine.read_bytes())
    del body["machine"]["flywheel"]
    machine.write_text(json.dumps({**body, "outputs": ["flywheel"]}))
    process = run(machine, "-o", tmp_path / "report.pdf")
    assert process.exit_code == 2
    assert "/machine/flywheel" in process.output
    assert not (tmp_path / "report.pdf").exists()
