"""Commands that are forked behave as those that are started from nothing."""

import json
import os
import signal
import subprocess
from multiprocessing import Pipe, get_context
from multiprocessing.connection import Connection
from pathlib import Path

import psutil
import pytest

from tests.commands import Command, run

PIPES = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}


@pytest.mark.parametrize("fresh", [False, True])
def test_streams_arguments_and_the_end_are_its_own(fresh: bool) -> None:
    with Command("json.tool", "--compact", fresh=fresh, **PIPES) as command:
        assert command.communicate('{"a": [1, "µ"]}', timeout=180) == ('{"a":[1,"\\u00b5"]}\n', "")
    assert command.returncode == 0
    with Command("json.tool", fresh=fresh, **PIPES) as command:
        out, err = command.communicate("[", timeout=180)
    assert (command.returncode, out, "Expecting value" in err) == (1, "", True)


def test_settings_are_its_own() -> None:
    line = "COUNTERWEIGHT_NOBODY_KNOWS: "
    refused = run("service", "serve", environment={**os.environ, "COUNTERWEIGHT_NOBODY_KNOWS": "1"})
    assert (refused.returncode, refused.stdout, line in refused.stderr) == (2, "", True)
    process = run("service", "schema", "optimize")
    assert json.loads(process.stdout)["title"] == "Optimize request"
    assert (process.returncode, process.stderr) == (0, "")


@pytest.mark.parametrize("ending", [signal.SIGTERM, signal.SIGKILL])
def test_signals_end_it(ending: signal.Signals) -> None:
    with Command("json.tool", **PIPES) as command:
        assert command.poll() is None
        command.send_signal(ending)
        assert command.wait(180) == -ending


def test_processes_that_are_forked_share_what_commands_are_forked_from() -> None:
    def says(connection: Connection) -> None:
        with Command("json.tool", **PIPES) as command:
            parent = psutil.Process(command.pid).ppid()
            command.communicate("[", timeout=180)
        connection.send((parent, command.returncode))

    ours, theirs = Pipe()
    says(theirs)
    process = get_context("fork").Process(target=says, args=(theirs,))
    process.start()
    process.join(180)
    first, second = ours.recv(), ours.recv()
    assert first == second
    assert "tests.mould" in " ".join(psutil.Process(first[0]).cmdline())


def test_what_is_told_to_an_interpreter_starts_one() -> None:
    def started(**environment: str) -> str:
        with Command("json.tool", environment={**os.environ, **environment}, **PIPES) as command:
            text = " ".join(psutil.Process(command.pid).cmdline())
            command.communicate("{}", timeout=180)
        return text

    assert "tests.mould" in started(COUNTERWEIGHT_LOG_LEVEL="debug")
    assert "tests.mould" not in started(PYTHONPATH="/nowhere")


def test_the_folder_of_its_temporary_files_may_have_any_name(tmp_path: Path) -> None:
    # addresses of sockets that are files have 107 characters at most
    folder = tmp_path / ("x" * 100)
    folder.mkdir()
    process = run("service", "schema", "optimize", environment={**os.environ, "TMPDIR": str(folder)})
    assert (process.returncode, process.stderr) == (0, "")
