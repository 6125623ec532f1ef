"""What a document is made of: chapters of paragraphs, tables, figures and listings.

Chapters build these blocks; HTML, PDF and the terminal are written from the same blocks, so that they say the same.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from operator import itemgetter
from typing import Literal, NamedTuple

from service.common.figures import digits, typeset
from service.drawings.svg import Drawing


class Run(NamedTuple):
    """A stretch of text: on the line, raised or lowered."""

    text: str
    level: Literal["base", "sup", "sub"] = "base"


_MAX_SHORT = 16
#: of an angle in a table
_ANGLE_DECIMALS, _WHOLE_TURNS = 4, ("360", "-360")
#: of a scale, below which a figure is what rounding leaves
_DUST = 1e-6
#: text with raised and lowered parts, as formulas have
Formula = tuple[Run, ...]


@dataclass(frozen=True)
class Number:
    """A figure of the answer: its value, and the digits that are shown."""

    value: float
    text: str


Cell = str | Number | Formula


@dataclass(frozen=True)
class Paragraph:
    """Sentences."""

    text: str
    tone: Literal["plain", "key", "warning"] = "plain"


@dataclass(frozen=True)
class Equation:
    """A formula on a line of its own."""

    formula: Formula


@dataclass(frozen=True)
class Column:
    """A column of a table."""

    title: str
    numeric: bool = False
    wide: bool = False


@dataclass(frozen=True)
class Table:
    """A table; without column titles it is a list of names and values."""

    title: str
    columns: tuple[Column, ...]
    rows: tuple[tuple[Cell, ...], ...]
    headed: bool = True

    @property
    def short(self) -> bool:
        """Whether the table stays on one page."""
        return len(self.rows) <= _MAX_SHORT


def turns_of(angle_deg: Sequence[float]) -> int:
    """Turns over which samples go, the end point not repeated: 2 where gas takes two."""
    return int(angle_deg[-1] // 360.0) + 1 if angle_deg else 1


@dataclass(frozen=True)
class Samples:
    """Values over the turn, for those who cannot see a drawing of them."""

    title: str
    unit: str
    angle_deg: Sequence[float]
    lines: Sequence[tuple[str, Sequence[float | None]]]


@dataclass(frozen=True)
class Figure:
    """Drawings side by side, and what they show; with samples where they are worth reading."""

    drawings: tuple[Drawing, ...]
    caption: str
    samples: Samples | None = None


@dataclass(frozen=True)
class Listing:
    """Text as it is, in a fixed pitch."""

    text: str


Block = Paragraph | Equation | Table | Figure | Listing


@dataclass(frozen=True)
class Chapter:
    """A chapter."""

    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True)
class Attachment:
    """A file that goes with the document."""

    name: str
    content: str


@dataclass(frozen=True)
class Document:
    """A document.

    day : that it bears, as it is printed.
    head : names and values under the title.
    revisions : table of revisions.
    logo : a PNG file.
    notes : paragraphs below them.
    opening : how many chapters come before the list of contents.
    date : ISO 8601, UTC.
    file_stem : what a file of it is called, without the ending.
    """

    title: str
    subject: str
    date: str
    status: Literal["optimal", "inaccurate", "infeasible"]
    day: str
    head: Table
    revisions: Table | None
    logo: bytes | None
    notes: tuple[str, ...]
    opening: int
    chapters: tuple[Chapter, ...]
    attachment: Attachment
    file_stem: str


def number(value: float | None) -> Cell:
    """A figure to six digits; a dash where there is none."""
    return "–" if value is None else Number(value, digits(value))


def angle(value: float | None) -> Cell:
    """An angle to a ten-thousandth of a degree; a whole turn is none, as what rounding leaves of one."""
    if value is None:
        return number(None)
    text = digits(round(value, _ANGLE_DECIMALS))
    return Number(value, "0" if text in _WHOLE_TURNS else text)


def prose(value: float) -> str:
    """A figure within a sentence."""
    return typeset(digits(value))


def figure_beside(value: float | None, scale: float, gap: float = 0.0) -> Cell:
    """A figure; what rounding leaves beside the scale is printed as 0, and what a gap outweighs as below the gap."""
    if value is not None and abs(value) < _DUST * abs(scale):
        return Number(value, "0")
    if value is not None and 0.0 < value < gap:
        return Number(value, f"< {digits(_upwards(gap))}")
    return number(value)


def _upwards(value: float) -> float:
    """A positive number to one digit, never smaller."""
    unit = 10.0 ** math.floor(math.log10(value))
    return math.ceil(value / unit) * unit


def table(title: str, columns: Sequence[str], rows: Sequence[Sequence[Cell | float | None]]) -> Table:
    """A table. A title that begins with ``#`` heads numbers, one with ``<`` text that takes the room left."""
    heads = tuple(
        Column(column.lstrip("#<"), numeric=column.startswith("#"), wide=column.startswith("<")) for column in columns
    )
    return Table(title, heads, tuple(tuple(_cell(cell) for cell in row) for row in rows))


def extremes(title: str, angle_deg: Sequence[float], series: Iterable[tuple[str, Sequence[float | None]]]) -> Table:
    """Largest and smallest sample of every series, and where first."""
    rows = []
    for name, values in series:
        samples = [(value, angle) for value, angle in zip(values, angle_deg, strict=True) if value is not None]
        result = (*max(samples, key=itemgetter(0)), *min(samples, key=itemgetter(0))) if samples else (None,) * 4
        rows.append((name, *result))
    return table(title, ["", "#largest", "#at, deg", "#smallest", "#at, deg"], rows)


def facts(title: str, rows: Sequence[tuple[str, Cell | float | None]]) -> Table:
    """Names and values."""
    columns = (Column(""), Column("", wide=True))
    return Table(title, columns, tuple((name, _cell(value)) for name, value in rows), headed=False)


def _cell(cell: Cell | float | None) -> Cell:
    return number(cell) if cell is None or isinstance(cell, int | float) else cell
