"""Files of spreadsheets: formulas, and what is no workbook."""

import io
import random
from contextlib import suppress
from datetime import datetime
from zipfile import ZIP_DEFLATED, ZipFile

import openpyxl
import pytest

from service.documents.examples import bodies
from service.workbook.files import UnreadableWorkbook, workbook, workbook_sheets
from service.workbook.sheets import Misplaced, request_sheets


def saved(**cells: object) -> bytes:
    book = openpyxl.Workbook()
    book.active.title = "webs"
    for place, value in cells.items():
        book.active[place] = value
    out = io.BytesIO()
    book.save(out)
    return out.getvalue()


def changed(content: bytes, part: str, old: bytes, new: bytes) -> bytes:
    out = io.BytesIO()
    with ZipFile(io.BytesIO(content)) as source, ZipFile(out, "w", ZIP_DEFLATED) as target:
        for name in source.namelist():
            inside = source.read(name)
            target.writestr(name, inside.replace(old, new) if name == part else inside)
    return out.getvalue()


def test_a_formula_is_never_computed_but_its_saved_value_is_read() -> None:
    content = saved(A1="max_mass_kg", A2="=30*2")
    with pytest.raises(Misplaced) as refused:
        workbook_sheets(content)
    assert refused.value.lines == ["webs!A2: a formula without a value; save the file in the program that computes it"]
    # as a program saves it that has computed it
    computed = changed(content, "xl/worksheets/sheet1.xml", b"<f>30*2</f><v></v>", b"<f>30*2</f><v>61</v>")
    assert computed != content
    assert workbook_sheets(computed) == {"webs": [["max_mass_kg"], [61]]}


def test_dates_are_refused() -> None:
    with pytest.raises(Misplaced) as refused:
        workbook_sheets(saved(A1="name", B2=datetime(2026, 1, 2)))
    assert refused.value.lines == ["webs!B2: neither a number nor a text"]


def test_hidden_sheets_and_blanks_say_nothing() -> None:
    book = openpyxl.Workbook()
    book.active.title = "webs"
    book.active["A1"], book.active["A2"] = "name", "   "
    book.create_sheet("notes").sheet_state = "hidden"
    out = io.BytesIO()
    book.save(out)
    assert workbook_sheets(out.getvalue()) == {"webs": [["name"], [None]]}


def test_a_bomb_is_not_unpacked() -> None:
    out = io.BytesIO()
    with ZipFile(out, "w", ZIP_DEFLATED) as archive:
        archive.writestr("xl/workbook.xml", b"0" * 30_000_000)
    with pytest.raises(UnreadableWorkbook, match="more than 20 MB"):
        workbook_sheets(out.getvalue())


def test_entities_are_not_expanded() -> None:
    levels = b"".join(b'<!ENTITY a%d "%s">' % (k, b"&a%d;" % (k - 1) * 10) for k in range(1, 10))
    bomb = b'<?xml version="1.0"?><!DOCTYPE x [<!ENTITY a0 "lol">' + levels + b"]><x>&a9;</x>"
    content = saved(A1="name")
    with ZipFile(io.BytesIO(content)) as archive:
        whole = archive.read("xl/worksheets/sheet1.xml")
    with pytest.raises(UnreadableWorkbook):
        workbook_sheets(changed(content, "xl/worksheets/sheet1.xml", whole, bomb))


def test_broken_files_are_refused_in_words() -> None:
    content, dice = workbook(request_sheets(bodies()["2d12"])), random.Random(1)
    for _ in range(60):
        broken = bytearray(content)
        for _ in range(dice.randrange(1, 20)):
            broken[dice.randrange(len(broken))] = dice.randrange(256)
        # nothing else is raised
        with suppress(UnreadableWorkbook, Misplaced):
            workbook_sheets(bytes(broken[: dice.randrange(len(broken) // 2, len(broken) + 1)]))
    with pytest.raises(UnreadableWorkbook, match="no xlsx file"):
        workbook_sheets(b"{}")
