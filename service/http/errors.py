"""From exceptions to problem details, by one table; no route knows a status code."""

from collections import Counter
from types import MappingProxyType

from fastapi import FastAPI
from starlette.requests import Request
from starlette.responses import Response

from service.common.problems import Fault, FaultTable
from service.http.methods import Methods
from service.wire.refusal import response


def union(*tables: FaultTable) -> FaultTable:
    """One table of the faults of all rooms.

    Raises
    ------
    ValueError
        if two tables say something about the same exception.
    """
    twice = [kind.__name__ for kind, times in Counter(kind for table in tables for kind in table).items() if times > 1]
    if twice:
        raise ValueError(f"in two tables of faults: {', '.join(twice)}")
    return MappingProxyType({kind: describe for table in tables for kind, describe in table.items()})


class ErrorAnswers:
    """Answers exceptions with problem details.

    Parameters
    ----------
    faults : what is said about every exception, that of the nearest base for one that is not there.
    """

    def __init__(self, faults: FaultTable) -> None:
        self._faults = faults

    def foreseen(self, error: Exception) -> bool:
        """Whether the table has more to say than that something failed."""
        return any(kind in self._faults for kind in type(error).__mro__[: -len(Exception.__mro__)])

    def answer(self, error: Exception, path: str) -> Response:
        """The problem details of an exception as an answer to a request for a path."""
        return response(self.fault(error), path)

    def fault(self, error: Exception) -> Fault:
        """What is said about an exception."""
        return next(self._faults[kind] for kind in type(error).__mro__ if kind in self._faults)(error)

    def install(self, app: FastAPI, methods: Methods) -> None:
        """Answer every exception of the table with problem details, and name all methods of a path where one is not."""

        async def handle(request: Request, error: Exception) -> Response:
            answer = self.answer(error, request.scope["path"])
            if answer.status_code == 405:
                answer.headers["Allow"] = ", ".join(methods.of(request.scope))
            return answer

        for kind in self._faults:
            app.add_exception_handler(kind, handle)
