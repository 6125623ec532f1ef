"""Answers that end before their end: a line of the log for each, whoever ends it, and no traceback."""

import asyncio
import json
import socket
import struct
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from service.documents.examples import load
from tests.network.bystander import TORQUE
from tests.network.serving import Service, request, service

#: closed at once, with what was not read
_RESET = struct.pack("ii", 1, 0)
_FORMATS = ("ndjson", "csv", "parquet", "arrow", "xlsx")
_ROWS = 20_000


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("data")


@pytest.fixture(scope="module")
def target(folder: Path) -> Iterator[Service]:
    # what is not read yet of the answers that were cut counts for their client until they have ended
    with service(data_dir=folder, held_mb=1000, held_mb_each=500, row_streams=500, row_streams_each=500) as server:
        yield server


@pytest.fixture(scope="module")
def sweep(target: Service) -> str:
    """The path of a sweep that is done."""
    axes = [{"path": "/machine/speed_rpm", "start": 300, "stop": 900, "count": _ROWS}]
    body = json.dumps({"base": json.loads(load("w60")), "axes": axes}).encode()

    async def finish() -> str:
        path = (await target.ask("POST", "/v1/sweeps", body)).headers["location"]
        async with asyncio.timeout(300):
            while json.loads((await target.ask("GET", path)).body)["state"] != "done":
                await asyncio.sleep(0.1)
        return path

    return asyncio.run(finish())


def cut(target: Service, content: bytes, least: int) -> int:
    """Read so many bytes of an answer at least, then go away; how many were read."""
    with socket.create_connection(("127.0.0.1", target.port), timeout=180) as asking:
        asking.sendall(content)
        size = 0
        while size < least and (piece := asking.recv(65_536)):
            size += len(piece)
        asking.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, _RESET)
    return size


def end_of_log(target: Service) -> int:
    """Where the next line of the log begins: the last one may be written at this moment."""
    return target.log().rfind("\n") + 1


def lines(target: Service, begun: int, requests: int, of: str = "") -> list[dict[str, Any]]:
    """What the log says from somewhere on, when it has said something of so many requests whose ids begin so; all of it
    is JSON."""
    deadline = time.monotonic() + 180
    while True:
        log = target.log()[begun:]
        documents = [json.loads(line) for line in log[: log.rfind("\n") + 1].splitlines()]
        ids = [line["request_id"] for line in documents if line["logger"] == "service.requests"]
        if sum(name.startswith(of) for name in ids) >= requests:
            return documents
        assert time.monotonic() < deadline, log
        time.sleep(0.05)


def test_clients_that_go_away_in_the_middle(target: Service, sweep: str) -> None:
    requests = [request("GET", f"{sweep}/results?format={name}") for name in _FORMATS]
    requests += [
        request("POST", "/v1/analyze", TORQUE),
        request("GET", "/openapi.json"),
        request("GET", "/v1/examples"),
    ]
    # what is unusual about a request has it read in another way
    requests += [body.replace(b"Host:", b"X-Unusual: \xe9\r\nHost:") for body in requests]
    begun, names = end_of_log(target), list[str]()
    for query in requests:
        for least in (0, 1, 100_000):
            names.append(f"cut-{len(names)}")
            cut(target, query.replace(b"Host:", f"X-Request-ID: {names[-1]}\r\nHost:".encode()), least)
    # that of what the sweep was asked before may come as late
    passages = [line for line in lines(target, begun, len(names), "cut-") if line["request_id"].startswith("cut-")]
    assert [line for line in passages if line["logger"] != "service.requests"] == []
    assert {line["status"] for line in passages} <= {200, 499}
    assert sorted(line["request_id"] for line in passages) == sorted(names)


def test_rows_that_are_damaged_in_the_middle(target: Service, sweep: str, folder: Path) -> None:
    identity = sweep.rpartition("/")[2]
    begun = end_of_log(target)
    repaired = 0
    for name in ("ndjson", "csv", "arrow"):
        last = max((folder / "results" / identity).glob("0*"))
        content = bytearray(last.read_bytes())
        content[len(content) // 2] ^= 1
        last.write_bytes(content)
        size = cut(target, request("GET", f"{sweep}/results?format={name}"), 1 << 40)
        assert size > 100_000
        repaired += 1
        deadline = time.monotonic() + 180
        while True:
            state = json.loads(asyncio.run(target.ask("GET", sweep)).body)
            if (state["state"], state["repaired"]) == ("done", repaired):
                break
            assert time.monotonic() < deadline, state
            time.sleep(0.05)
    passages = [line for line in lines(target, begun, repaired) if line["logger"] != "service.requests"]
    assert [line for line in passages if "exc_info" in line] == []
    cuts = [line for line in passages if "an answer was cut" in line["message"]]
    assert len(cuts) == repaired
    assert all("Rows damaged: The file of the rows" in line["message"] for line in cuts)
    assert len({line["request_id"] for line in cuts}) == repaired
