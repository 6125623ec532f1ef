"""What a worker says to the service: a pickled object over a socket, and with it an open file where there is one.

The service reads what has come and waits for the rest on its event loop. So no answer costs it a thread, and none holds
one where a worker has stopped in the middle of what it says.
"""

import pickle
import socket
import struct
from contextlib import ExitStack
from typing import Any, BinaryIO

from anyio import wait_readable as readable

#: before an object, how many bytes it has
_LENGTH = struct.Struct("!Q")
#: number of an open file
_FILE = struct.Struct("i")
#: read at a time [bytes], what is there without waiting; processes that are started inherit no file
_PIECE_BYTES = 65_536
_AS_IT_IS = socket.MSG_DONTWAIT | socket.MSG_CMSG_CLOEXEC


def say(to: socket.socket, said: object, file: BinaryIO | None = None) -> None:
    """Send an object whole, and with its first bytes a file.

    Raises
    ------
    OSError
        if nobody listens any more.
    """
    content = pickle.dumps(said)
    message = _LENGTH.pack(len(content)) + content
    sent = socket.send_fds(to, [message], [] if file is None else [file.fileno()])
    to.sendall(memoryview(message)[sent:])


async def heard(from_: socket.socket) -> tuple[Any, BinaryIO | None]:
    """The next object, and the file that came with it; what is said after it must wait until this one was heard.

    Raises
    ------
    EOFError, OSError
        if the worker is gone.
    """
    content, length = bytearray(), _LENGTH.size
    with ExitStack() as refused:
        file: BinaryIO | None = None
        while len(content) < length:
            try:
                # socket.recv_fds loses the flags in Python 3.11
                piece, beside, _, _ = from_.recvmsg(_PIECE_BYTES, socket.CMSG_LEN(_FILE.size), _AS_IT_IS)
            except BlockingIOError:
                await readable(from_)
                continue
            if not piece:
                raise EOFError
            for _, _, files in beside:
                file = refused.enter_context(open(_FILE.unpack(files)[0], "rb"))
            content += piece
            if len(content) >= _LENGTH.size:
                length = _LENGTH.size + _LENGTH.unpack_from(content)[0]
        refused.pop_all()
    return pickle.loads(memoryview(content)[_LENGTH.size :]), file
