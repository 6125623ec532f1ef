"""The command that writes the report on a machine to a file."""

from pathlib import Path
from typing import Annotated

import typer

from service.cli.terminal import File, Outputs, answer, fail, question

Target = Annotated[Path, typer.Option("-o", "--to", metavar="FILE", help="Document to write: .html or .pdf.")]


def report(file: File, to: Target, output: Outputs = None) -> None:
    """Write a document on a machine and its counterweights, to be read, printed and filed."""
    from schemas.requests import OptimizeRequest
    from service.report.document import report as compute
    from service.report.formats import FORMATS

    form = next((form for name, form in FORMATS.items() if to.suffix.lower() == f".{name}"), None)
    if form is None:
        fail("the name of the document must end in .html or .pdf")
    made = answer(compute, question(OptimizeRequest, file, output))
    try:
        to.write_bytes(form.write(made))
    except OSError as error:
        fail(f"cannot write {to}: {error.strerror}")
    raise typer.Exit(0 if made.status == "optimal" else 1)
