"""The process that workers are forked from: one for all, forked itself, replaced when it has ended."""

from multiprocessing import forkserver, get_context

import psutil

from tests.mould import FORK_SERVER

_CONTEXT = get_context("forkserver")


def _forked() -> tuple[int, int]:
    """The process that one was forked from, and its parent."""
    process = _CONTEXT.Process(target=abs, args=(1,))
    process.start()
    process.join(180)
    assert process.exitcode == 0
    pid: int = forkserver._forkserver._forkserver_pid  # type: ignore[attr-defined]
    return pid, psutil.Process(pid).ppid()


def test_it_is_forked_and_stays() -> None:
    (first, mould), (second, _) = _forked(), _forked()
    assert first == second
    assert psutil.Process(first).name() == FORK_SERVER
    assert "tests.mould" in " ".join(psutil.Process(mould).cmdline())


def test_one_that_was_killed_is_replaced() -> None:
    first, _ = _forked()
    server = psutil.Process(first)
    server.kill()
    server.wait(180)
    second, _ = _forked()
    assert second != first
