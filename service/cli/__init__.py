"""The command line ``counterweight``: the service without a server, on the same JSON.

Exit codes: 0 optimal or computed, 1 infeasible or inaccurate, 2 bad input. The optimiser and the server are imported by
the commands that need them, so that ``--help`` answers at once.
"""

import typer

from service.cli.accuracy import accuracy
from service.cli.catalogue import effects, examples, schema
from service.cli.compute import analyze, optimize, pin_loads, rating
from service.cli.key import key
from service.cli.pareto import pareto
from service.cli.report import report
from service.cli.serve import serve
from service.cli.sweep import sweep
from service.cli.verify import verify

app = typer.Typer(
    help="Certified optimum counterweights for reciprocating and scroll machines.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
app.command()(optimize)
app.command()(analyze)
app.command(name="pin-loads")(pin_loads)
app.command()(rating)
app.command()(pareto)
app.command()(accuracy)
app.command()(sweep)
app.command()(report)
app.command()(verify)
app.command()(effects)
app.command()(examples)
app.command()(schema)
app.command()(serve)
app.add_typer(key, name="key")


def main() -> None:
    """Run the command line."""
    app()
