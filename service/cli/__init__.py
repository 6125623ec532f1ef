"""The command line ``counterweight``: the service without a server, on the same JSON.

Exit codes: 0 optimal or computed, 1 infeasible or inaccurate, 2 bad input, 70 a fault of this program. The optimiser
and the server are imported by the commands that need them, so that ``--help`` answers at once.
"""

import gc
import os
import traceback
from typing import Annotated

import typer

from service.cli.catalogue import effects, examples, schema
from service.cli.compute import command
from service.cli.draw import draw
from service.cli.key import key
from service.cli.plot import plot
from service.cli.report import report
from service.cli.serve import serve
from service.cli.sweep import sweep
from service.cli.table import table
from service.cli.template import template
from service.cli.terminal import FAULT, put
from service.cli.verify import verify
from service.computations.table import COMPUTATIONS

#: new objects before those are looked for that nothing holds any more; a first answer makes 220,000, nearly all of
#: them modules and models
_COLLECTED_AFTER = 250_000
#: read by libraries when they are imported. Matrices are small, and threads that wait for large ones take a fifteenth
#: of a first answer. Plugins of models are looked for in all that is installed
_LIBRARIES = {"OPENBLAS_NUM_THREADS": "1", "PYDANTIC_DISABLE_PLUGINS": "__all__"}
#: setting of the service; at debug a fault of the program comes with its traceback
_LOG_LEVEL = "COUNTERWEIGHT_LOG_LEVEL"


def _version(value: bool) -> None:
    if value:
        from schemas.base.version import package_version

        put(package_version())
        raise typer.Exit


def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and exit.")
    ] = False,
) -> None:
    """Certified optimum counterweights for reciprocating and scroll machines."""


def command_line() -> typer.Typer:
    """All commands."""
    application = typer.Typer(
        no_args_is_help=True,
        add_completion=False,
        pretty_exceptions_enable=False,
    )
    application.callback()(_options)
    for computation in COMPUTATIONS.values():
        if computation.chapters is not None:
            application.command(name=computation.title)(command(computation))
    for function in (sweep, plot, report, draw, table, template, verify, effects, examples, schema, serve):
        application.command()(function)
    application.add_typer(key, name="key")
    return application


app = command_line()


def main() -> None:
    """Run the command line.

    What nothing here expects is said in a line, and by an exit code of its own: an answer has another.
    """
    gc.set_threshold(_COLLECTED_AFTER)
    for name, value in _LIBRARIES.items():
        os.environ.setdefault(name, value)
    try:
        app()
    except Exception as error:
        if os.environ.get(_LOG_LEVEL, "").lower() == "debug":
            traceback.print_exc()
        message = f"{type(error).__name__}: {error}".partition("\n")[0]
        typer.echo(f"internal fault, not of the input: {message} ({_LOG_LEVEL}=debug logs where)", err=True)
        raise SystemExit(FAULT) from None
    finally:
        # the interpreter looks through all that is loaded before it ends: a sixth of a first answer
        gc.freeze()
