"""A transport that puts the head and the body of an answer into one segment."""

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

    def flush(self) -> None:
        """Hand over what is held."""
        if self._held:
            held, self._held = self._held, bytearray()
            self._transport.write(held)

    def get_write_buffer_size(self) -> int:
        return len(self._held) + self._transport.get_write_buffer_size()

    def close(self) -> None:
        self.flush()
        self._transport.close()
