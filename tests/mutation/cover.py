"""Which tests run which lines of some files: a plugin of pytest, ``-p tests.mutation.cover``.

The environment says what is looked at: COVERED_FILES, a pattern from the root of the tree, and COVERED_TO, the file
that is written. It holds every test with its seconds and the lines that it ran, file by file. What runs while modules
are imported is of no test.
"""

import json
import os
import sys
import threading
import time
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

import pytest

#: calls of a function in one test that are followed line by line: arithmetic is called a million times
_FOLLOWED = 200


class Lines:
    """Lines of some files that have run since the last reading, of a function those of its first calls."""

    def __init__(self, files: set[str]) -> None:
        self._files = files
        self._found: dict[str, set[int]] = defaultdict(set)
        self._calls = Counter[CodeType]()

    def called(self, frame: FrameType, event: str, argument: Any) -> Any:
        """What the interpreter calls at every call."""
        code = frame.f_code
        if code.co_filename not in self._files or self._calls[code] >= _FOLLOWED:
            return None
        self._calls[code] += 1
        return self.traced(frame, event, argument)

    def traced(self, frame: FrameType, event: str, argument: Any) -> Any:
        """What the interpreter calls at every line of what is followed."""
        self._found[frame.f_code.co_filename].add(frame.f_lineno)
        return self.traced

    def read(self) -> dict[str, list[int]]:
        """Lines by file."""
        found = {name: sorted(lines) for name, lines in self._found.items()}
        self._found.clear()
        self._calls.clear()
        return found


_ROOT = Path.cwd()
_LINES = Lines({str(path) for path in _ROOT.glob(os.environ.get("COVERED_FILES", "*.none"))})
_TESTS: dict[str, tuple[float, dict[str, list[int]]]] = {}


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """A test with its fixtures."""
    before, begun = sys.gettrace(), time.process_time()
    threading.settrace(_LINES.called)
    sys.settrace(_LINES.called)
    try:
        yield
    finally:
        sys.settrace(before)
        threading.settrace(None)
    lines = {str(Path(name).relative_to(_ROOT)): found for name, found in _LINES.read().items()}
    _TESTS[item.nodeid] = time.process_time() - begun, lines


def pytest_sessionfinish() -> None:
    """Writes what was found."""
    if "COVERED_TO" in os.environ:
        Path(os.environ["COVERED_TO"]).write_text(json.dumps(_TESTS))
