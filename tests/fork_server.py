"""What workers are forked from that the process of the tests starts by itself: a command, forked as all are.

Started from nothing, it would load for two seconds what tests/mould.py has loaded, in each process of a run.
"""

import atexit
import os
import signal
import socket
from multiprocessing import forkserver, resource_tracker

from tests.commands import Command
from tests.mould import FORK_SERVER, PR_SET_NAME, prctl

_OWN = forkserver._forkserver  # type: ignore[attr-defined]


class ForkServer:
    """The process, started when it is needed and again when it has ended."""

    def __init__(self) -> None:
        #: and the process that has started it: one that is forked starts its own
        self._command: tuple[int, Command] | None = None

    def ensure_running(self) -> None:
        """In place of what multiprocessing does, which waits for a child of its own."""
        with _OWN._lock:
            resource_tracker.ensure_running()
            if self._command is not None and self._command[0] == os.getpid():
                if self._command[1].poll() is None:
                    return
                os.close(_OWN._forkserver_alive_fd)
            with socket.socket(socket.AF_UNIX) as listener:
                # a free name, and no file
                listener.bind("")
                listener.listen()
                needed, held = os.pipe()
                command = Command("tests.fork_server", stdin=needed, stdout=listener.fileno())
                os.close(needed)
                address = listener.getsockname()
            if self._command is None:
                # after what the command is forked from was started: it has to end before that
                atexit.register(self._end)
            self._command = os.getpid(), command
            _OWN._forkserver_address, _OWN._forkserver_alive_fd, _OWN._forkserver_pid = address, held, command.pid

    def _end(self) -> None:
        if self._command is not None and self._command[0] == os.getpid():
            # it ends when nobody holds the pipe any longer, and one that a test has stopped never
            os.close(_OWN._forkserver_alive_fd)
            self._command[1].kill()
            self._command[1].wait()


def fork_fork_servers() -> None:
    """From now on."""
    _OWN.ensure_running = ForkServer().ensure_running


if __name__ == "__main__":
    prctl(PR_SET_NAME, FORK_SERVER.encode())
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    needed, listener = os.dup(0), os.dup(1)
    os.dup2(2, 1)
    try:
        forkserver.main(listener, needed, [])
    finally:
        os._exit(0)
