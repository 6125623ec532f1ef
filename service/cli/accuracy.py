"""The command that shows what accuracy costs in time."""

from pathlib import Path
from typing import Annotated

import typer

from service.cli.terminal import AsJson, File, answer, fail, put, question, show

Repeats = Annotated[
    int | None,
    typer.Option(min=1, max=20, help="Rounds of timing, in place of `repeats` in the file.", show_default="5"),
]
Picture = Annotated[
    Path | None, typer.Option(metavar="FILE.svg", help="Draw error against time; needs counterweight\\[pictures].")
]


def accuracy(file: File, repeats: Repeats = None, as_json: AsJson = False, picture: Picture = None) -> None:
    """Show what accuracy costs in time on a machine."""
    from optimizer.accuracy.measure import accuracy as compute
    from schemas.accuracy import AccuracyRequest
    from service.accuracy_picture import NoMatplotlib, draw, require

    try:
        if picture is not None:
            require()
    except NoMatplotlib as error:
        fail(str(error))
    request = question(AccuracyRequest, file)
    if repeats is not None:
        request = request.model_copy(update={"repeats": repeats})
    found, title = answer(compute, request), request.machine.name or "machine"
    if picture is not None:
        try:
            picture.write_text(draw(title, found))
        except OSError as error:
            fail(f"cannot write {picture}: {error.strerror}")
    if as_json:
        put(found.model_dump_json())
    else:
        from service.accuracy_tables import accuracy_report

        show(accuracy_report(title, found))
    raise typer.Exit(1 if found.status == "infeasible" else 0)
