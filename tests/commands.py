"""Modules that tests run as a process: the service, and its other commands.

Each is a process of its own with settings, files and an end of its own, but forked from one that has loaded the same:
see tests/mould.py. What is told to Python or to the loader at the start of a process starts it from nothing, and so
does `fresh`, for tests of the start itself.
"""

import atexit
import json
import os
import select
import socket
import subprocess
import sys
import threading
from collections.abc import Mapping
from functools import cache
from inspect import signature
from pathlib import Path
from typing import Any

from tests.mould import DOCUMENTS, LARGEST

ROOT = Path(__file__).parents[1]
#: read when a process starts or a library is imported, not when a command runs
_AT_THE_START = ("LD_PRELOAD", "PYTHONPATH", "PYTHONHASHSEED", "PYTHONWARNINGS", "NUMBA_DISABLE_JIT")
_GONE = "the process that commands are forked from has ended"
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
        #: where it is told how the command has ended, which is a child of what it was forked from
        self._ends: int | None = None
        super().__init__([sys.executable, "-m", module, *arguments], env=chosen, cwd=cwd or root, **files)

    # all else, pipes before it and waiting after it, is as for what is started from nothing
    def _execute_child(self, *arguments: Any) -> None:
        if self._fresh:
            super()._execute_child(*arguments)  # type: ignore[misc]
            return
        names = list(signature(subprocess.Popen._execute_child).parameters)[1:]  # type: ignore[attr-defined]
        values = dict(zip(names, arguments, strict=True))
        pipes = [values[name] for name in _PIPES]
        ends = [values[name] for name in ("p2cread", "c2pwrite", "errwrite")]
        streams = [own if end == -1 else end for own, end in enumerate(ends)]
        self.pid, self._ends = _mould(self._root).fork(json.dumps(self._order), streams)
        self._child_created = True
        self._close_pipe_fds(*pipes)  # type: ignore[attr-defined]

    def _internal_poll(self, *arguments: Any, **named: Any) -> int | None:
        named["_waitpid"] = lambda _, options: self._try_wait(options)
        return super()._internal_poll(*arguments, **named)  # type: ignore[misc]

    def _try_wait(self, options: int) -> tuple[int, int]:
        if self._ends is None:
            return super()._try_wait(options)  # type: ignore[misc]
        if options & os.WNOHANG and not select.select([self._ends], [], [], 0)[0]:
            return 0, 0
        status = os.read(self._ends, 100)
        assert status, _GONE
        os.close(self._ends)
        self._ends = None
        return self.pid, int(status)


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
    """The process that is forked from, started with the first command, or for processes that will share it."""

    def __init__(self, root: Path) -> None:
        self._lock = threading.Lock()
        needed, self._needs = os.pipe()
        with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as listener:
            # a free name, and no file
            listener.bind("")
            listener.listen()
            self._address = listener.getsockname()
            files = listener.fileno(), needed
            self._process = subprocess.Popen(
                [sys.executable, "-m", "tests.mould", *map(str, files)],
                cwd=root,
                env=_environment(root),
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                pass_fds=files,
            )
        os.close(needed)
        #: connection of a process
        self._asks: tuple[int, socket.socket] | None = None
        atexit.register(self._end)

    def fork(self, order: str, streams: list[int]) -> tuple[int, int]:
        """The process of a command, and where it is told how it has ended."""
        assert len(order) < LARGEST
        with self._lock:
            asks = self._connection()
            socket.send_fds(asks, [order.encode()], streams)
            pid, files, _, _ = socket.recv_fds(asks, 100, 1)
        assert pid, _GONE
        return int(pid), files[0]

    def _connection(self) -> socket.socket:
        own = os.getpid()
        if self._asks is None or self._asks[0] != own:
            connection = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
            connection.connect(self._address)
            self._asks = own, connection
        return self._asks[1]

    def _end(self) -> None:
        if self._asks is not None:
            self._asks[1].close()
        os.close(self._needs)
        self._process.wait()


def share_mould() -> None:
    """Start it for all processes that are forked from this one."""
    _mould(ROOT)


@cache
def _mould(root: Path) -> _Mould:
    return _Mould(root)


def _environment(root: Path) -> dict[str, str]:
    """That of the tests; what is imported is that of a copy, if it is one, and documents are its own."""
    if root == ROOT:
        return dict(os.environ)
    return {name: value for name, value in os.environ.items() if name != DOCUMENTS} | {"PYTHONPATH": str(root)}
