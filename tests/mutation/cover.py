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
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from types import FrameType
from typing import Any

import pytest


class Lines:
    """Lines of some files that have run since the last reading."""

    def __init__(self, files: set[str]) -> None:
        self._files = files
        self._found: dict[str, set[int]] = defaultdict(set)

    def traced(self, frame: FrameType, event: str, argument: Any) -> Any:
        """What the interpreter calls at every call, and line by line where a file counts."""
        name = frame.f_code.co_filename
        if name not in self._files:
            return None
        self._found[name].add(frame.f_lineno)
        return self.traced

    def read(self) -> dict[str, list[int]]:
        """Lines by file."""
        found = {name: sorted(lines) for name, lines in self._found.items()}
        self._found.clear()
        return found


_ROOT = Path.cwd()
_LINES = Lines({str(path) for path in _ROOT.glob(os.environ.get("COVERED_FILES", "*.none"))})
_TESTS: dict[str, tuple[float, dict[str, list[int]]]] = {}


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """A test with its fixtures."""
    before, begun = sys.gettrace(), time.process_time()
    threading.settrace(_LINES.traced)
    sys.settrace(_LINES.traced)
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
