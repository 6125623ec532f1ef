"""What a command reads from files and writes to the terminal."""

import os
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Generic, NamedTuple, NoReturn, TypeVar

import typer

if TYPE_CHECKING:
    from schemas.base.model import FieldProblem, Model
    from service.report.blocks import Chapter

Question = TypeVar("Question", bound="Model")
Answer = TypeVar("Answer")

BAD_INPUT = 2
#: exit code of a fault of the program itself, EX_SOFTWARE of sysexits.h
FAULT = 70
#: how the name of a workbook ends
WORKBOOK = ".xlsx"
_STYLES = {
    **dict.fromkeys(("optimal", "measured", "held"), "bold green"),
    **dict.fromkeys(("infeasible", "broken"), "bold red"),
}

File = Annotated[str, typer.Argument(metavar="FILE", help="JSON file or workbook (.xlsx), or - for standard input.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print the exact answer of the REST service.")]


class Input(NamedTuple, Generic[Question]):
    """A request, and where its file says what; ``where`` takes a problem of a field."""

    request: Question
    where: "Callable[[FieldProblem], str]"


def question(model: type[Question], file: str, fields: Mapping[str, object] | None = None) -> Question:
    """The request in a file, with fields of the command line in place of those in it."""
    return read_input(model, file, fields).request


def read_input(model: type[Question], file: str, fields: Mapping[str, object] | None = None) -> Input[Question]:
    """The same, and where it stands: of a workbook in which cell."""
    from service.common.validation import InvalidRequest, check

    body, where = _cells(file) if file.lower().endswith(WORKBOOK) else (content(file), _pointer)
    if fields and isinstance(body, dict):
        body = {**body, **fields}
    try:
        return Input(check(model, body), where)
    except InvalidRequest as error:
        fail_fields(error.problems, error.more, where)


def _cells(file: str) -> "tuple[Any, Callable[[FieldProblem], str]]":
    """The request in a workbook."""
    from service.workbook.census import UnreadableWorkbook
    from service.workbook.files import workbook_sheets
    from service.workbook.sheets import REQUEST, Misplaced, read

    try:
        request = read(workbook_sheets(_read(file), names=REQUEST))
    except OSError as error:
        fail(f"cannot read {file}: {error.strerror}")
    except UnreadableWorkbook as error:
        fail(f"{file}: {error}")
    except Misplaced as error:
        fail(*error.lines)
    return request.body, request.where


def _pointer(problem: "FieldProblem") -> str:
    from service.common.validation import pointer

    return pointer(problem.path) or "the request"


def content(file: str) -> Any:
    """The JSON in a file."""
    from service.common.validation import UnreadableJson, read_json

    source = "standard input" if file == "-" else file
    try:
        return read_json(_read(file))
    except OSError as error:
        fail(f"cannot read {source}: {error.strerror}")
    except UnreadableJson as error:
        fail(f"{source} is not JSON: {error}")


def _read(file: str) -> bytes:
    if file != "-":
        return Path(file).read_bytes()
    if sys.stdin is None:
        fail("standard input is closed")
    return sys.stdin.buffer.read()


def answer(
    compute: "Callable[[Question], Answer]", question: Question, where: "Callable[[FieldProblem], str]" = _pointer
) -> "Answer":
    from optimizer.errors import NotComputable

    try:
        return compute(question)
    except NotComputable as error:
        fail_fields(error.problems, where=where)


def fail_fields(
    problems: "Sequence[FieldProblem]", more: bool = False, where: "Callable[[FieldProblem], str]" = _pointer
) -> NoReturn:
    lines = [f"{where(problem)}: {problem.message}" for problem in problems]
    fail(*lines, *(["... and more"] if more else []))


def fail(*lines: str) -> NoReturn:
    from service.common.plain import plain

    for line in lines:
        # it may quote the file, whose texts are no commands to the terminal
        typer.echo(plain(line).replace("\r", "\ufffd"), err=True)
    raise typer.Exit(BAD_INPUT)


def show(chapters: "Iterable[Chapter]", name: str | None = None, status: str | None = None) -> None:
    """Print chapters, under the name of what they are about and how it ended."""
    from rich.console import Console, Group
    from rich.text import Text

    from service.common.plain import plain
    from service.report.terminal import terminal

    ending = (f": {status}", _STYLES.get(status, "bold yellow")) if status else ""
    heading = [] if name is None else [Text.assemble(plain(name), ending)]
    console = Console()
    if not console.is_terminal:
        console.width = 160
    with console.capture() as rendered:
        console.print(Group(*heading, terminal(chapters)))
    put(rendered.get().rstrip("\n"))


def put(text: str) -> None:
    if sys.stdout is None:
        fail("standard output is closed")
    try:
        sys.stdout.reconfigure(errors="replace")  # type: ignore[union-attr]
        sys.stdout.write(text + "\n")
        sys.stdout.flush()
    except OSError as error:
        # what is still in the buffer must not fail once more at exit
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        fail(f"cannot write to standard output: {error.strerror}")
