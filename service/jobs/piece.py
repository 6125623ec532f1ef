"""What a chunk comes to, and the ways in which it comes to nothing."""

from collections.abc import Callable
from dataclasses import dataclass


class Stopped(Exception):
    """The flag of the job ended the work."""


class Unanswerable(Exception):
    """The request has no answer; computing it again does not help."""


@dataclass(frozen=True)
class ChunkResult:
    """What a chunk comes to: the content of its file, and how many of its rows failed; of a selection, its rows.

    invalid : rows of designs that break a rule; they did not fail.
    infeasible : of the rows that failed, those proven to have no counterweights.
    faults : number of own answers that the service has reported as wrong, in the answers too.
    """

    content: bytes
    failed: int
    selection_rows: int = 0
    invalid: int = 0
    faults: tuple[str, ...] = ()
    infeasible: int = 0


#: kind, request, start, stop, path of the flag -> piece
Run = Callable[[str, bytes, int, int, str], ChunkResult]
