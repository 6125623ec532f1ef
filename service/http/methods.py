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
        return getattr(next(iter(self._fitting(scope)), None), "path", None)

    def of(self, scope: Scope) -> Sequence[str]:
        """The methods, sorted; none where there is nothing."""
        return sorted({method for route in self._fitting(scope) for method in getattr(route, "methods", None) or ()})

    def _fitting(self, scope: Scope) -> list[BaseRoute]:
        """Routes at the path as it came: a mounted application has moved the root of its own."""
        whole = {**scope, "root_path": scope.get("app_root_path", scope.get("root_path", ""))}
        return [route for route in self._routes if route.matches(whole)[0] is not Match.NONE]
