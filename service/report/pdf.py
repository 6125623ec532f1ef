"""The document as PDF, set by typst: A4, numbered pages, tagged, with the request as an attachment.

The template is fixed and all that a request says reaches it as data, so that no text of a client is ever read as
markup. What a document holds it holds in memory; nothing is read from disk but fonts, nothing from a network.
"""

import json
import re
import struct
from base64 import b64encode
from dataclasses import asdict
from datetime import datetime
from functools import cache
from importlib.resources import files
from typing import Any

from service.common.figures import typeset
from service.common.plain import plain
from service.drawings.svg import Drawing
from service.report.blocks import Block, Cell, Document, Figure, Listing, Number, Paragraph, Table

#: comes with the library, so that documents look the same everywhere; other scripts use fonts of the system
_FONT = "Libertinus Serif"
#: longer words may be broken anywhere: in the narrow columns of tables and elsewhere, and in listings
_LONG_WORD = re.compile(r"\S{18,}")
_LONG_LINE = re.compile(r"\S{48,}")


def pdf(document: Document) -> bytes:
    """The PDF; the same bytes for the same document.

    Raises
    ------
    typst.TypstError
        never for what a request can say: the template takes any text.
    """
    import typst

    drawings: dict[str, bytes] = {}
    content = {
        "title": _broken(document.title, _LONG_WORD),
        "subject": document.subject,
        "day": document.day,
        "logo": document.logo is not None,
        "revisions": None if document.revisions is None else _table(document.revisions),
        "attachment": document.attachment.name,
        "head": _table(document.head),
        "notes": [_broken(note, _LONG_WORD) for note in document.notes],
        "opening": document.opening,
        "chapters": [
            {"title": chapter.title, "blocks": [_block(block, drawings) for block in chapter.blocks]}
            for chapter in document.chapters
        ],
    }
    sources = {
        "main": _template(),
        "document.json": json.dumps(_fit(content)).encode(),
        document.attachment.name: document.attachment.content.encode(),
        **({} if document.logo is None else {"logo.svg": _logo(document.logo)}),
        **drawings,
    }
    content_of_file: bytes = typst.compile(
        sources, font_paths=_fonts(), timestamp=datetime.fromisoformat(document.date), format="pdf"
    )
    return content_of_file


def png(drawing: Drawing) -> bytes:
    """A drawing in pixels, as many as its width says; what it leaves free is transparent."""
    import typst

    width, height = drawing.width * drawing.scale, drawing.height * drawing.scale
    page = f"#set page(width: {width:.2f}pt, height: {height:.2f}pt, margin: 0pt, fill: none)\n"
    sources = {"main": f'{page}#image("drawing.svg", width: 100%)'.encode(), "drawing.svg": drawing.svg(_FONT).encode()}
    # a pixel is a point
    pixels: bytes = typst.compile(sources, font_paths=_fonts(), format="png", ppi=72.0)
    return pixels


@cache
def _template() -> bytes:
    return (files("service.report") / "templates" / "report.typ").read_bytes()


@cache
def _fonts() -> Any:
    import typst

    return typst.Fonts()


def _block(block: Block, drawings: dict[str, bytes]) -> dict[str, Any]:
    kind = type(block).__name__.lower()
    if isinstance(block, Table):
        return {"kind": kind, **_table(block)}
    if isinstance(block, Listing):
        lines = block.text.splitlines()
        # a listing of one line is short, and there to be copied
        return {"kind": kind, "text": _broken(block.text, _LONG_LINE) if len(lines) > 1 else block.text}
    if isinstance(block, Figure):
        names = []
        for drawing in block.drawings:
            name = f"{len(drawings)}.svg"
            drawings[name] = drawing.svg(_FONT).encode()
            names.append({"file": name, "label": drawing.label, "width": drawing.width * drawing.scale})
        return {"kind": kind, "drawings": names, "caption": block.caption}
    if isinstance(block, Paragraph):
        return {"kind": kind, "tone": block.tone, "text": _broken(block.text, _LONG_WORD)}
    return {"kind": kind, **asdict(block)}


def _logo(image: bytes) -> bytes:
    """The PNG file within an SVG file: what typst holds in memory is text."""
    width, height = struct.unpack(">II", image[16:24])
    size = f'width="{width}" height="{height}"'
    data = b64encode(image).decode()
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} viewBox="0 0 {width} {height}">'
        f'<image {size} href="data:image/png;base64,{data}"/></svg>'
    ).encode()


def _table(block: Table) -> dict[str, Any]:
    return {
        "title": block.title,
        "headed": block.headed,
        "short": block.short,
        "columns": [asdict(column) for column in block.columns],
        "rows": [[_cell(cell, block.headed) for cell in row] for row in block.rows],
    }


def _cell(cell: Cell, narrow: bool) -> Any:
    if isinstance(cell, Number):
        return typeset(cell.text)
    if isinstance(cell, str):
        return _broken(cell, _LONG_WORD) if narrow else cell
    return {"runs": cell}


def _broken(text: str, words: re.Pattern[str]) -> str:
    """The text with places to break in words that are too long for a line."""
    return words.sub(lambda word: "\u200b".join(word[0]), text)


def _fit(value: Any) -> Any:
    """The value with every text in it plain."""
    if isinstance(value, str):
        return plain(value)
    if isinstance(value, dict):
        return {key: _fit(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_fit(item) for item in value]
    return value
