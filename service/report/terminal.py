"""Chapters in a terminal: headed paragraphs and tables; what other writers draw over the turn is a coarse table."""

from collections.abc import Iterable, Iterator
from typing import Literal

from rich.console import Group, RenderableType
from rich.table import Table as Grid
from rich.text import Text

from service.common.figures import NARROW, digits
from service.common.plain import plain
from service.report.blocks import (
    Block,
    Cell,
    Chapter,
    Equation,
    Figure,
    Formula,
    Listing,
    Number,
    Paragraph,
    Samples,
    Table,
    table,
    turns_of,
)

_TONES = {"plain": "", "key": "bold", "warning": "bold yellow"}
_MARKS = {"base": "", "sup": "^", "sub": "_"}
#: rows of a turn in a coarse table: every 30 degrees, as nearly as the samples allow
_COARSE_STEPS = 12
_SIDE_BY_SIDE = 6


def terminal(chapters: Iterable[Chapter]) -> Group:
    """Everything that can be read without drawings."""
    return Group(*(part for chapter in chapters for part in _chapter(chapter)))


def _chapter(chapter: Chapter) -> Iterator[RenderableType]:
    yield Text(chapter.title, "bold underline")
    for block in chapter.blocks:
        yield from _block(block)
    yield Text("")


def _block(block: Block) -> Iterator[RenderableType]:
    if isinstance(block, Paragraph):
        yield Text(plain(block.text).replace(NARROW, ""), _TONES[block.tone])
    elif isinstance(block, Equation):
        yield Text(_line(block.formula), "italic")
    elif isinstance(block, Listing):
        yield Text(plain(block.text))
    elif isinstance(block, Table):
        yield _grid(block)
    elif isinstance(block, Figure) and block.samples is not None:
        yield from map(_grid, _coarse(block.samples))


def _grid(block: Table) -> Grid:
    # titles and cells come from requests: as texts they are no markup
    grid = Grid(title=Text(plain(block.title)) if block.title else None, title_justify="left", title_style="bold")
    grid.show_header = block.headed
    for column in block.columns:
        justify: Literal["left", "right"] = "right" if column.numeric else "left"
        grid.add_column(Text(plain(column.title)), justify=justify, overflow="fold")
    for row in block.rows:
        grid.add_row(*(Text(_text(cell)) for cell in row))
    return grid


def _text(cell: Cell) -> str:
    if isinstance(cell, Number):
        return cell.text
    return plain(cell) if isinstance(cell, str) else _line(cell)


def _line(formula: Formula) -> str:
    """A formula on one line: ``x^2``, ``x_2``, ``x^(2 k)``."""
    return "".join(_MARKS[run.level] + (_grouped(run.text) if _MARKS[run.level] else run.text) for run in formula)


def _grouped(text: str) -> str:
    return text if len(text) == 1 or text.isalnum() else f"({text})"


def _coarse(samples: Samples) -> Iterator[Table]:
    stride = max(1, round(len(samples.angle_deg) / (_COARSE_STEPS * turns_of(samples.angle_deg))))
    for first in range(0, len(samples.lines), _SIDE_BY_SIDE):
        lines = samples.lines[first : first + _SIDE_BY_SIDE]
        rows = [
            (digits(samples.angle_deg[k]), *(values[k] for _, values in lines))
            for k in range(0, len(samples.angle_deg), stride)
        ]
        heads = ["#angle, deg", *(f"#{name}" for name, _ in lines)]
        yield table(f"{samples.title} over the cycle, {samples.unit}", heads, rows)
