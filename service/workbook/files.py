"""Sheets as files: xlsx, read without running anything and written without anything that runs."""

import io
import re
import warnings
from collections.abc import Iterator
from typing import Any
from zipfile import ZipFile

from openpyxl import Workbook, load_workbook
from openpyxl.cell.cell import TYPE_FORMULA
from openpyxl.styles import Font
from openpyxl.utils import get_column_letter

from service.plain import plain
from service.validation import UnreadableBody
from service.workbook.sheets import Cell, Misplaced, Sheets

#: unpacked; a machine of a hundred webs takes a hundredth of it
_MOST_BYTES = 20_000_000
_MOST_PARTS = 1_000
_MOST_LINES = 10_000
_MOST_COLUMNS = 300
#: of a cell, which the format allows
_LONGEST = 32_767
_WIDEST = 60
#: of XML, in whatever code: no workbook has such
_DEFINES = re.compile(rb"<\0*!\0*(?:D\0*O\0*C\0*T|E\0*N\0*T)", re.IGNORECASE)


class UnreadableWorkbook(UnreadableBody):
    """The bytes are no workbook, or one that is too large."""


def workbook_sheets(content: bytes, most_bytes: int = _MOST_BYTES) -> Sheets:
    """The cells of a workbook; of formulas the values that were saved with them, as nothing is computed here.

    Parameters
    ----------
    most_bytes : that it may hold unpacked.

    Raises
    ------
    UnreadableWorkbook
    Misplaced
        if a formula has no value, or a cell holds neither number nor text.
    """
    _require_small(content, most_bytes)
    try:
        with warnings.catch_warnings():
            # what it does not support, such as rules of validation, is of no use here
            warnings.simplefilter("ignore")
            values, texts = (load_workbook(io.BytesIO(content), read_only=True, data_only=of) for of in (True, False))
            wrong: list[str] = []
            found = {
                sheet.title: list(_lines(sheet, texts[sheet.title], wrong))
                for sheet in values.worksheets
                if sheet.sheet_state == "visible"
            }
    except UnreadableWorkbook:
        raise
    # whatever the library raises on files that are broken
    except Exception as error:
        raise UnreadableWorkbook(f"it cannot be read: {type(error).__name__}") from error
    if wrong:
        raise Misplaced(wrong)
    return found


def _require_small(content: bytes, most_bytes: int) -> None:
    try:
        with ZipFile(io.BytesIO(content)) as archive:
            parts = archive.infolist()
            if len(parts) > _MOST_PARTS or sum(part.file_size for part in parts) > most_bytes:
                raise UnreadableWorkbook(f"it holds more than {most_bytes / 1e6:g} MB or {_MOST_PARTS} files")
            # what is read ends where the part says that it ends; definitions could be repeated without end
            if any(_DEFINES.search(archive.read(part)) for part in parts):
                raise UnreadableWorkbook("it defines its own entities")
    except UnreadableWorkbook:
        raise
    # whatever the library raises on files that are broken
    except Exception as error:
        raise UnreadableWorkbook("it is no xlsx file") from error


def _lines(values: Any, texts: Any, wrong: list[str]) -> Iterator[list[Cell]]:
    title = values.title
    for number, (line, behind) in enumerate(zip(values.iter_rows(), texts.iter_rows(), strict=True), start=1):
        if number > _MOST_LINES or len(line) > _MOST_COLUMNS:
            raise UnreadableWorkbook(f"{title} has more than {_MOST_LINES} lines or {_MOST_COLUMNS} columns")
        for column, (cell, source) in enumerate(zip(line, behind, strict=True), start=1):
            fault = _fault(cell, source)
            if fault:
                wrong.append(f"{title}!{get_column_letter(column)}{number}: {fault}")
        yield [cell.value.strip() or None if isinstance(cell.value, str) else cell.value for cell in line]


def _fault(cell: Any, source: Any) -> str:
    """What is wrong with a cell, of its value and of what is behind it."""
    if cell.value is None:
        unsaved = source.data_type == TYPE_FORMULA
        return "a formula without a value; save the file in the program that computes it" if unsaved else ""
    return "" if isinstance(cell.value, str | float | int | bool) else "neither a number nor a text"


def workbook(sheets: Sheets) -> bytes:
    """A file of sheets; every text stays text, whatever it begins with."""
    book = Workbook()
    book.remove(book.active)
    for name, lines in sheets.items():
        sheet = book.create_sheet(name)
        widths: dict[int, int] = {}
        for number, line in enumerate(lines, start=1):
            for column, value in enumerate(line, start=1):
                cell = sheet.cell(number, column, _fitting(value))
                if isinstance(value, str):
                    cell.data_type = "s"
                if number == 1:
                    cell.font = Font(bold=True)
                widths[column] = max(widths.get(column, 0), len(str(value)))
        for column, width in widths.items():
            sheet.column_dimensions[get_column_letter(column)].width = min(_WIDEST, width + 2)
        sheet.freeze_panes = "A2"
    out = io.BytesIO()
    book.save(out)
    return out.getvalue()


def _fitting(value: Cell) -> Cell:
    if not isinstance(value, str):
        return value
    text = plain(value)
    return text if len(text) <= _LONGEST else f"too long for a cell ({len(text)} characters): see the JSON answer"
