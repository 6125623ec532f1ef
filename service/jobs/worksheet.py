"""Rows as a workbook, a batch at a time: numbers as numbers, every text as a text.

A workbook of a library is finished before its first byte can be sent. Here Arrow writes the cells of a batch (ECMA-376,
part 1, 18.3.1), and memory holds one batch however many there are.
"""

from collections.abc import Generator, Iterable
from typing import TYPE_CHECKING
from xml.sax.saxutils import escape
from zipfile import ZIP_DEFLATED, ZipFile

from service.common.plain import plain
from service.jobs.outbox import Outbox

if TYPE_CHECKING:
    import pyarrow as pa

#: of a worksheet, without the line of names
MOST_ROWS = 2**20 - 1
MOST_COLUMNS = 2**14
#: so many take a gigabyte unpacked, and few programs open more
MOST_CELLS = 30_000_000
_LONGEST = 32_767

_MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
_OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
_PACKAGE = "http://schemas.openxmlformats.org/package/2006"
_SHEET = "application/vnd.openxmlformats-officedocument.spreadsheetml"
_SHEETS = ("rows", "columns")
_HEAD = '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n'
_PARTS = {
    "[Content_Types].xml": f'<Types xmlns="{_PACKAGE}/content-types">'
    '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
    f'<Override PartName="/xl/workbook.xml" ContentType="{_SHEET}.sheet.main+xml"/>'
    + "".join(
        f'<Override PartName="/xl/worksheets/{name}.xml" ContentType="{_SHEET}.worksheet+xml"/>' for name in _SHEETS
    )
    + "</Types>",
    "_rels/.rels": f'<Relationships xmlns="{_PACKAGE}/relationships"><Relationship Id="r1" '
    f'Type="{_OFFICE}/officeDocument" Target="xl/workbook.xml"/></Relationships>',
    "xl/workbook.xml": f'<workbook xmlns="{_MAIN}" xmlns:r="{_OFFICE}"><sheets>'
    + "".join(f'<sheet name="{name}" sheetId="{k}" r:id="r{k}"/>' for k, name in enumerate(_SHEETS, start=1))
    + "</sheets></workbook>",
    "xl/_rels/workbook.xml.rels": f'<Relationships xmlns="{_PACKAGE}/relationships">'
    + "".join(
        f'<Relationship Id="r{k}" Type="{_OFFICE}/worksheet" Target="worksheets/{name}.xml"/>'
        for k, name in enumerate(_SHEETS, start=1)
    )
    + "</Relationships>",
}
# the line of names stays where it is
_BEGIN = (
    f'{_HEAD}<worksheet xmlns="{_MAIN}"><sheetViews><sheetView workbookViewId="0"><pane ySplit="1" topLeftCell="A2" '
    'activePane="bottomLeft" state="frozen"/></sheetView></sheetViews><sheetData>'
)
_END = "</sheetData></worksheet>"
_EMPTY = "<c/>"


class TooLargeForWorksheet(ValueError):
    """There are more rows, columns or cells than a worksheet takes."""


def require_fits(rows: int, columns: int) -> None:
    """Refuse what no worksheet holds.

    Raises
    ------
    TooLargeForWorksheet
    """
    for count, most, kind in ((rows, MOST_ROWS, "rows"), (columns, MOST_COLUMNS, "columns")):
        if count > most:
            raise TooLargeForWorksheet(
                f"a worksheet holds {most} {kind}, and there are {count}; take fewer, or csv or parquet"
            )
    if rows * columns > MOST_CELLS:
        raise TooLargeForWorksheet(
            f"{rows} rows of {columns} columns are more than {MOST_CELLS} cells; take fewer, or csv or parquet"
        )


def worksheet(schema: "pa.Schema", batches: "Iterable[pa.RecordBatch]") -> Generator[bytes, None, None]:
    """The rows on a sheet, and on a second one the unit and the meaning of their columns.

    Raises
    ------
    TooLargeForWorksheet
        as soon as there are too many.
    """
    out = Outbox()
    count = 0
    with ZipFile(out, "w", ZIP_DEFLATED, compresslevel=1) as archive:
        for name, content in _PARTS.items():
            archive.writestr(name, _HEAD + content)
        with archive.open("xl/worksheets/rows.xml", "w") as sheet:
            sheet.write((_BEGIN + _row(schema.names)).encode())
            for batch in batches:
                count += batch.num_rows
                require_fits(count, len(schema))
                sheet.write(_rows(batch).encode())
                yield out.take()
            sheet.write(_END.encode())
        lines = [["name", "unit", "meaning"], *([field.name, *_about(field)] for field in schema)]
        archive.writestr("xl/worksheets/columns.xml", _BEGIN + "".join(map(_row, lines)) + _END)
    yield out.take()


def _about(field: "pa.Field") -> list[str]:
    metadata = field.metadata or {}
    return [metadata.get(key, b"").decode() for key in (b"unit", b"meaning")]


def _row(texts: Iterable[str]) -> str:
    return f"<row>{''.join(map(_text, texts))}</row>"


def _text(text: str) -> str:
    content = escape(plain(text)[:_LONGEST], {"\r": "&#13;"})
    return f'<c t="inlineStr"><is><t xml:space="preserve">{content}</t></is></c>'


def _rows(batch: "pa.RecordBatch") -> str:
    import pyarrow.compute as pc

    cells = ["<row>", *map(_cells, batch.columns), "</row>"]
    return "".join(pc.binary_join_element_wise(*cells, "").to_pylist())


def _cells(column: "pa.Array") -> "pa.Array":
    import pyarrow as pa
    import pyarrow.compute as pc

    if pa.types.is_floating(column.type) or pa.types.is_integer(column.type):
        if pa.types.is_floating(column.type):
            # a cell holds no NaN and no infinity
            column = pc.if_else(pc.is_finite(column), column, None)
        return pc.binary_join_element_wise("<c><v>", column.cast(pa.string()), "</v></c>", "").fill_null(_EMPTY)
    encoded = column.cast(pa.string()).dictionary_encode()
    texts = pa.array([_text(text) for text in encoded.dictionary.to_pylist()], pa.string())
    return texts.take(encoded.indices).fill_null(_EMPTY)
