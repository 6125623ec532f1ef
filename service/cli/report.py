"""The command that writes the report on a machine to a file."""

from pathlib import Path
from pkgutil import resolve_name
from typing import Annotated

import typer

from service.cli.terminal import File, answer, fail, question
from service.computations.table import COMPUTATIONS

OutputOptions = Annotated[
    list[str] | None,
    typer.Option("--output", help="What the document shall hold, in place of `outputs` in the file; repeatable."),
]
Target = Annotated[Path, typer.Option("-o", "--to", metavar="FILE", help="Document to write: .html or .pdf.")]


def report(file: File, to: Target, output: OutputOptions = None) -> None:
    """Write a document on a machine and its counterweights, to be read, printed and filed."""
    computation = COMPUTATIONS["report"]
    form = next((form for form in computation.forms if form.suffix == to.suffix.lower()), None)
    if form is None:
        fail(f"the name of the document must end in {' or '.join(form.suffix for form in computation.forms)}")
    request = question(computation.request_model, file, {"outputs": output} if output else {})
    document = answer(computation.function, request)
    try:
        to.write_bytes(resolve_name(form.write)(document))
    except OSError as error:
        fail(f"cannot write {to}: {error.strerror}")
    raise typer.Exit(0 if document.status == "optimal" else 1)
