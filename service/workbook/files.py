"""Sheets as files: xlsx, read without running anything and written without anything that runs."""

import io
import warnings
from collections.abc import Collection, Iterator
from typing import Any

from openpyxl import Workbook, load_workbook
from openpyxl.styles import Font
from openpyxl.utils import get_column_letter

from service.common.plain import plain
from service.workbook.census import UnreadableWorkbook, census
from service.workbook.sheets import Cell, Misplaced, Sheets

#: unpacked; a machine of a hundred webs takes a hundredth of it
_MOST_BYTES = 20_000_000
#: of a cell, which the format allows
_LONGEST = 32_767
_WIDEST = 60


def workbook_sheets(content: bytes, most_bytes: int = _MOST_BYTES, names: Collection[str] | None = None) -> Sheets:
    """The cells of a workbook; of formulas the values that were saved with them, as nothing is computed here.

    Parameters
    ----------
    most_bytes : that it may hold unpacked.
    names : sheets whose cells are read; of others there are none. Null reads all.

    Raises
    ------
    UnreadableWorkbook
    Misplaced
        if a formula has no value, or a cell holds neither number nor text.
    """
    contents = census(content, most_bytes)
    try:
        with warnings.catch_warnings():
            # what it does not support, such as rules of validation, is of no use here
            warnings.simplefilter("ignore")
            book = load_workbook(io.BytesIO(content), read_only=True, data_only=True, keep_links=False)
            wrong: list[str] = []
            sheets = {
                sheet.title: list(_lines(sheet, wrong)) if names is None or sheet.title in names else []
                for sheet in book.worksheets
                if sheet.sheet_state == "visible"
            }
    # whatever the library raises on files that are broken
    except Exception as error:
        raise UnreadableWorkbook(f"it cannot be read: {type(error).__name__}") from error
    unsaved = "a formula without a value; save the file in the program that computes it"
    wrong += [f"{title}!{place}: {unsaved}" for title, place in contents.of_sheets() if sheets.get(title)]
    if wrong:
        raise Misplaced(wrong)
    return sheets


def _lines(sheet: Any, wrong: list[str]) -> Iterator[list[Cell]]:
    # what a sheet says of its size is not what it holds
    sheet.reset_dimensions()
    for number, line in enumerate(sheet.iter_rows(values_only=True), start=1):
        for column, value in enumerate(line, start=1):
            if not (value is None or isinstance(value, str | float | int | bool)):
                wrong.append(f"{sheet.title}!{get_column_letter(column)}{number}: neither a number nor a text")
        yield [value.strip() or None if isinstance(value, str) else value for value in line]


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
