"""What is read without h11 is what h11 would have read, and is answered as it would have been."""

import asyncio

import h11
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from starlette.types import Receive, Scope, Send
from uvicorn import Config
from uvicorn.server import ServerState

from service.fairness.scheduler import FairScheduler
from service.settings import Settings
from service.wire.connections import connections
from service.wire.plain_requests import Heads, plain_head

_LINES = (
    b"Host: localhost", b"host:a", b"Host: b", b"Content-Length: 2", b"content-length:0", b"Content-Length: 3, 3",
    b"Content-Length: -1", b"Connection: close", b"Connection: keep-alive, x", b"Connection: Keep-Alive",
    b"Transfer-Encoding: chunked", b"Expect: 100-continue", b"Upgrade: websocket", b"X: a b\t c  ", b"X:", b"X: \t ",
    b" folded", b"Bad Name: x", b"X : y", b"X: \x00", b"X: \xe9", b"X: a\rb", b"X: a\nb", b": x", b"no colon",
)  # fmt: skip
_FIRST = (
    b"GET / HTTP/1.1", b"POST /v1/optimize?a=%20b#c HTTP/1.1", b"GET / HTTP/1.0", b"GET /  HTTP/1.1", b"get / HTTP/1.1",
    b"GET /\xff HTTP/1.1", b"OPTIONS * HTTP/1.1", b"GET http://a/ HTTP/1.1", b"PROPFIND / HTTP/1.1",
    b"GET /a b HTTP/1.1",
)  # fmt: skip


@given(st.sampled_from(_FIRST), st.lists(st.sampled_from(_LINES), max_size=5), st.sampled_from((b"\r\n", b"\n")))
@example(_FIRST[1], [_LINES[0], _LINES[3], _LINES[13], _LINES[7]], b"\r\n")
def test_what_is_plain_is_read_as_h11_reads_it(first: bytes, lines: list[bytes], end: bytes) -> None:
    """Independent: the reader that takes all else."""
    body = b"{}more"
    pair = plain_head(end.join((first, *lines, b"", body)))
    if pair is None:
        return
    head, at = pair
    connection = h11.Connection(h11.SERVER)
    connection.receive_data(end.join((first, *lines, b"", body)))
    next_event = connection.next_event()
    assert isinstance(next_event, h11.Request)
    assert (head.method.encode(), head.target) == (next_event.method, next_event.target)
    assert head.headers == list(next_event.headers)
    assert next_event.http_version == b"1.1"
    read = b""
    while isinstance(event := connection.next_event(), h11.Data):
        read += event.data
    assert isinstance(event, h11.EndOfMessage)
    assert read == body[: head.length]
    assert connection.trailing_data[0] == body[head.length :]
    assert end.join((first, *lines, b"", body))[at:] == body
    assert head.keep_alive == (connection.their_state is h11.DONE)


@pytest.mark.parametrize("name", [b"Host", b"host", b"Content-Length", b"Connection"])
def test_what_may_be_said_once_is_not_plain_twice(name: bytes) -> None:
    """RFC 9112 3.2 and 6.3: a second Host is refused, and a second length; h11 does so."""
    value = {b"content-length": b"0", b"connection": b"close"}.get(name.lower(), b"a")
    head = b"GET / HTTP/1.1\r\nHost: a\r\n"
    once = head if name.lower() == b"host" else head + name + b": " + value + b"\r\n"
    assert plain_head(once + b"\r\n") is not None
    assert plain_head(once + name + b": " + value + b"\r\n\r\n") is None
    reader = Heads()
    assert reader.plain(once + b"\r\n") is not None
    assert reader.plain(once + name + b": b\r\n\r\n") is None


def test_what_clients_send_is_plain() -> None:
    head = b"POST /v1/optimize HTTP/1.1\r\nHost: localhost:8000\r\nUser-Agent: a/1.0 (b; c)\r\nContent-Length: 2\r\n"
    assert plain_head(head + b"Accept: */*\r\n\r\n{}") is not None
    assert plain_head(head + b"Accept: */*\r\n") is None


@given(st.lists(st.tuples(st.sampled_from(_FIRST), st.lists(st.sampled_from(_LINES[:8]), max_size=3)), max_size=6))
def test_what_comes_again_is_read_as_the_first_time(values: list[tuple[bytes, list[bytes]]]) -> None:
    heads = Heads()
    for first, lines in values:
        whole = b"\r\n".join((first, _LINES[0], *lines, b"", b"{}more"))
        for received in (whole, whole, whole[:-8], whole + b"x"):
            assert heads.plain(received) == plain_head(received)


async def app(scope: Scope, receive: Receive, send: Send) -> None:
    """Says what it was sent; at some paths it does not."""
    path = scope["path"]
    content = b""
    if path != "/early":
        while (message := await receive())["type"] == "http.request":
            content += message["body"]
            if not message["more_body"]:
                break
    headers = [(b"x-path", path.encode())]
    if path == "/split":
        headers.append((b"x", b"a\r\nb: c"))
    length = len(content) + (path == "/short")
    if path != "/chunks":
        headers.append((b"content-length", b"%d" % length))
    await send({"type": "http.response.start", "status": 200, "headers": headers})
    for piece in (content[:3], content[3:]):
        await send({"type": "http.response.body", "body": piece, "more_body": True})
    await send({"type": "http.response.body"})


def transcript(*pieces: bytes, headers_timeout_s: float = 300) -> bytes:
    """All that comes until the service closes; what is sent comes to it piece by piece."""

    async def run() -> bytes:
        config = Config(app, lifespan="off", log_config=None, date_header=False, server_header=False)
        config.load()
        protocol = connections(Settings(port=0, headers_timeout_s=headers_timeout_s), FairScheduler())
        server = await asyncio.get_running_loop().create_server(
            lambda: protocol(config, ServerState(), {}), "127.0.0.1", 0
        )
        async with server, asyncio.timeout(300):
            reader, writer = await asyncio.open_connection(*server.sockets[0].getsockname())
            try:
                for piece in pieces:
                    writer.write(piece)
                    await writer.drain()
                    await asyncio.sleep(0.01)
                return await reader.read()
            finally:
                writer.close()

    return asyncio.run(run())


def request_bytes(
    path: str, body: bytes = b"", method: str = "POST", connection: str = "close", more: str = ""
) -> bytes:
    lines = (
        f"{method} {path} HTTP/1.1\r\nHost: a\r\nConnection: {connection}\r\nContent-Length: {len(body)}\r\n{more}\r\n"
    )
    return lines.encode() + body


def test_an_answer_is_what_h11_writes() -> None:
    """Independent: the same question with a header that only h11 reads."""
    for method, path in (("POST", "/a"), ("POST", "/chunks"), ("HEAD", "/a"), ("HEAD", "/chunks"), ("GET", "/a%20b")):
        question = request_bytes(path, b"hello", method)
        body = request_bytes(path, b"hello", method, more="X: \xe9\r\n")
        assert plain_head(question) is not None
        assert plain_head(body) is None
        answers = [_sorted(transcript(content)) for content in (question, body)]
        assert answers[0] == answers[1]
        assert answers[0][0] == b"HTTP/1.1 200 OK"


def _sorted(answer: bytes) -> list[bytes]:
    head, _, content = answer.partition(b"\r\n\r\n")
    first, *lines = head.split(b"\r\n")
    lines = [name.lower() + value for name, _, value in (line.partition(b":") for line in lines)]
    # chunks may be of any size
    return [first, *sorted(lines), content.replace(b"3\r\nhel\r\n2\r\nlo\r\n", b"5\r\nhello\r\n")]


def test_a_body_may_come_in_pieces() -> None:
    question = request_bytes("/a", bytes(100_000))
    message = transcript(question[:200], question[200:50_000], question[50_000:])
    assert message.endswith(b"\r\n\r\n" + bytes(100_000))


def test_questions_that_come_together_are_answered_in_their_order() -> None:
    """Plain ones and others, in one piece and in pieces that begin anywhere."""
    unusual = request_bytes("/c", b"", "GET", "keep-alive", more="X: \xe9\r\n")
    every_weight = b"".join(
        (
            request_bytes("/a", b"one", connection="keep-alive"),
            request_bytes("/b", b"", "GET", "keep-alive"),
            unusual,
            request_bytes("/d", b"two", connection="keep-alive"),
            request_bytes("/e"),
        )
    )
    for size in (len(every_weight), 100, 37):
        message = transcript(*(every_weight[at : at + size] for at in range(0, len(every_weight), size)))
        heads = [line for line in message.split(b"\r\n") if line.startswith(b"x-path")]
        assert heads == [b"x-path: /" + name for name in (b"a", b"b", b"c", b"d", b"e")], size


def test_a_body_that_was_answered_early_is_read_to_its_end() -> None:
    early = request_bytes("/early", bytes(50_000), connection="keep-alive")
    message = transcript(early[:1000], early[1000:], request_bytes("/after"))
    assert b"x-path: /early" in message
    assert b"x-path: /after" in message


def test_a_body_that_never_ends_after_its_answer_ends_the_connection() -> None:
    question = request_bytes("/early", bytes(50_000), connection="keep-alive")
    assert b"x-path: /early" in transcript(question[:1000], headers_timeout_s=1)


@pytest.mark.parametrize("path", ["/split", "/short"])
def test_an_answer_that_is_none_ends_the_connection(path: str, caplog: pytest.LogCaptureFixture) -> None:
    message = transcript(request_bytes(path, b"hello", connection="keep-alive"))
    assert b"b: c" not in message
    assert "Exception in ASGI application" in caplog.text


@pytest.mark.parametrize("before", [b"", request_bytes("/before", b"hello", connection="keep-alive")])
@pytest.mark.parametrize("length", ["0", "5", "999"])
def test_a_request_with_two_lengths_is_the_last_of_its_connection(before: bytes, length: str) -> None:
    """RFC 9112, 6.1: what comes after it is a request to one reader, and a body to another."""
    head = f"POST /both HTTP/1.1\r\nHost: a\r\nContent-Length: {length}\r\nTransfer-Encoding: chunked\r\n\r\n"
    both = head.encode() + b"0\r\n\r\n"
    smuggled = request_bytes("/after", connection="keep-alive")
    for pieces in ((before + both + smuggled,), (before, both, smuggled), (before + head.encode(), b"0\r\n\r\n")):
        message = transcript(*pieces, headers_timeout_s=2)
        assert (b"x-path: /before" in message) == bool(before)
        refusal = message[message.index(b"HTTP/1.1 400 ") :]
        assert b"\r\nconnection: close\r\n" in refusal.lower()
        assert b"Transfer-Encoding, not both" in refusal
        assert b"x-path: /both" not in message
        assert b"x-path: /after" not in message


def test_a_client_that_says_nothing_more_is_let_go() -> None:
    """The time for the next head begins with its first byte, as it does with h11."""
    message = transcript(request_bytes("/a", connection="keep-alive"), b"GET /", headers_timeout_s=1)
    assert b"x-path: /a" in message
    assert b" 408 " in message
