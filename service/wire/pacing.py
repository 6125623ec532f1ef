"""Answers at the pace at which their clients read, client by client."""

from collections.abc import Awaitable, Iterator

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from service.fairness.faults import FAULTS, OverShare
from service.fairness.quotas import Holding
from service.fairness.scheduler import FairScheduler
from service.wire.refusal import response

#: what is handed over at a time; the connection takes the next when its buffer is nearly empty [bytes]
PIECE_BYTES = 16_384


class Pacing:
    """Hands over large answers in pieces, so that what is not read is kept once and counted for its client.

    One that would have its client hold more than its share is answered 429 in its place. Of answers in pieces one piece
    is handed over in a turn of the event loop, of one client after the other.
    """

    def __init__(self, app: ASGIApp, rounds: FairScheduler) -> None:
        self._app = app
        self._rounds = rounds

    def __call__(self, scope: Scope, receive: Receive, send: Send) -> Awaitable[None]:
        if scope["type"] != "http":
            return self._app(scope, receive, send)
        start: Message | None = None
        refused = False

        async def paced(message: Message) -> None:
            nonlocal start, refused
            if refused:
                return
            if message["type"] == "http.response.start":
                # the first part of its body shows whether it is answered so
                start = message
                return
            body = message.get("body", b"")
            if len(body) <= PIECE_BYTES and not message.get("more_body"):
                # small and whole
                begin, start = start, None
                if begin is not None:
                    await send(begin)
                await send(message)
                return
            holding: Holding | None = scope.get("state", {}).get("holding")
            size = len(body) if holding is not None and len(body) > PIECE_BYTES else 0
            if holding is not None and size:
                try:
                    holding.take("answers", size)
                except OverShare as error:
                    if start is not None:
                        refused = True
                        await response(FAULTS[OverShare](error), scope["path"])(scope, receive, send)
                        return
                    # it has begun, and is as large already as it is
                    size = 0
            begin, start = start, None
            await self._hand_over(begin, message, "" if holding is None else holding.who, send)
            if holding is not None and size:
                holding.give("answers", size)

        return self._app(scope, receive, paced)

    async def _hand_over(self, begin: Message | None, message: Message, who: str, send: Send) -> None:
        """Part of an answer, the first one with its head, piece by piece."""
        for piece in _pieces(message):
            await self._rounds.turn(who)
            if begin is not None:
                await send(begin)
                begin = None
            await send(piece)


def _pieces(message: Message) -> Iterator[Message]:
    body, at = message.get("body", b""), 0
    while len(body) - at > PIECE_BYTES:
        yield {"type": "http.response.body", "body": body[at : at + PIECE_BYTES], "more_body": True}
        at += PIECE_BYTES
    yield {**message, "body": body[at:]} if at else message
