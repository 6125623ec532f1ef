"""What a chunk comes to, and the ways in which it comes to nothing."""

from collections.abc import Callable
from dataclasses import dataclass


class Stopped(Exception):
    """The flag of the job told the worker to stop."""


class Unanswerable(Exception):
    """The request has no answer; computing it again does not help."""


@dataclass(frozen=True)
class ChunkResult:
    """What a chunk comes to: the content of its file, and how many of its rows failed; of a selection, its rows.

    invalid : rows of designs that break a rule; they did not fail.
    infeasible : of the rows that failed, those proven to have no counterweights.
    faults : what the service found wrong with its own answers, and says in them.
    """

    content: bytes
    failed: int
    selection_rows: int = 0
    invalid: int = 0
    faults: tuple[str, ...] = ()
    infeasible: int = 0


#: kind, request, start, stop, path of the flag -> piece
Run = Callable[[str, bytes, int, int, str], ChunkResult]
