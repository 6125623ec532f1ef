"""The command that draws the rows of a sweep."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from service.cli.terminal import fail, put

if TYPE_CHECKING:
    import pyarrow as pa

_READ = (".parquet", ".arrow", ".csv")
#: rows with these statuses are drawn
_ANSWERED = ("optimal", "analyzed")


def plot(
    rows: Annotated[Path, typer.Argument(metavar="ROWS", help="Rows of a sweep: .parquet, .arrow or .csv.")],
    x: Annotated[str, typer.Option("--x", metavar="COLUMN", help="Column across.")],
    y: Annotated[str, typer.Option("--y", metavar="COLUMN", help="Column upward.")],
    to: Annotated[Path, typer.Option("-o", "--out", metavar="FILE.svg", help="File to write.")],
) -> None:
    """Draw the designs of a sweep by two columns, with the front of those that no other beats in both."""
    from service.report.pictures import svg
    from service.report.scatter import Column, scatter

    if to.suffix != ".svg":
        fail(f"{to}: the name must end in .svg")
    table = _read(rows)
    for name in (x, y):
        if name not in table.schema.names:
            fail(f"{rows} has no column {name}; there are {', '.join(table.schema.names)}")
    across, upward, left_out = _values(table, x, y)
    if not across:
        fail(f"{rows} has no design with a certified answer and a number in {x} and {y}")
    units = [(table.schema.field(name).metadata or {}).get(b"unit", b"").decode() for name in (x, y)]
    picture = svg(scatter(Column(x, units[0], across), Column(y, units[1], upward)))
    try:
        to.write_bytes(picture)
    except OSError as error:
        fail(f"cannot write {to}: {error.strerror}")
    put(f"{to}: {len(across)} designs" + (f"; {left_out} without a certified answer left out" if left_out else ""))


def _read(rows: Path) -> "pa.Table":
    import pyarrow as pa
    import pyarrow.csv as pa_csv
    import pyarrow.parquet as pq

    if rows.suffix not in _READ:
        fail(f"{rows}: the name must end in {', '.join(_READ)}")
    try:
        # without threads: one of Arrow's that is left when the process ends aborts it
        if rows.suffix == ".parquet":
            with pq.ParquetFile(rows) as parquet:
                return parquet.read(use_threads=False)
        if rows.suffix == ".arrow":
            with pa.OSFile(str(rows)) as file:
                return pa.ipc.open_file(file, options=pa.ipc.IpcReadOptions(use_threads=False)).read_all()
        return pa_csv.read_csv(rows, read_options=pa_csv.ReadOptions(use_threads=False))
    except OSError as error:
        fail(f"cannot read {rows}: {error.strerror or 'it is damaged'}")
    except pa.ArrowException as error:
        fail(f"{rows} holds no rows of a sweep: {type(error).__name__}")


def _values(table: "pa.Table", x: str, y: str) -> tuple[list[float], list[float], int]:
    """Numbers of the designs that have an answer, and how many have none."""
    import pyarrow as pa
    import pyarrow.compute as pc

    for name in (x, y):
        kind = table.schema.field(name).type
        if not (pa.types.is_floating(kind) or pa.types.is_integer(kind)):
            fail(f"{name} is no column of numbers")
    numbers = [table[name].cast(pa.float64()) for name in (x, y)]
    keep = pc.and_(*(pc.fill_null(pc.is_finite(number), False) for number in numbers))
    if "status" in table.schema.names:
        keep = pc.and_(keep, pc.is_in(table["status"], value_set=pa.array(_ANSWERED)))
    across, upward = (number.filter(keep).to_pylist() for number in numbers)
    return across, upward, table.num_rows - len(across)
