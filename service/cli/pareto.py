"""The command that trades peak force against peak moment."""

from typing import TYPE_CHECKING, Annotated

import typer

from service.cli.terminal import AsJson, File, answer, fail_fields, put, question, show

if TYPE_CHECKING:
    from collections.abc import Mapping

    from schemas.pareto import ParetoRequest

Points = Annotated[int | None, typer.Option("--points", help="Number of points, in place of `points` in the file.")]
Budgets = Annotated[
    list[str] | None,
    typer.Option(
        "--budget",
        metavar="KG",
        help="A front under this total mass, a number or a text such as '200 lb', in place of"
        " `total_mass_budgets_kg` in the file; repeatable.",
    ),
]


def pareto(file: File, points: Points = None, budget: Budgets = None, as_json: AsJson = False) -> None:
    """Trade peak force against peak moment: points that no counterweights beat in both."""
    from optimizer.pareto.pareto import pareto as compute
    from schemas.pareto import ParetoRequest

    given: dict[str, object] = {} if points is None else {"points": points}
    if budget:
        given["total_mass_budgets_kg"] = [_quantity(each) for each in budget]
    request = _with(question(ParetoRequest, file), given)
    found = answer(compute, request)
    if as_json:
        put(found.model_dump_json())
    else:
        from service.pareto_tables import pareto_report

        show(pareto_report(request.machine.name or "machine", request.objective, found))
    raise typer.Exit(0 if found.status == "optimal" else 1)


def _with(request: "ParetoRequest", given: "Mapping[str, object]") -> "ParetoRequest":
    """The request with some fields given on the command line, checked like those of the file."""
    from schemas.pareto import ParetoRequest
    from service.http.validation import InvalidRequest, check

    fields = {name: getattr(request, name) for name in request.model_fields_set}
    try:
        return check(ParetoRequest, {**fields, **given})
    except InvalidRequest as error:
        fail_fields(error.problems, error.more)


def _quantity(text: str) -> float | str:
    """A number, or a text with a unit as it stands."""
    try:
        return float(text)
    except ValueError:
        return text
