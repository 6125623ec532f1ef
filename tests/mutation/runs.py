"""Runs of pytest over a copy of the tree, each in a process of its own.

A process loads the tests of a room once and is forked for every fault (:class:`Loaded`). A fault in what runs while
modules are imported is met by one that loads them anew.
"""

import contextlib
import json
import os
import signal
import sys
from collections.abc import Iterable
from pathlib import Path
from types import CodeType, FrameType, TracebackType
from typing import Any

from tests.mutation.patching import Functions, functions, patched

#: seconds of computing of the tests of a room, and of those of a mutant
ROOM_S, _MUTANT_S = 3600.0, 240.0
#: a test that waits may do so for so many times as long as it may compute
_WAITS = 20
#: loaded once for all rooms
_HEAVY = ("numpy", "numba", "scipy.sparse", "scipy.special", "clarabel", "pydantic", "fastapi", "hypothesis", "pytest")
_OWN = ("schemas", "optimizer", "service", "tests", "examples")
_NOT_LOADED = "no"


def load_what_is_heavy() -> None:
    """What forked processes share."""
    for name in _HEAVY:
        __import__(name)


def noticed(copy: Path, file: Path, text: str, tests: list[str], loaded: "Loaded | None" = None) -> bool:
    """Whether a test fails, or does not end, when a file has another text."""
    if not tests:
        return False
    original = (copy / file).read_text()
    (copy / file).write_text(text)
    try:
        code = None if loaded is None else loaded.ran(file, original, text, tests)
        return (ran(copy, ["-x", *tests], {}, _MUTANT_S) if code is None else code) != 0
    finally:
        (copy / file).write_text(original)


def ran(copy: Path, arguments: list[str], environment: dict[str, str], seconds: float) -> int:
    """Exit code of pytest in a process of its own, which has loaded what is heavy; not 0 where it does not end."""
    sys.stdout.flush()
    child = os.fork()
    if child == 0:
        _limited(seconds)
        os._exit(_alone(copy, arguments, environment))
    return _ended(child)


class Loaded:
    """A process that has imported the tests of a room, and what they test."""

    def __init__(self, copy: Path, tests: Iterable[str], pattern: str) -> None:
        asks, self._ask = os.pipe()
        self._answers, answer = os.pipe()
        sys.stdout.flush()
        self._process = os.fork()
        if self._process == 0:
            os.close(self._ask)
            os.close(self._answers)
            _serve(copy, list(tests), pattern, asks, answer)
        os.close(asks)
        os.close(answer)
        self._lines = os.fdopen(self._answers, "rb")

    def ran(self, file: Path, original: str, text: str, tests: list[str]) -> int | None:
        """Exit code of pytest with another text of a file; None where that has to be imported."""
        question = json.dumps([str(file), original, text, tests]).encode() + b"\n"
        os.write(self._ask, len(question).to_bytes(8, "big"))
        rest = memoryview(question)
        while rest:
            rest = rest[os.write(self._ask, rest) :]
        word = self._lines.readline().decode().strip()
        return None if word == _NOT_LOADED else int(word)

    def __enter__(self) -> "Loaded":
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        os.close(self._ask)
        self._lines.close()
        os.waitpid(self._process, 0)


def _serve(copy: Path, tests: list[str], pattern: str, asks: int, answer: int) -> None:
    """Of the loaded process: never returns."""
    try:
        _enter(copy, {})
        files = {str(path) for path in copy.glob(pattern)}
        used: set[CodeType] = set()

        def calls(frame: FrameType, event: str, _: Any) -> None:
            if event == "call" and frame.f_code.co_filename in files:
                used.add(frame.f_code)

        sys.setprofile(calls)
        _pytest(["--collect-only", *tests])
        sys.setprofile(None)
        actual_functions = functions(files, used)
        with os.fdopen(asks, "rb") as questions:
            while length := questions.read(8):
                file, original, text, names = json.loads(questions.read(int.from_bytes(length, "big")))
                code = _forked(copy, actual_functions, copy / file, original, text, names)
                os.write(answer, f"{_NOT_LOADED if code is None else code}\n".encode())
    finally:
        os._exit(0)


def _forked(copy: Path, functions: Functions, path: Path, original: str, text: str, tests: list[str]) -> int | None:
    child = os.fork()
    if child == 0:
        _limited(_MUTANT_S)
        os._exit(_pytest(["-x", *tests]) if patched(functions, path, original, text) else 98)
    code = _ended(child)
    return None if code == 98 else code


def _limited(seconds: float) -> None:
    """Of computing, so that a busy machine makes no fault noticed; what waits for ever ends too."""
    os.setsid()
    for end in (signal.SIGALRM, signal.SIGPROF):
        signal.signal(end, signal.SIG_DFL)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    signal.alarm(_WAITS * int(seconds))


def _ended(child: int) -> int:
    _, status = os.waitpid(child, 0)
    with contextlib.suppress(ProcessLookupError):
        # what a test has left behind
        os.killpg(child, signal.SIGKILL)
    return os.waitstatus_to_exitcode(status)


def _alone(copy: Path, arguments: list[str], environment: dict[str, str]) -> int:
    try:
        _enter(copy, environment)
        return _pytest(arguments)
    except BaseException:
        return 99


def _enter(copy: Path, environment: dict[str, str]) -> None:
    """Nothing of the tree itself is loaded before."""
    os.environ.update(environment, PYTHONPATH=str(copy), PYTHONDONTWRITEBYTECODE="1", CHECKED_ANSWERS="every")
    os.chdir(copy)
    sys.dont_write_bytecode = True
    sys.path[:] = [str(copy), *(text for text in sys.path if text not in ("", str(Path(__file__).parents[2])))]
    for name in [module for module in sys.modules if module.partition(".")[0] in _OWN]:
        del sys.modules[name]
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.dup2(nowhere, 2)


def _pytest(arguments: list[str]) -> int:
    try:
        import pytest

        options = ["-q", "-m", "not nightly", "-p", "no:cacheprovider", "-W", "ignore"]
        return int(pytest.main([*options, *arguments]))
    except BaseException:
        return 99
