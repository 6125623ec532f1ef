"""Answers in pieces end what makes them, whether their client reads them or goes."""

import gc
from collections.abc import Generator
from itertools import chain
from typing import Any

import anyio
import pytest
from starlette.requests import ClientDisconnect

from service.fairness.threads import Threads
from service.http.stream import Stream

_SCOPE: Any = {"type": "http", "asgi": {"spec_version": "2.4"}, "headers": [], "method": "GET"}


@pytest.mark.parametrize("count", [0, 1, 2, 3, 9])
def test_what_makes_the_pieces_is_closed_at_once(count: int) -> None:
    """Of the head, four pieces and the end so many messages arrive."""
    ended, bodies = [], list[bytes]()

    def content() -> Generator[bytes, None, None]:
        try:
            yield from (b"b", b"c", b"d")
        finally:
            ended.append(True)

    async def send(message: Any) -> None:
        if not left:
            raise OSError("the client is gone")
        left.pop()
        bodies.append(message.get("body", b""))

    async def receive() -> Any:
        await anyio.sleep_forever()

    async def answered() -> None:
        data = content()
        response = Stream(Threads().pieces("client", chain((next(data),), data)), data, "text/plain", {})
        await response(_SCOPE, receive, send)

    left = [None] * count
    # nothing is closed by chance
    gc.disable()
    try:
        if count < 5:
            with pytest.raises(ClientDisconnect):
                anyio.run(answered)
        else:
            anyio.run(answered)
    finally:
        gc.enable()
    assert ended == [True]
    assert b"".join(bodies) == b"bcd"[: max(0, count - 1)]
