"""What can be wrong with a request that is well formed."""

from collections.abc import Iterable

from schemas.base import FieldProblem


class MissingInput(ValueError):
    """A requested output needs data that the machine does not give; sending them helps."""

    def __init__(self, problems: Iterable[FieldProblem]) -> None:
        self.problems = list(problems)
        super().__init__("; ".join(problem.message for problem in self.problems))
