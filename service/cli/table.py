"""The command that writes one table of the answer as CSV."""

from pathlib import Path
from pkgutil import resolve_name
from typing import Annotated

import typer

from service.cli.terminal import File, answer, fail, put, read_input
from service.computations.table import COMPUTATIONS

_PREFIX = "table_"
NAMES = tuple(name.removeprefix(_PREFIX) for name in COMPUTATIONS if name.startswith(_PREFIX))

NameOfTable = Annotated[str, typer.Argument(metavar="TABLE", help=f"One of: {', '.join(NAMES)}.")]
Target = Annotated[
    Path | None, typer.Option("-o", "--to", metavar="FILE.csv", help="File to write; else standard output.")
]


def table(name: NameOfTable, file: File, to: Target = None) -> None:
    """Optimise a machine and write one table of the answer as CSV."""
    if name not in NAMES:
        fail(f"there is no table {name}; these are {', '.join(NAMES)}")
    computation = COMPUTATIONS[_PREFIX + name]
    request, where = read_input(computation.request_model, file)
    content = resolve_name(computation.forms[0].write)(answer(computation.function, request, where))
    if to is None:
        put(content.decode().replace("\r\n", "\n").rstrip("\n"))
        return
    try:
        to.write_bytes(content)
    except OSError as error:
        fail(f"cannot write {to}: {error.strerror}")
