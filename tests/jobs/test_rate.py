"""The rate of a job leaves outages out (analytic: so many rows in so many seconds of work)."""

import pytest

from service.jobs.rate import rows_per_second


def finished(*moments: float, rows: int = 100) -> list[tuple[float, int]]:
    """Chunks of as many rows each, the latest first."""
    return [(moment, rows) for moment in reversed(moments)]


@pytest.mark.parametrize(
    ("chunks", "started", "rate"),
    [
        ([], 0.0, None),
        ([], None, None),
        # two seconds a chunk
        (finished(2), 0.0, 50.0),
        (finished(2, 4, 6), 0.0, 50.0),
        # the first one tells nothing where its begin is unknown
        (finished(2), None, None),
        (finished(2, 4, 6), None, 50.0),
        # the service was away for ten minutes in the middle, and before anything was finished
        (finished(2, 4, 6, 606, 608, 610), 0.0, 50.0),
        (finished(600, 602, 604), 0.0, 50.0),
        # two workers that finish together
        (finished(2, 2, 4, 4, 6, 6), 0.0, 100.0),
        # chunks that are slow, all of them
        (finished(60, 120, 180), 0.0, 100 / 60),
        # the clock was set back
        (finished(1002, 1004, 6, 8), 1000.0, 400 / 6),
        (finished(5, 5, 5), 5.0, None),
    ],
)
def test_rates(chunks: list[tuple[float, int]], started: float | None, rate: float | None) -> None:
    assert rows_per_second(chunks, started) == (None if rate is None else pytest.approx(rate))
