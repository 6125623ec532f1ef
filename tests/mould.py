"""The process that tests fork commands from: it has loaded what they load, so each begins at its first line.

To load it takes longer than most tests last. What is forked reads its settings, opens its files and ends as any other;
its fork server is forked beforehand, as it would load the same once more. Run by tests/commands.py, with the number of
the socket that it is asked on.
"""

import atexit
import ctypes
import gc
import importlib
import json
import os
import runpy
import signal
import socket
import sys
import threading
from multiprocessing import forkserver

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
PR_SET_NAME, PR_SET_CHILD_SUBREAPER = 15, 36
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
    # which ignores them, as what is forked from it does
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    threads = os.listdir("/proc/self/task")
    assert len(threads) == 1, "of several threads a fork has one, and the locks of all"
    gc.collect()
    gc.freeze()


def wait(asked: socket.socket) -> str | None:
    """Fork a command for each that is asked for; in the command, the module that it runs; None when nobody asks."""
    while True:
        text, files, _, _ = socket.recv_fds(asked, LARGEST, 3)
        if not text:
            return None
        pid, says = os.pipe()
        between = os.fork()
        if between == 0:
            command = os.fork()
            if command == 0:
                asked.close()
                os.close(pid)
                os.close(says)
                return become(json.loads(text), files)
            os.write(says, str(command).encode())
            os._exit(0)
        for file in (says, *files):
            os.close(file)
        # once the one between has ended, who asked is the parent of the command
        os.waitpid(between, 0)
        asked.send(os.read(pid, 100))
        os.close(pid)


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
    with socket.socket(fileno=int(sys.argv[1])) as asked:
        asked.send(b"loaded")
        module = wait(asked)
    if module is not None:
        try:
            runpy.run_module(module, run_name="__main__", alter_sys=True)
        except SystemExit as end:
            # of texts and other objects the interpreter makes something itself
            if end.code is not None and not isinstance(end.code, int):
                raise
            leave(end.code or 0)
        leave(0)
