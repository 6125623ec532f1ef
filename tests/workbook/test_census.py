"""What is too large is refused before the library opens it, by what was counted in its XML."""

import io
from collections.abc import Callable
from zipfile import ZIP_DEFLATED, ZipFile

import pytest

from service.documents.examples import bodies
from service.workbook import files
from service.workbook.body import read_workbook
from service.workbook.census import MOST_CELLS, MOST_OF_A_PART, UnreadableWorkbook, census
from service.workbook.files import workbook, workbook_sheets
from service.workbook.sheets import Misplaced, Sheets, read, request_sheets

BODY = bodies("")["2d12"]
_NAMES = b'<worksheet xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"><sheetData>'
_END = b"</sheetData></worksheet>"


def changed(sheets: Sheets, change: Callable[[dict[str, bytes]], None]) -> bytes:
    """A workbook whose parts were changed by hand."""
    with ZipFile(io.BytesIO(workbook(sheets))) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    change(parts)
    out = io.BytesIO()
    with ZipFile(out, "w", ZIP_DEFLATED) as archive:
        for name, content in parts.items():
            archive.writestr(name, content)
    return out.getvalue()


def _sheet(content: bytes) -> Callable[[dict[str, bytes]], None]:
    def change(parts: dict[str, bytes]) -> None:
        parts["xl/worksheets/sheet1.xml"] = _NAMES + content + _END

    return change


def _styles(parts: dict[str, bytes]) -> None:
    parts["xl/styles.xml"] = parts["xl/styles.xml"].replace(b"</cellXfs>", b"<xf/>" * 50_000 + b"</cellXfs>")


def _names(parts: dict[str, bytes]) -> None:
    name = b"<definedNames>" + b'<definedName name="a">b</definedName>' * 20_000 + b"</definedNames>"
    parts["xl/workbook.xml"] = parts["xl/workbook.xml"].replace(b"</workbook>", name + b"</workbook>")


def _repeated_part(parts: dict[str, bytes]) -> None:
    relations = parts["xl/_rels/workbook.xml.rels"]
    parts["xl/_rels/workbook.xml.rels"] = relations.replace(b"sheet2.xml", b"sheet1.xml")


def _sheets_of_single_part(parts: dict[str, bytes]) -> None:
    text = b'<sheet name="machine" sheetId="1" state="visible" r:id="rId1"/>'
    many = text.replace(b"r:id", b"xmlns:r='r' r:id") * 5_000
    parts["xl/workbook.xml"] = parts["xl/workbook.xml"].replace(b"</sheets>", many + b"</sheets>")


@pytest.mark.parametrize(
    ("change", "text"),
    [
        (_sheet(b'<row r="1"><c r="XFD1"><v>1</v></c></row>'), "machine!XFD1"),
        (_sheet(b'<row r="1048576"><c r="A1048576"><v>1</v></c></row>'), "machine!A1048576"),
        (_sheet(b'<row r="1"><c r="A9999999"><v>1</v></c></row>'), "machine!A9999999"),
        (_sheet(b"<row/>" * 20_000), "lines"),
        (_sheet(b"<row><c/></row>" * 9_000 + b"<row>" + b"<c/>" * 200_000 + b"</row>"), "columns"),
        (_sheet(b'<row><c r="KN1"/></row>' * 5_000), f"{MOST_CELLS} cells"),
        (_sheet(b"<row><c><f/><f/></c></row>" * 9_000 + b"<a/>" * 200_000), "elements"),
        (_styles, f"{MOST_OF_A_PART} elements"),
        (_names, f"{MOST_OF_A_PART} elements"),
        (_repeated_part, "same part"),
        (_sheets_of_single_part, "twice"),
    ],
)
def test_it_is_refused_before_the_library_opens_it(
    monkeypatch: pytest.MonkeyPatch, change: Callable[[dict[str, bytes]], None], text: str
) -> None:
    def opened(*_: object, **__: object) -> None:
        raise AssertionError("the library has opened it")

    monkeypatch.setattr(files, "load_workbook", opened)
    with pytest.raises(UnreadableWorkbook, match=text):
        workbook_sheets(changed(request_sheets(BODY), change))


def test_forty_sheets_with_a_far_cell_each() -> None:
    """The file that took 25 s and a gigabyte: no far cell of a sheet that is not ours is reached."""
    sheets: Sheets = {**request_sheets(BODY), **{f"note {k}": [["a"]] for k in range(40)}}

    def far(parts: dict[str, bytes]) -> None:
        for name in parts:
            if name.startswith("xl/worksheets/"):
                parts[name] = parts[name].replace(b'r="A1"', b'r="XFD1"')

    with pytest.raises(UnreadableWorkbook, match="XFD1"):
        read_workbook(changed(sheets, far))


def test_a_sheet_that_says_it_is_large_is_read_as_it_is() -> None:
    def large(parts: dict[str, bytes]) -> None:
        for name in parts:
            if name.startswith("xl/worksheets/"):
                start, _, rest = parts[name].partition(b"<dimension ")
                parts[name] = start + b'<dimension ref="A1:XFD1048576"/>' + rest.partition(b"/>")[2]

    assert read_workbook(changed(request_sheets(BODY), large)).body == BODY


def test_cells_of_sheets_that_are_not_asked_for_are_not_read(monkeypatch: pytest.MonkeyPatch) -> None:
    title: list[str] = []
    real = files._lines
    monkeypatch.setattr(files, "_lines", lambda sheet, wrong: [title.append(sheet.title), *real(sheet, wrong)][1:])
    with pytest.raises(Misplaced, match="note: no sheet of a machine"):
        read(
            workbook_sheets(workbook({**request_sheets(BODY), "note": [["a"]], "answer": [["b"]]}), names=("machine",))
        )
    assert title == ["machine"]


@pytest.mark.parametrize("text", ["[" * 30_000, '{"a":' * 6_000, "[" + "1" * 5_000])
def test_json_of_any_depth_in_a_cell_is_refused_by_the_cell(text: str) -> None:
    sheets = request_sheets(BODY)
    sheets["machine"].append(["machine.note", text])
    with pytest.raises(Misplaced, match=rf"machine!B{len(sheets['machine'])}: no JSON"):
        read(workbook_sheets(workbook(sheets)))


def test_the_largest_machine_is_within_the_counts() -> None:
    machine = BODY["machine"]
    throws = [{**machine["throws"][0], "name": f"{k}"} for k in range(500)]
    web = {**machine["webs"][0], "sector": {"centre_deg": 1, "half_angle_deg": 2}}
    webs = [{**web, "name": f"{k}"} for k in range(500)]
    largest = {**BODY, "machine": {**machine, "throws": throws, "webs": webs}}
    assert read_workbook(workbook(request_sheets(largest))).body == largest
    assert census(workbook(request_sheets(largest)), 20_000_000).cells < 0.75 * MOST_CELLS


def test_the_json_of_all_cells_together_is_bounded() -> None:
    """One text that ten thousand cells name would be parsed ten thousand times."""
    sheets = request_sheets(BODY)
    sheets["machine"] += [[f"machine.note{k}", "[" + "1," * 10_000 + "1]"] for k in range(200)]
    with pytest.raises(Misplaced, match="the cells up to here hold more than"):
        read(workbook_sheets(workbook(sheets)))
