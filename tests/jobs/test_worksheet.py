"""Rows as a workbook: read back by a library, nothing a formula, what no worksheet holds refused."""

import io
from pathlib import Path
from typing import Any

import pyarrow as pa
import pytest
from openpyxl import load_workbook
from typer.testing import CliRunner

from service.cli import app
from service.jobs.worksheet import MOST_CELLS, MOST_ROWS, TooLargeForWorksheet, require_fits, worksheet
from tests.jobs.sweeps import analyses
from tests.jobs.test_cli_sweep import written
from tests.jobs.test_formats import ROWS, SCHEMA, table


def read(content: bytes) -> dict[str, list[tuple[Any, ...]]]:
    book = load_workbook(io.BytesIO(content))
    return {sheet.title: list(sheet.iter_rows(values_only=True)) for sheet in book.worksheets}


def test_rows_come_back_and_nothing_is_a_formula() -> None:
    content = b"".join(worksheet(SCHEMA, table(ROWS).to_batches()))
    data = read(content)
    # what ends a line comes back as the library has it
    expected = [tuple("\n=1" if cell == "\r=1" else cell for cell in row.values()) for row in ROWS]
    got = [tuple("\n=1" if cell in ("\r=1", "_x000D_=1") else cell for cell in row) for row in data["rows"][1:]]
    assert data["rows"][0] == tuple(SCHEMA.names)
    assert got == expected
    assert data["columns"][2] == ("force_peak_N", "N", "")
    types = {cell.data_type for sheet in load_workbook(io.BytesIO(content)).worksheets for row in sheet for cell in row}
    assert types <= {"n", "s", "inlineStr"}


def test_what_is_no_number_is_an_empty_cell() -> None:
    values = pa.table({"a": pa.array([float("nan"), float("inf"), 1.5, None])})
    assert [row[0] for row in read(b"".join(worksheet(values.schema, values.to_batches())))["rows"]] == [
        "a", None, None, 1.5, None,
    ]  # fmt: skip


@pytest.mark.parametrize(("rows", "columns"), [(MOST_ROWS, 28), (0, 16384), (1, 1)])
def test_what_fits(rows: int, columns: int) -> None:
    require_fits(rows, columns)


@pytest.mark.parametrize(
    ("rows", "columns", "text"),
    [
        (MOST_ROWS + 1, 1, "1048575 rows, and there are 1048576"),
        (1, 16385, "columns"),
        (MOST_CELLS // 30 + 1, 30, "cells"),
    ],
)
def test_what_does_not_fit(rows: int, columns: int, text: str) -> None:
    with pytest.raises(TooLargeForWorksheet, match=text):
        require_fits(rows, columns)


def test_the_command_refuses_before_anything_is_computed(tmp_path: Path) -> None:
    body = analyses(2000, 1000)
    out = tmp_path / "rows.xlsx"
    process = CliRunner().invoke(app, ["sweep", written(tmp_path, body), "-o", str(out)])
    assert process.exit_code == 2
    assert "a worksheet holds 1048575 rows, and there are 2000000" in process.output.replace("\n", " ")
    assert not out.exists()
