"""What is logged and counted about requests, and what is not: nothing of a machine unless asked for."""

import asyncio
import json
import logging
import re
import threading
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import uvicorn
from starlette.testclient import TestClient

from service.app import create_app
from service.documents.examples import load
from service.settings import Settings
from service.watch import logs
from service.wire.server import listen, url
from tests.network.serving import Service, service

SECRET = "secret-7021962"
#: a path that would like to be a line
INJECTION = '/\n{"level":"ERROR"}'
TRACE = "0af7651916cd43dd8448eb211c80319c"
BODY = load("w60").replace(b'"name": "', f'"name": "{SECRET} '.encode(), 1)


def lines(text: str) -> list[dict[str, Any]]:
    # the last may be half written
    return [json.loads(line) for line in text[: text.rfind("\n") + 1].splitlines()]


def requests(text: str, path: str) -> list[dict[str, Any]]:
    return [line for line in lines(text) if line["logger"] == "service.requests" and line["path"] == path]


def log_of_requests(target: Service) -> str:
    """What the service logs about four requests, one of which tries to write a line of its own."""
    before = len(target.log())

    async def ask() -> None:
        headers = {"X-Request-ID": "mine-1", "Traceparent": f"00-{TRACE}-b7ad6b7169203331-01"}
        assert (await target.ask("POST", "/v1/optimize", BODY, headers)).headers["x-request-id"] == "mine-1"
        await target.ask("POST", "/v1/optimize", BODY.replace(b"speed_rpm", SECRET.encode()))
        odd = await target.ask("GET", "/v1/sweeps", headers={"X-Request-ID": 'a"\tb', "Traceparent": "00-x-y-z"})
        assert re.fullmatch("[0-9a-f]{32}", odd.headers["x-request-id"])
        await target.ask("GET", "/%0a%7b%22level%22:%22ERROR%22%7d")

    asyncio.run(ask())
    # a line is written when the answer is already on its way
    deadline = time.monotonic() + 180
    while sum(line["logger"] == "service.requests" for line in lines(target.log()[before:])) < 4:
        assert time.monotonic() < deadline
        time.sleep(0.02)
    return target.log()[before:]


def test_every_line_is_json_with_the_request_and_without_the_machine(target: Service) -> None:
    text = log_of_requests(target)
    good, bad = requests(text, "/v1/optimize")
    assert (good["status"], good["method"], good["request_id"], good["trace_id"]) == (200, "POST", "mine-1", TRACE)
    assert good["duration_ms"] > 0
    assert bad["status"] == 422
    assert bad["trace_id"] != TRACE
    assert [line["level"] for line in requests(text, INJECTION)] == ["INFO"]
    assert SECRET not in text


def test_machines_are_logged_if_asked_for() -> None:
    with service(log_machines="true") as target:
        good, bad = requests(log_of_requests(target), "/v1/optimize")
    assert SECRET in good["body"]
    assert SECRET in bad["body"]


def test_a_fault_is_logged_by_where_it_is(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def fail() -> None:
        raise RuntimeError(SECRET)

    pair = logging.getLogger().handlers[:], logging.getLogger().level
    try:
        for quotes, form in ((False, "json"), (True, "json"), (False, "text")):
            logs.configure(Settings(log_machines=quotes, log_format=form))
            try:
                fail()
            except RuntimeError:
                logging.getLogger("x").exception("it failed")
            text = capsys.readouterr().err
            assert "it failed" in text
            assert "RuntimeError" in text
            assert "test_logs.py" in text
            assert (SECRET in text) is quotes
    finally:
        logging.getLogger().handlers[:], _ = pair
        logging.getLogger().setLevel(pair[1])


def test_what_nobody_foresaw_is_one_line_with_the_id_of_its_request(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    settings = Settings(data_dir=tmp_path, port=0)
    app = create_app(settings, warm=False)

    def fail() -> None:
        raise RuntimeError(SECRET)

    app.add_api_route("/v1/broken", fail)
    # before the route that answers whatever no other does
    app.router.routes.insert(0, app.router.routes.pop())
    pair = logging.getLogger().handlers[:], logging.getLogger().level
    try:
        logs.configure(settings)
        with listen(settings) as listening:
            server = uvicorn.Server(uvicorn.Config(app, log_config=None, access_log=False, lifespan="off"))
            thread = threading.Thread(target=server.run, args=([listening],))
            thread.start()
            body = urllib.request.Request(f"{url(listening)}/v1/broken", headers={"X-Request-ID": "mine-2"})
            with pytest.raises(urllib.error.HTTPError) as answered:
                urllib.request.urlopen(body, timeout=180)
            answered.value.close()
            server.should_exit = True
            thread.join(180)
        text = capsys.readouterr().err
    finally:
        logging.getLogger().handlers[:], _ = pair
        logging.getLogger().setLevel(pair[1])
    assert (answered.value.code, answered.value.headers["X-Request-ID"]) == (500, "mine-2")
    assert SECRET not in text
    (fault,) = (line for line in lines(text) if line["level"] == "ERROR")
    assert fault["request_id"] == "mine-2"
    assert "test_logs.py" in fault["exc_info"]
    assert fault["exc_info"].endswith("RuntimeError")
    (request,) = requests(text, "/v1/broken")
    assert (request["status"], request["request_id"]) == (500, "mine-2")


def test_nobody_begins_a_line_of_text() -> None:
    with service(log_format="text") as target:
        before = len(target.log())
        for path in (b"/%0a2026-01-01 00:00:00,000 ERROR   forged", b"/%0d%1b[2J%c2%85%e2%80%a8x", b'/"%20status=200'):
            asyncio.run(target.send(b"GET " + path.replace(b" ", b"%20") + b" HTTP/1.0\r\n\r\n"))
        deadline = time.monotonic() + 180
        while (log := target.log()[before:]).count("unmatched 404") < 3:
            assert time.monotonic() < deadline
            time.sleep(0.02)
    begun = [line for line in log.split("\n") if line and not line.startswith("    ")]
    assert len(begun) == 3
    quoted = re.compile(r'\S+ \S+ INFO    GET unmatched 404 method=GET path="(?:[^"\\]|\\.)*" status=404 .*')
    assert all(quoted.fullmatch(line) for line in begun)
    assert not set(log) & set("\r\x1b\x85\u2028")


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    settings = Settings(concurrent_solves=1, data_dir=tmp_path_factory.mktemp("data"))
    with TestClient(create_app(settings, warm=False), raise_server_exceptions=False) as client:
        yield client


def sample(client: TestClient, name: str) -> float:
    answer = client.get("/metrics")
    assert answer.headers["content-type"].startswith("text/plain")
    match = re.search(rf"^{re.escape(name)} (\S+)$", answer.text, re.MULTILINE)
    return float(match[1]) if match else 0.0


def test_metrics_count_requests_solves_and_gaps(client: TestClient) -> None:
    headers = {"Content-Type": "application/json"}
    for _ in range(3):
        answer = client.post("/v1/optimize", content=BODY, headers=headers)
        assert answer.status_code == 200
    method = answer.json()["certificate"]["method"]
    assert client.post("/v1/optimize", json={}).status_code == 422
    assert client.head("/healthz").status_code == 200
    client.request("BREW", "/nothing/at/all")
    requests = "counterweight_requests_total"
    assert sample(client, f'{requests}{{method="POST",route="/v1/optimize",status="200"}}') == 3
    assert sample(client, f'{requests}{{method="POST",route="/v1/optimize",status="422"}}') == 1
    assert sample(client, f'{requests}{{method="HEAD",route="/healthz",status="200"}}') == 1
    assert sample(client, f'{requests}{{method="other",route="unmatched",status="404"}}') == 1
    assert sample(client, f'counterweight_solve_seconds_count{{method="{method}"}}') == 3
    gap = answer.json()["certificate"]["relative_gap"]
    total = sample(client, f'counterweight_certified_relative_gap_sum{{method="{method}"}}')
    assert total == pytest.approx(3 * gap, rel=1e-6)
    assert sample(client, 'counterweight_computation_seconds_count{computation="optimize"}') == 3
    assert sample(client, 'counterweight_worker_events_total{event="started"}') == 1
    assert sample(client, "counterweight_computations_waiting") == 0


def test_metrics_tell_of_jobs_only_when_there_are_any(client: TestClient) -> None:
    assert sample(client, "counterweight_job_database_up") == 1
    assert sample(client, 'counterweight_jobs{state="cancelled"}') == 0
    axes = [{"path": "/machine/speed_rpm", "start": 300, "stop": 900, "count": 10_000_000}]
    started = client.post("/v1/sweeps", json={"base": json.loads(load("w60")), "axes": axes})
    client.delete(started.headers["location"])
    assert sample(client, 'counterweight_jobs{state="cancelled"}') == 1


def test_traces_go_to_the_collector(tmp_path: Path) -> None:
    from http.server import BaseHTTPRequestHandler, HTTPServer
    from threading import Thread

    from opentelemetry.proto.collector.trace.v1.trace_service_pb2 import ExportTraceServiceRequest

    got: list[bytes] = []

    class Collector(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            got.append(self.rfile.read(int(self.headers["Content-Length"])))
            self.send_response(200)
            self.send_header("Content-Length", "0")
            self.end_headers()

        def log_message(self, *_: object) -> None:
            pass

    with HTTPServer(("127.0.0.1", 0), Collector) as collector:
        thread = Thread(target=collector.serve_forever)
        thread.start()
        try:
            settings = Settings(otlp_endpoint=f"http://127.0.0.1:{collector.server_port}", data_dir=tmp_path)
            with TestClient(create_app(settings, warm=False)) as client:
                headers = {"Content-Type": "application/json", "Traceparent": f"00-{TRACE}-b7ad6b7169203331-01"}
                assert client.post("/v1/optimize", content=BODY, headers=headers).status_code == 200
        finally:
            collector.shutdown()
            thread.join()
    # at once, unless the machine is late by seconds in between
    resources = [
        resource for content in got for resource in ExportTraceServiceRequest.FromString(content).resource_spans
    ]
    spans = {span.name: span for resource in resources for scope in resource.scope_spans for span in scope.spans}
    assert set(spans) == {"POST", "optimize"}
    assert {span.trace_id.hex() for span in spans.values()} == {TRACE}
    assert spans["optimize"].parent_span_id == spans["POST"].span_id
    assert SECRET.encode() not in b"".join(got)
