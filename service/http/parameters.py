"""Parameters of path and query: those that a route does not have are refused, as unknown fields of bodies are."""

from collections.abc import Collection
from urllib.parse import parse_qsl

from fastapi.routing import APIRoute
from starlette.requests import Request

from schemas.base.model import FieldProblem
from service.guard.keys import PROBES

#: more parameters than any client means are not looked at one by one
_MOST = 50
_LONGEST_NAME = 64


class UnknownParameter(ValueError):
    """The query has parameters that the route does not know; ``problems`` name them."""

    def __init__(self, names: Collection[str]) -> None:
        words = list(dict.fromkeys(name[:_LONGEST_NAME] for name in names))[:_MOST]
        self.problems = [FieldProblem(("query", name), "unknown parameter") for name in words]
        super().__init__("unknown parameter")


def require_parameters(request: Request, allowed: Collection[str] = ()) -> None:
    """Go on only if all parameters of the query are allowed.

    Raises
    ------
    UnknownParameter
    """
    query = request.scope.get("query_string", b"")
    if not query:
        return
    names = [name for name, _ in parse_qsl(query.decode("latin-1"), keep_blank_values=True)]
    unknown = [name for name in names if name not in allowed]
    if unknown:
        raise UnknownParameter(unknown)


async def of_the_route(request: Request) -> None:
    """The same at a route of the framework, which knows its parameters; probes are answered whatever they add."""
    route = request.scope.get("route")
    if isinstance(route, APIRoute) and route.include_in_schema and route.path not in PROBES:
        require_parameters(request, {param.alias for param in route.dependant.query_params})
