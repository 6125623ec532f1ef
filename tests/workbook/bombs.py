"""Workbooks of 64 kB at most that describe far more: what each asks of whoever reads it."""

import io
from collections.abc import Callable
from zipfile import ZIP_DEFLATED, ZipFile

_KINDS = "http://schemas.openxmlformats.org/officeDocument/2006/relationships/"
_PACKAGE = "http://schemas.openxmlformats.org/package/2006/relationships"
_MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
_TITLES = ("machine", "throws", "rows", "webs", "bearings", "unbalances")
Parts = dict[str, str | bytes]


def parts(sheets: dict[str, str], strings: str = "", styles: str = "", book: str = "") -> Parts:
    """The parts of a workbook whose sheets hold some XML, with shared strings, styles and more of its own."""
    files = [("worksheet", f"worksheets/sheet{k}.xml") for k, _ in enumerate(sheets)]
    files += [("sharedStrings", "sharedStrings.xml"), ("styles", "styles.xml")]
    relations = "".join(
        f'<Relationship Id="r{k}" Type="{_KINDS}{kind}" Target="{target}"/>' for k, (kind, target) in enumerate(files)
    )
    listed = "".join(f'<sheet name="{title}" sheetId="{k + 1}" r:id="r{k}"/>' for k, title in enumerate(sheets))
    root = f'<Relationship Id="r0" Type="{_KINDS}officeDocument" Target="xl/workbook.xml"/>'
    return {
        "_rels/.rels": f'<Relationships xmlns="{_PACKAGE}">{root}</Relationships>',
        "xl/_rels/workbook.xml.rels": f'<Relationships xmlns="{_PACKAGE}">{relations}</Relationships>',
        "xl/workbook.xml": f'<workbook xmlns="{_MAIN}" xmlns:r="x"><sheets>{listed}</sheets>{book}</workbook>',
        "xl/sharedStrings.xml": f'<sst xmlns="{_MAIN}">{strings}</sst>',
        "xl/styles.xml": f'<styleSheet xmlns="{_MAIN}">{styles}</styleSheet>',
        **{f"xl/worksheets/sheet{k}.xml": sheet(content) for k, content in enumerate(sheets.values())},
    }


def sheet(content: str) -> str:
    """The XML of a sheet of some lines."""
    return f'<worksheet xmlns="{_MAIN}"><sheetData>{content}</sheetData></worksheet>'


def packed(inside: Parts) -> bytes:
    """An archive of some parts."""
    out = io.BytesIO()
    with ZipFile(out, "w", ZIP_DEFLATED, compresslevel=9) as archive:
        for name, content in inside.items():
            archive.writestr(name, content)
    return out.getvalue()


def _texts(count: int, text: str) -> bytes:
    """Cells in columns 1 and 2 of the sheet of fields that share a text."""
    lines = "".join(f'<c r="A{k}"><v>{k}</v></c><c r="B{k}" t="s"><v>0</v></c>' for k in range(2, count))
    return packed(parts({"machine": lines}, f"<si><t>{text}</t></si>"))


def _far_cells() -> bytes:
    far = '<row r="1048576"><c r="XFD1048576"><v>1</v></c></row>'
    return packed(parts({**dict.fromkeys(_TITLES, far), **{f"s{k}": far for k in range(34)}}))


def _fully() -> bytes:
    heads = "".join(f'<c t="inlineStr"><is><t>f{k}</t></is></c>' for k in range(300))
    line = "<row>" + "<c><v>1</v></c>" * 300 + "</row>"
    return packed(parts({"webs": f"<row>{heads}</row>" + line * 60}))


def _names_of_fields() -> bytes:
    lines = "".join(f'<row><c t="s"><v>0</v></c><c><v>{k}</v></c></row>' for k in range(8_000))
    return packed(parts({"machine": lines}, f"<si><t>{'a.' * 16_000}</t></si>"))


def _nested_archive() -> bytes:
    inside = packed({"x": b"0" * 3_900_000})
    return packed(parts({"machine": ""}) | {"xl/embeddings/x.xlsx": inside, "y": b"0" * 3_990_000})


def _links() -> bytes:
    inside = parts({"machine": ""})
    assert isinstance(inside["xl/_rels/workbook.xml.rels"], str)
    return packed(
        inside
        | {
            "xl/_rels/workbook.xml.rels": inside["xl/_rels/workbook.xml.rels"].replace(
                'Target="worksheets/sheet0.xml"', 'TargetMode="External" Target="file:///etc/passwd"'
            )
        }
    )


def _copies() -> bytes:
    """Many sheets that refer to one part."""
    inside = parts(dict.fromkeys(_TITLES, "<row><c><v>1</v></c></row>" * 5000))
    text = inside["xl/worksheets/sheet0.xml"]
    relations = str(inside["xl/_rels/workbook.xml.rels"])
    for k in range(1, len(_TITLES)):
        relations = relations.replace(f"sheet{k}.xml", "sheet0.xml")
        del inside[f"xl/worksheets/sheet{k}.xml"]
    return packed(inside | {"xl/_rels/workbook.xml.rels": relations, "xl/worksheets/sheet0.xml": text})


BOMBS: dict[str, Callable[[], bytes]] = {
    "far cells": _far_cells,
    "deep JSON": lambda: _texts(3, "[" * 30_000),
    "deep closed JSON": lambda: _texts(3, "[" * 15_000 + "]" * 15_000),
    "the same JSON a thousand times": lambda: _texts(7_500, "[" + "[]," * 9_000 + "[]]"),
    "the same text ten thousand times": lambda: _texts(7_500, "x" * 32_000),
    "a text of 3.9 MB": lambda: _texts(3, "x" * 3_900_000),
    "full sheets": _fully,
    "names of fields": _names_of_fields,
    "a cell far right on each line": lambda: packed(
        parts({"webs": "".join(f'<c r="KN{k}"><v>1</v></c>' for k in range(1, 10_000))})
    ),
    "blank lines": lambda: packed(parts({"webs": "<row/>" * 600_000})),
    "blank cells": lambda: packed(parts({"webs": "<row>" + '<c s="1"/>' * 390_000 + "</row>"})),
    "merged ranges": lambda: packed(
        parts({"webs": ""})
        | {"xl/worksheets/sheet0.xml": sheet("").replace("</w", '<mergeCell ref="A1:XFD1048576"/>' * 100_000 + "</w")}
    ),
    "widths": lambda: packed(
        parts({"webs": ""})
        | {
            "xl/worksheets/sheet0.xml": sheet("").replace(
                "<sheetData>",
                '<dimension ref="A1:XFD1048576"/><cols><col max="16384" width="1e308"/></cols><sheetData>',
            )
        }
    ),
    "styles": lambda: packed(parts({"webs": ""}, styles="<cellXfs>" + '<xf numFmtId="14"/>' * 190_000 + "</cellXfs>")),
    "formats": lambda: packed(
        parts({"webs": ""}, styles="".join(f'<numFmt numFmtId="9" formatCode="{c * 60_000}"/>' for c in ("[h", "_")))
    ),
    "defined names": lambda: packed(parts({"webs": ""}, book='<definedName name="x">webs!A1</definedName>' * 90_000)),
    "sheets": lambda: packed(parts({f"s{k}": "" for k in range(250)})),
    "shared strings": lambda: packed(parts({"webs": ""}, "<si><t>x</t></si>" * 220_000)),
    "rich texts": lambda: packed(parts({"webs": ""}, "<si>" + "<r><t>x</t></r>" * 250_000 + "</si>")),
    "nested elements": lambda: packed(parts({"webs": "<a>" * 1_000_000})),
    "attributes": lambda: packed(parts({"webs": "<c " + " ".join(f'a{k}="1"' for k in range(25_000)) + "/>"})),
    "long attribute": lambda: packed(parts({"webs": '<c r="' + "A" * 3_900_000 + '"/>'})),
    "comments": lambda: packed(parts({"webs": "<!-- x -->" * 380_000})),
    "characters": lambda: packed(parts({"webs": "&#120;" * 600_000})),
    "a number of many digits": lambda: packed(
        parts({"machine": f"<row/><row><c><v>1</v></c><c><v>{'9' * 32_000}</v></c></row>"})
    ),
    "wrong cells": lambda: packed(parts({"webs": "<row>" + '<c t="e"><v>#N/A</v></c>' * 100_000 + "</row>"})),
    "an archive in an archive": _nested_archive,
    "links": _links,
    "copies": _copies,
    "files": lambda: packed({f"{k}": b"" for k in range(600)}),
    "twice the same file": lambda: packed({"xl/workbook.xml": b"\xff" * 4_000_000}),
}
