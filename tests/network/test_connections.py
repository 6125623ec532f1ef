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


@pytest.fixture(scope="module")
def strict() -> Iterator[Service]:
    with service(
        headers_timeout_s=1, body_timeout_s=1, write_timeout_s=1, max_connections=20, keep_alive_s=2, log_level="info"
    ) as made:
        yield made


async def healthy(target: Service) -> None:
    # whoever is told 408 was late himself: these tests wait for a second, and a machine that is busy may as well
    while (status := (await target.ask("GET", "/healthz")).status) == 408:
        pass
    assert status == 200


def test_headers_that_come_too_slowly_end_the_connection(strict: Service) -> None:
    async def drip() -> int:
        async with strict.connection() as (reader, writer):
            writer.write(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n")
            answer = asyncio.create_task(read(reader))
            while not answer.done():
                # each piece is in time, the whole is not
                writer.write(b"X: y\r\n")
                await asyncio.sleep(0.1)
            return (await answer).status

    async def all_of_them() -> list[int]:
        dripping = [asyncio.create_task(drip()) for _ in range(10)]
        await asyncio.sleep(0.5)
        await healthy(strict)
        return await asyncio.gather(*dripping)

    assert asyncio.run(all_of_them()) == [408] * 10


def test_a_connection_that_says_nothing_is_closed(strict: Service) -> None:
    async def silent() -> int:
        async with strict.connection() as (reader, _):
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
            found = await answer
            return found.status, json.loads(found.body)["title"]

    assert asyncio.run(drip()) == (408, "Body too slow")


def test_a_body_that_never_ends_after_its_answer_ends_the_connection(strict: Service) -> None:
    async def endless() -> None:
        async with asyncio.timeout(180), strict.connection() as (reader, writer):
            head = request("POST", "/v1/optimize", headers={"Content-Length": "9" * 15, "Connection": "keep-alive"})
            writer.write(head)
            assert (await read(reader)).status == 413
            with suppress(ConnectionError):
                while True:
                    writer.write(b" " * 1000)
                    await writer.drain()
                    await asyncio.sleep(0.02)

    asyncio.run(endless())


def test_a_client_that_reads_nothing_is_let_go(strict: Service) -> None:
    async def reads_nothing() -> None:
        async with strict.connection() as (reader, writer):
            reader._transport.pause_reading()  # type: ignore[attr-defined]
            # more than the buffers of both kernels hold
            wanted = request("GET", "/openapi.json", headers={"Connection": "keep-alive"})
            writer.write(wanted * 200)
            await asyncio.sleep(4)
            await healthy(strict)

    asyncio.run(reads_nothing())
    # one of the few connections that there may be would be gone for ever
    asyncio.run(too_many(strict, 15, 200))


def test_a_client_that_reads_slowly_is_not_let_go(strict: Service) -> None:
    async def reads_slowly() -> bytes:
        async with strict.connection() as (reader, writer):
            # small buffers on this side: the service has to wait
            writer.get_extra_info("socket").setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            transport = reader._transport  # type: ignore[attr-defined]
            transport.max_size = 8192
            writer.write(request("GET", "/openapi.json"))
            content = b""
            begun = time.monotonic()
            # several times as long as one may read nothing
            while time.monotonic() - begun < 4:
                piece = await reader.read(8192)
                assert piece
                content += piece
                await asyncio.sleep(0.1)
            return content

    head, _, content = asyncio.run(reads_slowly()).partition(b"\r\n\r\n")
    assert head.startswith(b"HTTP/1.1 200 ")
    whole = asyncio.run(strict.ask("GET", "/openapi.json")).body
    assert whole.startswith(content)
    # the rest was still to come
    assert 0 < len(content) < len(whole)
    assert f"content-length: {len(whole)}".encode() in head


async def too_many(target: Service, others: int, expected: int) -> None:
    """As many connections as that come to an answer as expected, if not at once: on a busy machine those that say
    nothing are closed before the last is open, and those that are closed are let go later."""
    deadline = time.monotonic() + 180
    while (reply := await beside(target, others)).status != expected:
        assert time.monotonic() < deadline, reply
    if expected == 503:
        assert reply.headers["retry-after"] == "1"
        assert reply.headers["connection"] == "close"
        assert reply.headers["content-type"] == "application/problem+json"


async def beside(target: Service, others: int) -> Reply:
    held = [await asyncio.open_connection("127.0.0.1", target.port) for _ in range(others)]
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
    asked = (
        request("POST", "/v1/accuracy", body),
        request("POST", "/v1/accuracy", b"%x\r\n%b\r\n0\r\n\r\n" % (len(body), body), {"Transfer-Encoding": "chunked"}),
    )

    async def leave(question: bytes) -> None:
        async with strict.connection() as (_, writer):
            writer.write(question)
            await writer.drain()
            await strict.computing(1)
        await strict.computing(0)

    for question in asked:
        asyncio.run(leave(question))
    deadline = time.monotonic() + 180
    while strict.log().count('accuracy 499"') < len(asked):
        assert time.monotonic() < deadline
        time.sleep(0.02)
