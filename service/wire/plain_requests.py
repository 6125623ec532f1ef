"""Requests as nearly every client sends them, read and answered without h11, whose generality is a fifth of the work.

What has anything unusual about it is none of these. Unusual are no HTTP/1.1, a body in chunks, a client that waits for
a word to go on, a repeated length. So are letters beside US-ASCII and a head that comes in pieces. h11 reads it, or
refuses it.
"""

import re
from dataclasses import dataclass

from uvicorn.protocols.http.h11_impl import STATUS_PHRASES, RequestResponseCycle

_TOKEN = rb"[!#$%&'*+.^_`|~0-9A-Za-z-]++"
_VALUE = rb"(?:[!-~]++(?:[ \t]++[!-~]++)*+)?+"
# nothing is tried twice (possessive): a head that means ill costs no more than its length
_HEAD = re.compile(
    rb"(GET|HEAD|POST|PUT|DELETE|OPTIONS|PATCH) (/[!-~]*+) HTTP/1\.1\r\n"
    rb"((?:%b:[ \t]*+%b[ \t]*+\r\n)++)\r\n" % (_TOKEN, _VALUE)
)
_HEADER = re.compile(rb"([^:]++):[ \t]*+(%b)[ \t]*+\r\n" % _VALUE)
_LENGTH = re.compile(rb"[0-9]{1,18}")
_UNUSUAL = frozenset({b"transfer-encoding", b"expect", b"upgrade"})
_ONCE = (b"host", b"content-length", b"connection")
#: heads that are kept for the next request [bytes]
_SHORT = 2048
_WITHOUT_BODY = frozenset({204, 304})


@dataclass(frozen=True)
class Head:
    """What comes before a body.

    headers : names in small letters.
    length : of the body [bytes].
    keep_alive : whether the client may ask for more on this connection.
    """

    method: str
    target: bytes
    headers: list[tuple[bytes, bytes]]
    length: int
    keep_alive: bool


def plain_head(received: bytes) -> tuple[Head, int] | None:
    """The head with which some bytes begin, and where it ends; None if it is not whole, or not plain."""
    match = _HEAD.match(received)
    if match is None:
        return None
    headers = [(name.lower(), value) for name, value in _HEADER.findall(match[3])]
    names = [name for name, _ in headers]
    fields = dict(headers)
    if not _UNUSUAL.isdisjoint(fields) or b"host" not in fields or any(names.count(name) > 1 for name in _ONCE):
        return None
    length, connection = fields.get(b"content-length", b"0"), fields.get(b"connection", b"keep-alive").lower()
    if not _LENGTH.fullmatch(length) or connection not in (b"keep-alive", b"close"):
        return None
    return Head(match[1].decode(), match[2], headers, int(length), connection == b"keep-alive"), match.end()


class Heads:
    """The heads of one connection: a client that asks again most often says the same again, which is read once."""

    def __init__(self) -> None:
        self._bytes = b""
        self._head: Head | None = None

    def plain(self, received: bytes) -> tuple[Head, int] | None:
        """As :func:`plain_head`."""
        if self._head is not None and received.startswith(self._bytes):
            return self._head, len(self._bytes)
        pair = plain_head(received)
        if pair is not None and pair[1] <= _SHORT:
            self._head, self._bytes = pair[0], received[: pair[1]]
        return pair


class PlainCycle(RequestResponseCycle):
    """One request and its answer, which is written piece by piece."""

    #: of an answer whose length was said what is to come [bytes]; None of one in chunks
    _left: int | None = None
    #: what is said before the body, and goes out with the first of it
    _begun = b""

    async def send(self, message) -> None:  # type: ignore[no-untyped-def]
        if self.flow.write_paused and not self.disconnected:
            await self.flow.drain()
        if self.disconnected:
            return
        kind = "http.response.body" if self.response_started else "http.response.start"
        if message["type"] != kind or self.response_complete:
            raise RuntimeError(f"{message['type']} in place of {kind}, or after the end of an answer")
        if not self.response_started:
            self.response_started = True
            self._begun = self._head(message["status"], [*self.default_headers, *message.get("headers", ())])
            return
        more = message.get("more_body", False)
        data = self._begun + self._piece(b"" if self._bodiless else message.get("body", b""), more)
        self._begun = b""
        if more:
            self.transport.write(data)
        else:
            self.transport.write_last(data)  # type: ignore[attr-defined]
            self.response_complete = True
            self.message_event.set()
            if not self.keep_alive:
                self.transport.close()
            self.on_response()

    def _head(self, status: int, headers: list[tuple[bytes, bytes]]) -> bytes:
        length, closes = None, False
        for name, value in headers:
            if name == b"content-length":
                length = int(value)
            elif name == b"connection" and value.lower() == b"close":
                self.keep_alive, closes = False, True
        if length is None and status not in _WITHOUT_BODY:
            headers.append((b"Transfer-Encoding", b"chunked"))
        if not (self.keep_alive or closes):
            headers.append((b"Connection", b"close"))
        lines = [b"%b: %b" % header for header in headers]
        # one by one: a pattern of all three takes thirty times as long
        head = b"".join(lines)
        if b"\r" in head or b"\n" in head or b"\0" in head:
            raise RuntimeError("a header would end in the middle")
        self._bodiless = self.scope["method"] == "HEAD" or status in _WITHOUT_BODY
        self._left = 0 if self._bodiless else length
        return b"HTTP/1.1 %d %b\r\n%b\r\n\r\n" % (status, STATUS_PHRASES[status], b"\r\n".join(lines))

    def _piece(self, body: bytes, more: bool) -> bytes:
        if self._left is None:
            piece = b"%x\r\n%b\r\n" % (len(body), body) if body else b""
            return piece if more else piece + b"0\r\n\r\n"
        self._left -= len(body)
        if self._left < 0 or (self._left and not more):
            raise RuntimeError("an answer is not as long as it said")
        return body
