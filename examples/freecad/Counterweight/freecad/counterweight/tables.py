"""Spreadsheets of a document as tables. Needs FreeCAD, no window."""

from __future__ import annotations

import re

import FreeCAD as App

from .sheets import Wrong, letters

_ADDRESS = re.compile(r"([A-Z]{1,2})([0-9]+)")
#: what a number in FreeCAD's own unit is in that of the field
_SI = {"Length": 1e-3, "Mass": 1.0, "Angle": 1.0, "": 1.0}


def table_of(sheet):
    """The values of all cells, a quantity with its unit as a number in m, kg or degrees.

    Raises
    ------
    Wrong
    """
    cells = {}
    for name in sheet.PropertiesList:
        address = _ADDRESS.fullmatch(name)
        if address:
            cells[int(address[2]), address[1]] = _value(sheet, name)
    rows = max((row for row, _ in cells), default=0)
    columns = max((_number(column) for _, column in cells), default=-1) + 1
    return [[cells.get((row, letters(column))) for column in range(columns)] for row in range(1, rows + 1)]


def write(sheet, table):
    """Fill a sheet; every text stays text, whatever it begins with."""
    for row, line in enumerate(table, start=1):
        for column, value in enumerate(line):
            if value is not None:
                content = f"'{value}" if isinstance(value, str) else repr(value)
                sheet.set(f"{letters(column)}{row}", content)


def _value(sheet, name):
    value = sheet.get(name)
    if isinstance(value, App.Units.Quantity):
        if value.Unit.Type not in _SI:
            raise Wrong([f"{sheet.Label}!{name}: {value} is no length, mass or angle"])
        return value.Value * _SI[value.Unit.Type]
    if isinstance(value, str):
        return value.strip() or None
    return value


def _number(column):
    number = 0
    for letter in column:
        number = 26 * number + ord(letter) - ord("A") + 1
    return number - 1
