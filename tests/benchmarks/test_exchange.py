"""The connection of the benchmark on the wire hears whole answers, and nothing but 200."""

import asyncio
from collections.abc import Sequence
from contextlib import suppress

import pytest

from tests.benchmarks.exchange import Exchange

_HEAD = b"HTTP/1.1 200 OK\r\ncontent-type: text/plain\r\nContent-Length: 5\r\n\r\n"


async def _replies(pieces: Sequence[bytes], count: int) -> list[bytes]:
    """What a client hears of a server that sends these pieces for each question, and then closes."""

    async def serve(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        # the server cancels who still serves when it is closed
        with suppress(asyncio.CancelledError):
            for _ in range(count):
                await reader.readexactly(8)
                for piece in pieces:
                    writer.write(piece)
                    await writer.drain()
                    await asyncio.sleep(0.001)
        writer.close()

    async with asyncio.timeout(30), await asyncio.start_server(serve, "127.0.0.1", 0) as server:
        _, connection = await asyncio.get_running_loop().create_connection(
            Exchange, *server.sockets[0].getsockname()[:2]
        )
        try:
            return [await connection.reply(b"question") for _ in range(count)]
        finally:
            connection.close()


# analytic: whatever the pieces, the body is what follows the head
@pytest.mark.parametrize(
    "pieces",
    [[_HEAD + b"12345"], [_HEAD, b"12345"], [_HEAD[:20], _HEAD[20:] + b"1", b"2345"]],
    ids=["whole", "head and body", "cut anywhere"],
)
def test_an_answer_is_heard_in_whatever_pieces_it_comes(pieces: list[bytes]) -> None:
    assert asyncio.run(_replies(pieces, 3)) == [b"12345"] * 3


@pytest.mark.parametrize(
    "head", [b"HTTP/1.1 503 Busy\r\nContent-Length: 5\r\n\r\n12345", b"HTTP/1.1 200 OK\r\nX: y\r\n\r\n12345"]
)
def test_another_status_or_no_length_fails(head: bytes) -> None:
    with pytest.raises(AssertionError, match=r"HTTP/1\.1"):
        asyncio.run(_replies([head], 1))


def test_a_connection_that_is_lost_fails() -> None:
    with pytest.raises(ConnectionError):
        asyncio.run(_replies([_HEAD + b"123"], 1))
