"""Lanes of a worker: tasks of alike priorities, each with a thread of its own that reads them and computes them.

A thread that was nice once may not go back, and one that is behind others would wake late for a task that is not. So
first tasks have a lane of their own, and no task is handed from one thread to another: that takes as long as to check a
request.
"""

import os
import socket
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import BinaryIO

from service.common.time_slices import set_slice
from service.workers.task import Priority, Task

#: nicer than the first thread of a worker by so much
_BEHIND = {Priority.FIRST: 0, Priority.FURTHER: 8, Priority.LONG: 11}
_NICEST = 19


@dataclass(frozen=True)
class Lane:
    """Tasks that come on one connection.

    name : of its thread, by which the service knows it.
    foremost : the priority before which none of them is; a thread that is behind it reads no more of them.
    """

    name: str
    foremost: Priority


FIRST, FURTHER = Lane("first", Priority.FIRST), Lane("further", Priority.FURTHER)
LANES = (FIRST, FURTHER)


def lane_of(priority: Priority) -> Lane:
    """The lane in which tasks of a priority come."""
    return FIRST if priority is Priority.FIRST else FURTHER


def niceness(priority: Priority, pid: int) -> int:
    """How nice a thread of a worker is that computes something of a priority."""
    return min(_NICEST, os.getpriority(os.PRIO_PROCESS, pid) + _BEHIND[priority])


def lower(lane: Lane, priority: Priority, pid: int) -> None:
    """Have what the thread of a lane computes go on behind others, as tasks of a priority do.

    Raises
    ------
    OSError
        if the process is gone, or the system tells nothing of its threads.
    """
    for thread in Path(f"/proc/{pid}/task").iterdir():
        if (thread / "comm").read_text().rstrip() == lane.name:
            os.setpriority(os.PRIO_PROCESS, int(thread.name), niceness(priority, pid))


def compute(lane: Lane, connection: socket.socket, answer: Callable[[Task], None]) -> None:
    """Have the tasks of a lane answered until nobody asks any more.

    The thread that calls only waits: it starts another one that computes, as nice as it is itself, when that of before
    has become too nice.
    """
    with suppress(EOFError, BrokenPipeError, ConnectionResetError), connection.makefile("rb") as stream:
        task, priority = Task.receive(stream)
        while True:
            with ThreadPoolExecutor(1, initializer=_begin, initargs=(lane,)) as thread:
                answers = partial(answer_all, lane, stream, answer)
                while (following := thread.submit(answers, task, priority).result()) is None:
                    task, priority = Task.receive(stream)
                task, priority = following


def answer_all(
    lane: Lane, stream: BinaryIO, answer: Callable[[Task], None], task: Task, priority: Priority
) -> tuple[Task, Priority] | None:
    """Answer tasks, one that was read before and those that come; until one comes for which this thread is too nice.

    Returns
    -------
    that one. Or None once this thread is behind what may come.
    """
    while _takes(priority):
        answer(task)
        del task
        if _own() > niceness(lane.foremost, os.getpid()):
            return None
        task, priority = Task.receive(stream)
    return task, priority


def _begin(lane: Lane) -> None:
    # where the system names no threads, the service finds none to lower
    with suppress(OSError):
        Path("/proc/thread-self/comm").write_text(lane.name)
    if lane is not FIRST:
        # first tasks have short slices, as the thread that starts this one has
        with suppress(OSError):
            set_slice(None)


def _takes(priority: Priority) -> bool:
    """Whether this thread may have a priority; it has it then."""
    target, own = niceness(priority, os.getpid()), _own()
    if own < target:
        os.setpriority(os.PRIO_PROCESS, 0, target)
    return own <= target


def _own() -> int:
    return os.getpriority(os.PRIO_PROCESS, 0)
