"""Tables of a terminal: as wide as it is, with every figure on one line."""

import io

import pytest
from rich.console import Console

from service.report.blocks import Chapter, Paragraph, table
from service.report.terminal import terminal

_FIGURES = (8.57183e-06, -0.00231336, 27682.2, 1e-300)
_METHODS = ("interior point, finer numbers", "polygonal cones", "one scenario alone")


def _lines(width: int, columns: int) -> list[str]:
    heads = ["method", *(f"#certified gap of the objective {n}" for n in range(columns)), ""]
    rows = [
        (method, *(_FIGURES[(n + k) % len(_FIGURES)] for k in range(columns)), "frontier")
        for n, method in enumerate(_METHODS)
    ]
    out = io.StringIO()
    console = Console(file=out, width=width, force_terminal=False)
    console.print(terminal([Chapter("Ladder", (Paragraph("words"), table("", heads, rows)))]))
    return out.getvalue().splitlines()


@pytest.mark.parametrize(("width", "columns"), [(80, 5), (80, 3), (70, 3), (100, 6), (160, 7)])
def test_figures_stand_on_one_line_whatever_the_width(width: int, columns: int) -> None:
    """Property: every figure is somewhere in one piece, and no line is wider than the terminal."""
    lines = _lines(width, columns)
    assert max(map(len, lines)) <= width
    words = " ".join(lines).replace("│", " ").split()
    for figure in ("8.57183e-06", "-0.00231336", "27682.2", "1e-300"):
        assert words.count(figure) >= 3 * columns // len(_FIGURES) - 1 > 0
    assert words.count("frontier") == len(_METHODS)


def test_there_are_frames_where_there_is_room() -> None:
    assert any("┃" in line for line in _lines(160, 3))
    assert not any("┃" in line for line in _lines(60, 3))
    # by whole words: nothing is broken but where not even one has room
    assert "interior" in " ".join(_lines(60, 3)).split()


def test_figures_are_the_last_to_be_broken() -> None:
    """Where words have no room they are broken, and the figures beside them are not."""
    lines = _lines(48, 3)
    assert max(map(len, lines)) <= 48
    assert "8.57183e-06" in " ".join(lines).split()


def test_a_unit_of_a_title_stands_in_one_piece() -> None:
    """Where a title does not fit beside others, its unit goes on a line of its own: never N above m."""
    titles = ["point", *(f"#{name} moment, N m" for name in ("peak", "weighted", "smallest", "certified", "largest"))]
    output = io.StringIO()
    front = table("Front", titles, [("0", *(1234.5678,) * 5)])
    Console(file=output, width=75).print(terminal([Chapter("Front", (front,))]))
    text = output.getvalue()
    assert "N m" in text
    assert not [line for line in text.splitlines() if line.replace("┃", " ").split() == ["m"] * 5]
    assert all(line.count("N m") in (0, 5) for line in text.splitlines())
