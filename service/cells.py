"""Tables and their cells, as every report writes them."""

from rich.table import Table
from rich.text import Text

Cell = str | float | None


def table(title: str, *columns: str) -> Table:
    """An empty table."""
    found = Table(title=title, title_justify="left", title_style="bold")
    for column in columns:
        found.add_column(column, overflow="fold")
    return found


def add(rows: Table, *cells: Cell) -> None:
    """Add a row; names come from the request: as plain text, they are no markup."""
    rows.add_row(*(Text(cell if isinstance(cell, str) else number(cell)) for cell in cells))


def number(value: float | None) -> str:
    """A figure to six digits."""
    return "-" if value is None else f"{value:.6g}"
