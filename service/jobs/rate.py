"""How fast a job goes on while it is computed."""

from collections.abc import Callable, Sequence
from functools import lru_cache
from itertools import pairwise

#: chunks take a second or two. Between two of a job that is computed, no time is as long as this, nor as so many times
#: nine in ten of the others [s]
_OUTAGE_S = 10.0
_LONGEST = 5.0
#: the rate is that of the last so many chunks
LAST_CHUNKS = 100
#: jobs whose rate is not computed again before they change
_JOBS = 1000

Rate = Callable[[str, int, float], float | None]


def rate_by_version(last_finished: Callable[[str, int], Sequence[tuple[float, int]]]) -> Rate:
    """The rate of a job, by its id, its version and its start [s since 1970], computed once for each version.

    A version grows with each chunk that is finished, so the rate of a version does not change. Hundreds may look at a
    job between two chunks. A hundred rows give way to the event loop at each of them, which is what a look costs.

    Parameters
    ----------
    last_finished : the last chunks of a job, at most so many, as :func:`rows_per_second` takes them.
    """

    @lru_cache(_JOBS)
    def rate(job: str, _version: int, started: float) -> float | None:
        finished = last_finished(job, LAST_CHUNKS)
        return rows_per_second(finished, started if len(finished) < LAST_CHUNKS else None)

    return rate


def rows_per_second(finished: Sequence[tuple[float, int]], started: float | None) -> float | None:
    """Rows finished in a second, without the times when nobody computed; None where there is nothing to go by.

    Parameters
    ----------
    finished : moments when chunks were finished [s], the latest first, and the rows of each.
    started : when the earliest of them was begun; None if that is unknown.
    """
    moments = [(started, 0)] if started is not None else []
    moments += reversed(finished)
    # a clock that was set back tells nothing
    steps = [(max(0.0, later - before), rows) for (before, _), (later, rows) in pairwise(moments)]
    if not steps:
        return None
    gaps = sorted(gap for gap, _ in steps)
    longest = max(_OUTAGE_S, _LONGEST * gaps[int(0.9 * (len(gaps) - 1))])
    worked = [(gap, rows) for gap, rows in steps if gap <= longest]
    seconds = sum(gap for gap, _ in worked)
    return sum(rows for _, rows in worked) / seconds if seconds > 0 else None
