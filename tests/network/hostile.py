"""Hand-written requests that mean ill, and what each of them may be answered."""

import gzip
import json
from collections.abc import AsyncIterable, AsyncIterator, Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from service.documents.examples import bodies
from tests.network.serving import request

_BIG = 100_000_000

Raw = bytes | AsyncIterable[bytes]


@dataclass(frozen=True)
class Attack:
    """Requests that mean ill, and the statuses that they may be answered with; 0 is a connection that was closed."""

    name: str
    requests: Callable[[], Iterator[Raw]]
    statuses: frozenset[int]


MACHINES = bodies()
QUESTIONS: dict[str, dict[str, Any]] = {
    "/v1/optimize": MACHINES["2d12"],
    "/v1/analyze": {"machine": MACHINES["2d12"]["machine"], "outputs": ["residual"]},
    "/v1/pareto": {"machine": MACHINES["w60"]["machine"], "points": 3},
    "/v1/accuracy": {"machine": MACHINES["w60"]["machine"], "repeats": 1},
    "/v1/report": MACHINES["w60"],
    "/v1/rating": next(iter(bodies("rating").values())),
    "/v1/match": next(iter(bodies("match").values())),
    "/v1/round": next(iter(bodies("round").values())),
    "/v1/shaft": next(iter(bodies("shaft").values())),
    "/v1/layout": {"machine": MACHINES["2d12"]["machine"], "counterweights": [], "fitted": []},
    "/v1/scroll/pin-loads": next(iter(bodies("pin-loads").values())),
    "/v1/sweeps": {**next(iter(bodies("sweeps").values())), "dry_run": True},
}
#: JSON texts that stand where something else should
_WRONG = ("null", "true", '""', '"x"', "[]", "{}", "[[]]", '{"":0}', "-1", "1e300", "0.5", '"1 parsec"')
_NO_NUMBERS = ("NaN", "Infinity", "-Infinity", "1e400", "-1e999", '"nan m"', '"1e999 kg"', "9" * 5000)
_SURROGATES = ('"\\ud800"', '"\\udfff\\ud800"', '{"\\ud83d":1}', '["\\udc00"]')
_POINTERS = (
    "", "/", "//", "machine", "/machine", "/nowhere", "/machine/nowhere", "/machine/throws/99", "/machine/throws/-1",
    "/machine/throws/-", "/machine/throws/1e3", "/machine/~2", "/machine/throws/0/rows/0/~0", "/__class__",
    "/machine/throws/" + "9" * 400, "/" * 5000, "/machine/\ud800", "/machine/throws/0/rows/0/connecting_rod/x/y/z",
)  # fmt: skip
_PATHS = (
    "../../etc/passwd", "..%2f..%2fetc%2fpasswd", "%2e%2e/%2e%2e/jobs.sqlite", "....//....//x", "%00", "%ff%fe",
    "..%5c..%5cx", "0" * 32, "0" * 33, "a" * 3000, "%0d%0aSet-Cookie:%20x", "1%27%20OR%20%271%27=%271", "*", "%25",
    "jobs.sqlite", "{id}", "%E2%80%AE",
)  # fmt: skip
_FOLDERS = (
    "/v1/sweeps/{}", "/v1/sweeps/{}/results", "/v1/sweeps/{}/events", "/v1/sweeps/{}/metadata", "/v1/examples/{}",
    "/portal/x/{}", "/docs/assets/{}", "/{}",
)  # fmt: skip
_UNITS = (
    "9" * 900_000 + " m", "1 " + "m" * 900_000, " " * 900_000, "9**9**9**9 m", "1e" + "9" * 100_000 + " mm", "1 m m",
    "__import__('os').system('x') m", "1\u00a0mm", "\u0661 mm", "1_000 mm", "0x10 mm", "1 mm\n", "\u212b",
)  # fmt: skip


def _places(node: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    pairs = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    for key, value in pairs:
        yield (*path, key)
        yield from _places(value, (*path, key))


_MARK = "7021962"


def _marked(body: Any, path: tuple[Any, ...]) -> str:
    """JSON of a body with a mark in place of what stands at a path."""
    whole = node = body.copy()
    for key in path[:-1]:
        node[key] = node[key].copy()
        node = node[key]
    node[path[-1]] = _MARK
    return json.dumps(whole)


def _filled(marked: str, text: str) -> bytes:
    """With a text in place of the mark."""
    return marked.replace(f'"{_MARK}"', text, 1).encode("utf-8", "surrogatepass")


def _replaced(body: Any, path: tuple[Any, ...], text: str) -> bytes:
    return _filled(_marked(body, path), text)


def _everywhere(texts: tuple[str, ...], paths: Iterable[str] = QUESTIONS) -> Iterator[Raw]:
    for path in paths:
        body = QUESTIONS[path]
        for place in _places(body):
            marked = _marked(body, place)
            for text in texts:
                yield request("POST", path, _filled(marked, text))


def _numbers() -> Iterator[Raw]:
    for path, body in QUESTIONS.items():
        for place in _places(body):
            node = body
            for key in place:
                node = node[key]
            if isinstance(node, (int, float)) and not isinstance(node, bool):
                marked = _marked(body, place)
                for text in _NO_NUMBERS:
                    yield request("POST", path, _filled(marked, text))


def _nesting() -> Iterator[Raw]:
    for path, body in QUESTIONS.items():
        for depth in (1_000, 100_000):
            for opened, closed in (("[", "]"), ('{"a":', "}"), ('{"machine":', "}")):
                nested = opened * depth + "1" + closed * depth
                yield request("POST", path, nested.encode())
                yield request("POST", path, (opened * depth).encode())
                yield request("POST", path, _replaced(body, (next(iter(body)),), nested))


def _duplicates() -> Iterator[Raw]:
    for path, body in QUESTIONS.items():
        text = json.dumps(body)[1:-1]
        yield request("POST", path, f"{{{text},{text}}}".encode())
        yield request("POST", path, ("{" + '"machine":1,' * 50_000 + text + "}").encode())
        yield request("POST", path, ("{" + ",".join(f'"k{k}":1' for k in range(50_000)) + "}").encode())


async def _endless(head: bytes, piece: bytes) -> AsyncIterator[bytes]:
    yield head
    for _ in range(_BIG // len(piece)):
        yield piece


def _large() -> Iterator[Raw]:
    block = b" " * 100_000
    for path in QUESTIONS:
        yield request("POST", path, headers={"Content-Length": str(_BIG)})
        yield request("POST", path, headers={"Content-Length": "9" * 30})
    for path in ("/v1/optimize", "/v1/sweeps"):
        yield _endless(request("POST", path, headers={"Content-Length": str(_BIG)}), block)
        chunk = f"{len(block):x}\r\n".encode() + block + b"\r\n"
        yield _endless(request("POST", path, headers={"Transfer-Encoding": "chunked"}), chunk)


def _compressed() -> Iterator[Raw]:
    bomb = gzip.compress(b" " * 10_000_000)
    for path in QUESTIONS:
        for coding in ("gzip", "deflate", "br", "gzip, gzip"):
            yield request("POST", path, bomb, {"Content-Encoding": coding})


def _announced() -> Iterator[Raw]:
    kinds = (
        "text/plain", "application/xml", "", "application/json; charset=utf-16", "a/b/c;;=", "*/*", "x" * 5000,
        "application/json; charset*=a; charset*0=b", f"application/json; charset*{'9' * 5000}=b",
        "application/json; charset*0*=utf-8''a; charset*1=b", 'application/json; charset="', "application/json; =a",
    )  # fmt: skip
    for path, body in QUESTIONS.items():
        for kind in kinds:
            yield request("POST", path, json.dumps(body).encode(), {"Content-Type": kind})


def _pointers() -> Iterator[Raw]:
    base = MACHINES["w60"]
    for pointer in _POINTERS:
        for values in ([1, 2], [None], ["\ud800"], [{}], [], [1] * 40_000):
            body = {"base": base, "axes": [{"path": pointer, "values": values}], "design": "grid", "dry_run": True}
            yield request("POST", "/v1/sweeps", json.dumps(body).encode())


def _astray() -> Iterator[Raw]:
    for folder in _FOLDERS:
        for path in _PATHS:
            for method in ("GET", "DELETE", "POST"):
                yield request(method, folder.format(path))
    for query in ("limit=0", "limit=9" + "9" * 400, "before=../x", "before=" + "f" * 32, "limit=NaN", "%ff=%00"):
        yield request("GET", f"/v1/sweeps?{query}")


def _units() -> Iterator[Raw]:
    for text in _UNITS:
        yield request("POST", "/v1/optimize", _replaced(MACHINES["w60"], ("machine", "speed_rpm"), json.dumps(text)))


def _headers() -> Iterator[Raw]:
    yield request("GET", "/healthz", headers={f"X-{k}": "x" * 50 for k in range(10_000)})
    yield request("GET", "/healthz", headers={"X-Long": "x" * 1_000_000})
    yield request("GET", "/healthz?" + "x" * 1_000_000)
    yield request("POST", "/v1/optimize", b"{}", {"Idempotency-Key": "x" * 5000, "Prefer": "respond-async"})
    for name, value in (
        ("Accept", ",".join(["a/b;q=0.1"] * 500)), ("Prefer", "," * 5000), ("Last-Event-ID", "9" * 5000),
        ("X-Request-ID", "x" * 5000), ("Traceparent", "00-" + "0" * 5000), ("Authorization", "Bearer " + "x" * 5000),
        ("Cookie", "=;" * 3000), ("Range", "bytes=" + "0-," * 2000), ("X-Forwarded-For", "1," * 3000),
        ("Upgrade", "websocket"), ("Expect", "100-continue"), ("Accept-Encoding", "gzip;q=" + "0" * 3000),
    ):  # fmt: skip
        for path in ("/healthz", "/v1/sweeps", "/", "/v1/examples/2d12", "/v1/sweeps/x/events"):
            yield request("GET", path, headers={name: value})


def _hosts() -> Iterator[Raw]:
    names = (
        "evil.example",
        "127.0.0.1.evil.example",
        "a@localhost",
        "localhost:x",
        "[::1",
        "",
        ",",
        "x" * 5000,
        "\xff",
    )
    requests = (("GET", "/v1/sweeps"), ("DELETE", "/v1/sweeps/x"), ("POST", "/v1/optimize"), ("GET", "/"))
    for name in names:
        for method, path in requests:
            yield request(method, path, headers={"Host": name})


def _no_http() -> Iterator[Raw]:
    yield from (b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", b"\0" * 5000)
    yield from (b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"GET /\xff HTTP/1.1\r\nHost: [::1]\r\n\r\n", b"\r\n" * 500)
    post = b"POST /v1/optimize HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
    for rest in (
        b"Content-Length: -1\r\n\r\n{}",
        b"Content-Length: 2\r\nContent-Length: 3\r\n\r\n{}",
        b"Transfer-Encoding: gzip, chunked\r\n\r\n{}",
        b"Content-Length: 2\r\nTransfer-Encoding: chunked\r\n\r\n2\r\n{}\r\n0\r\n\r\n",
        b"Transfer-Encoding: chunked\r\n\r\nzz\r\n{}",
        b"Transfer-Encoding: chunked\r\n\r\n-1\r\n{}\r\n0\r\n\r\n",
        b"Transfer-Encoding: chunked\r\n\r\n" + b"f" * 400 + b"\r\n{}",
        b" folded: x\r\n\r\n",
        b"Bad Name: x\r\n\r\n",
        b"X: \x00\r\n\r\n",
    ):
        yield post + rest


def _methods() -> Iterator[Raw]:
    for path in (*QUESTIONS, "/v1/sweeps/" + "0" * 32, "/healthz", "/metrics", "/nothing", "/docs", "*"):
        for method in ("PUT", "PATCH", "TRACE", "CONNECT", "OPTIONS", "PROPFIND", "X" * 1000):
            yield request(method, path)


#: what takes machines that are not whole, and says what it does not draw
_HALF_TYPED = {"/v1/layout"}
_REFUSED = frozenset({400, 422})
_ANSWERED = _REFUSED | {200}

ATTACKS = (
    Attack("no numbers", _numbers, _ANSWERED),
    Attack("lone surrogates", lambda: _everywhere(_SURROGATES, QUESTIONS.keys() - _HALF_TYPED), _REFUSED),
    Attack("lone surrogates, half-typed", lambda: _everywhere(_SURROGATES, _HALF_TYPED), _ANSWERED),
    Attack("wrong types", lambda: _everywhere(_WRONG), _ANSWERED),
    Attack("nesting", _nesting, _REFUSED | {413}),
    Attack("duplicate keys", _duplicates, _ANSWERED),
    Attack("100 MB", _large, frozenset({413, 400})),
    Attack("compressed", _compressed, frozenset({415})),
    Attack("other media", _announced, frozenset({400, 415})),
    Attack("pointers into nowhere", _pointers, _REFUSED),
    Attack("paths astray", _astray, frozenset({200, 404, 405, 422})),
    Attack("unit strings", _units, _REFUSED),
    Attack("header floods", _headers, frozenset({200, 400, 401, 404, 422, 431})),
    Attack("foreign hosts", _hosts, frozenset({400, 421})),
    # some of it is HTTP after all: a later version, the preface of another, a folded header
    Attack("no HTTP", _no_http, frozenset({200, 400, 404, 415})),
    Attack("methods", _methods, frozenset({200, 400, 404, 405, 415})),
)
