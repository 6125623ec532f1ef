"""SIGKILL of the service and of workers, two services on one database, and an orderly end."""

import json
import socket
import time
from contextlib import suppress
from pathlib import Path

import psutil
import pytest

from optimizer.studies.sweep import run_chunk
from schemas.base.version import package_version
from schemas.sweep.request import SweepRequest
from tests.jobs.kills import kill
from tests.jobs.process import service
from tests.jobs.serving import VERSION
from tests.jobs.sweeps import analyses

SWEEP = analyses(20, 50)


def expected() -> "object":
    request = SweepRequest.model_validate(SWEEP)
    return run_chunk(request.model_dump_json().encode(), 0, request.total)


@pytest.mark.nightly
def test_kills_at_random_moments(tmp_path: Path) -> None:
    # a hundred, of longer sweeps: python -m tests.jobs.kills. A hundred chunks take 20 s, and no life lasts as long
    sweeps, midway = kill(tmp_path, kills=4, seed=7, longest_s=0.5, kills_per_process=2, body=analyses(20, 320))
    assert (sweeps, midway) == (2, 2)


def test_a_killed_worker(tmp_path: Path) -> None:
    with service(tmp_path, delay_s=0.1) as running:
        _, headers, _ = running.send("POST", "/v1/sweeps", SWEEP)
        path = headers["location"]
        killed = 0
        while killed < 2 and running.read(path)["state"] in ("queued", "running"):
            for worker in running.workers():
                if running.read(path)["done"] > 100 * killed:
                    with suppress(psutil.NoSuchProcess):
                        worker.kill()
                        killed += 1
                    time.sleep(0.5)
                    break
            time.sleep(0.1)
        assert killed == 2
        assert running.ended(path)["state"] == "done"
        assert running.rows(path).equals(expected())


@pytest.mark.parametrize("database", ["sqlite", "postgresql"])
def test_two_services_share_one_sweep(tmp_path: Path, database: str, request: pytest.FixtureRequest) -> None:
    more = {}
    if database == "postgresql":
        more["database_url"] = request.getfixturevalue("postgres_url")
    settings = {**more, "sweep_workers": "1"}
    # as in an upgrade: of two versions, the second of which goes on alone
    later = {VERSION: "99.0.0"}
    with (
        service(tmp_path, delay_s=0.1, **settings) as server,
        service(tmp_path, delay_s=0.1, more=later, **settings) as two,
    ):
        versions = [
            json.loads(single_service.send("GET", "/v1/version")[2])["version"] for single_service in (server, two)
        ]
        assert versions == [package_version(), "99.0.0"]
        _, headers, _ = server.send("POST", "/v1/sweeps", SWEEP)
        path = headers["location"]
        # either knows of it, and one of them is killed on the way
        assert two.read(path)["total"] == 1000
        while two.read(path)["done"] < 200:
            time.sleep(0.05)
        server.process.kill()
        assert two.ended(path)["done"] == 1000
        assert two.rows(path).equals(expected())


def test_it_stops_at_once_and_goes_on(tmp_path: Path) -> None:
    # a stream of events does not use up the grace for open requests
    with service(tmp_path, delay_s=0.2, graceful_shutdown_s="600", sweep_workers="1") as running:
        _, headers, _ = running.send("POST", "/v1/sweeps", SWEEP)
        path = headers["location"]
        with socket.create_connection(running.where, timeout=180) as stream:
            stream.sendall(f"GET {path}/events HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
            assert b"200 OK" in stream.recv(4096)
            while running.read(path)["done"] == 0:
                time.sleep(0.05)
            running.process.terminate()
            running.process.wait(180)
    with service(tmp_path, delay_s=0, sweep_workers="1") as again:
        state = again.ended(path)
        assert (state["state"], state["done"]) == ("done", 1000)
        assert again.rows(path).equals(expected())
