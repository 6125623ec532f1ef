"""The command line ``counterweight``: the service without a server, on the same JSON.

Exit codes: 0 optimal or computed, 1 infeasible or inaccurate, 2 bad input. The optimiser and the server are imported by
the commands that need them, so that ``--help`` answers at once.
"""

import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NoReturn, TypeVar

import typer

if TYPE_CHECKING:
    from rich.console import RenderableType

    from schemas.base import FieldProblem, Model

    Question = TypeVar("Question", bound=Model)
    Answer = TypeVar("Answer", bound=Model)

BAD_INPUT = 2

app = typer.Typer(
    help="Certified optimum counterweights for reciprocating and scroll machines.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)

File = Annotated[str, typer.Argument(metavar="FILE", help="JSON file, or - for standard input.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print the exact answer of the REST service.")]
Outputs = Annotated[
    list[str] | None,
    typer.Option("--output", help="What the answer shall hold, in place of `outputs` in the file; repeatable."),
]


def main() -> None:
    """Run the command line."""
    app()


@app.command()
def optimize(file: File, as_json: AsJson = False, output: Outputs = None) -> None:
    """Choose the counterweights of a machine."""
    from optimizer.optimize import optimize as compute
    from schemas.requests import OptimizeRequest

    request = _question(OptimizeRequest, file, output)
    answer = _answer(compute, request)
    if as_json:
        _print(answer.model_dump_json())
    else:
        from service.tables import optimize_report

        _show(optimize_report(request.machine.name or "machine", request.objective, answer))
    raise typer.Exit(0 if answer.status == "optimal" else 1)


@app.command()
def analyze(file: File, as_json: AsJson = False, output: Outputs = None) -> None:
    """Say what a machine does as it stands, or with given counterweights."""
    from optimizer.analyze import analyze as compute
    from schemas.requests import AnalyzeRequest

    request = _question(AnalyzeRequest, file, output)
    answer = _answer(compute, request)
    if as_json:
        _print(answer.model_dump_json())
    else:
        from service.tables import analyze_report

        _show(analyze_report(request.machine.name or "machine", answer))


@app.command(name="pin-loads")
def pin_loads(file: File, as_json: AsJson = False) -> None:
    """Say what the anti-rotation pins of a scroll carry over a turn."""
    from optimizer.pin_loads import pin_loads as compute
    from schemas.scroll import PinLoadsRequest

    answer = _answer(compute, _question(PinLoadsRequest, file))
    if as_json:
        _print(answer.model_dump_json())
    else:
        from service.pin_tables import pin_loads_report

        _show(pin_loads_report(answer))


@app.command()
def rating(file: File, as_json: AsJson = False) -> None:
    """Size the cylinders of a compressor, and say what they deliver and need."""
    from optimizer.rating.rate import rate
    from schemas.rating import RatingRequest

    request = _question(RatingRequest, file)
    answer = _answer(rate, request)
    if as_json:
        _print(answer.model_dump_json())
    else:
        from service.rating_tables import rating_report

        _show(rating_report(request.name or "compressor", answer))


@app.command()
def effects(as_json: AsJson = False) -> None:
    """List what can be asked for, and what is simulated and read for it."""
    from optimizer.effects.catalogue import catalogue

    if as_json:
        _print(catalogue().model_dump_json())
    else:
        from service.tables import effects_report

        _show(effects_report(catalogue()))


@app.command()
def examples(
    name: Annotated[str | None, typer.Argument(metavar="NAME", help="Print this one, ready for optimize.")] = None,
    as_json: AsJson = False,
) -> None:
    """List the examples, or print one of them."""
    from service.examples import UnknownExample, catalogue, load

    if name is not None:
        try:
            _print(load(name).decode().rstrip("\n"))
        except UnknownExample:
            _fail("there is no example of this name; `counterweight examples` lists them")
    elif as_json:
        _print(catalogue().model_dump_json())
    else:
        from service.tables import names_report

        _show(names_report("examples", [(one.name, one.title) for one in catalogue().examples]))


@app.command()
def schema(
    name: Annotated[str | None, typer.Argument(metavar="NAME", help="Print the JSON schema of this document.")] = None,
) -> None:
    """List the documents that go in and come out, or print the JSON schema of one of them."""
    import json

    from service.documents import DOCUMENTS

    if name is None:
        from service.tables import names_report

        _show(names_report("documents", [(key, document.meaning) for key, document in DOCUMENTS.items()]))
    elif name in DOCUMENTS:
        _print(json.dumps(DOCUMENTS[name].json_schema(), indent=2))
    else:
        _fail(f"there is no document of this name; there are {', '.join(DOCUMENTS)}")


@app.command()
def serve(
    host: Annotated[str | None, typer.Option(help="Address to listen on.", show_default="127.0.0.1")] = None,
    port: Annotated[int | None, typer.Option(help="Port; 0 takes a free one.", show_default="8000")] = None,
) -> None:
    """Run the REST service until it is interrupted."""
    from pydantic import ValidationError

    from service.server import listen, run, url
    from service.settings import Settings

    given: dict[str, Any] = {key: value for key, value in (("host", host), ("port", port)) if value is not None}
    try:
        settings = Settings(**given)
        socket = listen(settings)
    except ValidationError as error:
        _fail(*(f"{'.'.join(map(str, detail['loc']))}: {detail['msg']}" for detail in error.errors()))
    except OSError as error:
        _fail(f"cannot listen on {settings.host}, port {settings.port}: {error.strerror or error}")
    _print(f"counterweight listens on {url(socket)} (documentation at {url(socket)}/docs)")
    run(settings, socket)


def _question(model: "type[Question]", file: str, outputs: Sequence[str] | None = None) -> "Question":
    """The request in a file, with other outputs if they were given."""
    from service.validation import InvalidRequest, UnreadableJson, check, read_json

    source = "standard input" if file == "-" else file
    try:
        body = read_json(_read(file))
        if outputs and isinstance(body, dict):
            body = {**body, "outputs": outputs}
        return check(model, body)
    except OSError as error:
        _fail(f"cannot read {source}: {error.strerror}")
    except UnreadableJson as error:
        _fail(f"{source} is not JSON: {error}")
    except InvalidRequest as error:
        _fail_fields(error.problems, error.more)


def _read(file: str) -> bytes:
    if file != "-":
        return Path(file).read_bytes()
    if sys.stdin is None:
        _fail("standard input is closed")
    return sys.stdin.buffer.read()


def _answer(compute: "Callable[[Question], Answer]", question: "Question") -> "Answer":
    from optimizer.errors import MissingInput
    from optimizer.rating.errors import OutOfRange

    try:
        return compute(question)
    except (MissingInput, OutOfRange) as error:
        _fail_fields(error.problems)


def _fail_fields(problems: "Sequence[FieldProblem]", more: bool = False) -> NoReturn:
    from service.validation import pointer

    lines = [f"{pointer(problem.path) or 'the request'}: {problem.message}" for problem in problems]
    _fail(*lines, *(["... and more"] if more else []))


def _fail(*lines: str) -> NoReturn:
    for line in lines:
        typer.echo(line, err=True)
    raise typer.Exit(BAD_INPUT)


def _show(content: "RenderableType") -> None:
    from rich.console import Console

    console = Console()
    if not console.is_terminal:
        console.width = 160
    with console.capture() as rendered:
        console.print(content)
    _print(rendered.get().rstrip("\n"))


def _print(text: str) -> None:
    if sys.stdout is None:
        _fail("standard output is closed")
    try:
        sys.stdout.reconfigure(errors="replace")  # type: ignore[union-attr]
        sys.stdout.write(text + "\n")
        sys.stdout.flush()
    except OSError as error:
        # what is still in the buffer must not fail once more at exit
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        _fail(f"cannot write to standard output: {error.strerror}")
