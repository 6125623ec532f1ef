"""The smoke test passes on the service, and on nothing that is not right."""

import json
import os
import re
import socket
import subprocess
import threading
from collections.abc import Callable, Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import pytest
import uvicorn

from service.app import create_app
from service.guard import keys
from service.settings import Settings
from tests.deploy.files import DEPLOY


def smoke(url: str, key: str = "", ready_s: int = 600) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "COUNTERWEIGHT_KEY": key, "SMOKE_READY_S": str(ready_s), "SMOKE_SWEEP_S": "600"}
    environment.pop("http_proxy", None)
    return subprocess.run([DEPLOY / "smoke.sh", url], env=environment, capture_output=True, text=True, check=False)


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, str]]:
    """Address of a service that asks for keys, and a key."""
    folder = tmp_path_factory.mktemp("service")
    key, record = keys.make("smoke", ("compute", "sweeps"))
    keys.write(folder / "keys.jsonl", [record])
    settings = Settings(
        data_dir=folder, keys_file=folder / "keys.jsonl", concurrent_solves=1, sweep_workers=1, log_level="error"
    )
    listening = socket.create_server(("127.0.0.1", 0))
    server = uvicorn.Server(uvicorn.Config(create_app(settings), log_config=None))
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listening]})
    thread.start()
    yield f"http://127.0.0.1:{listening.getsockname()[1]}", key
    server.should_exit = True
    thread.join()
    listening.close()


def test_the_service_passes_and_nothing_is_left(service: tuple[str, str]) -> None:
    url, key = service
    ran = smoke(url, key)
    assert ran.returncode == 0, ran.stderr
    assert ran.stdout.count("ok  ") == 9
    process = subprocess.run(
        ["curl", "--silent", "--header", f"Authorization: Bearer {key}", f"{url}/v1/sweeps"],
        capture_output=True,
        check=True,
    )
    assert json.loads(process.stdout)["sweeps"] == []


def test_a_wrong_key_does_not_pass(service: tuple[str, str]) -> None:
    ran = smoke(service[0], "wrong")
    assert ran.returncode == 1
    assert "certified optimum (status 401" in ran.stderr


def test_a_key_is_on_no_command_line() -> None:
    """Other users of the machine read those."""
    text = (DEPLOY / "smoke.sh").read_text("utf-8")
    assert not re.search(r"--header[^\n]*COUNTERWEIGHT_KEY", text)


def test_nobody_there(unused: str) -> None:
    ran = smoke(unused, ready_s=0)
    assert ran.returncode == 1
    assert "FAILED  ready (status 000" in ran.stderr


@pytest.fixture
def unused() -> Iterator[str]:
    # taken, so that nobody else listens there
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        yield f"http://127.0.0.1:{taken.getsockname()[1]}"


Answers = dict[str, tuple[int, Any]]


@pytest.fixture
def impostor() -> Iterator[Callable[[Answers], str]]:
    """Makes a server that gives the same answer at a path whatever it is asked."""
    servers: list[ThreadingHTTPServer] = []

    def start(answers: Answers) -> str:
        class Handler(BaseHTTPRequestHandler):
            def do_GET(self) -> None:
                self.rfile.read(int(self.headers.get("content-length", 0)))
                status, body = answers.get(self.path, (404, {}))
                content = json.dumps(body).encode()
                self.send_response(status)
                self.send_header("content-length", str(len(content)))
                self.end_headers()
                self.wfile.write(content)

            do_POST = do_DELETE = do_GET

            def log_message(self, format: str, *args: object) -> None:  # noqa: A002
                pass

        server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        threading.Thread(target=server.serve_forever).start()
        servers.append(server)
        return f"http://127.0.0.1:{server.server_port}"

    yield start
    for server in servers:
        server.shutdown()
        server.server_close()


READY: Answers = {"/readyz": (200, {"status": "ready"})}


def optimum(**changed: Any) -> dict[str, Any]:
    """The right answer to the machine of the script. Analytic: 30 kg, and 6 kg at 0.1 m and 600 rpm remain."""
    remains = 6 * 0.1 * (600 * 3.141592653589793 / 30) ** 2
    answer = {
        "status": "optimal",
        "total_mass_kg": 30.0,
        "residual": {"after": {"force": {"peak_N": remains}}},
        "floor": {"force_N": remains},
        "certificate": {"objective": remains, "lower_bound": remains, "gap": 0.0, "relative_gap": 0.0},
    }
    return {**answer, **changed}


def test_an_answer_that_is_right_is_taken(impostor: Callable[[Answers], str]) -> None:
    ran = smoke(impostor({**READY, "/v1/optimize": (200, optimum())}))
    assert "ok      certified optimum" in ran.stdout
    assert "FAILED  a wrong field is named (status 200, expected 422)" in ran.stderr
    assert ran.returncode == 1


@pytest.mark.parametrize(
    "wrong",
    [
        {"status": "inaccurate"},
        {"total_mass_kg": 30.1},
        {"residual": {"after": {"force": {"peak_N": 2300.0}}}},
        {"certificate": {"objective": 1.0, "lower_bound": 0.9, "gap": 0.1, "relative_gap": 1e-5}},
        {"certificate": {"objective": 1.0, "lower_bound": 1.1, "gap": 0.0, "relative_gap": 0.0}},
        {"certificate": {"objective": 1.0, "lower_bound": 1.0, "gap": -0.1, "relative_gap": -0.1}},
    ],
)
def test_an_answer_that_is_wrong_is_not(impostor: Callable[[Answers], str], wrong: dict[str, Any]) -> None:
    ran = smoke(impostor({**READY, "/v1/optimize": (200, optimum(**wrong))}))
    assert ran.returncode == 1
    assert "FAILED  certified optimum" in ran.stderr


def test_a_service_that_is_never_ready(impostor: Callable[[Answers], str]) -> None:
    ran = smoke(impostor({"/readyz": (503, {"title": "not ready"})}), ready_s=1)
    assert ran.returncode == 1
    assert "FAILED  ready (status 503" in ran.stderr


def test_nothing_is_left_in_the_temporary_folder(unused: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    smoke(unused, ready_s=0)
    assert list(tmp_path.iterdir()) == []
