"""Lines of cells, the headings first; as CSV."""

import csv
import io
from collections.abc import Sequence

from service.common.plain import inert, plain

Cell = str | float | int | bool | None
Lines = list[list[Cell]]


def as_csv(lines: Sequence[Sequence[Cell]]) -> bytes:
    """In UTF-8; a text that a spreadsheet would run stays text."""
    out = io.StringIO(newline="")
    writer = csv.writer(out, lineterminator="\r\n")
    for line in lines:
        writer.writerow([inert(plain(cell)) if isinstance(cell, str) else cell for cell in line])
    return out.getvalue().encode()
