"""The command that checks an answer against its request."""

from typing import Annotated

import typer

from service.cli.terminal import AsJson, File, fail, put, show

Answer = Annotated[
    str, typer.Argument(metavar="ANSWER", help="JSON file of its answer; of a sweep, its rows as NDJSON.")
]


def verify(file: File, answer: Answer, as_json: AsJson = False) -> None:
    """Check an answer against its request, from the two files alone."""
    from schemas.request.verify import VerifyAnswer
    from service.verification import checker

    try:
        result = VerifyAnswer.model_validate(checker().verify(checker().read(file), checker().read(answer)))
    except OSError as error:
        fail(f"cannot read {error.filename}: {error.strerror}")
    except ValueError as error:
        fail(str(error))
    if as_json:
        put(result.model_dump_json())
    else:
        from service.report.chapters.verification import verified

        show(verified(result), "answer", result.verdict)
    raise typer.Exit(checker().CODES[result.verdict])
