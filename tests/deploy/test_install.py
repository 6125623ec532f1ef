"""How a list is installed: by uv, or by the pip that there is, and never without saying so."""

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
#: what is called says so, fails where the test says that it does, and brings what it is to bring
_PROGRAM = """#!/bin/sh
name=$(basename "$0")
echo "$name $*" >> "$CALLS"
case "$FAILS" in *"($name)"*) exit 1 ;; esac
case "$*" in
    *uv.txt) cp "$0" "$PROGRAMS/uv" ;;
    "-m ensurepip") cp "$0" "$PROGRAMS/pip3" ;;
esac
"""


def _calls(folder: Path, present: tuple[str, ...], fails: str, *arguments: str) -> tuple[list[str], str]:
    """What is called, and what is said, in an environment with these programs."""
    programs = folder / "env" / "bin"
    programs.mkdir(parents=True)
    for path in (folder / "machine", *(programs / name for name in ("python", *present))):
        path.write_text(_PROGRAM)
        path.chmod(0o755)
    calls = folder / "calls"
    machine = {"PYTHON": str(folder / "machine"), "PIP_INDEX_URL": "https://mirror"}
    environment = os.environ | machine | {"CALLS": str(calls), "FAILS": fails, "PROGRAMS": str(programs)}
    process = subprocess.run(
        [ROOT / "deploy/install.sh", folder / "env", *arguments],
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    return [line.replace(str(folder), "") for line in calls.read_text().splitlines()], process.stdout


def test_a_list_is_installed_by_uv_which_the_pip_beside_brings(tmp_path: Path) -> None:
    calls, _ = _calls(tmp_path, (), "", "list.txt")
    # pip is asked for its mirror at the same time
    (brought,) = (call for call in calls if call.endswith("deploy/uv.txt"))
    assert brought.startswith("machine -m pip --python /env/bin/python")
    assert "--require-hashes --requirement" in brought
    assert calls[-1].startswith("uv pip install --python /env/bin/python")


def test_uv_that_is_there_installs_by_hash(tmp_path: Path) -> None:
    calls, answers = _calls(tmp_path, ("uv",), "", "list.txt")
    options = "--no-deps --require-hashes --requirement list.txt"
    assert calls[-1] == f"uv pip install --python /env/bin/python --no-progress {options}"
    assert answers == ""


def test_a_checkout_is_installed_where_it_lies(tmp_path: Path) -> None:
    calls, _ = _calls(tmp_path, ("uv",), "", "--editable", ".")
    (call,) = calls  # pip is not even asked for its mirror
    assert call.endswith("--quiet --no-deps --no-build-isolation --editable .")


def test_uv_is_told_of_the_mirror_of_pip(tmp_path: Path) -> None:
    programs = tmp_path / "env" / "bin"
    programs.mkdir(parents=True)
    for name, script in (
        ("pip", "echo \"global.cert='/x'\nglobal.index-url='https://pip.of/mirror'\""),
        ("uv", 'echo "$UV_DEFAULT_INDEX"'),
    ):
        (programs / name).write_text(f"#!/bin/sh\n{script}\n")
        (programs / name).chmod(0o755)
    fields = {name: value for name, value in os.environ.items() if name not in ("PIP_INDEX_URL", "UV_DEFAULT_INDEX")}
    command = [ROOT / "deploy/install.sh", tmp_path / "env", "list.txt"]
    assert (
        subprocess.run(command, env=fields, capture_output=True, text=True, check=True).stdout
        == "https://pip.of/mirror\n"
    )


@pytest.mark.parametrize("arguments", [("list.txt",), ("--editable", ".")])
def test_without_uv_pip_installs_the_same_and_it_is_said(tmp_path: Path, arguments: tuple[str, ...]) -> None:
    calls, answers = _calls(tmp_path, ("uv", "pip"), "(uv)", *arguments)
    assert calls[-1].startswith("pip --disable-pip-version-check install ")
    assert calls[-1].endswith(" ".join(arguments))
    assert answers.startswith("without uv: pip installs")


def test_where_no_pip_is_the_environment_gets_its_own(tmp_path: Path) -> None:
    calls, answers = _calls(tmp_path, ("uv",), "(machine)(uv)", "list.txt")
    assert "python -m ensurepip" in calls
    assert calls[-1].startswith("pip3 --disable-pip-version-check install ")
    assert answers.startswith("without uv")
