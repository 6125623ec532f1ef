"""TypeScript and C#: the examples of docs/clients.md run against a service, and wait for one that is in trouble."""

import os
import re
import shutil
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

from tests.clients.conftest import ROOT
from tests.clients.mono import MISSING, installed

_WRITTEN = "http://127.0.0.1:8000"
#: Mono may abort once Main has returned: a thread of its pool still hands on what came of a socket. All is printed then
_MONO_ABORTED = "* Assertion at mono-threads.c"
_MONO = ["-r:System.Net.Http", "-r:System.Runtime.Serialization"]


def example(language: str) -> tuple[str, str]:
    """Code of a language, and what it prints."""
    match = re.search(
        rf"```{language}\n(.*?)```\n\n```text\n(.*?)```", (ROOT / "docs/clients.md").read_text(), re.DOTALL
    )
    assert match is not None
    return match[1], match[2]


def ran(language: str, code: str, folder: Path) -> str:
    """What a program prints."""
    if language == "typescript":
        deno = Path(sys.executable).with_name("deno")
        shutil.copy(ROOT / "examples/typescript/counterweight.ts", folder)
        (folder / "program.ts").write_text(code)
        command = [str(deno), "run", "--no-check", "--no-remote", "--allow-net=127.0.0.1", "program.ts"]
    else:
        if not installed():
            pytest.skip(MISSING)
        (folder / "Program.cs").write_text(code)
        helper = ROOT / "examples/csharp/Counterweight.cs"
        subprocess.run(["mcs", *_MONO, "Program.cs", helper, "-out:program.exe"], cwd=folder, check=True, timeout=120)
        command = ["mono", "program.exe"]
    environment = {**os.environ, "DENO_NO_UPDATE_CHECK": "1", "DENO_DIR": str(folder / "deno")}
    process = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, timeout=180, check=False
    )
    text, aborted, _ = process.stdout.partition(_MONO_ABORTED)
    assert process.returncode == (-signal.SIGABRT if aborted else 0), process.stderr
    return text


@pytest.mark.parametrize("language", ["typescript", "csharp"])
def test_the_examples_print_what_stands_below_them(language: str, url: str, tmp_path: Path) -> None:
    code, answer = example(language)
    assert ran(language, code.replace(_WRITTEN, url), tmp_path) == answer


# ---- a service in trouble


class _Trouble(BaseHTTPRequestHandler):
    """Busy at first; cuts the first POST off unanswered, and the stream of events after each event."""

    seen: list[tuple[str, str]]
    protocol_version = "HTTP/1.1"

    def do_GET(self) -> None:
        if self.path.endswith("/events"):
            last = self.headers.get("Last-Event-ID", "")
            self.seen.append(("events", last))
            self._stream(b"id: 2\ndata: %b\n\n" % _job("done") if last else b"id: 1\ndata: %b\n\n" % _job("running"))
        elif self.path.endswith("/results"):
            self._answer(200, b'{"right": true}')
        elif not any(kind == "busy" for kind, _ in self.seen):
            self.seen.append(("busy", self.path))
            self._answer(503, b"{}", {"Retry-After": "1"})
        else:
            self._answer(200, b"{}")

    def do_POST(self) -> None:
        self.rfile.read(int(self.headers["Content-Length"]))
        self.seen.append(("post", self.headers["Idempotency-Key"]))
        if sum(kind == "post" for kind, _ in self.seen) == 1:
            self.close_connection = True
            return
        self._answer(202, _job("queued"))

    def _answer(self, status: int, body: bytes, headers: dict[str, str] | None = None) -> None:
        self.send_response(status)
        for name, value in {"Content-Type": "application/json", **(headers or {})}.items():
            self.send_header(name, value)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def _stream(self, body: bytes) -> None:
        self.send_response(200)
        self.send_header("Content-Type", "text/event-stream")
        self.send_header("Connection", "close")
        self.end_headers()
        self.wfile.write(body)
        self.close_connection = True

    def log_message(self, *_: object) -> None:
        return


def _job(state: str) -> bytes:
    return b'{"id": "1", "state": "%b", "links": {"self": "/job", "results": "/job/results"}}' % state.encode()


@pytest.fixture
def trouble() -> Iterator[ThreadingHTTPServer]:
    _Trouble.seen = []
    with ThreadingHTTPServer(("127.0.0.1", 0), _Trouble) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield server
        server.shutdown()


PROGRAMS = {
    "typescript": """
import { Service } from "./counterweight.ts";
const service = new Service("%s");
await service.send("/v1/version");
const job = await service.later("/v1/pareto", {});
console.log(JSON.stringify(await service.result(job)));
""",
    "csharp": """
using System;
using System.Net.Http;
using System.Threading.Tasks;
public static class Program
{
    public static void Main() => Run().GetAwaiter().GetResult();
    private static async Task Run()
    {
        var client = new HttpClient(new Patient()) { BaseAddress = new Uri("%s") };
        await client.GetStringAsync("/v1/version");
        var job = await client.Later("/v1/pareto", "{}");
        Console.WriteLine(await client.Result(job));
    }
}
""",
}


@pytest.mark.parametrize("language", PROGRAMS)
def test_a_service_in_trouble_is_waited_for(language: str, trouble: ThreadingHTTPServer, tmp_path: Path) -> None:
    where = f"http://127.0.0.1:{trouble.server_address[1]}"
    printed = ran(language, PROGRAMS[language].replace("%s", where), tmp_path)
    assert printed.replace(" ", "").strip() == '{"right":true}'
    keys = [key for kind, key in _Trouble.seen if kind == "post"]
    # what was cut off was sent again, as the same call
    assert len(keys) == 2
    assert len(set(keys)) == 1
    assert keys[0]
    # the stream went on after the event that had arrived
    assert [last for kind, last in _Trouble.seen if kind == "events"] == ["", "1"]
    assert [kind for kind, _ in _Trouble.seen].count("busy") == 1
