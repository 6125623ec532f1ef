"""What can be wrong with a rating whose every field is right by itself."""

from collections.abc import Iterable

from schemas.base import FieldProblem


class OutOfRange(ValueError):
    """The inputs do not go together: no cylinder can do this; other ones help.

    ``problems`` name fields by paths from the root of the request.
    """

    def __init__(self, problems: Iterable[FieldProblem]) -> None:
        self.problems = list(problems)
        super().__init__("; ".join(problem.message for problem in self.problems))


def refuse(problems: Iterable[FieldProblem]) -> None:
    """Raise :class:`OutOfRange` if there are any problems."""
    found = list(problems)
    if found:
        raise OutOfRange(found)
