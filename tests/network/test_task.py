"""What a worker is asked, over a stream."""

import io
from dataclasses import replace

import pytest

from service.computations.table import COMPUTATIONS
from service.guard.sizes import SizeLimits
from service.settings import Settings
from service.workers.task import Priority, Task

_ONE = COMPUTATIONS["optimize"]
SETTINGS = Settings()
PLAIN = Task(_ONE, _ONE.forms[0], b'{"machine": {}}', SizeLimits.of(SETTINGS))
OTHERS = (
    replace(PLAIN, body=b""),
    replace(PLAIN, form=_ONE.forms[1], coding="zstd", workbook=True),
    replace(PLAIN, computation=COMPUTATIONS["pareto"], long=True),
    replace(PLAIN, limits=SizeLimits.of(Settings(max_rows=3))),
)


def test_tasks_come_as_they_were_said() -> None:
    values = [(task, priority) for task in (PLAIN, *OTHERS, PLAIN) for priority in Priority]
    stream = io.BytesIO(b"".join(task.serialize(priority) for task, priority in values))
    assert [Task.receive(stream) for _ in values] == values


@pytest.mark.parametrize("left", [0, 5, 20, 1000])
def test_what_ends_early_is_an_end(left: int) -> None:
    whole = replace(PLAIN, body=b"x" * 2000).serialize(Priority.FIRST)
    assert len(whole) > 2000
    with pytest.raises(EOFError):
        Task.receive(io.BytesIO(whole[:left]))


def test_tasks_that_do_not_last_are_not_taken_for_those_that_come_after_them() -> None:
    """What is known by its identity may be gone, and another one have its place in memory."""
    for rows in range(1, 2_000):
        limits = SizeLimits.of(SETTINGS.model_copy(update={"max_rows": rows}))
        task, _ = Task.receive(io.BytesIO(replace(PLAIN, limits=limits).serialize(Priority.FIRST)))
        assert task.limits.rows == rows
