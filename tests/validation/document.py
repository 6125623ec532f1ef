"""The tables of docs/validation.md: `python -m tests.validation.document` writes them anew."""

import re
from collections.abc import Iterable, Sequence
from pathlib import Path

from tests.validation import pack
from tests.validation.comparison import Comparison, Misprint

DOCUMENT = Path(__file__).parents[2] / "docs" / "validation.md"
_HEADS = ("machine", "quantity", "against", "theirs", "ours", "difference", "allowed", "unit")
_WRONG = ("place", "printed", "right", "ours", "unit", "reason")
MISPRINTS = "Misprints"


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table in Markdown."""
    lines = ["| " + " | ".join(row) + " |" for row in (heads, ["---"] * len(heads), *rows)]
    return "\n".join(lines)


def of_comparisons(comparisons: Iterable[Comparison]) -> str:
    return table(_HEADS, (comparison.cells for comparison in comparisons))


def of_misprints(misprints: Iterable[Misprint]) -> str:
    return table(
        _WRONG,
        ((f"{misprint.source}: {misprint.place}", *pack.figures(misprint), misprint.reason) for misprint in misprints),
    )


def table_rows(title: str) -> list[list[str]]:
    """Rows of the table below a heading, as they stand in the document."""
    lines = [line for line in _section(DOCUMENT.read_text(), title).split("\n") if line.startswith("| ")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


def _section(text: str, title: str) -> str:
    return text.split(f"\n## {title}\n")[1].split("\n## ")[0]


def _put(text: str, title: str, figure: str) -> str:
    whole = _section(text, title)
    words = re.sub(r"\n\|.*", "", whole, flags=re.DOTALL).rstrip("\n")
    return text.replace(whole, f"{words}\n\n{figure}\n", 1)


def main() -> None:
    text = DOCUMENT.read_text()
    for title, compared in pack.CHAPTERS.items():
        text = _put(text, title, of_comparisons(compared()))
    DOCUMENT.write_text(_put(text, MISPRINTS, of_misprints(pack.misprints())))


if __name__ == "__main__":
    main()
