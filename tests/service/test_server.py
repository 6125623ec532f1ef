"""The server as a process: one line with its address, real sockets, an orderly end."""

import http.client
import os
import re
import signal
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import closing
from tempfile import TemporaryFile
from typing import IO
from urllib.parse import urlsplit

import pytest

from service.documents.examples import load
from tests.commands import Command, run


def start(log: IO[str], fresh: bool = False, **environment: str) -> "subprocess.Popen[str]":
    """The server, from nothing or forked; what it logs goes into a file, which takes all of it."""
    return Command(
        *("service", "serve", "--port", "0"),
        environment={**os.environ, **environment},
        fresh=fresh,
        stdout=subprocess.PIPE,
        stderr=log,
        text=True,
    )


def address(process: "subprocess.Popen[str]") -> tuple[str, int]:
    assert process.stdout is not None
    text = process.stdout.readline()
    match = re.fullmatch(r"counterweight listens on (http://\S+) \(documentation at \1/docs\)\n", text)
    assert match is not None
    parts = urlsplit(match[1])
    assert parts.hostname is not None
    assert parts.port is not None
    return parts.hostname, parts.port


@pytest.fixture(scope="module")
def server() -> Iterator[tuple[str, int]]:
    with TemporaryFile("w+") as log, start(log, COUNTERWEIGHT_MAX_BODY_BYTES="100000") as process:
        try:
            where = address(process)
            deadline = time.monotonic() + 180
            while status(where, "GET", "/readyz") != 200:
                assert time.monotonic() < deadline
                time.sleep(0.05)
            yield where
        finally:
            process.terminate()
            process.wait(180)
        log.seek(0)
        assert "Traceback" not in log.read()


def send(where: tuple[str, int], method: str, path: str, body: object = None, **headers: str) -> tuple[int, str, bytes]:
    with closing(http.client.HTTPConnection(*where, timeout=180)) as connection:
        connection.request(method, path, body, {"Content-Type": "application/json", **headers})  # type: ignore[arg-type]
        answer = connection.getresponse()
        return answer.status, answer.headers["Content-Type"], answer.read()


def status(where: tuple[str, int], method: str, path: str) -> int:
    return send(where, method, path)[0]


def test_it_computes(server: tuple[str, int]) -> None:
    code, kind, content = send(server, "POST", "/v1/optimize", load("w60"))
    assert (code, kind) == (200, "application/json")
    assert b'"status":"optimal"' in content


def test_head_has_no_body(server: tuple[str, int]) -> None:
    assert send(server, "HEAD", "/healthz")[::2] == (200, b"")
    assert send(server, "HEAD", "/v1/optimize")[::2] == (405, b"")


@pytest.mark.parametrize("size", [100_001, 5_000_000])
def test_a_large_body_is_refused_with_a_readable_answer(server: tuple[str, int], size: int) -> None:
    code, kind, _ = send(server, "POST", "/v1/optimize", b" " * size)
    assert (code, kind) == (413, "application/problem+json")
    # without a length: the client sends it in chunks
    code, kind, _ = send(server, "POST", "/v1/optimize", iter([b" " * 1000] * (size // 1000 + 1)))
    assert (code, kind) == (413, "application/problem+json")


def test_a_client_that_hangs_up_early_leaves_no_traceback(server: tuple[str, int]) -> None:
    with socket.create_connection(server, timeout=180) as connection:
        head = "POST /v1/optimize HTTP/1.0\r\nContent-Type: application/json\r\nContent-Length: 500\r\n\r\n{"
        connection.sendall(head.encode())
    assert status(server, "GET", "/healthz") == 200


@pytest.mark.parametrize(
    "odd",
    [
        b"\xff/\xff",
        b'application/json; charset*0="a\xff"; charset*1*=%fe',
        b"application/json; charset*=a; charset*0=b",
        b"application/json; charset*" + b"9" * 5000 + b"=b",
        b"a/b/c;;=",
        b"=",
    ],
)
def test_odd_headers(server: tuple[str, int], odd: bytes) -> None:
    with socket.create_connection(server, timeout=180) as connection:
        head = b"POST /v1/optimize HTTP/1.0\r\nContent-Length: 2\r\nConnection: close\r\nContent-Type: "
        connection.sendall(head + odd + b"\r\n\r\n{}")
        first = connection.makefile("rb").readline()
    assert re.match(rb"HTTP/1.1 4\d\d ", first)


@pytest.mark.parametrize(("ending", "fresh"), [(signal.SIGTERM, True), (signal.SIGINT, False)])
def test_an_orderly_end(ending: signal.Signals, fresh: bool) -> None:
    with TemporaryFile("w+") as log, start(log, fresh) as process:
        where = address(process)
        assert status(where, "GET", "/healthz") == 200
        process.send_signal(ending)
        process.wait(180)
        log.seek(0)
        assert log.read() == ""
    assert process.returncode in (0, -signal.SIGTERM)


def test_addresses_that_cannot_be_taken() -> None:
    def refused(*arguments: str, **environment: str) -> str:
        process = run("service", "serve", *arguments, environment={**os.environ, **environment})
        assert (process.returncode, process.stdout) == (2, "")
        assert "Traceback" not in process.stderr
        return process.stderr

    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = str(taken.getsockname()[1])
        assert f"cannot listen on 127.0.0.1, port {port}: " in refused("--port", port)
    assert refused("--port", "70000").startswith("--port: ")
    assert refused(PORT="http").startswith("PORT: ")
    # a service that is to have keys does not start without them because of a letter
    assert "COUNTERWEIGHT_KEY_FILE: " in refused(COUNTERWEIGHT_KEY_FILE="keys.jsonl")
