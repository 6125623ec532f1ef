"""The command that writes a machine as a workbook, to be changed into one's own."""

from pathlib import Path
from typing import Annotated

import typer

from service.cli.terminal import WORKBOOK, fail

Target = Annotated[Path, typer.Argument(metavar="FILE.xlsx", help="Workbook to write.")]
Example = Annotated[str, typer.Option("--example", metavar="NAME", help="Machine to begin with, or empty.")]


def template(to: Target, example: Example = "single-horizontal") -> None:
    """Write a machine as a workbook, for `counterweight optimize machine.xlsx -o answer.xlsx`."""
    from service.documents.examples import UnknownExample
    from service.documents.template import template as made

    if to.suffix.lower() != WORKBOOK:
        fail(f"the name of the workbook must end in {WORKBOOK}")
    try:
        to.write_bytes(made(example))
    except UnknownExample:
        fail("there is no example of this name; `counterweight examples` lists them")
    except OSError as error:
        fail(f"cannot write {to}: {error.strerror}")
