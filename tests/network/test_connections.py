"""Clients that are slow, too many, or go away; they must not disturb others."""

import asyncio
import json
import socket
import time
from collections.abc import Iterator
from contextlib import suppress

import pytest

from service.documents.examples import load
from tests.network.serving import Reply, Service, read, request, service

#: the longest that a client of ``strict`` may read nothing [s]
LONGEST_S = 2


@pytest.fixture(scope="module")
def hasty() -> Iterator[Service]:
    """It waits a second for headers: a test that a busy machine has stand still may be late itself."""
    with service(headers_timeout_s=1) as server:
        yield server


@pytest.fixture(scope="module")
def strict() -> Iterator[Service]:
    """It is patient with headers, so that whoever asks for something else is not late however busy the machine is."""
    with service(
        headers_timeout_s=120, body_timeout_s=1, write_timeout_s=LONGEST_S, max_connections=20, log_level="info"
    ) as server:
        yield server


async def healthy(target: Service) -> None:
    # whoever is told 408 was late himself: a second is not long on a machine that is busy
    deadline = time.monotonic() + 180
    while (status := (await target.ask("GET", "/healthz")).status) == 408:
        assert time.monotonic() < deadline
    assert status == 200


def test_headers_that_come_too_slowly_end_the_connection(hasty: Service) -> None:
    async def drip() -> int:
        async with hasty.connection() as (reader, writer):
            writer.write(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n")
            answer = asyncio.create_task(read(reader))
            while not answer.done():
                # each piece is in time, the whole is not
                writer.write(b"X: y\r\n")
                await asyncio.sleep(0.1)
            return (await answer).status

    async def every_weight() -> list[int]:
        dripping = [asyncio.create_task(drip()) for _ in range(10)]
        await asyncio.sleep(0.5)
        await healthy(hasty)
        return await asyncio.gather(*dripping)

    assert asyncio.run(every_weight()) == [408] * 10


def test_a_connection_that_says_nothing_is_closed(hasty: Service) -> None:
    async def silent() -> int:
        async with hasty.connection() as (reader, _):
            return (await asyncio.wait_for(read(reader), 180)).status

    assert asyncio.run(silent()) == 408


def test_a_body_that_comes_too_slowly_is_answered_408(strict: Service) -> None:
    async def drip() -> tuple[int, str]:
        async with strict.connection() as (reader, writer):
            writer.write(request("POST", "/v1/optimize", headers={"Content-Length": "100"}))
            answer = asyncio.create_task(read(reader))
            while not answer.done():
                writer.write(b" ")
                await asyncio.sleep(0.1)
            reply = await answer
            return reply.status, json.loads(reply.body)["title"]

    assert asyncio.run(drip()) == (408, "Body too slow")


def test_a_body_that_never_ends_after_its_answer_ends_the_connection(hasty: Service) -> None:
    async def endless() -> int:
        async with asyncio.timeout(180), hasty.connection() as (reader, writer):
            head = request("POST", "/v1/optimize", headers={"Content-Length": "9" * 15, "Connection": "keep-alive"})
            writer.write(head)
            if (status := (await read(reader)).status) == 413:
                with suppress(ConnectionError):
                    while True:
                        writer.write(b" " * 1000)
                        await writer.drain()
                        await asyncio.sleep(0.02)
            return status

    deadline = time.monotonic() + 180
    while (status := asyncio.run(endless())) == 408:
        assert time.monotonic() < deadline
    assert status == 413


def test_a_client_that_reads_nothing_is_let_go(strict: Service) -> None:
    async def reads_nothing() -> None:
        async with strict.connection() as (reader, writer):
            reader._transport.pause_reading()  # type: ignore[attr-defined]
            # more than the buffers of both kernels hold
            body = request("GET", "/openapi.json", headers={"Connection": "keep-alive"})
            writer.write(body * 200)
            await asyncio.sleep(2 * LONGEST_S)
            await healthy(strict)

    asyncio.run(reads_nothing())
    # one of the few connections that there may be would be gone for ever
    asyncio.run(too_many(strict, 15, 200))


def test_a_client_that_reads_slowly_is_not_let_go(strict: Service) -> None:
    async def reads_slowly() -> bytes | None:
        """None if it was cut off after it had stood still itself, on a machine that is busy."""
        async with strict.connection() as (reader, writer):
            # small buffers on this side: the service has to wait
            writer.get_extra_info("socket").setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            transport = reader._transport  # type: ignore[attr-defined]
            transport.max_size = 8192
            writer.write(request("GET", "/openapi.json"))
            content = b""
            begun = last = time.monotonic()
            longest = 0.0
            # several times as long as one may read nothing
            while time.monotonic() - begun < 3 * LONGEST_S:
                piece = b""
                with suppress(ConnectionError):
                    piece = await reader.read(8192)
                longest, last = max(longest, time.monotonic() - last), time.monotonic()
                if not piece:
                    assert longest > 0.5 * LONGEST_S
                    return None
                content += piece
                await asyncio.sleep(0.1)
            return content

    deadline = time.monotonic() + 180
    while (actual_reads_slowly := asyncio.run(reads_slowly())) is None:
        assert time.monotonic() < deadline
    head, _, content = actual_reads_slowly.partition(b"\r\n\r\n")
    assert head.startswith(b"HTTP/1.1 200 ")
    whole = asyncio.run(strict.ask("GET", "/openapi.json")).body
    assert whole.startswith(content)
    # the rest was still to come
    assert 0 < len(content) < len(whole)
    assert f"content-length: {len(whole)}".encode() in head


async def too_many(target: Service, count: int, expected: int) -> None:
    """As many connections as that come to an answer as expected, if not at once: those that are closed are let go
    later."""
    deadline = time.monotonic() + 180
    while (reply := await beside(target, count)).status != expected:
        assert time.monotonic() < deadline, reply
    if expected == 503:
        assert reply.headers["retry-after"] == "1"
        assert reply.headers["connection"] == "close"
        assert reply.headers["content-type"] == "application/problem+json"


async def beside(target: Service, count: int) -> Reply:
    held = [await asyncio.open_connection("127.0.0.1", target.port) for _ in range(count)]
    try:
        # whoever asks for health is answered, however many there are
        await healthy(target)
        return await target.ask("GET", "/v1/examples")
    finally:
        for _, writer in held:
            writer.close()


def test_too_many_connections_are_answered_503_and_forgotten(strict: Service) -> None:
    asyncio.run(too_many(strict, 25, 503))
    asyncio.run(too_many(strict, 5, 200))


def test_the_work_of_a_client_that_goes_away_ends(strict: Service) -> None:
    # many seconds of work, which nobody waits for
    body = json.dumps({"machine": json.loads(load("2d12"))["machine"], "repeats": 20}).encode()

    # the second one is no plain request
    pair = (
        request("POST", "/v1/accuracy", body),
        request("POST", "/v1/accuracy", b"%x\r\n%b\r\n0\r\n\r\n" % (len(body), body), {"Transfer-Encoding": "chunked"}),
    )

    async def leave(question: bytes) -> None:
        async with strict.connection() as (_, writer):
            writer.write(question)
            await writer.drain()
            await strict.computing(1)
        await strict.computing(0)

    for question in pair:
        asyncio.run(leave(question))
    deadline = time.monotonic() + 180
    while strict.log().count('accuracy 499"') < len(pair):
        assert time.monotonic() < deadline
        time.sleep(0.02)
