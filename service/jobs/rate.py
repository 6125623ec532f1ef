"""How fast a job goes on while it is computed."""

from collections.abc import Sequence
from itertools import pairwise

#: chunks take a second or two: between two of a job that is computed, no time is as long as this, nor as so many times
#: nine in ten of the others [s]
_OUTAGE_S = 10.0
_LONGEST = 5.0


def rows_per_second(finished: Sequence[tuple[float, int]], started: float | None) -> float | None:
    """Rows finished in a second, without the times when nobody computed; None where there is nothing to go by.

    Parameters
    ----------
    finished : moments when chunks were finished [s], the latest first, and the rows of each.
    started : when the earliest of them was begun; None if that is unknown.
    """
    ordered = [(started, 0)] if started is not None else []
    ordered += reversed(finished)
    # a clock that was set back tells nothing
    steps = [(max(0.0, later - before), rows) for (before, _), (later, rows) in pairwise(ordered)]
    if not steps:
        return None
    gaps = sorted(gap for gap, _ in steps)
    longest = max(_OUTAGE_S, _LONGEST * gaps[int(0.9 * (len(gaps) - 1))])
    worked = [(gap, rows) for gap, rows in steps if gap <= longest]
    seconds = sum(gap for gap, _ in worked)
    return sum(rows for _, rows in worked) / seconds if seconds > 0 else None
