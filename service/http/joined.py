"""A transport that puts the head and the body of an answer into one segment, and reads no more than is looked at."""

import asyncio
from typing import Any

#: more than this is not held back [bytes]
_LARGE = 16_000


class Joined:
    """What is written within one turn of the event loop goes out together; all else is as the transport does it."""

    def __init__(self, transport: asyncio.Transport, loop: asyncio.AbstractEventLoop) -> None:
        self._transport = transport
        self._loop = loop
        self._held = bytearray()
        self._full = self._held_back = False

    def __getattr__(self, name: str) -> Any:
        return getattr(self._transport, name)

    def write(self, data: bytes) -> None:
        if not data:
            return
        if not self._held:
            self._loop.call_soon(self.flush)
        self._held += data
        if len(self._held) > _LARGE:
            self.flush()

    def write_last(self, data: bytes) -> None:
        """Hand over the end of an answer, with what is held; nothing is left for another turn."""
        self._held += data
        self.flush()

    def flush(self) -> None:
        """Hand over what is held."""
        if self._held:
            held, self._held = self._held, bytearray()
            self._transport.write(held)

    def pause_reading(self) -> None:
        self._full = True
        self._transport.pause_reading()

    def resume_reading(self) -> None:
        self._full = False
        self._read_on()

    def hold_back(self) -> None:
        """Read no more until what has been read was looked at."""
        self._held_back = True
        self._transport.pause_reading()

    def go_on(self) -> None:
        """What has been read was looked at."""
        self._held_back = False
        self._read_on()

    def _read_on(self) -> None:
        if not (self._full or self._held_back):
            self._transport.resume_reading()

    def get_write_buffer_size(self) -> int:
        return len(self._held) + self._transport.get_write_buffer_size()

    def close(self) -> None:
        self.flush()
        self._transport.close()

    def ended(self) -> None:
        """Its connection has ended. The transport holds a method of its own, and would stay with all it has until the
        next collection of garbage."""
        vars(self._transport).pop("_read_ready_cb", None)
