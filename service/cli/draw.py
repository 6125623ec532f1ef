"""The command that writes the drawings of counterweights to a file."""

from pathlib import Path
from pkgutil import resolve_name
from typing import Annotated, Any

import typer

from service.cli.terminal import File, answer, content, fail, question
from service.computations.table import COMPUTATIONS

AnswerOption = Annotated[
    str | None,
    typer.Option("--answer", metavar="FILE", help="Draw the counterweights of this answer; else the best ones."),
]
Target = Annotated[Path, typer.Option("-o", "--to", metavar="FILE.zip", help="File to write.")]
#: what says which counterweight it is
_PLACED = ("web", "mass_kg", "angle_deg")


def draw(file: File, to: Target, of: AnswerOption = None) -> None:
    """Draw the counterweights of a machine for a workshop and for other CAD: DXF, SVG, STEP, bill of material."""
    computation = COMPUTATIONS["drawings"]
    fields = {} if of is None else {"counterweights": _fitted(of)}
    drawings = answer(computation.function, question(computation.request_model, file, fields))
    data = resolve_name(computation.forms[0].write)(drawings)
    try:
        to.write_bytes(data)
    except OSError as error:
        fail(f"cannot write {to}: {error.strerror}")
    raise typer.Exit(1 if drawings.status == "inaccurate" else 0)


def _fitted(file: str) -> list[dict[str, Any]]:
    """The counterweights of an answer, as a request names them."""
    body = content(file)
    try:
        every = [
            *body["counterweights"],
            *(counterweight for shaft in body["balance_shafts"] for counterweight in shaft["counterweights"]),
        ]
        return [{name: item[name] for name in _PLACED} for item in every]
    except (KeyError, TypeError):
        fail(f"{file} is not the answer to an optimisation or an analysis")
