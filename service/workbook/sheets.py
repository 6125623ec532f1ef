"""What stands in which cell: a request as sheets, and back.

The sheet `machine` has a line for each field, named by its path with dots. Throws, rows, webs, bearings and unbalances
have a sheet each, with a line for each of them and a column for each field. Units are in the names of the fields. An
empty cell leaves its field out. A text that is `null`, or begins with a bracket, a brace or a quotation mark, is JSON;
every other one is that text.
"""

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

from openpyxl.utils import get_column_letter

from schemas.base.model import FieldProblem
from schemas.base.rules import Path
from service.common.validation import UnreadableJson, json_value

Cell = str | float | int | bool | None
#: lines of cells by sheet, the headings first
Sheets = dict[str, list[list[Cell]]]

FIELDS = "machine"
_FIELD_HEADS: tuple[Cell, ...] = ("field", "value")
_THROWS = "throws"
_ROWS = "rows"
#: name of the throw that a row is on; its number from 0 where throws have no names, or some cell is no name of one
_THROW = "throw"
_TABLES = (_THROWS, _ROWS, "webs", "bearings", "unbalances")
#: sheets of an answer, which say nothing of the machine
ANSWER, COUNTERWEIGHTS, FOUNDATION, BUILT = "answer", "counterweights", "foundation_loads", "as_built"
#: sheets of a request
REQUEST = (FIELDS, *_TABLES)
_JSON = ("[", "{", '"')
#: of the JSON of all cells together [characters]; twelve indicator diagrams take a third of it
_MOST_JSON = 500_000
#: of the name of a field with its dots, and the fields in it; the longest there is has a fifth of them
_LONGEST_FIELD, _DEEPEST = 200, 16
_LONGEST_TITLE = 31
#: wrong cells that are named
_MOST_NAMES = 100


class Misplaced(ValueError):
    """Cells that say nothing of a machine; ``lines`` name them."""

    def __init__(self, lines: Sequence[str]) -> None:
        self.lines = list(lines)
        super().__init__("; ".join(lines))


@dataclass(frozen=True)
class Read:
    """A request that was read, and where its fields stand.

    cells : by path from the root of the request.
    lines : sheet and line of what has a line of its own.
    """

    body: dict[str, Any]
    cells: Mapping[Path, str]
    lines: Mapping[Path, tuple[str, int]]

    def where(self, problem: FieldProblem) -> str:
        """The cell of a field, or the line where it is missing."""
        path = problem.path
        if path in self.cells:
            return self.cells[path]
        for length in range(len(path), 0, -1):
            if path[:length] in self.lines:
                sheet, line = self.lines[path[:length]]
                return f"{sheet}, line {line}: {_dotted(path[length:])}"
        return f"{FIELDS}: {_dotted(path)}"


# ---- from a request


def request_sheets(body: Mapping[str, Any]) -> Sheets:
    """The sheets of a request."""
    machine = dict(body.get("machine", {}))
    throws = [dict(entry) for entry in machine.pop(_THROWS, ())]
    names = _throw_names(throws)
    rows = [
        {_THROW: number if names is None else names[number], **row}
        for number, throw in enumerate(throws)
        for row in throw.pop(_ROWS, ())
    ]
    tables = {_THROWS: throws, _ROWS: rows, **{name: machine.pop(name, []) for name in _TABLES[2:]}}
    fields: list[list[Cell]] = [list(_FIELD_HEADS)]
    fields += [[name, value] for name, value in flat({**body, "machine": machine})]
    return {FIELDS: fields, **{name: table(lines) for name, lines in tables.items() if lines}}


def _throw_names(throws: Any) -> list[str] | None:
    """Names of all throws, by which rows can be put on them; none where some have none, or share one."""
    names = [throw.get("name") if isinstance(throw, Mapping) else None for throw in throws]
    texts = [name for name in names if isinstance(name, str)]
    return texts if texts and len(texts) == len(names) == len(set(texts)) else None


def table(lines: Sequence[Mapping[str, Any]]) -> list[list[Cell]]:
    """A line for each, with all fields that any of them has."""
    flattened = [dict(flat(line)) for line in lines]
    heads = list(dict.fromkeys(name for line in flattened for name in line))
    return [[*heads], *([line.get(name) for name in heads] for line in flattened)]


def flat(fields: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Cell]]:
    """Paths with dots, and what stands in their cells."""
    for name, value in fields.items():
        if isinstance(value, Mapping) and value:
            yield from flat(value, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}", _cell(value)


def _cell(value: Any) -> Cell:
    plain = isinstance(value, float | int | bool) or (
        isinstance(value, str) and value != "null" and not value.startswith(_JSON)
    )
    return value if plain else json.dumps(value, ensure_ascii=False)


# ---- to a request


def read(sheets: Sheets) -> Read:
    """The request that sheets say.

    Raises
    ------
    Misplaced
    """
    reader = _Reader()
    for name, lines in sheets.items():
        if name == FIELDS:
            reader.fields(lines)
        elif name in _TABLES:
            reader.table(name, lines)
        elif name not in (ANSWER, COUNTERWEIGHTS, FOUNDATION, BUILT):
            names = ", ".join(REQUEST)
            reader.wrong.append(f"{name[:_LONGEST_TITLE]}: no sheet of a machine; these are {names}")
    return reader.result()


@dataclass
class _Reader:
    body: dict[str, Any] = field(default_factory=dict)
    tables: dict[str, list[tuple[int, dict[str, Any], dict[Path, str]]]] = field(default_factory=dict)
    cells: dict[Path, str] = field(default_factory=dict)
    wrong: list[str] = field(default_factory=list)
    json_length: int = 0

    def _refuse(self, line: str) -> None:
        self.wrong.append(line)
        if len(self.wrong) > _MOST_NAMES:
            raise Misplaced(self.wrong)

    def fields(self, lines: Sequence[Sequence[Cell]]) -> None:
        """The sheet of single fields; further columns are notes."""
        for number, line in enumerate(lines[1:], start=2):
            name, value = [*line, None, None][:2]
            place = f"{FIELDS}!B{number}"
            if name is None and value is not None:
                self._refuse(f"{place}: a value without a field beside it")
            elif name is not None and value is not None:
                self._set(self.body, self.cells, str(name), value, place)

    def table(self, sheet: str, lines: Sequence[Sequence[Cell]]) -> None:
        """A sheet of lines below headings."""
        heads = lines[0] if lines else ()
        entries = self.tables.setdefault(sheet, [])
        for number, line in enumerate(lines[1:], start=2):
            if all(value is None for value in line):
                continue
            item: dict[str, Any] = {}
            places: dict[Path, str] = {}
            for column, value in enumerate(line):
                if value is None:
                    continue
                place = f"{sheet}!{get_column_letter(column + 1)}{number}"
                head = heads[column] if column < len(heads) else None
                if head is None:
                    self._refuse(f"{place}: a value without a heading")
                else:
                    self._set(item, places, str(head), value, place)
            entries.append((number, item, places))

    def _set(self, item: dict[str, Any], places: dict[Path, str], name: str, value: Cell, place: str) -> None:
        path = _path(name)
        if path is None:
            self._refuse(f"{place}: no field has so long a name")
            return
        for key in path[:-1]:
            inner = item.setdefault(key, {})
            if not isinstance(inner, dict):
                self._refuse(f"{place}: {name} is said beside {key} as a whole")
                return
            item = inner
        if path[-1] in item:
            self._refuse(f"{place}: {name} is said twice")
            return
        try:
            item[path[-1]] = self._value(path[-1], value)
        except UnreadableJson as error:
            self._refuse(f"{place}: no JSON: {error}")
        places[path] = place

    def _value(self, name: str, value: Cell) -> Any:
        """What a cell says."""
        if isinstance(value, str) and (value == "null" or value.startswith(_JSON)):
            self.json_length += len(value)
            if self.json_length > _MOST_JSON:
                raise UnreadableJson(f"the cells up to here hold more than {_MOST_JSON} characters of it")
            return json_value(value)
        # a spreadsheet makes a number of a name such as 1
        return _text(value) if name == "name" else value

    def result(self) -> Read:
        lines: dict[Path, tuple[str, int]] = {}
        machine = self.body.setdefault("machine", {}) if self.tables else {}
        for sheet in _TABLES:
            if sheet == _ROWS:
                self._name_throws(machine)
            for number, item, places in self.tables.get(sheet, ()):
                path = self._placed(machine, sheet, number, item)
                if path is not None:
                    lines[path] = sheet, number
                    self.cells |= {(*path, *below): place for below, place in places.items()}
        if self.wrong:
            raise Misplaced(self.wrong)
        return Read(self.body, self.cells, lines)

    def _placed(self, machine: Any, sheet: str, number: int, item: dict[str, Any]) -> Path | None:
        """Put a line where it belongs; the path from the root."""
        if not isinstance(machine, dict):
            self._refuse(f"{sheet}, line {number}: the machine is said as a whole too")
            return None
        if sheet == _ROWS:
            return self._row_placed(machine.get(_THROWS, []), number, item)
        items = machine.setdefault(sheet, [])
        if not isinstance(items, list):
            self._refuse(f"{sheet}, line {number}: the sheet {FIELDS} says {sheet} too")
            return None
        items.append(item)
        return "machine", sheet, len(items) - 1

    def _name_throws(self, machine: Any) -> None:
        """Numbers in place of the names of throws, if the rows have nothing but names."""
        throws = machine.get(_THROWS) if isinstance(machine, dict) else None
        names = _throw_names(throws) if isinstance(throws, list) else None
        rows = [item for _, item, _ in self.tables.get(_ROWS, ())]
        if names is not None and all(_text(row.get(_THROW)) in names for row in rows):
            for row in rows:
                row[_THROW] = names.index(_text(row[_THROW]))

    def _row_placed(self, throws: Any, number: int, item: dict[str, Any]) -> Path | None:
        """Put a row on its throw."""
        sheet, throw = _ROWS, item.pop(_THROW, None)
        if not isinstance(throws, list):
            self._refuse(f"{sheet}, line {number}: the sheet {FIELDS} says {_THROWS} too")
            return None
        if not isinstance(throw, int | float) or throw not in range(len(throws)):
            names = _throw_names(throws)
            numbers = f"the number of its throw, from 0 to {len(throws) - 1}"
            message = numbers if names is None else f"the name of its throw: {', '.join(names[:_MOST_NAMES])}"
            message = message if throws else "there are no throws"
            self._refuse(f"{sheet}, line {number}: {_THROW}: {message}")
            return None
        bearer = throws[int(throw)]
        rows = bearer.setdefault(_ROWS, []) if isinstance(bearer, dict) else None
        if not isinstance(rows, list):
            self._refuse(f"{sheet}, line {number}: its throw is no object, or says {_ROWS} already")
            return None
        rows.append(item)
        return "machine", _THROWS, int(throw), _ROWS, len(rows) - 1


def _text(value: Any) -> Any:
    """A number as the text that it stands for; what is none, truths among them, as it is."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return value
    # no float holds a whole number of hundreds of digits
    return str(value) if isinstance(value, int) else f"{value:.15g}"


@lru_cache(512)
def _split(name: str) -> tuple[str, ...]:
    return tuple(name.split("."))


def _path(name: str) -> tuple[str, ...] | None:
    """The fields in a name with dots; None if it is longer than any."""
    if len(name) > _LONGEST_FIELD or name.count(".") >= _DEEPEST:
        return None
    return _split(name)


def _dotted(path: Path) -> str:
    return ".".join(map(str, path)) or "what it says"
