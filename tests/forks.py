"""A run of the tests in several processes, each forked from the one that has collected them.

To import all and to collect takes six seconds of a core, so it happens once. Each process runs one test at a time and
sends its reports; it has the test after it as well, whose fixtures it may keep. tests/distribution.py says what comes
next. The last that run share what is left of long files.
"""

import multiprocessing
import os
import signal
import sys
import traceback
import warnings
from collections import deque
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import count
from multiprocessing.connection import Connection, wait
from multiprocessing.context import ForkProcess
from typing import Any, NoReturn

import pytest
from _pytest.capture import CaptureManager

from tests.commands import share_mould
from tests.distribution import Distribution, begins_with_what_waits, divides
from tests.mould import PR_SET_PDEATHSIG, prctl

_FORK = multiprocessing.get_context("fork")
#: what only the process does that prints and counts
_OF_THE_FIRST = ("terminalreporter", "lfplugin", "nfplugin", "stepwiseplugin")
#: of what begins with tests that compute: sweeps of services are nicer by 15, and who waits for them would wait for all
#: that is computed beside them; what is nicer still would get nothing beside other programs
_NICE = 10
#: tests that are left of a file so that another process takes half: of fewer it would rather make fixtures anew
_LEFT = 8
#: between two looks at processes that say nothing [s]
_LOOK_S = 1.0
#: at the end of a run that is broken off, for a process to end [s]
_END_S = 10.0


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("processes")
    # pytest keeps short names for itself, and pytest-xdist has made this one customary
    group._addoption("-n", "--numprocesses", type=int, default=0, help="processes that run the tests beside each other")


@pytest.hookimpl(tryfirst=True)
def pytest_runtestloop(session: pytest.Session) -> bool | None:
    """In several processes, if they are asked for."""
    processes: int = session.config.getoption("numprocesses")
    if processes == 0 or session.testsfailed or session.config.getoption("collectonly"):
        return None
    Run(session).run(processes)
    if session.shouldfail:
        raise session.Failed(session.shouldfail)
    if session.shouldstop:
        raise session.Interrupted(session.shouldstop)
    return True


class Messages:
    """What one test has to say to the first process, as a plugin of pytest in another."""

    def __init__(self, config: pytest.Config) -> None:
        self._config = config
        # all say how long they took; of most tests that is all that two of three say
        self._every = config.getoption("durations") is not None or config.getoption("xmlpath") is not None
        self._reports: list[dict[str, Any]] = []
        self._warnings: list[dict[str, Any]] = []

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.passed and report.when != "call" and not self._every:
            return
        data = self._config.hook.pytest_report_to_serializable(config=self._config, report=report)
        self._reports.append(data)

    def pytest_warning_recorded(
        self, warning_message: warnings.WarningMessage, when: str, nodeid: str, location: object
    ) -> None:
        message = warning_message
        # its text, as not all that a warning holds can be sent
        text = warnings.WarningMessage(str(message.message), message.category, message.filename, message.lineno)
        self._warnings.append({"warning_message": text, "when": when, "nodeid": nodeid, "location": location})

    def take(self) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
        """Reports and warnings since the last time."""
        taken = self._reports, self._warnings
        self._reports, self._warnings = [], []
        return taken


@dataclass(frozen=True)
class Worker:
    """A process, and the tests that it has: the first of `sent` runs, of its unit the rest is still here."""

    process: ForkProcess
    connection: Connection
    waiting: bool
    unit: deque[int]
    sent: deque[int] = field(default_factory=deque)


class Run:
    """All tests of a session in as many processes as are asked for, until none is left or pytest wants to stop."""

    def __init__(self, session: pytest.Session) -> None:
        self._session, self._config = session, session.config
        self._distribution = Distribution(item.nodeid for item in session.items)
        self._workers: dict[Connection, Worker] = {}
        self._numbers = count()
        threads = os.listdir("/proc/self/task")
        assert len(threads) == 1, "of several threads a fork has one, and the locks of all"

    def run(self, processes: int) -> None:
        if self._distribution.waits:
            share_mould()
        try:
            for number in range(processes):
                self._start(waiting=begins_with_what_waits(number), unit=deque())
            # not before all have their first, which may be all that there is
            for worker in self._workers.values():
                self._send(worker)
            while self._workers:
                ready = wait([*self._workers], _LOOK_S)
                for connection in ready:
                    self._hear(self._workers[connection])  # type: ignore[index]
                if not ready:
                    self._look()
        finally:
            self._end()

    def _start(self, waiting: bool, unit: deque[int]) -> Worker:
        ours, theirs = _FORK.Pipe()
        connections = (ours, *self._workers)
        process = _FORK.Process(target=work, args=(self._session, theirs, connections, next(self._numbers), waiting))
        process.start()
        theirs.close()
        worker = self._workers[ours] = Worker(process, ours, waiting, unit)
        self._send(worker)
        return worker

    def _send(self, worker: Worker) -> None:
        if not worker.unit and not self._stopped:
            worker.unit.extend(self._distribution.take(worker.waiting) or self._half())
        place = worker.unit.popleft() if worker.unit and not self._stopped else None
        if place is not None:
            worker.sent.append(place)
        # one that has ended is heard of where it is heard
        with suppress(BrokenPipeError):
            worker.connection.send(place)

    def _half(self) -> deque[int]:
        """Where no unit is left, the second half of the longest that another process has, lest that one ends last."""
        items = self._session.items
        rests = [
            worker.unit for worker in self._workers.values() if worker.unit and divides(items[worker.unit[0]].nodeid)
        ]
        longest = max(rests, key=len, default=deque())
        if len(longest) < _LEFT:
            return deque()
        return deque(reversed([longest.pop() for _ in range(len(longest) // 2)]))

    @property
    def _stopped(self) -> bool:
        return bool(self._session.shouldfail or self._session.shouldstop)

    def _hear(self, worker: Worker) -> None:
        try:
            reports, warned = worker.connection.recv()
        except (EOFError, ConnectionResetError):
            self._bury(worker)
            return
        for warning in warned:
            self._config.hook.pytest_warning_recorded.call_historic(kwargs=warning)
        values = [self._config.hook.pytest_report_from_serializable(config=self._config, data=data) for data in reports]
        self._report(worker.sent.popleft(), values)
        self._send(worker)

    def _look(self) -> None:
        """After processes that have ended, and whose connection is held open by what their tests have started."""
        for worker in [*self._workers.values()]:
            if not worker.process.is_alive() and not worker.connection.poll():
                self._bury(worker)

    def _bury(self, worker: Worker) -> None:
        """Of a process that has ended; where it had a test, that has failed, and another process has the rest."""
        del self._workers[worker.connection]
        worker.connection.close()
        worker.process.join()
        if not worker.sent:
            return
        place = worker.sent.popleft()
        item = self._session.items[place]
        text = f"the process of this test has ended: {_end(worker.process.exitcode)}"
        report = pytest.TestReport(item.nodeid, item.location, {}, "failed", text, "call")
        self._report(place, [report])
        if not self._stopped:
            self._send(self._start(worker.waiting, worker.sent + worker.unit))

    def _report(self, place: int, reports: Iterable[pytest.TestReport]) -> None:
        hook, item = self._config.hook, self._session.items[place]
        hook.pytest_runtest_logstart(nodeid=item.nodeid, location=item.location)
        for report in reports:
            hook.pytest_runtest_logreport(report=report)
        hook.pytest_runtest_logfinish(nodeid=item.nodeid, location=item.location)

    def _end(self) -> None:
        """Of the processes that are left where this one breaks off."""
        for worker in self._workers.values():
            worker.process.terminate()
        for worker in self._workers.values():
            worker.process.join(_END_S)


def _end(code: int | None) -> str:
    return f"exit code {code}" if code is None or code >= 0 else signal.Signals(-code).name


def work(
    session: pytest.Session, connection: Connection, connections: Iterable[Connection], number: int, waiting: bool
) -> NoReturn:
    """In a process: the tests that are sent, until there is none."""
    prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
    if not waiting:
        os.nice(_NICE)
    # by which it would not be missed that the first process has ended
    for single_connection in connections:
        single_connection.close()
    config = session.config
    plugins = config.pluginmanager
    _move(config, number)
    for name in _OF_THE_FIRST:
        if plugins.has_plugin(name):
            plugins.unregister(name=name)
    messages = Messages(config)
    plugins.register(messages)
    try:
        place = connection.recv()
        while place is not None:
            following = connection.recv()
            nextitem = None if following is None else session.items[following]
            config.hook.pytest_runtest_protocol(item=session.items[place], nextitem=nextitem)
            connection.send(messages.take())
            place = following
    except (EOFError, BrokenPipeError):
        # the first process has ended
        os._exit(1)
    except BaseException:
        # else it would be captured
        _capture(config).stop_global_capturing()
        traceback.print_exc()
        os._exit(1)
    sys.stdout.flush()
    # threads that tests have left are not waited for, and no files removed that are of the first process
    os._exit(0)


def _move(config: pytest.Config, number: int) -> None:
    """To folders and to files of its own."""
    folders: pytest.TempPathFactory = config._tmp_path_factory  # type: ignore[attr-defined]
    folders._basetemp = folders.mktemp(f"p{number}", numbered=False)
    os.environ["COUNTERWEIGHT_DATA_DIR"] = str(folders.mktemp("data", numbered=False))
    capture = _capture(config)
    capture.stop_global_capturing()
    capture.start_global_capturing()
    capture.suspend_global_capture()


def _capture(config: pytest.Config) -> CaptureManager:
    capture = config.pluginmanager.getplugin("capturemanager")
    assert isinstance(capture, CaptureManager)
    return capture
