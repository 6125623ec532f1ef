"""Hostile requests by chance, thousands on connections that are kept: what no list of attacks thinks of."""

import asyncio
import json
import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from random import Random

from service.computations.computation import XLSX
from service.computations.table import COMPUTATIONS
from service.documents.examples import bodies
from service.workbook.files import workbook
from service.workbook.sheets import Sheets, request_sheets
from tests.network.serving import Reply, Service, read
from tests.workbook.bombs import BOMBS

_PATHS = (
    *(computation.path for computation in COMPUTATIONS.values()),
    "/v1/match", "/v1/verify", "/v1/report", "/v1/optimize", "/v1/sweeps",
    "/v1/sweeps/" + "0" * 32, "/v1/sweeps/x/results", "/v1/sweeps/x/events",
    "/v1/sweeps/x/resume", "/v1/examples", "/v1/examples/w60", "/v1/effects", "/v1/version", "/healthz", "/readyz",
    "/metrics", "/portal/x/main.js", "/docs/assets/favicon.png", "/", "/nothing", "*", "//", "/v1/../healthz",
)  # fmt: skip
_TAILS = (
    "", "", "", "?", "?limit=%0a", "%0a", "%0d%0aX:%20y", "%00", "?a=%ff&a=%fe", "?columns=" + "x," * 200, "/", ";x",
    "?before=%F0%9F%92%A9", "?format=csv&limit=9e9", "?select[]=1", "%2e%2e%2f", "?offset=-0", "#x",
)  # fmt: skip
_METHODS = ("POST",) * 6 + ("GET",) * 5 + ("DELETE", "PUT", "OPTIONS", "PATCH", "get", "BREW")
_KINDS = (
    "application/json", "application/json", "application/json", "application/problem+json", "application/json;",
    "text/json", "application/json; charset=utf-8", 'application/json; charset="utf-8"', "text/json;charset=utf-7",
    "application/json; charset*=utf-8''a; charset*0=b", "application/json; charset*1*=%00; charset*0*=x''%ff",
    "application/json; charset*99999999999999999999=b", "application/json; ;;charset", "multipart/form-data",
    "application/json, text/html", 'application/json; a="\\"; charset=x', "application/json; charset*0*='", "\xff/\xfe",
)  # fmt: skip
_HEADERS = (
    ("X-Forwarded-For", "127.0.0.1"), ("X-Forwarded-For", "\xff, , 10.0.0.1:x, [::1"), ("X-Forwarded-Proto", "x:"),
    ("X-Forwarded-Host", "evil.example"), ("Forwarded", "for=127.0.0.1;host=x"), ("Accept", "*/*;q=nan"),
    ("Accept", "a/b;q=1e999, ;, text/*;q=-1"), ("Accept-Encoding", "gzip;q=inf"), ("Range", "bytes=9-1,-,x"),
    ("Authorization", "Bearer " + "\xe9" * 50), ("Authorization", "Basic eA=="), ("X-API-Key", "cw_" + "0" * 12 + "_x"),
    ("Idempotency-Key", "\xa0"), ("Prefer", "respond-async;;=,\xff"), ("Prefer", "respond-async"), ("Origin", "null"),
    ("Origin", "http://evil.example"), ("Access-Control-Request-Method", "\xff"), ("Last-Event-ID", "\xb2"),
    ("If-None-Match", '"\xff'), ("Traceparent", "00-" + "g" * 32), ("X-Request-ID", "%0a"), ("Expect", "100-continue"),
    ("Content-Encoding", "identity, gzip"), ("Cookie", "=" * 4000), ("X-Long", "x" * 12_000), ("Upgrade", "h2c"),
    ("Connection", "upgrade, close, x"), ("TE", "trailers"), ("Trailer", "Content-Length"), ("Host", "evil.example"),
    ("Host", "localhost"), ("X-Empty", ""),
)  # fmt: skip
_BITS = ("null", "[]", "{}", "1e999", "NaN", '"\\ud800"', '"9 parsec"', "-0", "true", "[" * 60, '"' + "x" * 300 + '"')


#: where workbooks are read, what may stand in a cell, and how many requests and workbooks are such
_READERS = ("/v1/optimize", "/v1/convert", "/v1/report", "/v1/drawings", "/v1/analyze")
_CELLS = (
    None, True, -1, 0, 1e300, 1e-300, "null", "[" * 30_000, "[]", "{}", '{"a":' * 3_000, '"\\ud800"', "NaN", "9 parsec",
    "9" * 5_000, "[" + "9" * 5_000 + "]", "a." * 5_000, "machine", "machine.throws", "accuracy.time_limit_s", "=1+1",
    "x" * 32_000, '[1, "', "__class__.__init__",
)  # fmt: skip
_WORKBOOKS, _BROKEN = 0.15, 0.3


@dataclass(frozen=True)
class Burst:
    """Bytes, the number of answers that they may have, and whether the client sends nothing more after them."""

    raw: bytes
    answers: int = 1
    ends: bool = False


def requests(random: Random) -> Iterator[Burst]:
    """Hostile requests without end."""
    texts = [json.dumps(body) for body in bodies().values()]
    books, bombs = _books(), _bombs()
    while True:
        shape = random.random()
        if random.random() < _WORKBOOKS:
            content = random.choice(bombs) if shape < 0.2 else _workbook(random, random.choice(books))
            yield Burst(_posted(random.choice(_READERS), content))
            continue
        request = _request(random, texts)
        if shape < 0.05:
            yield Burst(request[: random.randrange(1, len(request))], ends=True)
        elif shape < 0.1:
            count = random.randrange(2, 6)
            yield Burst(b"".join([request, *(_request(random, texts) for _ in range(count - 1))]), count)
        else:
            yield Burst(request)


@cache
def _books() -> list[Sheets]:
    """The examples as sheets; to make them takes longer than to send them."""
    return [request_sheets(body) for body in bodies().values()]


@cache
def _bombs() -> list[bytes]:
    return [bomb() for bomb in BOMBS.values()]


def _posted(path: str, content: bytes) -> bytes:
    head = f"POST {path} HTTP/1.1\r\nHost: localhost\r\nContent-Type: {XLSX}\r\nContent-Length: {len(content)}\r\n\r\n"
    return head.encode() + content


def _workbook(random: Random, sheets: Sheets) -> bytes:
    """A workbook in which some cells say something else, or of which some bytes do."""
    changed = {name: [[*line] for line in lines] for name, lines in sheets.items()}
    for _ in range(random.randrange(1, 4)):
        line = random.choice(changed[random.choice(list(changed))])
        line[random.randrange(len(line))] = random.choice(_CELLS)
    content = bytearray(workbook(changed))
    if random.random() < _BROKEN:
        for _ in range(random.randrange(1, 6)):
            content[random.randrange(len(content))] = random.randrange(256)
    return bytes(content)


def _request(random: Random, texts: list[str]) -> bytes:
    method, path = random.choice(_METHODS), random.choice(_PATHS) + random.choice(_TAILS)
    headers = [("Host", "localhost")] if random.random() < 0.97 else []
    headers += random.sample(_HEADERS, random.choice((0, 0, 1, 2)))
    body = _body(random, texts) if random.random() < 0.7 else b""
    if body or method == "POST":
        headers.append(("Content-Type", random.choice(_KINDS)))
    framing = random.random()
    if framing < 0.1:
        headers.append(("Transfer-Encoding", random.choice(("chunked", "chunked", "Chunked", "chunked, chunked"))))
        body = _chunked(random, body)
    elif body or framing < 0.5:
        headers.append(("Content-Length", str(len(body))))
        if framing < 0.12:
            headers.append(("Content-Length", random.choice((str(len(body)), str(len(body) + 1), "+1", "0x1"))))
    else:
        body = b""
    version = "1.0" if random.random() < 0.05 else "1.1"
    lines = "".join(f"{name}: {value}\r\n" for name, value in headers)
    return f"{method} {path} HTTP/{version}\r\n{lines}\r\n".encode("latin-1", "replace") + body


def _body(random: Random, texts: list[str]) -> bytes:
    """A body in which some pieces of JSON stand where others were, or that is none any more."""
    text = random.choice(texts) if random.random() < 0.5 else "{" + ",".join(f'"{k}":1' for k in range(5)) + "}"
    for _ in range(random.randrange(3)):
        at = random.randrange(len(text))
        text = text[:at] + random.choice(_BITS) + text[at + random.randrange(20) :]
    return text.encode()


def _chunked(random: Random, body: bytes) -> bytes:
    size = random.choice((f"{len(body):x}", f"{len(body):X};a=b", f"000{len(body):x}", f"{len(body):x} ;=\xff"))
    last = random.choice(("0\r\n\r\n", "0;x\r\n\r\n", "0\r\nX-Trailer: y\r\n\r\n", "0\r\nContent-Length: 9\r\n\r\n"))
    return (size.encode("latin-1") + b"\r\n" + body + b"\r\n" if body else b"") + last.encode()


async def send(target: Service, random: Random, count: int) -> list[tuple[Burst, Reply, float]]:
    """Send so many by chance, one after the other, on a connection that is kept as long as the service keeps it.

    Returns
    -------
    what was sent, the answer, and how long that took [s].
    """
    values: list[tuple[Burst, Reply, float]] = []
    pending = requests(random)
    while len(values) < count:
        async with target.connection() as (reader, writer):
            persistent = True
            while persistent and len(values) < count:
                message, begun = next(pending), time.perf_counter()
                with suppress(OSError):
                    writer.write(message.raw)
                    if message.ends:
                        writer.write_eof()
                for _ in range(message.answers):
                    async with asyncio.timeout(1800):
                        reply = await read(reader)
                        while reply.status == 100:
                            reply = await read(reader)
                    values.append((message, reply, time.perf_counter() - begun))
                    persistent = reply.status > 0 and reply.headers.get("connection") != "close" and not message.ends
                    if not persistent:
                        break
    return values
