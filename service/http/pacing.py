"""Answers at the pace at which their clients read."""

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from service.guard.shares import Holding, OverShare
from service.http.errors import answered

#: what is handed over at a time; the connection takes the next when its buffer is nearly empty [bytes]
PIECE_BYTES = 16_384


class Pacing:
    """Hands over large answers in pieces, so that what is not read is kept once and counted for its client.

    One that would have its client hold more than its share is answered 429 in its place.
    """

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        start: Message | None = None
        refused = False

        async def paced(message: Message) -> None:
            nonlocal start, refused
            if refused:
                return
            if message["type"] == "http.response.start":
                # whether it is answered so is known with the first part of its body
                start = message
                return
            body = message.get("body", b"")
            holding: Holding | None = scope.get("state", {}).get("holding")
            counted = len(body) if holding is not None and len(body) > PIECE_BYTES else 0
            if holding is not None and counted:
                try:
                    holding.take("answers", counted)
                except OverShare as error:
                    if start is not None:
                        refused = True
                        await answered(error, scope["path"])(scope, receive, send)
                        return
                    # it has begun, and is as large already as it is
                    counted = 0
            if start is not None:
                begin, start = start, None
                await send(begin)
            at = 0
            while len(body) - at > PIECE_BYTES:
                await send({"type": "http.response.body", "body": body[at : at + PIECE_BYTES], "more_body": True})
                at += PIECE_BYTES
            await send({**message, "body": body[at:]} if at else message)
            if holding is not None and counted:
                holding.give("answers", counted)

        await self._app(scope, receive, paced)
