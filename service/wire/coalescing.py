"""A transport that puts the head and the body of an answer into one segment, and reads no more than is looked at."""

import asyncio
from collections.abc import Callable
from typing import Any

#: more than this is not held back [bytes]
_LARGE = 16_000


class CoalescingTransport:
    """What is written within one turn of the event loop goes out together; all else is as the transport does it.

    unread : whether the client still sends what has been answered already.
    patience_s : for which that is read when the connection is closed.
    """

    def __init__(
        self,
        transport: asyncio.Transport,
        loop: asyncio.AbstractEventLoop,
        unread: Callable[[], bool],
        patience_s: float,
    ) -> None:
        self._transport = transport
        self._loop = loop
        self._unread, self._patience_s = unread, patience_s
        self._lingers: asyncio.TimerHandle | None = None
        self._buffer = bytearray()
        self._full = self._is_paused = False

    def __getattr__(self, name: str) -> Any:
        return getattr(self._transport, name)

    def write(self, data: bytes) -> None:
        if not data:
            return
        if not self._buffer:
            self._loop.call_soon(self.flush)
        self._buffer += data
        if len(self._buffer) > _LARGE:
            self.flush()

    def write_last(self, data: bytes) -> None:
        """Hand over the end of an answer, with what is held; nothing is left for another turn."""
        self._buffer += data
        self.flush()

    def flush(self) -> None:
        """Hand over what is held."""
        if self._buffer:
            data, self._buffer = self._buffer, bytearray()
            self._transport.write(data)

    def pause_reading(self) -> None:
        self._full = True
        self._transport.pause_reading()

    def resume_reading(self) -> None:
        self._full = False
        self._read_on()

    def hold_back(self) -> None:
        """Read no more until what has been read was looked at."""
        self._is_paused = True
        self._transport.pause_reading()

    def go_on(self) -> None:
        """What has been read was looked at."""
        if self._is_paused:
            self._is_paused = False
            self._read_on()

    def _read_on(self) -> None:
        if not (self._full or self._is_paused):
            self._transport.resume_reading()

    def get_write_buffer_size(self) -> int:
        return len(self._buffer) + self._transport.get_write_buffer_size()

    def is_closing(self) -> bool:
        return self._lingers is not None or self._transport.is_closing()

    def close(self) -> None:
        """End it, when the client has sent all and read the answer: who closes on unread bytes takes it from him."""
        if self.is_closing() or not self._unread():
            self.end()
            return
        self.flush()
        self._lingers = self._loop.call_later(self._patience_s, self._transport.close)
        try:
            self._transport.write_eof()
        except OSError:
            # the client has gone already: nobody sends, and nobody reads
            self._transport.close()
            return
        self._full = self._is_paused = False
        self._read_on()

    def end(self) -> None:
        """Close it, whatever the client does."""
        self.flush()
        self._transport.close()

    def ended(self) -> None:
        """Its connection has ended. The transport holds a method of its own, and this one of the connection: both would
        stay with all they have until the next collection of garbage."""
        if self._lingers is not None:
            self._lingers.cancel()
        self._unread = bool
        vars(self._transport).pop("_read_ready_cb", None)
