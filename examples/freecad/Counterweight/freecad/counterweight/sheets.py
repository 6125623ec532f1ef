"""A machine in four tables, as a designer fills them in, and the request that they say. No CAD.

``machine`` has a line for each field: its path with dots, its value. ``throws``, ``rows`` and ``webs`` have a line for
each of them below a line of headings, which are paths of fields too, with their units in their names. An empty cell
leaves its field out. Three columns are no fields: ``use`` (no: the line does not count), ``throw`` (name of the throw
that a row is on) and ``rod`` (label of the body that is the row's connecting rod).
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any, Dict, List, Mapping, Sequence, Tuple, Union

from .quantities import quantity

Cell = Union[str, float, int, None]
Table = List[List[Cell]]

MACHINE, THROWS, ROWS, WEBS = "machine", "throws", "rows", "webs"
USE, THROW, ROD = "use", "throw", "rod"
_NO = ("no", "0", "false")
#: what ends the name of a field that is a number
_UNITS = ("_m", "_m2", "_m3", "_kg", "_kg_m3", "_deg", "_rpm", "_N", "_Nm", "_share", "_weight", "_K", "_Pa")


class Wrong(ValueError):
    """What is asked for cannot be asked so; ``lines`` say where and why."""

    def __init__(self, lines: Sequence[str]) -> None:
        self.lines = list(lines)
        super().__init__("\n".join(lines))


@dataclass
class SheetRequest:
    """A request without the masses of the solids.

    body : the request.
    cells : by JSON pointer, the cell that says a field.
    rods : label of the rod by (number of the throw, number of the row).
    """

    body: Dict[str, Any] = field(default_factory=dict)
    cells: Dict[str, str] = field(default_factory=dict)
    rods: Dict[Tuple[int, int], str] = field(default_factory=dict)

    def where(self, pointer: str) -> str:
        """The cell of a field, or of the nearest one around it."""
        at = pointer
        while at and at not in self.cells:
            at = at.rpartition("/")[0]
        return self.cells[at] + (f" ({pointer})" if at != pointer else "") if at else pointer or "the request"


def from_tables(tables: Mapping[str, Table]) -> SheetRequest:
    """The request that tables say.

    Raises
    ------
    Wrong
    """
    reader = _Reader()
    reader.single(tables.get(MACHINE, []))
    machine = reader.request.body.setdefault("machine", {})
    machine.setdefault("kind", "reciprocating")
    throws: Dict[str, int] = {}
    for item, cells, place in reader.lines(THROWS, tables.get(THROWS, [])):
        throws[str(item.get("name", ""))] = reader.put(["machine", THROWS], item, cells, place)
    for item, cells, place in reader.lines(ROWS, tables.get(ROWS, [])):
        throw, rod = str(item.pop(THROW, "")), item.pop(ROD, None)
        if throw not in throws:
            reader.wrong.append(f"{place}: throw: there is no throw {throw!r} that is used")
            continue
        number = reader.put(["machine", THROWS, throws[throw], ROWS], item, cells, place)
        if rod is not None:
            reader.request.rods[throws[throw], number] = str(rod)
    for item, cells, place in reader.lines(WEBS, tables.get(WEBS, [])):
        if "envelope" not in item:
            reader.wrong.append(f"{place}: a web needs its envelope: nothing could be drawn")
        reader.put(["machine", WEBS], item, cells, place)
    if machine["kind"] != "reciprocating" or "balance_shafts" in machine or "unbalances" in machine:
        reader.wrong.append(f"{MACHINE}: one crankshaft, whose unbalances come from its solids")
    if not throws:
        reader.wrong.append(f"{THROWS}: no throw is used")
    if not machine.get(WEBS):
        reader.wrong.append(f"{WEBS}: no web is used")
    if reader.wrong:
        raise Wrong(reader.wrong)
    return reader.request


@dataclass
class _Reader:
    request: SheetRequest = field(default_factory=SheetRequest)
    wrong: List[str] = field(default_factory=list)

    def single(self, table: Table) -> None:
        for number, line in enumerate(table[1:], start=2):
            name, value = [*line, None, None][:2]
            if name is not None and value is not None:
                self._set(self.request.body, self.request.cells, str(name), value, f"{MACHINE}!B{number}")

    def lines(self, sheet: str, table: Table) -> List[Tuple[Dict[str, Any], Dict[str, str], str]]:
        """What every line says, with the cells of its fields, and where it stands."""
        heads = table[0] if table else []
        items = []
        for number, line in enumerate(table[1:], start=2):
            item: Dict[str, Any] = {}
            cells: Dict[str, str] = {}
            used = True
            for column, (head, value) in enumerate(zip(heads, line)):
                if head is None or value is None:
                    continue
                if head == USE:
                    used = _text(value).lower() not in _NO
                else:
                    self._set(item, cells, str(head), value, f"{sheet}!{letters(column)}{number}")
            if item and used:
                items.append((item, cells, f"{sheet}!{number}"))
        return items

    def put(self, path: Sequence[Union[str, int]], item: Dict[str, Any], cells: Mapping[str, str], place: str) -> int:
        """Append an item to a list of the request; its number."""
        at: Any = self.request.body
        for key in path[:-1]:
            at = at[key]
        items = at.setdefault(path[-1], [])
        items.append(item)
        pointer = "".join(f"/{key}" for key in path) + f"/{len(items) - 1}"
        self.request.cells[pointer] = place
        self.request.cells.update({pointer + below: cell for below, cell in cells.items()})
        return len(items) - 1

    def _set(self, item: Dict[str, Any], cells: Dict[str, str], name: str, value: Cell, place: str) -> None:
        *path, last = name.split(".")
        for key in path:
            item = item.setdefault(key, {})
        if last in ("name", THROW, ROD):
            item[last] = _text(value)
        elif not isinstance(value, str):
            item[last] = value
        elif last.endswith(_UNITS):
            number = quantity(last, value)
            if number is None:
                self.wrong.append(
                    f"{place}: {name}: must be a number, or one with a unit such as '180 mm', not {value!r}"
                )
            else:
                item[last] = number
        else:
            item[last] = _parsed(value)
        cells["".join(f"/{key}" for key in (*path, last))] = place


def _text(value: Cell) -> str:
    """A spreadsheet makes a number of a name such as 1."""
    return value.strip() if isinstance(value, str) else f"{value:.15g}"


def _parsed(value: str) -> Any:
    """Text, or JSON in the notation of it."""
    if value not in ("null", "true", "false") and value[:1] not in ("[", "{"):
        return value
    try:
        return json.loads(value)
    except ValueError:
        return value


def letters(column: int) -> str:
    """Name of a column, counted from 0."""
    name = ""
    column += 1
    while column:
        column, rest = divmod(column - 1, 26)
        name = chr(ord("A") + rest) + name
    return name


def table(heads: Sequence[str], lines: Sequence[Mapping[str, Cell]]) -> Table:
    """A table of lines by heading."""
    return [list(heads), *([line.get(head) for head in heads] for line in lines)]


def completed(tables: Mapping[str, Table], description: Mapping[str, Any]) -> Dict[str, Table]:
    """Tables of what the faces show, with what a request says besides; its throws and webs stand in their order.

    Raises
    ------
    Wrong
    """
    machine = dict(description.get("machine", {}))
    throws, webs = [dict(throw) for throw in machine.pop(THROWS, [])], machine.pop(WEBS, [])
    lines = [throw.pop(ROWS, []) for throw in throws]
    throw_table = _with_fields(THROWS, tables[THROWS], throws)
    names = throw_table[0].index("name")
    rows = [{THROW: line[names], **flat(row)} for line, on in zip(throw_table[1:], lines) for row in on]
    heads = list(dict.fromkeys([THROW, *(name for row in rows for name in row)]))
    fields = flat({**description, "machine": machine})
    return {
        MACHINE: [["field", "value"], *([name, value] for name, value in fields.items())],
        THROWS: throw_table,
        ROWS: table(heads, rows),
        WEBS: _with_fields(WEBS, tables[WEBS], webs) if webs else tables[WEBS],
    }


def _with_fields(sheet: str, sheet_table: Table, description: Sequence[Mapping[str, Any]]) -> Table:
    """A table with what is said besides, line by line; what is doubtful does not count."""
    heads = [str(head) for head in sheet_table[0]]
    lines = [line for line in (dict(zip(heads, line)) for line in sheet_table[1:]) if line.get(USE) != "no"]
    if len(description) != len(lines):
        raise Wrong([f"{sheet}: the faces show {len(lines)}, {len(description)} are described"])
    for line, more in zip(lines, description):
        line.update(flat(more))
    return table(list(dict.fromkeys([*heads, *(key for line in lines for key in line)])), lines)


def flat(fields: Mapping[str, Any], prefix: str = "") -> Dict[str, Cell]:
    """Values by their paths with dots."""
    cells: Dict[str, Cell] = {}
    for name, value in fields.items():
        if isinstance(value, Mapping):
            cells.update(flat(value, f"{prefix}{name}."))
        else:
            plain = value is None or (isinstance(value, (str, float, int)) and not isinstance(value, bool))
            cells[f"{prefix}{name}"] = value if plain else json.dumps(value)
    return cells
