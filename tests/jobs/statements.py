"""Crash at every statement to PostgreSQL on the path of jobs from their order to their end.

A process is forked for each point, does all that services do to jobs (:mod:`tests.jobs.crashes`), and is killed by
SIGKILL at the point: before a statement, before the commit of a transaction, or when that has come through. Then
another one finds out what the server has, and goes on with it.

``python -m tests.jobs.statements`` crashes at every point, with ``--points`` at so many, evenly spread; the tests crash
at a few.
"""

import os
import signal
import sys
import tempfile
from functools import partial
from pathlib import Path

import psycopg
from sqlalchemy import Engine, event
from sqlalchemy.pool import Pool

from tests.jobs import postgres
from tests.jobs.crashes import Journal, check, live, report

#: what SQLAlchemy calls the points
_POINTS = ((Engine, "before_cursor_execute"), (Engine, "commit"), (Pool, "checkin"))


class _Passed:
    """Points that a process came to, in memory that outlives it; at one of them it ends."""

    def __init__(self, at: int | None) -> None:
        self._at, self.journal = at, Journal()

    def listen(self) -> None:
        """Count from now on."""
        number = 0

        def come(name: str, *_: object) -> None:
            nonlocal number
            self.journal.say(name, "-", number)
            if number == self._at:
                os.kill(os.getpid(), signal.SIGKILL)
            number += 1

        for target, name in _POINTS:
            event.listen(target, name, partial(come, name))

    @property
    def names(self) -> list[str]:
        """What the points are."""
        return [name for name, _, _ in self.journal]


def _life(root: Path, journal: Journal, url: str, at: int | None = None) -> list[str]:
    """The points that a process comes to that ends at one of them, or lives to the end."""
    passed = _Passed(at)
    child = os.fork()
    if child == 0:
        try:
            passed.listen()
            live(root, journal, url)
        except BaseException:
            sys.excepthook(*sys.exc_info())
            os._exit(1)
        os._exit(0)
    _, status = os.waitpid(child, 0)
    assert os.waitstatus_to_exitcode(status) == (0 if at is None else -signal.SIGKILL), "the work was not done"
    return passed.names


def crashes(url: str, points: int) -> tuple[int, int, int, int]:
    """Crash at so many points, evenly spread: points, how many there are, rows lost, orphans."""
    with tempfile.TemporaryDirectory() as folder:
        names = _life(Path(folder), journal := Journal(), url)
        assert check(Path(folder), journal, url) == (0, 0)
        _emptied(url)
    chosen = [number * len(names) // points for number in range(points)] if points < len(names) else range(len(names))
    lost = orphans = tried = 0
    for at in chosen:
        with tempfile.TemporaryDirectory() as folder:
            journal = Journal()
            tried += len(_life(Path(folder), journal, url, at)) == at + 1
            more = check(Path(folder), journal, url)
            lost, orphans = lost + more[0], orphans + more[1]
        _emptied(url)
    return tried, len(names), lost, orphans


def _emptied(url: str) -> None:
    with psycopg.connect(url, autocommit=True) as connection:
        connection.execute("DROP SCHEMA public CASCADE")
        connection.execute("CREATE SCHEMA public")


def _on_a_server(points: int) -> tuple[int, int, int, int]:
    with postgres.server() as server:
        return crashes(server.url, points)


if __name__ == "__main__":
    report(__doc__, _on_a_server, postgres.Missing)
