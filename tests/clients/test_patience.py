"""What the Python client does when it is told to come back later, against a server that says so."""

import json
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from email.utils import formatdate
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

Answer = tuple[int, dict[str, str], bytes]
_GOOD: Answer = (200, {}, b'{"status": "optimal"}')


@contextmanager
def serving(answers: Iterator[Answer]) -> Iterator[tuple[str, list[tuple[str, dict[str, str]]]]]:
    """A server that gives one answer after the other; where it is, and what it was sent."""
    values: list[tuple[str, dict[str, str]]] = []

    class Handler(BaseHTTPRequestHandler):
        def _answer(self) -> None:
            self.rfile.read(int(self.headers.get("Content-Length", "0")))
            values.append((self.path, {name.lower(): value for name, value in self.headers.items()}))
            status, headers, content = next(answers)
            self.send_response(status)
            for name, value in headers.items():
                self.send_header(name, value)
            self.send_header("Content-Length", str(len(content)))
            self.end_headers()
            self.wfile.write(content)

        do_GET = do_POST = _answer

        def log_message(self, format: str, *args: Any) -> None:  # noqa: A002
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), Handler) as server:
        thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01})
        thread.start()
        try:
            yield f"http://127.0.0.1:{server.server_port}", values
        finally:
            server.shutdown()
            thread.join()


def busy(status: int, **headers: str) -> Answer:
    error = {"title": "Busy", "status": status, "detail": "Later."}
    named = {name.replace("_", "-"): value for name, value in headers.items()}
    return status, named, json.dumps(error).encode()


@pytest.fixture
def waited(counterweight: ModuleType, monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """The times for which the client has waited [s], in place of its waiting for so long."""
    times: list[float] = []
    clock = SimpleNamespace(sleep=times.append, monotonic=lambda: sum(times))
    monkeypatch.setattr(counterweight, "time", clock)
    return times


@pytest.mark.parametrize(("answer", "wait_s"), [(busy(503, Retry_After="1"), 1.0), (busy(429, Retry_After="0"), 0.0)])
def test_it_comes_back_when_it_is_told_to(
    counterweight: ModuleType, waited: list[float], answer: Answer, wait_s: float
) -> None:
    with serving(iter([answer, _GOOD])) as (url, requests):
        assert counterweight.Service(url).optimize({}) == {"status": "optimal"}
    assert waited == [wait_s]
    assert len(requests) == 2


def test_it_comes_back_on_the_date_it_is_told(counterweight: ModuleType, waited: list[float]) -> None:
    tomorrow = formatdate(time.time() + 86_400, usegmt=True)
    with serving(iter([busy(503, Retry_After=tomorrow), _GOOD])) as (url, _):
        counterweight.Service(url, patience_s=90_000).optimize({})
    # what is left of the day when the answer is read
    assert len(waited) == 1
    assert 80_000 < waited[0] <= 86_400


@pytest.mark.parametrize(
    "answer",
    [busy(503, Retry_After="60"), busy(503), busy(503, Retry_After="soon"), busy(500, Retry_After="0")],
    ids=["longer than its patience", "without a time", "without a readable time", "not worth a second try"],
)
def test_it_gives_up(counterweight: ModuleType, waited: list[float], answer: Answer) -> None:
    refusal = pytest.raises(counterweight.Refused, match="Busy: Later")
    with serving(iter([answer])) as (url, requests), refusal as refused:
        counterweight.Service(url, patience_s=5).optimize({})
    assert waited == []
    assert refused.value.status == answer[0]
    assert len(requests) == 1


def test_its_patience_is_for_all_waits_together(counterweight: ModuleType, waited: list[float]) -> None:
    with serving(iter([busy(429, Retry_After="1")] * 9)) as (url, requests), pytest.raises(counterweight.Refused):
        counterweight.Service(url, patience_s=2.5).optimize({})
    assert waited == [1.0, 1.0]
    assert len(requests) == 3


def test_a_sweep_that_is_tried_again_is_the_same_sweep(counterweight: ModuleType) -> None:
    with serving(iter([busy(503, Retry_After="0"), _GOOD])) as (url, requests):
        counterweight.Service(url).sweep({})
    assert requests[0][1]["idempotency-key"] == requests[1][1]["idempotency-key"]


def test_a_proxy_that_answers_in_its_own_way(counterweight: ModuleType) -> None:
    page: Answer = (502, {"Content-Type": "text/html"}, b"<h1>Bad gateway</h1>")
    with serving(iter([page])) as (url, _), pytest.raises(counterweight.Refused, match="502 Bad Gateway"):
        counterweight.Service(url).optimize({})


def test_the_key_goes_to_the_service_and_not_to_where_it_redirects(counterweight: ModuleType) -> None:
    moved = {"Location": ""}
    with serving(iter([_GOOD])) as (elsewhere, there), serving(iter([(302, moved, b"")])) as (url, here):
        moved["Location"] = f"{elsewhere}/v1/examples"
        counterweight.Service(url, key="cw_secret").examples()
    assert here[0][1]["authorization"] == "Bearer cw_secret"
    assert "authorization" not in there[0][1]


def test_paths_and_links_behind_a_proxy_with_a_prefix(counterweight: ModuleType) -> None:
    with serving(iter([_GOOD, _GOOD])) as (url, requests):
        service = counterweight.Service(f"{url}/balance/")
        service.examples()
        service.state({"links": {"self": "/balance/v1/sweeps/5f0c"}})
    assert [path for path, _ in requests] == ["/balance/v1/examples", "/balance/v1/sweeps/5f0c"]
