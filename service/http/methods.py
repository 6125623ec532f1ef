"""Which methods a path answers, whichever routes they belong to."""

from collections.abc import Iterable, Sequence

from starlette.routing import BaseRoute, Match
from starlette.types import Scope


class Methods:
    """The methods of all routes at the path of a request; the framework names those of the first one alone."""

    def __init__(self, routes: Iterable[BaseRoute]) -> None:
        self._routes = tuple(routes)

    def of(self, scope: Scope) -> Sequence[str]:
        """The methods, sorted; none where there is nothing."""
        fitting = [route for route in self._routes if route.matches(scope)[0] is not Match.NONE]
        return sorted({method for route in fitting for method in getattr(route, "methods", None) or ()})
