"""Answers in pieces, as they are made."""

from collections.abc import AsyncIterator, Generator, Mapping
from contextlib import closing

from starlette.responses import StreamingResponse
from starlette.types import Send


class Stream(StreamingResponse):
    """Ends what makes the pieces when the client is gone: garbage would be closed later, and in any order.

    Parameters
    ----------
    pieces : made by the content, a piece at a time.
    """

    def __init__(
        self,
        pieces: AsyncIterator[bytes],
        content: Generator[bytes, None, None],
        media_type: str,
        headers: Mapping[str, str],
    ) -> None:
        super().__init__(pieces, headers=headers, media_type=media_type)
        self._content = content

    async def stream_response(self, send: Send) -> None:
        with closing(self._content):
            await super().stream_response(send)
