"""Which routes a path has, and which methods they answer together."""

from collections.abc import Iterable, Sequence

from starlette.routing import BaseRoute, Match
from starlette.types import Scope


class Methods:
    """The methods of all routes at the path of a request; the framework names those of the first one alone."""

    def __init__(self, routes: Iterable[BaseRoute]) -> None:
        # a router that another one holds has no path of its own
        self._routes = tuple(route for route in routes if hasattr(route, "path"))

    def template(self, scope: Scope) -> str | None:
        """The path of the first route, as it is written; None where there is nothing."""
        found = (route for route in self._routes if route.matches(scope)[0] is not Match.NONE)
        return getattr(next(found, None), "path", None)

    def of(self, scope: Scope) -> Sequence[str]:
        """The methods, sorted; none where there is nothing."""
        fitting = [route for route in self._routes if route.matches(scope)[0] is not Match.NONE]
        return sorted({method for route in fitting for method in getattr(route, "methods", None) or ()})
