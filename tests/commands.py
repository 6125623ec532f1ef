"""Modules that tests run as a process: the service, and its other commands.

Each is a process of its own with settings, files and an end of its own, but forked from one that has loaded the same:
see tests/mould.py. What is told to Python or to the loader at the start of a process starts it from nothing, and so
does `fresh`, for tests of the start itself.
"""

import atexit
import json
import os
import socket
import subprocess
import sys
import threading
from collections.abc import Mapping
from functools import cache
from inspect import signature
from pathlib import Path
from typing import Any

from tests.mould import LARGEST, PR_SET_CHILD_SUBREAPER, prctl

ROOT = Path(__file__).parents[1]
#: read when a process starts or a library is imported, not when a command runs
_AT_THE_START = ("LD_PRELOAD", "PYTHONPATH", "PYTHONHASHSEED", "PYTHONWARNINGS", "NUMBA_DISABLE_JIT")
#: on a machine that is busy
_WITHIN_S = 300.0
#: as Popen names them for its fork
_PIPES = ("p2cread", "p2cwrite", "c2pread", "c2pwrite", "errread", "errwrite")


class Command(subprocess.Popen):  # type: ignore[type-arg]
    """``python -m module arguments`` with the packages of a folder, of the project if none is given.

    Parameters
    ----------
    environment : all of it; that of the tests if not given.
    fresh : started from nothing.
    root : a folder with a copy of the project, whose packages it has.
    cwd : where it runs, if not there.
    files : standard input, output and error, and whether they are text, as :class:`subprocess.Popen` takes them.
    """

    def __init__(
        self,
        module: str,
        *arguments: str,
        environment: Mapping[str, str] | None = None,
        fresh: bool = False,
        root: Path = ROOT,
        cwd: Path | None = None,
        **files: Any,
    ) -> None:
        before = _environment(root)
        chosen = before if environment is None else dict(environment)
        unlike = any(chosen.get(name) != before.get(name) for name in _AT_THE_START)
        self._order = {"arguments": [module, *arguments], "environment": chosen, "folder": str(cwd or root)}
        self._fresh, self._root = fresh or unlike, root
        super().__init__([sys.executable, "-m", module, *arguments], env=chosen, cwd=cwd or root, **files)

    # all else, pipes before it and waiting after it, is as for what is started from nothing
    def _execute_child(self, *given: Any) -> None:
        if self._fresh:
            super()._execute_child(*given)  # type: ignore[misc]
            return
        names = list(signature(subprocess.Popen._execute_child).parameters)[1:]  # type: ignore[attr-defined]
        values = dict(zip(names, given, strict=True))
        pipes = [values[name] for name in _PIPES]
        ends = [values[name] for name in ("p2cread", "c2pwrite", "errwrite")]
        streams = [own if end == -1 else end for own, end in enumerate(ends)]
        self.pid = _mould(self._root).fork(json.dumps(self._order), streams)
        self._child_created = True
        self._close_pipe_fds(*pipes)  # type: ignore[attr-defined]


def run(module: str, *arguments: str, **more: Any) -> "subprocess.CompletedProcess[str]":
    """What a command says and how it ends; further arguments are those of :class:`Command`."""
    files: dict[str, Any] = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with Command(module, *arguments, text=True, **files, **more) as command:
        try:
            out, err = command.communicate(timeout=_WITHIN_S)
        except BaseException:
            command.kill()
            raise
        return subprocess.CompletedProcess(arguments, command.returncode, out, err)


class _Mould:
    """The process that is forked from, started when the first command is."""

    def __init__(self, root: Path) -> None:
        self._lock = threading.Lock()
        self._asks, asked = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with asked:
            self._process = subprocess.Popen(
                [sys.executable, "-m", "tests.mould", str(asked.fileno())],
                cwd=root,
                env=_environment(root),
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                pass_fds=[asked.fileno()],
            )
        assert self._asks.recv(100) == b"loaded", "the process that commands are forked from has ended"
        atexit.register(self._end)

    def fork(self, order: str, streams: list[int]) -> int:
        """The process of a command, a child of this one."""
        assert len(order) < LARGEST
        with self._lock:
            # what forks it ends at once, and this process takes its place; otherwise orphans are not ours
            prctl(PR_SET_CHILD_SUBREAPER, 1)
            try:
                socket.send_fds(self._asks, [order.encode()], streams)
                pid = self._asks.recv(100)
            finally:
                prctl(PR_SET_CHILD_SUBREAPER, 0)
        assert pid, "the process that commands are forked from has ended"
        return int(pid)

    def _end(self) -> None:
        self._asks.close()
        self._process.wait()


@cache
def _mould(root: Path) -> _Mould:
    return _Mould(root)


def _environment(root: Path) -> dict[str, str]:
    """That of the tests; what is imported is that of a copy, if it is one."""
    return dict(os.environ) if root == ROOT else {**os.environ, "PYTHONPATH": str(root)}
