"""The state machine of the warm-up: warming, then ready or failed."""

import gc
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from threading import Event
from typing import Any

import pytest
from starlette.testclient import TestClient

from service.app import create_app
from service.http.openapi import Documented
from service.settings import Settings
from service.watch import needs, readiness
from service.watch.readiness import NotReady
from service.workers.pool import Pool


def wait_until(condition: Callable[[], bool]) -> None:
    deadline = time.monotonic() + 180
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.01)


def test_warming_then_ready(monkeypatch: pytest.MonkeyPatch) -> None:
    go, openapi = Event(), Documented.openapi
    apps: list[Documented] = []

    def counted(app: Documented) -> dict[str, Any]:
        apps.append(app)
        return openapi(app)

    monkeypatch.setattr(Documented, "openapi", counted)
    monkeypatch.setattr(Pool, "open", lambda _: go.wait(180))
    with TestClient(create_app(Settings())) as client:
        assert client.get("/healthz").json() == {"status": "alive"}
        answer = client.get("/readyz")
        assert answer.status_code == 503
        assert answer.headers["content-type"] == "application/problem+json"
        assert answer.headers["retry-after"] == "2"
        refused = client.post("/v1/optimize", json={})
        assert (refused.status_code, refused.json()["title"]) == (503, "Not ready")
        assert client.get("/v1/examples").status_code == 200
        go.set()
        wait_until(lambda: client.get("/readyz").status_code == 200)
        assert client.get("/readyz").json() == {"status": "ready"}
        assert client.post("/v1/optimize", json={}).status_code == 422
        # it takes longer than all else that is done before the service is ready
        assert apps == []
        first, second = (client.get("/openapi.json").json() for _ in range(2))
        assert (first, len(apps)) == (second, 1)


def test_what_is_loaded_is_no_garbage_to_look_through(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Pool, "open", lambda _: None)
    # what another test may have had taken out
    gc.unfreeze()
    gc.collect()
    before = len(gc.get_objects())
    try:
        with TestClient(create_app(Settings())) as client:
            wait_until(lambda: client.get("/readyz").status_code == 200)
            # all but what became garbage on the way
            assert gc.get_freeze_count() > 0.9 * before
            assert len(gc.get_objects()) < before / 10
    finally:
        gc.unfreeze()


def test_a_warm_up_that_fails_is_reported_and_logged(
    caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(_: Pool) -> None:
        raise RuntimeError("no solver in here")

    monkeypatch.setattr(Pool, "open", fail)
    with TestClient(create_app(Settings())) as client:
        wait_until(lambda: "could not be loaded" in client.get("/readyz").json()["detail"])
        answer = client.get("/readyz")
        assert answer.status_code == 503
        assert "retry-after" not in answer.headers
        assert "no solver in here" not in answer.text
        assert client.post("/v1/analyze", json={}).status_code == 503
        assert client.get("/healthz").status_code == 200
    assert "no solver in here" in caplog.text


def test_ready_means_database_and_disk_and_threads_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(readiness, "_LOOK_S", 0.05)
    monkeypatch.setattr(readiness, "_PATIENCE_S", 0.5)
    trouble: list[str] = []
    go = Event()

    def check() -> None:
        if trouble == ["no thread"]:
            go.wait(180)
        elif trouble:
            raise NotReady(trouble[0], retry_after_s=5)

    app = create_app(Settings(data_dir=tmp_path), warm=False)
    app.state.readiness._checks = {"one": check}
    with TestClient(app) as client:
        for text, expected in (("no disk", "no disk"), ("no thread", "No thread has answered within 0.5 s.")):
            wait_until(lambda: client.get("/readyz").status_code == 200)
            go.clear()
            trouble[:] = [text]
            # on a busy machine no thread may have answered first
            wait_until(lambda expected=expected: client.get("/readyz").json().get("detail") == expected)  # type: ignore[misc]
            answer = client.get("/readyz")
            assert (answer.status_code, answer.headers["retry-after"]) == (503, "5")
            # what needs no more than the solver goes on
            assert client.post("/v1/optimize", json={}).status_code == 422
            assert client.get("/healthz").status_code == 200
            trouble.clear()
            go.set()
        wait_until(lambda: client.get("/readyz").status_code == 200)


def test_what_is_needed(tmp_path: Path) -> None:
    needs.database(lambda: {})
    needs.disk(tmp_path / "not" / "yet", 0)
    with pytest.raises(NotReady, match="database"):
        needs.database(lambda: None)
    with pytest.raises(NotReady, match="MB are free"):
        needs.disk(tmp_path, 10**9)


def test_processes_that_are_stopped(tmp_path: Path) -> None:
    # a name that looks like the end of one, and like a state
    program = tmp_path / "x) T 1"
    program.symlink_to("/bin/sleep")
    processes = [subprocess.Popen([program, "600"]) for _ in range(2)]
    try:
        pids = [process.pid for process in processes]
        needs.workers(lambda: [])
        needs.workers(lambda: pids)
        os.kill(pids[0], signal.SIGSTOP)
        os.waitpid(pids[0], os.WUNTRACED)
        needs.workers(lambda: pids)
        with pytest.raises(NotReady, match="have been stopped"):
            needs.workers(lambda: pids[:1])
    finally:
        for command in processes:
            command.kill()
            command.wait()
    # they have ended
    needs.workers(lambda: pids)


def test_a_shutdown_does_not_wait_for_the_warm_up(monkeypatch: pytest.MonkeyPatch) -> None:
    go, ended = Event(), Event()

    def warm_up(_: Pool) -> None:
        go.wait(180)
        ended.set()

    monkeypatch.setattr(Pool, "open", warm_up)
    with TestClient(create_app(Settings())) as client:
        assert client.get("/healthz").status_code == 200
    assert not ended.is_set()
    go.set()
    assert ended.wait(180)


def test_the_service_is_loaded_without_the_optimiser() -> None:
    """Its workers have it; a quarter of the time until the service listens. In a process of its own."""
    code = "import sys; import service.app; print(*sys.modules)"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=300, check=True)
    assert {"sqlalchemy", "numpy", "pyarrow", "optimizer.optimize"} & set(ran.stdout.split()) == {"sqlalchemy"}
