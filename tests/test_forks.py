"""Tests in several processes: what they report, and what is said of a process that ends."""

import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ET
from pathlib import Path

import psutil
import pytest

from tests.distribution import TESTS

_FIXTURES = """
import os, pathlib, pytest
HERE = pathlib.Path(__file__).parent

def note(what):
    with open(HERE / "notes", "a") as notes:
        notes.write(f"{what} {os.getpid()}\\n")

@pytest.fixture(scope="session", autouse=True)
def whole():
    note("begin")
    yield
    note("end")

@pytest.fixture(scope="module")
def place(request, tmp_path_factory):
    note(f"module {request.node.name} {os.environ['COUNTERWEIGHT_DATA_DIR']} {tmp_path_factory.getbasetemp()}")
"""
_FILES = {
    "test_first.py": """
import pytest, threading, time, warnings

def test_thread_left():
    threading.Thread(target=time.sleep, args=(600,)).start()

@pytest.mark.parametrize("number", range(5))
def test_number(number, place):
    print("what is printed by", number)
    assert number != 3

def test_warning(place):
    warnings.warn("beware of this", UserWarning)
""",
    "test_second.py": """
import os, signal, time

def test_before(place):
    pass

def test_killed(place):
    os.kill(os.getpid(), signal.SIGKILL)

def test_after(place):
    pass

def test_left(place):
    # what it has forked has its connection, and stays
    if (pid := os.fork()) == 0:
        time.sleep(600)
    with open(__file__ + ".left", "w") as left:
        left.write(str(pid))
    os._exit(7)
""",
}


def pytest_run(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    # no pipes, as processes that are left would hold them open
    with tempfile.TemporaryFile("w+") as out:
        files = {"stdout": out, "stderr": out}
        environment = {**os.environ, **_ALONE}
        ended = subprocess.run(command(folder, *arguments), cwd=TESTS.parent, env=environment, timeout=300, **files)
        out.seek(0)
        return subprocess.CompletedProcess(ended.args, ended.returncode, out.read())


#: plugins of installed packages take longer to load than all that these runs do
_ALONE = {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}


def command(folder: Path, *arguments: str) -> list[str]:
    own = ["-p", "tests.forks", "-p", "no:cacheprovider"]
    return [sys.executable, "-m", "pytest", *own, "-c", os.devnull, "--rootdir", str(folder), *arguments, str(folder)]


def written(folder: Path, files: dict[str, str]) -> Path:
    folder.mkdir()
    for name, text in files.items():
        (folder / name).write_text(text)
    return folder


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return written(tmp_path_factory.mktemp("run") / "tests", {"conftest.py": _FIXTURES, **_FILES})


@pytest.fixture(scope="module")
def result(folder: Path) -> subprocess.CompletedProcess[str]:
    """Of a run of seven tests in one file, one of which fails, and of four in another, two of which end processes."""
    process = pytest_run(folder, "-n", "2", "-v", "--durations=0", "-vv", f"--junitxml={folder / 'report.xml'}")
    os.kill(int((folder / "test_second.py.left").read_text()), signal.SIGKILL)
    return process


def test_all_is_reported_once(result: subprocess.CompletedProcess[str]) -> None:
    assert result.returncode == pytest.ExitCode.TESTS_FAILED
    assert "3 failed, 8 passed" in result.stdout
    assert result.stdout.count("UserWarning: beware of this") == 1
    verdicts = re.findall(r"(test_\w+\.py::\S+) (PASSED|FAILED)", result.stdout)
    assert len(verdicts) == 11
    assert {name for name, verdict in verdicts if verdict == "FAILED"} == {
        "test_first.py::test_number[3]", "test_second.py::test_killed", "test_second.py::test_left",
    }  # fmt: skip


def test_what_failed_shows_its_reason_and_what_it_printed(result: subprocess.CompletedProcess[str]) -> None:
    assert "assert 3 != 3" in result.stdout
    assert "what is printed by 3" in result.stdout
    assert "what is printed by 2" not in result.stdout
    assert "UserWarning: beware of this" in result.stdout
    assert re.search(r"\d\.\d\ds call +test_first.py::test_number\[2\]", result.stdout)


def test_how_a_process_has_ended_is_said_of_its_test(result: subprocess.CompletedProcess[str]) -> None:
    matches = re.findall(r"the process of this test has ended: (.*)", result.stdout)
    assert {"SIGKILL", "exit code 7"} <= set(matches)


def test_reports_are_written(result: subprocess.CompletedProcess[str], folder: Path) -> None:
    suite = ET.parse(folder / "report.xml").getroot()[0]
    assert (suite.get("tests"), suite.get("failures"), suite.get("errors")) == ("11", "3", "0")


def test_fixtures_are_shared_within_a_process_and_end_with_it(
    result: subprocess.CompletedProcess[str], folder: Path
) -> None:
    notes = [line.split() for line in (folder / "notes").read_text().splitlines()]
    begun = [pid for action, *_, pid in notes if action == "begin"]
    ended = [pid for action, *_, pid in notes if action == "end"]
    # the second file needs three, two of which come to no end
    assert len(begun) == len(set(begun)) == 3
    assert len(ended) == 1
    assert set(ended) < set(begun)
    modules = [line for line in notes if line[0] == "module"]
    assert sorted(line[1] for line in modules) == ["test_first.py", "test_second.py", "test_second.py"]
    assert len({line[2] for line in modules}) == len({line[3] for line in modules}) == 3


def test_the_rest_of_a_long_file_is_shared(tmp_path: Path) -> None:
    text = """
import os, pathlib, pytest, time
HERE = pathlib.Path(__file__).parent

@pytest.mark.parametrize("number", range(40))
def test_number(number):
    (HERE / f"of-{os.getpid()}").touch()
    # the first waits for the other process
    while number == 0 and len(list(HERE.glob("of-*"))) < 2:
        time.sleep(0.02)
"""
    folder = written(tmp_path / "tests", {"test_a.py": text})
    result = pytest_run(folder, "-n", "2")
    assert "40 passed" in result.stdout
    assert len(list(folder.glob("of-*"))) == 2


def test_a_run_stops_after_the_first_failure(tmp_path: Path) -> None:
    many = "\n".join(f"def test_{number}(): pass" for number in range(50))
    folder = written(tmp_path / "tests", {"test_a.py": "def test_wrong(): assert False\n" + many})
    result = pytest_run(folder, "-n", "1", "-x")
    assert result.returncode == pytest.ExitCode.TESTS_FAILED
    assert "stopping after 1 failures" in result.stdout
    # the next was sent already
    assert "1 failed, 1 passed" in result.stdout


def test_an_error_of_the_run_itself_is_told(tmp_path: Path) -> None:
    hook = "def pytest_runtest_logstart(nodeid): raise RuntimeError('no such plugin')"
    folder = written(tmp_path / "tests", {"conftest.py": hook, "test_a.py": "def test_a(): pass"})
    result = pytest_run(folder, "-n", "1")
    assert result.returncode != pytest.ExitCode.OK
    assert "RuntimeError: no such plugin" in result.stdout


def test_a_process_with_threads_is_not_forked(tmp_path: Path) -> None:
    text = "import threading, time\nthreading.Thread(target=time.sleep, args=(1,)).start()\ndef test_a(): pass"
    result = pytest_run(written(tmp_path / "tests", {"test_a.py": text}), "-n", "1")
    assert result.returncode == pytest.ExitCode.INTERNAL_ERROR
    assert "of several threads a fork has one" in result.stdout


_ENDLESS = """
import pathlib, time

def test_endless():
    pathlib.Path(__file__).with_suffix(".on").touch()
    time.sleep(600)
"""


def test_processes_end_with_the_first(tmp_path: Path) -> None:
    folder = written(tmp_path / "tests", {"test_a.py": _ENDLESS, "test_b.py": _ENDLESS})
    environment = {**os.environ, **_ALONE}
    run_command = command(folder, "-n", "2")
    with subprocess.Popen(run_command, cwd=TESTS.parent, env=environment, stdout=subprocess.DEVNULL) as run:
        processes: list[psutil.Process] = []
        try:
            deadline = time.monotonic() + 60
            while len(list(folder.glob("*.on"))) < 2:
                assert run.poll() is None
                assert time.monotonic() < deadline
                time.sleep(0.02)
            processes += psutil.Process(run.pid).children()
            assert len(processes) == 2
        finally:
            run.kill()
        assert psutil.wait_procs(processes, 60)[1] == []
