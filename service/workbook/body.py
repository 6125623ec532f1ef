"""A workbook as the body of a request: what is wrong with it is said with its cell."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from optimizer.errors import NotComputable
from schemas.base.model import FieldProblem
from service.common.validation import InvalidRequest
from service.workbook.files import workbook_sheets
from service.workbook.sheets import REQUEST, Misplaced, Read, read

#: unpacked; a machine of a hundred webs takes a twentieth of it
_MOST_BYTES = 4_000_000


def read_workbook(content: bytes) -> Read:
    """The request in a workbook.

    Raises
    ------
    UnreadableWorkbook, InvalidRequest
    """
    try:
        return read(workbook_sheets(content, _MOST_BYTES, REQUEST))
    except Misplaced as error:
        raise InvalidRequest(FieldProblem((), line) for line in error.lines) from None


@contextmanager
def cell_places(workbook: Read) -> Iterator[None]:
    """Within it, what is wrong with a field is said with the cell that the field stands in."""
    try:
        yield
    except (InvalidRequest, NotComputable) as error:
        error.problems = _with_cells(workbook, error.problems)
        raise


def _with_cells(workbook: Read, problems: Sequence[FieldProblem]) -> list[FieldProblem]:
    return [FieldProblem(problem.path, f"{workbook.where(problem)}: {problem.message}") for problem in problems]
