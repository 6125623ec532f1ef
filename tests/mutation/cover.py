"""Which tests run which lines of some files: a plugin of pytest, ``-p tests.mutation.cover``.

The environment says what is looked at: COVERED_FILES, a pattern from the root of the tree, and COVERED_TO, the file
that is written. It holds, for every file of tests, whether all passed, and each test with its seconds and the lines
that it ran. It holds the lines that ran for all of the file: while it was imported, and by fixtures that serve several
tests.
"""

import json
import os
import sys
import threading
import time
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from inspect import CO_OPTIMIZED
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

import pytest

#: calls of a function in one test that are followed line by line: arithmetic is called a million times
_FOLLOWED = 200

Line = tuple[str, int]


class Lines:
    """Lines of some files that have run, of a function those of its first calls; none of modules being imported."""

    def __init__(self, files: set[str]) -> None:
        self._files = files
        self._calls = Counter[CodeType]()
        self.ran: set[Line] = set()

    def called(self, frame: FrameType, event: str, argument: Any) -> Any:
        """What the interpreter calls at every call."""
        code = frame.f_code
        if code.co_filename not in self._files or not code.co_flags & CO_OPTIMIZED or self._calls[code] >= _FOLLOWED:
            return None
        self._calls[code] += 1
        return self.traced(frame, event, argument)

    def traced(self, frame: FrameType, event: str, argument: Any) -> Any:
        """What the interpreter calls at every line of what is followed."""
        self.ran.add((frame.f_code.co_filename, frame.f_lineno))
        return self.traced

    @contextmanager
    def followed(self) -> Iterator[None]:
        """Lines that run inside."""
        self.ran.clear()
        self._calls.clear()
        before = sys.gettrace()
        threading.settrace(self.called)
        sys.settrace(self.called)
        try:
            yield
        finally:
            sys.settrace(before)
            threading.settrace(None)


class File:
    """What is known of a file of tests."""

    def __init__(self) -> None:
        self.passed = True
        self.tests: dict[str, tuple[float, dict[str, list[int]]]] = {}
        self.shared: set[Line] = set()

    def written(self) -> dict[str, Any]:
        """For json."""
        return {"passed": self.passed, "tests": self.tests, "shared": _by_file(self.shared)}


_ROOT = Path.cwd()
_LINES = Lines({str(path) for path in _ROOT.glob(os.environ.get("COVERED_FILES", "*.none"))})
_FILES: dict[str, File] = defaultdict(File)


def _by_file(lines: Iterable[Line]) -> dict[str, list[int]]:
    files: dict[str, list[int]] = defaultdict(list)
    for name, line in sorted(lines):
        files[str(Path(name).relative_to(_ROOT))].append(line)
    return files


def _file(name: str) -> File:
    return _FILES[name.partition("::")[0]]


@pytest.hookimpl(hookwrapper=True)
def pytest_make_collect_report(collector: pytest.Collector) -> Iterator[None]:
    """The import of a file of tests, which may compute what its tests compare with."""
    with _LINES.followed():
        yield
    if isinstance(collector, pytest.Module):
        _file(collector.nodeid).shared |= _LINES.ran


@pytest.hookimpl(hookwrapper=True)
def pytest_fixture_setup(fixturedef: pytest.FixtureDef[Any]) -> Iterator[None]:
    """What serves several tests runs when the first of them needs it."""
    before = set(_LINES.ran)
    yield
    if fixturedef.scope != "function":
        _file(os.environ["PYTEST_CURRENT_TEST"]).shared |= _LINES.ran - before


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """A test with its fixtures."""
    begun = time.process_time()
    with _LINES.followed():
        yield
    _file(item.nodeid).tests[item.nodeid] = time.process_time() - begun, _by_file(_LINES.ran)


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    """A file with a test that fails can tell nothing."""
    _file(report.nodeid).passed &= not report.failed


def pytest_sessionfinish() -> None:
    """Writes what was noted."""
    if "COVERED_TO" in os.environ:
        files = {name: file.written() for name, file in _FILES.items() if file.tests}
        Path(os.environ["COVERED_TO"]).write_text(json.dumps(files))
