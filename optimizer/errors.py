"""What can be wrong with a request that is well formed."""

from collections.abc import Iterable

from schemas.base.model import FieldProblem


class NotComputable(ValueError):
    """The request cannot be computed; ``problems`` name fields by paths from its root."""

    def __init__(self, problems: Iterable[FieldProblem]) -> None:
        self.problems = list(problems)
        super().__init__("; ".join(problem.message for problem in self.problems))


class MissingInput(NotComputable):
    """A requested output needs data that the machine does not give; sending them helps."""


class OutOfRange(NotComputable):
    """The inputs do not go together: no cylinder can do this; other ones help."""


def refuse(problems: Iterable[FieldProblem]) -> None:
    """Raise :class:`OutOfRange` if there are any problems."""
    faults = list(problems)
    if faults:
        raise OutOfRange(faults)
