"""`make validate`: prints the comparisons of docs/validation.md, computed now; ends 0 if all agree."""

import sys
from collections.abc import Sequence

from tests.validation import pack
from tests.validation.comparison import Comparison

_HEADS = ("machine", "quantity", "against", "theirs", "ours", "difference", "allowed", "unit")


def main() -> int:
    comparisons = []
    for title, compared in pack.CHAPTERS.items():
        lines = list(compared())
        print(f"\n{title}\n")
        _print([_HEADS, *((*line.cells, "" if line.agrees else "DIFFERS") for line in lines)])
        comparisons += lines
    print("\nMisprints of the sources\n")
    wrong = list(pack.misprints())
    heads = ("place", "printed", "right", "ours", "unit", "reason")
    _print([heads, *((misprint.place, *pack.figures(misprint), misprint.reason) for misprint in wrong)])
    comparisons += [misprint.right for misprint in wrong]
    return _verdict(comparisons)


def _verdict(comparisons: Sequence[Comparison]) -> int:
    differing = sum(not comparison.agrees for comparison in comparisons)
    print(f"\n{len(comparisons)} comparisons, {differing} beyond what printing or method allow")
    return int(differing > 0)


def _print(rows: Sequence[Sequence[str]]) -> None:
    widths = [max(len(row[k]) for row in rows if k < len(row)) for k in range(max(map(len, rows)))]
    for row in rows:
        print("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=False)).rstrip())


if __name__ == "__main__":
    sys.exit(main())
