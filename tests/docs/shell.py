"""The command ``counterweight`` for shells that follow the documents: each is forked, see tests/commands.py."""

import json
import socket
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from tests.commands import Command

_LARGEST = 1 << 16
#: hands on what it has, and ends as the command does
_PROGRAM = """#!{python} -IS
import json, os, socket, sys
with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as asks:
    asks.connect({address!r})
    order = dict(arguments=sys.argv[1:], environment=dict(os.environ), cwd=os.getcwd())
    socket.send_fds(asks, [json.dumps(order).encode()], [0, 1, 2])
    os._exit(int(asks.recv(20)))
"""


@contextmanager
def program(folder: Path) -> Iterator[None]:
    """As long as it lasts, there is a program ``counterweight`` in a folder."""
    address, file = str(folder / "commands"), folder / "counterweight"
    with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as listener:
        listener.bind(address)
        listener.listen()
        file.write_text(_PROGRAM.format(python=sys.executable, address=address))
        file.chmod(0o755)
        answering = threading.Thread(target=_answer, args=(listener,))
        answering.start()
        yield
        # the thread waits for another one
        listener.shutdown(socket.SHUT_RDWR)
        answering.join()


def _answer(listener: socket.socket) -> None:
    threads = []
    while True:
        try:
            asks, _ = listener.accept()
        except OSError:
            break
        threads.append(threading.Thread(target=_run, args=(asks,)))
        threads[-1].start()
    for thread in threads:
        thread.join()


def _run(asks: socket.socket) -> None:
    with asks:
        text, streams, _, _ = socket.recv_fds(asks, _LARGEST, 3)
        order = json.loads(text)
        try:
            files = dict(zip(("stdin", "stdout", "stderr"), streams, strict=True))
            cwd = Path(order["cwd"])
            command = Command("service", *order["arguments"], environment=order["environment"], cwd=cwd, **files)
        finally:
            for stream in streams:
                socket.close(stream)
        asks.send(str(command.wait()).encode())
