"""The commands that compute, one for each entry of the table of computations whose answer a terminal can show."""

from collections.abc import Callable
from inspect import Parameter, Signature
from pathlib import Path
from pkgutil import resolve_name
from typing import Annotated, Any

import typer

from service.cli.terminal import WORKBOOK, AsJson, File, answer, fail, put, read_input, show
from service.computations.computation import Computation

#: statuses of answers that fall short of the request
_UNMET = ("infeasible", "inaccurate")
_OPTIONS: dict[str, Any] = {
    "outputs": Annotated[
        list[str] | None,
        typer.Option("--output", help="What the answer shall hold, in place of `outputs` in the file; repeatable."),
    ],
    "points": Annotated[int | None, typer.Option(help="Number of points, in place of `points` in the file.")],
    "total_mass_budgets_kg": Annotated[
        list[str] | None,
        typer.Option(
            "--budget",
            metavar="KG",
            help="A front under this total mass, a number or a text such as '200 lb', in place of"
            " `total_mass_budgets_kg` in the file; repeatable.",
        ),
    ],
    "mass_step_kg": Annotated[
        str | None, typer.Option("--mass-step", metavar="KG", help="In place of `mass_step_kg` in the file.")
    ],
    "angle_step_deg": Annotated[
        str | None, typer.Option("--angle-step", metavar="DEG", help="In place of `angle_step_deg` in the file.")
    ],
    "repeats": Annotated[int | None, typer.Option(help="Rounds of timing, in place of `repeats` in the file.")],
}
_Picture = Annotated[Path | None, typer.Option(metavar="FILE.svg", help="Draw the answer.")]
_Workbook = Annotated[
    Path | None, typer.Option("-o", "--to", metavar="FILE.xlsx", help="Write request and answer to a workbook too.")
]


def command(computation: Computation) -> Callable[..., None]:
    """The command of a computation, with the options that its entry names."""

    def run(file: str, as_json: bool, picture: Path | None = None, to: Path | None = None, **fields: Any) -> None:
        if to is not None and to.suffix.lower() != WORKBOOK:
            fail(f"the name of the workbook must end in {WORKBOOK}")
        request, where = read_input(
            computation.request_model, file, {name: _read(value) for name, value in fields.items() if value}
        )
        outcome = answer(computation.function, request, where)
        name = getattr(getattr(request, "machine", request), "name", None) or computation.title
        if picture is not None:
            try:
                picture.write_text(resolve_name(computation.picture or "")(name, outcome))
            except OSError as error:
                fail(f"cannot write {picture}: {error.strerror}")
        if to is not None:
            try:
                to.write_bytes(resolve_name(computation.workbook or "")(request, outcome))
            except OSError as error:
                fail(f"cannot write {to}: {error.strerror}")
        status = getattr(outcome, "status", None)
        if as_json:
            put(outcome.model_dump_json())
        else:
            show(resolve_name(computation.chapters or "")(request, outcome), name, status)
        raise typer.Exit(1 if status in _UNMET else 0)

    options = {"file": File, **{name: _OPTIONS[name] for name in computation.options}, "as_json": AsJson}
    if computation.picture is not None:
        options["picture"] = _Picture
    if computation.workbook is not None:
        options["to"] = _Workbook
    defaults = {"file": Parameter.empty, "as_json": False}
    run.__doc__ = computation.help
    run.__annotations__ = options
    run.__signature__ = Signature(  # type: ignore[attr-defined]
        [
            Parameter(name, Parameter.KEYWORD_ONLY, default=defaults.get(name), annotation=option)
            for name, option in options.items()
        ]
    )
    return run


def _read(entry: Any) -> Any:
    """Numbers as numbers; texts with a unit as they stand."""
    if isinstance(entry, list):
        return [_read(part) for part in entry]
    try:
        return float(entry) if isinstance(entry, str) else entry
    except ValueError:
        return entry
