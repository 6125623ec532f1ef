"""What a worker says to the service: a pickled object over a socket, and with it an open file where there is one.

The service reads what has come on its event loop, for which a worker is one reader as long as it lives. So no answer
costs it a thread, and none holds one where a worker has stopped in the middle of what it says.
"""

import asyncio
import os
import pickle
import socket
import struct
from collections.abc import Callable
from contextlib import suppress
from typing import Any, BinaryIO

#: before an object, how many bytes it has
_LENGTH = struct.Struct("!Q")
#: number of an open file
_FILE = struct.Struct("i")
#: read at a time [bytes], what is there without waiting; processes that are started inherit no file
_PIECE_BYTES = 65_536
_AS_IT_IS = socket.MSG_DONTWAIT | socket.MSG_CMSG_CLOEXEC


def say(to: socket.socket, item: object, file: BinaryIO | None = None) -> None:
    """Send an object whole, and with its first bytes a file.

    Raises
    ------
    OSError
        if nobody listens any more.
    """
    content = pickle.dumps(item)
    message = _LENGTH.pack(len(content)) + content
    first = 0 if file is None else socket.send_fds(to, [message], [file.fileno()])
    to.sendall(memoryview(message)[first:] if first else message)


class Listener:
    """Hears what is said at the other end of a socket, one object after the other.

    Who stops waiting loses nothing: it is there for the next who waits.
    """

    def __init__(self, from_: socket.socket) -> None:
        self._from = from_
        self._loop: asyncio.AbstractEventLoop | None = None
        self._waits: asyncio.Future[None] | None = None
        self._content = b""
        self._file: BinaryIO | None = None
        self._gone = False

    async def receive(self) -> tuple[Any, BinaryIO | None]:
        """The next object, and the file that came with it; what is said after it must wait until this one was heard.

        Raises
        ------
        EOFError
            if the worker is gone.
        """
        loop = asyncio.get_running_loop()
        if loop is not self._loop and not self._gone:
            self._loop = loop
            loop.add_reader(self._from, self._read)
        while not self._whole:
            if self._gone:
                raise EOFError
            self._waits = loop.create_future()
            await self._waits
        content, self._content = self._content, b""
        file, self._file = self._file, None
        return pickle.loads(memoryview(content)[_LENGTH.size :]), file

    @property
    def _whole(self) -> bool:
        content = self._content
        return len(content) >= _LENGTH.size and len(content) - _LENGTH.size >= _LENGTH.unpack_from(content)[0]

    @property
    def gone(self) -> bool:
        """Whether nobody is there any more."""
        if not (self._gone or self._loop is asyncio.get_running_loop()):
            # no loop reads it yet
            with suppress(BlockingIOError):
                return not self._from.recv(1, socket.MSG_PEEK | socket.MSG_DONTWAIT)
        return self._gone

    def end(self) -> None:
        """Hear no more; in whatever thread, while nobody waits."""
        for over, close in list(_ENDING.values()):
            if over.is_closed():
                close()
        loop = self._loop
        if loop is None or loop.is_closed():
            self._close()
        else:
            _ENDING[self] = (loop, self._close)
            # only there: else the next file of the same number would be taken for this one
            with suppress(RuntimeError):
                loop.call_soon_threadsafe(self._close)

    def _read(self) -> None:
        try:
            # socket.recv_fds loses the flags in Python 3.11
            piece, beside, _, _ = self._from.recvmsg(_PIECE_BYTES, socket.CMSG_LEN(_FILE.size), _AS_IT_IS)
        except BlockingIOError:
            return
        except OSError:
            piece, beside = b"", []
        for _, _, files in beside:
            self._file = os.fdopen(_FILE.unpack(files)[0], "rb")
        # most often that is all of it, and is not copied; what is large comes in a file
        self._content += piece
        if not piece:
            self._close()
        if (self._gone or self._whole) and self._waits is not None and not self._waits.done():
            self._waits.set_result(None)

    def _close(self) -> None:
        _ENDING.pop(self, None)
        self._gone = True
        if self._loop is not None and not self._loop.is_closed():
            self._loop.remove_reader(self._from)
        self._loop = None
        self._from.close()
        if self._file is not None and not self._whole:
            self._file.close()


#: those that their loop is to close, which may be over before: they are closed with the next one
_ENDING: dict[Listener, tuple[asyncio.AbstractEventLoop, Callable[[], None]]] = {}
