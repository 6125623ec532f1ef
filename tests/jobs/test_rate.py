"""The rate of a job leaves outages out (analytic: so many rows in so many seconds of work)."""

import pytest

from service.jobs.database import DatabaseUnavailable
from service.jobs.rate import LAST_CHUNKS, rate_by_version, rows_per_second


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


def test_a_version_is_read_once() -> None:
    """However many look at a job between two chunks, its chunks are read once; a later version is read again."""
    chunks = finished(2, 4)
    values: list[tuple[str, int]] = []

    def last_finished(job: str, most: int) -> list[tuple[float, int]]:
        values.append((job, most))
        return chunks

    rate = rate_by_version(last_finished)
    assert [rate("a", 1, 0.0) for _ in range(3)] == [pytest.approx(50.0)] * 3
    assert values == [("a", LAST_CHUNKS)]
    chunks = finished(1, 2)
    assert (rate("b", 1, 0.0), rate("a", 2, 0.0), rate("a", 1, 0.0)) == pytest.approx((100.0, 100.0, 50.0))
    assert [job for job, _ in values] == ["a", "b", "a"]


def test_of_many_chunks_the_begin_is_unknown() -> None:
    """Where there may be earlier chunks than those that are read, the start of the job says nothing."""
    few, many = finished(2, 4), finished(*range(1000, 1000 + LAST_CHUNKS))
    assert rate_by_version(lambda _, most: few[:most])("a", 1, 0.0) == pytest.approx(50.0)
    assert rate_by_version(lambda _, most: many[:most])("a", 1, 0.0) == pytest.approx(100.0)


def test_a_failure_is_not_kept() -> None:
    """The next look reads again what could not be read."""
    answers: list[Exception | list[tuple[float, int]]] = [DatabaseUnavailable("away"), finished(2, 4)]

    def last_finished(_: str, __: int) -> list[tuple[float, int]]:
        answer = answers.pop(0)
        if isinstance(answer, Exception):
            raise answer
        return answer

    rate = rate_by_version(last_finished)
    with pytest.raises(DatabaseUnavailable):
        rate("a", 1, 0.0)
    assert rate("a", 1, 0.0) == pytest.approx(50.0)
