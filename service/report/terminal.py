"""Chapters in a terminal: headed paragraphs and tables; what other writers draw over the turn is a coarse table."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

from rich.box import SIMPLE_HEAD
from rich.cells import cell_len
from rich.console import Console, ConsoleOptions, Group, RenderableType, RenderResult
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
#: characters of a unit at the end of a title, at most
_LONGEST_UNIT = 8


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
        yield _Grid(block)
    elif isinstance(block, Figure) and block.samples is not None:
        yield from map(_Grid, _coarse(block.samples))


@dataclass(frozen=True)
class _Grid:
    """A table as wide as there is room for: words go on the next line, figures never do."""

    block: Table

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Yield the grid with frames, or where its words do not fit between them the one without."""
        block, room = self.block, options.max_width
        # titles and cells come from requests: as texts they are no markup
        rows = [[plain(_text(cell)) for cell in row] for row in block.rows]
        columns = [_spread(plain(column.title), [row[k] for row in rows], column.numeric, block.headed)
                   for k, column in enumerate(block.columns)]  # fmt: skip
        framed = room - 3 * len(columns) - 1
        tight = sum(column.word for column in columns) > framed
        widths = _widths(columns, room - len(columns) + 1 if tight else framed)
        grid = Grid(title=Text(plain(block.title)) if block.title else None, title_justify="left", title_style="bold")
        grid.show_header = block.headed
        if tight:
            grid.box, grid.show_edge, grid.padding = SIMPLE_HEAD, False, (0, 0, 0, 0)
        for column, width in zip(block.columns, widths, strict=True):
            justify: Literal["left", "right"] = "right" if column.numeric else "left"
            title = plain(column.title)
            if cell_len(title) > width and (unit := _unit(title)):
                title = f"{title.removesuffix(unit).rstrip()}\n{unit}"
            grid.add_column(Text(title), justify=justify, overflow="fold", width=width)
        for row in rows:
            grid.add_row(*map(Text, row))
        yield grid


class _Spread(NamedTuple):
    """Characters that a column takes: with broken words, with a word on a line, and with all of a text on one."""

    figure: int
    word: int
    whole: int


def _spread(title: str, cells: Sequence[str], is_numeric: bool, is_headed: bool) -> _Spread:
    heads = [title] if is_headed else []
    unit = _unit(title) if is_headed else ""
    texts = [head.removesuffix(unit) for head in heads] + ([] if is_numeric else [*cells])
    words = [unit, *(word for text in texts for word in text.split())]
    figure = max(map(cell_len, cells), default=1) if is_numeric else 1
    word = max([figure, *map(cell_len, words)])
    return _Spread(figure, word, max([word, *map(cell_len, [*heads, *cells])]))


def _unit(title: str) -> str:
    """What a title ends with and is never broken: N m of "peak moment, N m"; nothing where that is no unit."""
    unit = title.rpartition(", ")[2]
    return unit if unit != title and cell_len(unit) <= _LONGEST_UNIT else ""


def _widths(columns: Sequence[_Spread], room: int) -> list[int]:
    """Of every column: what it takes where all have room, else at least its words and a share of what is left."""
    widths = [column.word for column in columns]
    left = room - sum(widths)
    while left < 0:
        spare = [width - column.figure for width, column in zip(widths, columns, strict=True)]
        if max(spare) <= 0:
            # not even the figures have room: as narrow as can be
            break
        widths[spare.index(max(spare))] -= 1
        left += 1
    while left > 0:
        missing = [column.whole - width for width, column in zip(widths, columns, strict=True)]
        if max(missing) <= 0:
            break
        widths[missing.index(max(missing))] += 1
        left -= 1
    return widths


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
