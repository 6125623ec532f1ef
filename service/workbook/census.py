"""What a workbook holds, counted in its XML before the library opens it: what is too large costs next to nothing.

The library makes an object of every cell up to the last one of a row, of every row up to the last one, and of every
style. So a file of some kilobytes that names one far cell, or a thousand styles, would take seconds and gigabytes.
"""

import io
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from posixpath import basename
from typing import Any
from xml.parsers import expat
from zipfile import ZipFile

from openpyxl.utils import column_index_from_string, get_column_letter

from service.common.validation import UnreadableBody

MOST_LINES = 10_000
MOST_COLUMNS = 300
#: of all sheets, with the empty ones before the last of each row; the largest machine has 30,000
MOST_CELLS = 40_000
#: of all parts; each cell is up to three
MOST_ELEMENTS = 100_000
#: of every part that is no sheet and no list of texts: styles, names, links. Spreadsheets write some hundreds
MOST_OF_A_PART = 5_000
MOST_PARTS = 200
MOST_SHEETS = 50
_PLACE = re.compile(r"([A-Z]{1,3})([1-9][0-9]{0,6})")


class UnreadableWorkbook(UnreadableBody):
    """The bytes are no workbook, or one that is too large."""


@dataclass
class Census:
    """What was counted.

    titles : of the sheets, by the name of their parts.
    unsaved : cells with a formula that has no value, by the name of the part of their sheet.
    """

    titles: dict[str, str] = field(default_factory=dict)
    unsaved: dict[str, list[str]] = field(default_factory=dict)
    elements: int = 0
    cells: int = 0

    def of_sheets(self) -> Iterator[tuple[str, str]]:
        """Title of the sheet and place of every formula without a value."""
        for part, places in self.unsaved.items():
            for place in places:
                yield self.titles.get(part, part), place


def census(content: bytes, most_bytes: int) -> Census:
    """Count what is in a workbook.

    Parameters
    ----------
    most_bytes : that it may hold unpacked.

    Raises
    ------
    UnreadableWorkbook
        if it is too large, declares entities, or is no archive.
    """
    result = Census()
    try:
        with ZipFile(io.BytesIO(content)) as archive:
            parts = archive.infolist()
            if len(parts) > MOST_PARTS or sum(part.file_size for part in parts) > most_bytes:
                raise UnreadableWorkbook(f"it holds more than {most_bytes / 1e6:g} MB or {MOST_PARTS} files")
            relations = _Relations()
            # the list of the sheets first, so that what follows can be named; what is read ends where the part says
            for part in sorted(parts, key=lambda part: "workbook.xml" not in part.filename):
                _Part(basename(part.filename), result, relations).count(archive.read(part))
                result.titles |= relations.titles()
    except UnreadableWorkbook:
        raise
    # whatever the library raises on files that are broken
    except Exception as error:
        raise UnreadableWorkbook("it is no xlsx file") from error
    return result


@dataclass
class _Relations:
    """Sheets and parts of the archive, each by the identity of their relation."""

    sheets: dict[str, str] = field(default_factory=dict)
    parts: dict[str, str] = field(default_factory=dict)

    def add_sheet(self, identity: str, title: str) -> None:
        if len(self.sheets) == MOST_SHEETS:
            raise UnreadableWorkbook(f"it has more than {MOST_SHEETS} sheets")
        if identity in self.sheets or title in self.sheets.values():
            raise UnreadableWorkbook(f"it has the sheet {title} twice")
        self.sheets[identity] = title

    def titles(self) -> dict[str, str]:
        """Titles of the sheets by the names of their parts."""
        sheets = {identity: title for identity, title in self.sheets.items() if identity in self.parts}
        titles = {self.parts[identity]: title for identity, title in sheets.items()}
        if len(titles) < len(sheets):
            raise UnreadableWorkbook("two of its sheets are the same part")
        return titles


class _Part:
    """One part of the archive while it is parsed."""

    def __init__(self, name: str, census_of_file: Census, relations: _Relations) -> None:
        self._name, self._census, self._relations = name, census_of_file, relations
        self._root, self._elements = "", 0
        self._line, self._column = 0, 0
        self._formula, self._value, self._inside = False, False, ""

    def count(self, content: bytes) -> None:
        parser = expat.ParserCreate()
        parser.buffer_text = True
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._text
        parser.StartDoctypeDeclHandler = self._doctype
        try:
            parser.Parse(content, True)
        except expat.ExpatError as error:
            # a picture is none; what is XML up to a fault the library refuses there as well
            if self._root == "worksheet":
                raise UnreadableWorkbook(f"{self._title} is no XML") from error

    @property
    def _title(self) -> str:
        return self._census.titles.get(self._name, self._name)

    def _doctype(self, *_: Any) -> None:
        raise UnreadableWorkbook("it defines its own entities")

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        name = name.rpartition(":")[2]
        self._root = self._root or name
        self._elements += 1
        self._census.elements += 1
        free = self._root in ("worksheet", "sst")
        if self._census.elements > MOST_ELEMENTS or (self._elements > MOST_OF_A_PART and not free):
            raise UnreadableWorkbook(f"{self._title} has more than {self._elements - 1} elements")
        if self._root == "worksheet":
            self._of_sheet(name, attributes)
        elif name == "sheet":
            identity = next((value for key, value in attributes.items() if key.endswith(":id")), "")
            self._relations.add_sheet(identity, attributes.get("name", ""))
        elif name == "Relationship" and self._name == "workbook.xml.rels":
            self._relations.parts[attributes.get("Id", "")] = basename(attributes.get("Target", ""))

    def _of_sheet(self, name: str, attributes: dict[str, str]) -> None:
        self._inside = name
        if name == "row":
            number = attributes.get("r", "")
            self._line = int(number) if number.isascii() and number.isdigit() and len(number) < 9 else self._line + 1
            self._column = 0
        elif name == "c":
            place = _PLACE.fullmatch(attributes.get("r", ""))
            column = column_index_from_string(place[1]) if place else self._column + 1
            line = int(place[2]) if place else self._line
            self._census.cells += max(column - self._column, 1)
            self._line, self._column = line, column
            self._formula = self._value = False
        elif name == "f":
            self._formula = True
        if self._line > MOST_LINES or self._column > MOST_COLUMNS:
            where = f"{get_column_letter(min(self._column, 18_278)) if self._column else 'A'}{self._line}"
            raise UnreadableWorkbook(
                f"{self._title}!{where}: a sheet has at most {MOST_LINES} lines and {MOST_COLUMNS} columns"
            )
        if self._census.cells > MOST_CELLS:
            raise UnreadableWorkbook(f"{self._title}: all sheets together have at most {MOST_CELLS} cells")

    def _text(self, text: str) -> None:
        if self._inside in ("v", "t") and text:
            self._value = True

    def _end(self, name: str) -> None:
        name = name.rpartition(":")[2]
        if name == "c" and self._formula and not self._value:
            place = f"{get_column_letter(self._column)}{self._line}"
            self._census.unsaved.setdefault(self._name, []).append(place)
        self._inside = ""
