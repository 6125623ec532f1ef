"""The process that tests fork commands from: it has loaded what they load, so each begins at its first line.

To load it takes longer than most tests last, so the processes of a run share it: it tells each how its commands end.
What is forked reads its settings, opens its files and ends as any other; its fork server is forked beforehand, as it
would load the same once more. Run by tests/commands.py, with the numbers of the socket that it is asked on, and of a
pipe that is open as long as it is needed.
"""

import atexit
import ctypes
import gc
import importlib
import json
import os
import runpy
import selectors
import signal
import socket
import sys
import threading
from contextlib import suppress
from multiprocessing import forkserver
from pathlib import Path

#: by the service and by its commands, beside what its workers load
_LOADED = (
    "service.app",
    "service.cli",
    "service.jobs.preload",
    "service.jobs.export",
    "service.watch.logs",
    "service.wire.server",
    "uvicorn.lifespan.on",
    # when it serves, or prints an answer
    "anyio._backends._asyncio",
    "multiprocessing.popen_forkserver",
    "schemas.answer.shaft",
    "schemas.match.answer",
    "schemas.rating.answer",
    "service.report.terminal",
    "sqlalchemy.dialects.sqlite.aiosqlite",
    "typer.rich_utils",
    "uvicorn.loops.asyncio",
)
#: what may be asked for at a time [bytes]
LARGEST = 1 << 17
#: of linux/prctl.h
PR_SET_PDEATHSIG, PR_SET_NAME = 1, 15
#: names a file with what tests/documents.py has made in the first process of a run
DOCUMENTS = "TESTS_DOCUMENTS"
#: name of the process that workers are forked from, as its command line is that of the mould
FORK_SERVER = "fork server"


def prctl(option: int, argument: object) -> None:
    """
    Raises
    ------
    OSError
    """
    library = ctypes.CDLL(None, use_errno=True)
    if library.prctl(option, argument, 0, 0, 0) != 0:
        raise OSError(ctypes.get_errno(), "prctl")


def load() -> None:
    """What the service, its workers and its commands load."""
    from service.watch.memory import keep_little

    # as the command does before Arrow is imported
    keep_little()
    # the other allocator of Arrow, which nobody uses then, has a thread
    os.environ["JE_ARROW_MALLOC_CONF"] = "background_thread:false"
    # first, as it tells the libraries to have one thread
    failure = importlib.import_module("service.workers.preload").failure
    assert failure is None, failure
    for name in _LOADED:
        importlib.import_module(name)
    if DOCUMENTS in os.environ:
        importlib.import_module("tests.documents").read_documents(Path(os.environ[DOCUMENTS]))
    # which ignores them, as what is forked from it does
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    threads = os.listdir("/proc/self/task")
    assert len(threads) == 1, "of several threads a fork has one, and the locks of all"
    gc.collect()
    gc.freeze()


class Mould:
    """Forks a command for each that is asked for, and tells who asked how it has ended.

    Parameters
    ----------
    listener : on which processes connect that ask.
    needed : a pipe that ends when it is needed no longer.
    """

    def __init__(self, listener: socket.socket, needed: int) -> None:
        self._listener, self._needed = listener, needed
        self._selector = selectors.DefaultSelector()
        #: of each command that runs, where its end is told
        self._ends: dict[int, int] = {}
        self._woken, self._wakes = os.pipe()
        os.set_blocking(self._wakes, False)
        signal.set_wakeup_fd(self._wakes)
        signal.signal(signal.SIGCHLD, lambda *_: None)
        for file in (listener, needed, self._woken):
            self._selector.register(file, selectors.EVENT_READ)

    def wait(self) -> str | None:
        """In a command, the module that it runs; None when this is needed no longer."""
        while True:
            for key, _ in self._selector.select():
                if key.fileobj == self._needed:
                    return None
                if key.fileobj == self._woken:
                    os.read(self._woken, 1000)
                    self._bury()
                elif key.fileobj == self._listener:
                    self._selector.register(self._listener.accept()[0], selectors.EVENT_READ)
                elif (module := self._fork(key.fileobj)) is not None:  # type: ignore[arg-type]
                    return module

    def _fork(self, single_socket: socket.socket) -> str | None:
        text, files, _, _ = socket.recv_fds(single_socket, LARGEST, 3)
        if not text:
            self._selector.unregister(single_socket)
            single_socket.close()
            return None
        hears, tells = os.pipe()
        pid = os.fork()
        if pid == 0:
            os.close(hears)
            os.close(tells)
            self._leave()
            return become(json.loads(text), files)
        self._ends[pid] = tells
        # who asked may have ended
        with suppress(OSError):
            socket.send_fds(single_socket, [str(pid).encode()], [hears])
        for file in (hears, *files):
            os.close(file)
        return None

    def _leave(self) -> None:
        """What is not a command's."""
        signal.set_wakeup_fd(-1)
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        for key in [*self._selector.get_map().values()]:
            # whose object would close it once more, by then another's
            if isinstance(key.fileobj, socket.socket):
                key.fileobj.close()
            else:
                os.close(key.fd)
        self._selector.close()
        for file in (self._wakes, *self._ends.values()):
            os.close(file)

    def _bury(self) -> None:
        """Tell of the commands that have ended."""
        while self._ends:
            pid, status = os.waitpid(-1, os.WNOHANG)
            if pid == 0:
                break
            tells = self._ends.pop(pid)
            with suppress(BrokenPipeError):
                os.write(tells, str(status).encode())
            os.close(tells)


def become(command: dict[str, object], files: list[int]) -> str:
    """Take place, environment, files and arguments of a command; its module."""
    for number, file in enumerate(files):
        os.dup2(file, number)
        os.close(file)
    # those of the mould know what its own files can do
    sys.stdin = sys.__stdin__ = os.fdopen(0, closefd=False)
    sys.stdout = sys.__stdout__ = os.fdopen(1, "w", closefd=False)
    sys.stderr = sys.__stderr__ = os.fdopen(2, "w", buffering=1, errors="backslashreplace", closefd=False)
    os.chdir(str(command["folder"]))
    os.environ.clear()
    os.environ.update(command["environment"])  # type: ignore[call-overload]
    module, *arguments = command["arguments"]  # type: ignore[misc]
    sys.argv = [module, *arguments]
    fork_fork_server()
    return module


def fork_fork_server() -> None:
    """Have multiprocessing find its fork server running; it ends with the last process that it may be asked by."""
    with socket.socket(socket.AF_UNIX) as listener:
        # a free name, and no file: the path of one may have 107 characters, and folders of tests have nearly as many
        listener.bind("")
        address = listener.getsockname()
        listener.listen()
        alive, held = os.pipe()
        pid = os.fork()
        if pid == 0:
            os.close(held)
            prctl(PR_SET_NAME, FORK_SERVER.encode())
            signal.signal(signal.SIGTERM, signal.SIG_IGN)
            signal.signal(signal.SIGINT, signal.SIG_IGN)
            try:
                forkserver.main(listener.detach(), alive, [])
            finally:
                os._exit(0)
        os.close(alive)
    own = forkserver._forkserver
    own._forkserver_address, own._forkserver_alive_fd, own._forkserver_pid = address, held, pid


def leave(code: int) -> None:
    """End as the interpreter does, but for taking apart all that is loaded: that takes longer than most commands."""
    threading._shutdown()
    atexit._run_exitfuncs()
    if not sys.stdout.closed:
        sys.stdout.flush()
    os._exit(code)


if __name__ == "__main__":
    # the name of the module is in the way of whoever unpickles what `__main__` has
    load()
    module = Mould(socket.socket(fileno=int(sys.argv[1])), int(sys.argv[2])).wait()
    if module is not None:
        try:
            runpy.run_module(module, run_name="__main__", alter_sys=True)
        except SystemExit as end:
            # of texts and other objects the interpreter makes something itself
            if end.code is not None and not isinstance(end.code, int):
                raise
            leave(end.code or 0)
        leave(0)
