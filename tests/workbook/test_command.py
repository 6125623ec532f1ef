"""A workbook in, a workbook out, on the command line."""

import json
from pathlib import Path

import openpyxl
import pytest
from typer.testing import CliRunner

from service.cli import app

RUN = CliRunner()


@pytest.fixture
def machine(tmp_path: Path) -> Path:
    path = tmp_path / "machine.xlsx"
    assert RUN.invoke(app, ["template", str(path), "--example", "2d12"]).exit_code == 0
    return path


def changed(path: Path, sheet: str, cell: str, value: object) -> None:
    book = openpyxl.load_workbook(path)
    book[sheet][cell] = value
    book.save(path)


def test_a_workbook_is_answered_as_its_json_is(machine: Path, tmp_path: Path) -> None:
    to = tmp_path / "answer.xlsx"
    process = RUN.invoke(app, ["optimize", str(machine), "--json", "--to", str(to)])
    assert process.exit_code == 0, process.output
    document, same = (json.loads(RUN.invoke(app, ["optimize", file, "--json"]).stdout) for file in (
        str(machine), "examples/2d12.json"
    ))  # fmt: skip
    assert document["counterweights"] == same["counterweights"]
    book = openpyxl.load_workbook(to)
    heads, *lines = book["counterweights"].iter_rows(values_only=True)
    mass = heads.index("mass_kg")
    assert [line[mass] for line in lines] == pytest.approx(
        [counterweight["mass_kg"] for counterweight in same["counterweights"]], rel=1e-14
    )
    answer = dict(line[:2] for line in book["answer"].iter_rows(values_only=True))
    assert answer["status"] == "optimal"
    assert answer["residual.after.force.peak_N"] == pytest.approx(same["residual"]["after"]["force"]["peak_N"])
    # the answer holds its question, and may be asked again
    assert RUN.invoke(app, ["optimize", str(to)]).exit_code == 0


def test_what_is_wrong_is_said_by_its_cell(machine: Path) -> None:
    changed(machine, "webs", "D3", "sixty")
    changed(machine, "rows", "D2", -1)
    refused = RUN.invoke(app, ["optimize", str(machine)])
    assert refused.exit_code == 2
    assert "webs!D3: " in refused.stderr
    assert "rows!D2: " in refused.stderr


def test_what_does_not_go_together_is_said_by_its_cell(machine: Path) -> None:
    # what an output needs is known only when it is asked for
    changed(machine, "machine", "A20", "outputs")
    changed(machine, "machine", "B20", '["torque"]')
    changed(machine, "rows", "E3", None)
    refused = RUN.invoke(app, ["optimize", str(machine)])
    assert refused.exit_code == 2
    assert "rows, line 3: connecting_rod.length_m: " in refused.stderr


@pytest.mark.parametrize(
    ("command", "text"),
    [
        (["template", "machine.csv"], "must end in .xlsx"),
        (["template", "no/folder/machine.xlsx"], "cannot write"),
        (["template", "machine.xlsx", "--example", "none"], "no example of this name"),
        (["optimize", "none.xlsx"], "cannot read none.xlsx"),
        (["optimize", "examples/2d12.json", "--to", "answer.csv"], "must end in .xlsx"),
        (["optimize", "examples/2d12.json", "--to", "no/folder/answer.xlsx"], "cannot write"),
    ],
)
def test_bad_files_are_a_line_and_the_exit_code_2(command: list[str], text: str) -> None:
    refused = RUN.invoke(app, command)
    assert (refused.exit_code, text in refused.stderr) == (2, True), refused.output
