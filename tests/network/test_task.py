"""What a worker is asked, over a stream."""

import io
from dataclasses import replace

import pytest

from service.computations import COMPUTATIONS
from service.guard.sizes import SizeLimits
from service.settings import Settings
from service.workers.task import Priority, Task

_ONE = COMPUTATIONS["optimize"]
PLAIN = Task(_ONE, _ONE.forms[0], b'{"machine": {}}', SizeLimits.of(Settings()))
OTHERS = (
    replace(PLAIN, body=b""),
    replace(PLAIN, form=_ONE.forms[1], coding="zstd", workbook=True),
    replace(PLAIN, computation=COMPUTATIONS["pareto"], long=True),
    replace(PLAIN, limits=SizeLimits.of(Settings(max_rows=3))),
)


def test_tasks_come_as_they_were_said() -> None:
    said = [(task, priority) for task in (PLAIN, *OTHERS, PLAIN) for priority in Priority]
    stream = io.BytesIO(b"".join(task.serialize(priority) for task, priority in said))
    assert [Task.receive(stream) for _ in said] == said


@pytest.mark.parametrize("left", [0, 5, 20, 1000])
def test_what_ends_early_is_an_end(left: int) -> None:
    whole = replace(PLAIN, body=b"x" * 2000).serialize(Priority.FIRST)
    assert len(whole) > 2000
    with pytest.raises(EOFError):
        Task.receive(io.BytesIO(whole[:left]))
